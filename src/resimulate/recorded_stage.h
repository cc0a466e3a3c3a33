#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "render/rays/ray_scene.h"
#include "resimulate/recorded_motion.h"
#include "sim/scene_assembly.h"
#include "sim/simulation.h"

namespace tera {

/// The site of a scenario as the recorded motion of its machines leaves it: their tools work the
/// simulated ground where they were measured to be. What was recorded of the ground is not used.
///
/// Model   the soil of the scenario under the recorded motion, step by step as Simulation has it,
///         from `settle_s` before the first time on; obstacles on their paths.
/// Omits   forces: the machines are where they were, whatever the ground says.
class RecordedStage {
 public:
  /// Ground and loads at one time. Equal grounds are one.
  struct Moment {
    std::shared_ptr<const TerrainSurface> ground;
    std::vector<std::vector<SoilReaction::Load>> loads;  ///< of each machine's shovels
  };

  /// Works the scenario's soil, once. `machines` one for each of the scenario's; `start_ns` is when
  /// the recording begins.
  RecordedStage(Scenario* scenario, const std::vector<RecordedMotion>& machines, TimeNs start_ns);

  /// At `t_ns`, which must not lie before the last.
  Moment AdvanceTo(TimeNs t_ns);
  /// Machines and obstacles at a time near that of the moment.
  WorldState StateAt(TimeNs t_ns, const Moment& moment) const;

 private:
  const TerrainSurface& ground() const { return scenario_->soil->surface(); }
  std::uint64_t GroundVersion() const;
  Scenario* scenario_;
  const std::vector<RecordedMotion>& machines_;
  std::vector<int> soil_handle_;
  std::vector<std::optional<int>> bed_handle_;
  Moment now_;
  std::uint64_t version_ = 0;
  TimeNs start_ns_;
  SampleClock clock_;
  std::int64_t step_;
};

}  // namespace tera
