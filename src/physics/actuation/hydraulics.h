#pragma once

#include <vector>

#include "physics/actuation/linkage.h"
#include "physics/description/machine.h"

/// Forces and pressures of a machine's cylinders.

namespace tera {

/// Greatest efforts of a joint's actuator in either direction, magnitudes.
struct EffortLimits {
  double positive_nm = 0, negative_nm = 0;
};

/// The cylinders of one machine.
///
/// Model   quasi-static. A cylinder balances F = p_head A_head - p_rod A_rod, and turns its joint
///         with tau = n F ds/dq. At relief it pushes with F = p_relief A_head - p_return A_rod and
///         pulls with p_relief A_rod - p_return A_head; this limits its joint. Cylinders of one
///         joint share its effort in proportion to their limits, as do cylinders whose loaded
///         chambers are connected. The chamber with the lower pressure is open to the return line
///         and has its pressure. Effort beyond relief, as from an end stop, is force but not
///         pressure.
/// Omits   compressibility, losses of lines and valves, relief valves of their own for held
///         chambers, friction of seals, mass of rod and oil.
/// Source  Merritt 1967, "Hydraulic control systems", ch. 6 (areas and forces of a cylinder).
class Hydraulics {
 public:
  /// Starts with the joints at `q_rad`. The model must outlive this object.
  Hydraulics(const MachineModel& model, const std::vector<double>& q_rad);

  /// Moves the joints to `q_rad`.
  void Update(const std::vector<double>& q_rad);

  /// Each joint's limits at its position: its cylinders at relief pressure, or max_effort_nm where
  /// no cylinder has a bore. A joint whose max_effort_nm is 0 always swings freely.
  const std::vector<EffortLimits>& limits() const { return limits_; }

  /// Writes the cylinders' lengths, rates, forces and pressures at the positions of the last
  /// update, with the rates and efforts of `state`.
  void Measure(MachineState* state) const;

 private:
  const MachineModel& model_;
  std::vector<CylinderReach> reach_;  ///< one for each cylinder
  std::vector<EffortLimits> limits_;  ///< one for each joint
};

/// Effort of a joint's cylinders at relief pressure and position `q_rad`; 0 without cylinders that
/// have a bore.
EffortLimits ReliefEffort(const MachineModel& model, int joint, double q_rad);

}  // namespace tera
