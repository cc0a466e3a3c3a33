#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "view/stage.h"

namespace tera {

/// Machines and objects of a simulated recording. `moved` as in LoadRecordedScenario. Throws
/// InputError for a real recording, and if the scenario or one of its files is unreadable.
Stage StageOfRecording(const std::filesystem::path& recording,
                       const std::vector<std::string>& moved);

}  // namespace tera
