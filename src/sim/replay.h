#pragma once

#include <filesystem>

#include "sim/scenario.h"

namespace tera {

/// Gives `scenario` the commands of a simulated recording of it: every machine obeys its
/// commands.csv there instead of its operator, and the run lasts as long as the recording. Throws
/// InputError where the recording is real or incomplete, or its commands do not fit the machines.
void CommandAsRecorded(const std::filesystem::path& recording, Scenario* scenario);

}  // namespace tera
