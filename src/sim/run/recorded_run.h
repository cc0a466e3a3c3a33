#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/scenario/load_scenario.h"

namespace tera {

/// The scenario of a simulated recording, resolved again from its unchanged input files.
/// `overrides` (key.path=value) are applied on top. `moved` and the errors are as in
/// LoadRecordedRun.
LoadedScenario LoadRecordedScenario(const std::filesystem::path& directory,
                                    const std::vector<std::string>& overrides,
                                    const std::vector<std::string>& moved);

/// The scenario of a simulated recording, with machines that obey the recorded commands. An
/// interrupted run is loaded up to its last recorded state. Inputs keep their recorded names.
///
/// An entry of `moved` has the form OLD=NEW. An input that dataset.yaml lists as OLD, or in the
/// folder OLD, is then read from NEW.
///
/// Throws  InputError if the recording is a real one, or if an input is missing, has changed, or
///         was not read by the recorded run.
LoadedScenario LoadRecordedRun(const std::filesystem::path& directory,
                               const std::vector<std::string>& moved);

/// Throws InputError if the dataset `out`, or its incomplete version, would be at or inside
/// `recording`. The recording may be the only copy of the run.
void RequireAnotherPlace(const std::filesystem::path& recording, const std::filesystem::path& out);

}  // namespace tera
