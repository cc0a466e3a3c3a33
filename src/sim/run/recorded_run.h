#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/scenario/load_scenario.h"

namespace tera {

/// The scenario of a simulated recording, resolved again from its unchanged input files, with
/// `overrides` (key.path=value) on top. `moved` and the errors are as in LoadRecordedRun.
LoadedScenario LoadRecordedScenario(const std::filesystem::path& directory,
                                    const std::vector<std::string>& overrides,
                                    const std::vector<std::string>& moved);

/// The scenario of a simulated recording from unchanged input files, with machines that obey the
/// recorded commands. A stopped run is read up to its last state. Inputs keep their recorded names.
/// `moved` are texts OLD=NEW: an input that dataset.yaml lists as OLD, or below the folder OLD, is
/// found at NEW.
///
/// Throws  InputError if an input is missing, has changed or was not read by the recorded run, and
///         if the recording is a real one.
LoadedScenario LoadRecordedRun(const std::filesystem::path& directory,
                               const std::vector<std::string>& moved);

/// Throws InputError if a dataset at `out`, or its incomplete one, would lie at or inside the
/// replayed recording. The recording may be the only copy of the run.
void RequireAnotherPlace(const std::filesystem::path& recording, const std::filesystem::path& out);

}  // namespace tera
