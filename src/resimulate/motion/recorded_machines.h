#pragma once

#include <vector>

#include "resimulate/motion/recorded_motion.h"
#include "sim/motion_source.h"
#include "sim/scenario/scenario.h"

namespace tera {

/// Moves machines as recorded, regardless of the ground.
///
/// Model   before the start of the run, machines stand at their initial poses. The loads of shovels
///         come from the simulated ground.
/// Omits   forces, levers, cylinders.
class RecordedMachines : public MotionSource {
 public:
  /// Keeps references. `motions` has one entry per machine of the scenario.
  RecordedMachines(const Scenario& scenario, const std::vector<RecordedMotion>& motions)
      : scenario_(scenario), motions_(motions) {}

  void Start(const Begin& begin, WorldState* world) override;
  void Move(const Step& step, WorldState* world) override;
  /// False in a long gap of the recorded poses or encoder samples (RecordedMotion::IsKnownAt).
  bool IsKnown(std::size_t machine) const override;

 private:
  MachineState StateAt(std::size_t machine, TimeNs t_ns) const;

  const Scenario& scenario_;
  const std::vector<RecordedMotion>& motions_;
  TimeNs start_ns_ = 0, now_ns_ = 0;
};

}  // namespace tera
