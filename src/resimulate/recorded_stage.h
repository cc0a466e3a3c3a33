#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "render/rays/ray_scene.h"
#include "resimulate/motion/recorded_motion.h"
#include "sim/scene_assembly.h"
#include "sim/simulation.h"

namespace tera {

/// The site of a scenario while its machines move as recorded. Their tools work the simulated
/// ground along the measured poses. Recorded ground is not used.
///
/// Model   a Simulation whose machines follow the recording. It starts `settle_s` before the first
///         time.
/// Omits   forces: machines follow their recorded poses regardless of the ground.
class RecordedStage {
 public:
  /// Ground and loads at one time. Moments with equal ground share the object.
  struct Moment {
    std::shared_ptr<const TerrainSurface> ground;
    std::vector<std::vector<SoilReaction::Load>> loads;  ///< [machine][shovel]
  };

  /// Keeps references. `machines` has one entry for each machine of the scenario. `start_ns` is the
  /// start of the recording.
  RecordedStage(const Scenario& scenario, const std::vector<RecordedMotion>& machines,
                TimeNs start_ns);
  RecordedStage(Scenario&&, const std::vector<RecordedMotion>&, TimeNs) = delete;

  /// Advances to `t_ns`, which must not decrease from call to call.
  Moment AdvanceTo(TimeNs t_ns);
  /// Machines and obstacles at `t_ns`, with the loads of `moment`, which must be at about that
  /// time.
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
