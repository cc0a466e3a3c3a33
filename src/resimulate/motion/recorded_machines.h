#pragma once

#include <vector>

#include "resimulate/motion/recorded_motion.h"
#include "sim/motion_source.h"
#include "sim/scenario/scenario.h"

namespace tera {

/// Machines that move as a recording has it, whatever the ground says.
///
/// Model   before the start of the run they stand where they are then. What their shovels carry is
///         what the ground gave them.
/// Omits   forces, levers, cylinders.
class RecordedMachines : public MotionSource {
 public:
  /// Keeps references. `motions` one for each of the scenario's machines.
  RecordedMachines(const Scenario& scenario, const std::vector<RecordedMotion>& motions)
      : scenario_(scenario), motions_(motions) {}

  void Start(const Begin& begin, WorldState* world) override;
  void Move(const Step& step, WorldState* world) override;
  /// Where poses and encoders are missing for longer than a moment, it is not.
  bool IsKnown(std::size_t machine) const override;

 private:
  MachineState StateAt(std::size_t machine, TimeNs t_ns) const;

  const Scenario& scenario_;
  const std::vector<RecordedMotion>& motions_;
  TimeNs start_ns_ = 0, now_ns_ = 0;
};

}  // namespace tera
