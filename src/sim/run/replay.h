#pragma once

#include <filesystem>

#include "dataset/format/recording.h"
#include "sim/scenario/scenario.h"

namespace tera {

/// Throws InputError for a real recording.
void RequireSimulated(const Recording& recording);

/// Replaces the operators of `scenario` by the commands of a simulated recording of it
/// (commands.csv). The run lasts as long as the recording.
///
/// Throws  InputError if the commands do not fit the machines.
void CommandAsRecorded(const Recording& recording, Scenario* scenario);

/// The same with the commands of a stopped run (WasStopped), up to the last time for which every
/// machine's commands are on disk. The run ends there.
///
/// Throws  InputError if they do not fit, or if there are none yet.
void CommandAsFarAsRecorded(const std::filesystem::path& directory, Scenario* scenario);

}  // namespace tera
