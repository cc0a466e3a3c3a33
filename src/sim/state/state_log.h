#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "dataset/files/block_file.h"
#include "sim/scenario/scenario.h"
#include "sim/state/packed_series.h"
#include "sim/state/packed_terrain.h"
#include "sim/state/terrain_changes.h"
#include "sim/world_state.h"

namespace tera {

/// Optional file of a dataset with the evolution of its scene.
inline constexpr char kStateFile[] = "truth/state.blocks";

/// Records the evolution of a scene, so that other sensors can measure it without physics and soil
/// (StatePlayback). It contains all moving bodies at each physics step and all changes of the
/// visible ground, without loss.
///
/// Model   a file of blocks (dataset/files/block_file.h), each for one second. A block contains the
///         numbers of each step (state_rows.h) as a packed series, then the changes of the ground.
///         The header contains the version and identifies the scenario.
class StateLog {
 public:
  /// `state` is the state at the start of the run. `resolved_yaml` is the scenario's text in the
  /// dataset. Keeps a reference to `scenario`.
  StateLog(const Scenario& scenario, const std::string& resolved_yaml,
           const std::filesystem::path& file, const WorldState& state);

  /// Adds the world after a further step.
  void Add(const WorldState& state);
  /// Completes the file. Must be called after the last step.
  void Commit();
  std::int64_t bytes() const { return file_.bytes(); }

 private:
  void AddRow(const WorldState& state);
  void WriteBlock();

  const Scenario& scenario_;
  BlockFileWriter file_;
  PackedSeries series_;
  std::vector<double> rows_;
  std::size_t count_ = 0;
  TerrainTracker tracker_;
  TerrainPacker terrain_;
};

/// Throws InputError if the dataset contains no state.
void RequireState(const std::filesystem::path& dataset);

/// The header of a scenario's state file.
std::string StateHeader(const std::string& resolved_yaml, std::size_t columns);

}  // namespace tera
