#pragma once

#include <vector>

#include "physics/actuation/linkage.h"
#include "physics/description/machine.h"

/// Forces and pressures of a machine's cylinders.

namespace tera {

/// Greatest efforts of a joint's actuator in either direction, as magnitudes.
struct EffortLimits {
  double positive_nm = 0, negative_nm = 0;
};

/// The cylinders of one machine.
///
/// Model   Quasi-static: F = p_head A_head - p_rod A_rod for each cylinder, and tau = n F ds/dq on
///         its joint. At relief pressure a cylinder pushes with F = p_relief A_head - p_return
///         A_rod and pulls with p_relief A_rod - p_return A_head. This limits its joint. Cylinders
///         of one joint share its effort in proportion to their limits, as if their loaded chambers
///         were connected. The chamber with the lower pressure is at return pressure. Effort beyond
///         relief, for example from an end stop, is reported as force but not as pressure.
/// Omits   Compressibility, losses of lines and valves, separate relief valves for locked chambers,
///         friction of seals, mass of rod and oil.
/// Source  Merritt 1967, "Hydraulic control systems", ch. 6 (areas and forces of a cylinder).
class Hydraulics {
 public:
  /// Starts with the joints at `q_rad`. The model must outlive this object.
  Hydraulics(const MachineModel& model, const std::vector<double>& q_rad);

  /// Moves the joints to `q_rad`.
  void Update(const std::vector<double>& q_rad);

  /// Limits of each joint at its position: its cylinders at relief pressure, or max_effort_nm if no
  /// cylinder has a bore. A joint whose max_effort_nm is 0 always swings freely.
  const std::vector<EffortLimits>& limits() const { return limits_; }

  /// Writes lengths, rates, forces and pressures of the cylinders into `state`, from its rates and
  /// efforts at the positions of the last update.
  void Measure(MachineState* state) const;

 private:
  const MachineModel& model_;
  std::vector<CylinderReach> reach_;  ///< one for each cylinder
  std::vector<EffortLimits> limits_;  ///< one for each joint
};

/// Effort of a joint's cylinders at relief pressure at `q_rad`; 0 without cylinders that have a
/// bore.
EffortLimits ReliefEffort(const MachineModel& model, int joint, double q_rad);

}  // namespace tera
