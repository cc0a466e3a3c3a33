#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/scenario/load_scenario.h"

namespace tera {

/// The scenario of a simulated recording as it was read from input files that are what they were,
/// but for `overrides` (key.path=value), with which the text is resolved anew. Otherwise as
/// LoadRecordedRun.
LoadedScenario LoadRecordedScenario(const std::filesystem::path& directory,
                                    const std::vector<std::string>& overrides,
                                    const std::vector<std::string>& moved);

/// The scenario of a simulated recording, whose machines obey the recorded commands, from input
/// files that are what they were; also of a run that was stopped, as far as it came. What the
/// scenario reads keeps the names that the recording gave. `moved` are texts OLD=NEW: an input that
/// dataset.yaml lists as OLD, or below the folder OLD, is now at NEW. Throws InputError where an
/// input is missing, has changed or was not read by the recorded run, and where the recording is a
/// real one.
LoadedScenario LoadRecordedRun(const std::filesystem::path& directory,
                               const std::vector<std::string>& moved);

/// Throws InputError where a dataset at `out`, or its incomplete one, would be written to the
/// recording that is replayed or inside it: the recording may be all that is left of the run.
void RequireAnotherPlace(const std::filesystem::path& recording, const std::filesystem::path& out);

}  // namespace tera
