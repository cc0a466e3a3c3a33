#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "view/stage.h"

namespace tera {

/// Machines and things of the scene that a simulated recording was made in. `moved` as of
/// LoadRecordedScenario. Throws InputError where the recording is a real one, or where its scenario
/// or one of its files cannot be read.
Stage StageOfRecording(const std::filesystem::path& recording,
                       const std::vector<std::string>& moved);

}  // namespace tera
