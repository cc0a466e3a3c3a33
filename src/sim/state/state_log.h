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

/// Where a dataset keeps the evolution of its scene, if it does.
inline constexpr char kStateFile[] = "truth/state.blocks";

/// Keeps how a scene evolved, so that other sensors can measure it without physics and soil
/// (StatePlayback): everything that moves, at every step of the physics, and every change of the
/// visible ground, without loss.
///
/// Model   a file of blocks (dataset/files/block_file.h) of a second each. Numbers of a step as
///         state_rows.h says, packed as a series; changes of the ground beside those numbers. The
///         header says the version and of which scenario it is.
class StateLog {
 public:
  /// `state` is that of the run's start. Keeps a reference to `scenario`; `resolved_yaml` is its
  /// text in the dataset.
  StateLog(const Scenario& scenario, const std::string& resolved_yaml,
           const std::filesystem::path& file, const WorldState& state);

  /// The world after one more step.
  void Add(const WorldState& state);
  /// After the last step.
  void Commit();
  std::int64_t bytes() const { return file_.bytes(); }

 private:
  void AddRow(const WorldState& state);
  void WriteBlock();

  const Scenario& scenario_;
  BlockFileWriter file_;
  PackedSeries series_;
  std::vector<double> rows_;
  std::size_t count_ = 0;  ///< of rows
  TerrainTracker tracker_;
  TerrainPacker terrain_;
};

/// Throws InputError where the state of a dataset was not kept.
void RequireState(const std::filesystem::path& dataset);

/// The header of a scenario's state file.
std::string StateHeader(const std::string& resolved_yaml, std::size_t columns);

}  // namespace tera
