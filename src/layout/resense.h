#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/run/generate.h"

namespace tera {

/// A rig that a recorded scene is to be measured with.
struct ResenseRig {
  std::filesystem::path file;
  std::string machine;  ///< that carries it; empty: the first one of the scenario
};

/// Measures the scene of `dataset`, whose state was kept (`tera generate --keep-state`), with
/// another rig, and writes to `options.out` the dataset that the same run would have given with
/// that rig, to the byte: neither physics nor soil runs. What really happened is taken over as it
/// is, the rigs of other machines measure anew.
///
/// Throws InputError as LoadRecordedScenario, StatePlayback, DatasetWriter and Rasterizer do.
GenerateReport Resense(const std::filesystem::path& dataset, const ResenseRig& rig,
                       const std::vector<std::string>& moved, const GenerateOptions& options);

}  // namespace tera
