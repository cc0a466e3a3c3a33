#pragma once

#include <vector>

#include "resimulate/motion/recorded_motion.h"
#include "sim/motion_source.h"
#include "sim/scenario/scenario.h"

namespace tera {

/// Machines that move as recorded, independent of the ground.
///
/// Model   before the run's start they stand at their initial poses. The simulated ground
///         determines the load of their shovels.
/// Omits   forces, levers, cylinders.
class RecordedMachines : public MotionSource {
 public:
  /// Keeps references. `motions` has one entry per machine of the scenario.
  RecordedMachines(const Scenario& scenario, const std::vector<RecordedMotion>& motions)
      : scenario_(scenario), motions_(motions) {}

  void Start(const Begin& begin, WorldState* world) override;
  void Move(const Step& step, WorldState* world) override;
  /// False during a longer gap of poses or encoders.
  bool IsKnown(std::size_t machine) const override;

 private:
  MachineState StateAt(std::size_t machine, TimeNs t_ns) const;

  const Scenario& scenario_;
  const std::vector<RecordedMotion>& motions_;
  TimeNs start_ns_ = 0, now_ns_ = 0;
};

}  // namespace tera
