#pragma once

#include <filesystem>

#include "dataset/format/recording.h"
#include "sim/scenario/scenario.h"

namespace tera {

/// Throws InputError for a real recording.
void RequireSimulated(const Recording& recording);

/// Replaces the operators of `scenario` by the commands of its recording (commands.csv). Sets the
/// duration to that of the recording.
///
/// Throws  InputError if the commands do not fit the machines.
void CommandAsRecorded(const Recording& recording, Scenario* scenario);

/// As CommandAsRecorded, for an interrupted recording (WasStopped). The run ends at the last time
/// for which the commands of all machines are on disk.
///
/// Throws  InputError if they do not fit, or if there are none.
void CommandAsFarAsRecorded(const std::filesystem::path& directory, Scenario* scenario);

}  // namespace tera
