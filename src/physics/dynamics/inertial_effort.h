#pragma once

#include <vector>

#include "physics/description/machine.h"

namespace tera {

/// What accelerates a machine's masses: of each joint the part of its effort that accelerates the
/// links beyond it and the soil they carry, and of the whole machine the force and torque.
///
/// Frames  W.
/// Model   Newton and Euler for every link, with the accelerations of the state, summed from the
///         tips to the joint and on to the base: what is left of a joint's effort, or of the
///         ground's force on the machine, bears weight, ground and contacts.
/// Omits   the extent of carried soil, a point mass; momentum of soil that comes or goes; the spin
///         of running gear.
class InertialEfforts {
 public:
  /// At rest. `model` must outlive it.
  explicit InertialEfforts(const MachineModel& model);

  void Update(const MachineState& state);

  /// One for each joint; 0 for fixed ones.
  const std::vector<double>& joints_nm() const { return joints_nm_; }
  /// About the base's origin.
  const Wrench& machine() const { return beyond_[0]; }

 private:
  const MachineModel& model_;
  std::vector<Wrench> beyond_;  ///< of each link with all that it carries, about the base's origin
  std::vector<double> joints_nm_;
};

}  // namespace tera
