#pragma once

#include <filesystem>

#include "dataset/format/recording.h"
#include "sim/scenario/scenario.h"

namespace tera {

/// Throws InputError where the recording is a real one.
void RequireSimulated(const Recording& recording);

/// Gives `scenario` the commands of a simulated recording of it: every machine obeys its
/// commands.csv there instead of its operator, and the run lasts as long as the recording. Throws
/// InputError where the commands do not fit the machines.
void CommandAsRecorded(const Recording& recording, Scenario* scenario);

/// Gives `scenario` the commands of a run that was stopped (WasStopped), as far as those of every
/// machine had come to the disk: the run ends there. Throws InputError where they do not fit, or
/// where there are none yet.
void CommandAsFarAsRecorded(const std::filesystem::path& directory, Scenario* scenario);

}  // namespace tera
