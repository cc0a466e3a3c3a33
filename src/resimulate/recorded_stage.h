#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "render/rays/ray_scene.h"
#include "resimulate/motion/recorded_motion.h"
#include "sim/scene_assembly.h"
#include "sim/simulation.h"

namespace tera {

/// Site of a scenario under the recorded motion of its machines: the tools work the simulated
/// ground along their measured poses. Recorded ground is not used.
///
/// Model   a Simulation whose machines move as recorded, from `settle_s` before the first time.
/// Omits   forces: machines follow their recorded poses independent of the ground.
class RecordedStage {
 public:
  /// Ground and loads at one time. Equal grounds share an object.
  struct Moment {
    std::shared_ptr<const TerrainSurface> ground;
    std::vector<std::vector<SoilReaction::Load>> loads;  ///< by machine and shovel
  };

  /// Keeps references. `machines` has one entry per machine of the scenario; `start_ns` is the
  /// start of the recording.
  RecordedStage(const Scenario& scenario, const std::vector<RecordedMotion>& machines,
                TimeNs start_ns);
  RecordedStage(Scenario&&, const std::vector<RecordedMotion>&, TimeNs) = delete;

  /// Advances to `t_ns`, which must not decrease between calls.
  Moment AdvanceTo(TimeNs t_ns);
  /// Machines and obstacles at a time near the moment's.
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
