#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/run/generate.h"

namespace tera {

/// A rig that measures a recorded scene.
struct ResenseRig {
  std::filesystem::path file;
  std::string machine;  ///< machine that carries it; empty: the first of the scenario
};

/// Measures the scene of `dataset` with another rig. The dataset must have its state (`tera
/// generate --keep-state`). Writes to `options.out` the dataset that the same run would give with
/// that rig, byte for byte. Physics and soil do not run. The truth is copied; the rigs of other
/// machines measure again.
///
/// Throws  InputError as LoadRecordedScenario, StatePlayback, DatasetWriter and Rasterizer do.
GenerateReport Resense(const std::filesystem::path& dataset, const ResenseRig& rig,
                       const std::vector<std::string>& moved, const GenerateOptions& options);

}  // namespace tera
