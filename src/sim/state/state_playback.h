#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/types/terrain_surface.h"
#include "dataset/files/block_file.h"
#include "sim/scenario/scenario.h"
#include "sim/state/packed_series.h"
#include "sim/state/packed_terrain.h"
#include "sim/world_state.h"

namespace tera {

/// Plays a recorded scene (StateLog) step by step, without physics and soil. Everything that
/// sensors see equals the original run bit for bit.
///
/// Omits   quantities that no sensor measures: see state_rows.h.
class StatePlayback {
 public:
  /// Begins at the start of the run. `scenario` may have other sensors than the run; the object
  /// keeps a reference to it. `resolved_yaml` is the text of the run's own scenario.
  ///
  /// Throws  InputError if the file is missing, damaged, of another version or of another scenario.
  ///         Step throws likewise.
  StatePlayback(const Scenario& scenario, const std::string& resolved_yaml,
                const std::filesystem::path& file);
  StatePlayback(Scenario&&, const std::string&, const std::filesystem::path&) = delete;

  /// Advances by one physics step. Returns false when the recording is over. It contains one step
  /// beyond the end of the run, for Run::Finish.
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
  std::vector<double> rows_;  ///< rows in the current block
  std::size_t columns_, count_ = 0, next_ = 0;
  std::int64_t step_ = 0;
  Instant previous_, state_;
  TerrainSurface ground_;
  std::optional<GroundWeather> weather_;
};

}  // namespace tera
