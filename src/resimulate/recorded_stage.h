#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "render/rays/ray_scene.h"
#include "resimulate/motion/recorded_motion.h"
#include "sim/scene_assembly.h"
#include "sim/simulation.h"

namespace tera {

/// The site of a scenario as the recorded motion of its machines leaves it: their tools work the
/// simulated ground where they were measured to be. What was recorded of the ground is not used.
///
/// Model   a Simulation whose machines move as recorded, from `settle_s` before the first time on.
/// Omits   forces: the machines are where they were, whatever the ground says.
class RecordedStage {
 public:
  /// Ground and loads at one time. Equal grounds are one.
  struct Moment {
    std::shared_ptr<const TerrainSurface> ground;
    std::vector<std::vector<SoilReaction::Load>> loads;  ///< of each machine's shovels
  };

  /// Keeps references. `machines` one for each of the scenario's; `start_ns` is when the recording
  /// begins.
  RecordedStage(const Scenario& scenario, const std::vector<RecordedMotion>& machines,
                TimeNs start_ns);
  RecordedStage(Scenario&&, const std::vector<RecordedMotion>&, TimeNs) = delete;

  /// At `t_ns`, which must not lie before the last.
  Moment AdvanceTo(TimeNs t_ns);
  /// Machines and obstacles at a time near that of the moment.
  Instant StateAt(TimeNs t_ns, const Moment& moment) const;

 private:
  std::uint64_t GroundVersion() const;

  const Scenario& scenario_;
  const std::vector<RecordedMotion>& machines_;
  Simulation simulation_;
  Moment now_;
  std::uint64_t version_ = 0;
};

}  // namespace tera
