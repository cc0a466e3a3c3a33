#pragma once

#include <vector>

#include "physics/actuation/linkage.h"
#include "physics/description/machine.h"

/// Forces and pressures of a machine's cylinders.

namespace tera {

/// Magnitudes of the most that a joint's actuator can do in either direction.
struct EffortLimits {
  double positive_nm = 0, negative_nm = 0;
};

/// The cylinders of one machine.
///
/// Model   quasi-static. A cylinder balances F = p_head A_head - p_rod A_rod, and turns its joint
///         with tau = n F ds/dq. At relief it pushes with F = p_relief A_head - p_return A_rod and
///         pulls with p_relief A_rod - p_return A_head; that limits its joint. Cylinders of one
///         joint share its effort in proportion to what each can do, as do those whose loaded
///         chambers are connected. The chamber with the lower pressure is the one open to the
///         return line and has its pressure. Effort beyond relief, as of an end stop, is force but
///         not pressure.
/// Omits   compressibility, losses of lines and valves, relief valves of their own for held
///         chambers, friction of seals, mass of rod and oil.
/// Source  Merritt 1967, "Hydraulic control systems", ch. 6 (areas and forces of a cylinder).
class Hydraulics {
 public:
  /// For a machine whose joints stand at `q_rad`. The model must outlive it.
  Hydraulics(const MachineModel& model, const std::vector<double>& q_rad);

  /// Joints have moved to `q_rad`.
  void Update(const std::vector<double>& q_rad);

  /// Each joint's limits where it stands: what relief lets its cylinders do, or its max_effort_nm
  /// where it has none with a bore. A joint whose max_effort_nm is 0 swings freely in any case.
  const std::vector<EffortLimits>& limits() const { return limits_; }

  /// Cylinders at the positions of the last update, with the rates and efforts of `state`.
  void Measure(MachineState* state) const;

 private:
  const MachineModel& model_;
  std::vector<CylinderReach> reach_;  ///< one for each cylinder
  std::vector<EffortLimits> limits_;  ///< one for each joint
};

/// What relief lets a joint's cylinders do at `q_rad`; 0 without cylinders that have a bore.
EffortLimits ReliefEffort(const MachineModel& model, int joint, double q_rad);

}  // namespace tera
