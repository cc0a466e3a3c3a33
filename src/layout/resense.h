#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/run/generate.h"

namespace tera {

/// A rig to measure a recorded scene with.
struct ResenseRig {
  std::filesystem::path file;
  std::string machine;  ///< machine that carries it; empty: the scenario's first
};

/// Measures the scene of `dataset` again, with another rig. The dataset must contain its state
/// (`tera generate --keep-state`). Physics and soil are played back, not simulated. The resulting
/// dataset in `options.out` equals, byte for byte, that of a full run with the new rig. The truth
/// is copied; the rigs of other machines measure again too. `moved` as in LoadRecordedScenario.
///
/// Throws  InputError as LoadRecordedScenario, StatePlayback, DatasetWriter and Rasterizer do.
GenerateReport Resense(const std::filesystem::path& dataset, const ResenseRig& rig,
                       const std::vector<std::string>& moved, const GenerateOptions& options);

}  // namespace tera
