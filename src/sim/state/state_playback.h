#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/types/terrain_surface.h"
#include "dataset/files/block_file.h"
#include "sim/scenario/scenario.h"
#include "sim/state/packed_series.h"
#include "sim/state/packed_terrain.h"
#include "sim/world_state.h"

namespace tera {

/// A scene as it evolved in a run whose state was kept (StateLog), step by step, without physics
/// and soil: to the bit what the sensors of that run saw.
///
/// Omits   what no sensor measures: see state_rows.h.
class StatePlayback {
 public:
  /// Stands at the start of the run. Keeps a reference to `scenario`, which may have other sensors
  /// than the run had; `resolved_yaml` is the text of the run's own scenario. Throws InputError
  /// where the file is missing, damaged, of another version or of another scenario, as Step does.
  StatePlayback(const Scenario& scenario, const std::string& resolved_yaml,
                const std::filesystem::path& file);
  StatePlayback(Scenario&&, const std::string&, const std::filesystem::path&) = delete;

  /// Goes on by one step of the physics. False at the end of the run, behind which there is one
  /// step more, as Run::Finish takes it.
  bool Step();

  WorldStep last_step() const { return {previous_, state_, ground_}; }
  const Instant& state() const { return state_; }
  const TerrainSurface& ground() const { return ground_; }

 private:
  bool LoadBlock();
  [[noreturn]] void Fail(const std::string& finding) const;
  void Advance(double dt_s);

  const Scenario& scenario_;
  std::filesystem::path path_;
  BlockFileReader file_;
  PackedSeries series_;
  TerrainUnpacker terrain_;
  std::vector<double> rows_;  ///< of the block at hand
  std::size_t columns_, count_ = 0, next_ = 0;
  std::int64_t step_ = 0;
  Instant previous_, state_;
  TerrainSurface ground_;
};

}  // namespace tera
