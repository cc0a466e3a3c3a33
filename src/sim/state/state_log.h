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

/// A dataset's optional file with the evolution of its scene.
inline constexpr char kStateFile[] = "truth/state.blocks";

/// Records a scene's evolution, so that other sensors can measure it without physics and soil
/// (StatePlayback). It keeps all moving bodies at every step of the physics and every change of the
/// visible ground, without loss.
///
/// Model   a file of blocks (dataset/files/block_file.h) of a second each. The numbers of a step
///         (state_rows.h) are packed as a series, followed by the changes of the ground. The header
///         has the version and identifies the scenario.
class StateLog {
 public:
  /// `state` is the state at the run's start. Keeps a reference to `scenario`; `resolved_yaml` is
  /// its text in the dataset.
  StateLog(const Scenario& scenario, const std::string& resolved_yaml,
           const std::filesystem::path& file, const WorldState& state);

  /// Adds the world after one more step.
  void Add(const WorldState& state);
  /// Call after the last step.
  void Commit();
  std::int64_t bytes() const { return file_.bytes(); }

 private:
  void AddRow(const WorldState& state);
  void WriteBlock();

  const Scenario& scenario_;
  BlockFileWriter file_;
  PackedSeries series_;
  std::vector<double> rows_;
  std::size_t count_ = 0;  ///< number of rows
  TerrainTracker tracker_;
  TerrainPacker terrain_;
};

/// Throws InputError if the dataset has no state.
void RequireState(const std::filesystem::path& dataset);

/// The header of a scenario's state file.
std::string StateHeader(const std::string& resolved_yaml, std::size_t columns);

}  // namespace tera
