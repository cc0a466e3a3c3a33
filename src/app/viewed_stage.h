#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "view/stage.h"

namespace tera {

/// Machines and objects of the scene of a simulated recording. `moved` as in LoadRecordedScenario.
/// Throws InputError for a real recording, and for an unreadable scenario or file.
Stage StageOfRecording(const std::filesystem::path& recording,
                       const std::vector<std::string>& moved);

}  // namespace tera
