#pragma once

#include <vector>

#include "physics/description/machine.h"

namespace tera {

/// Inertial parts of the joint efforts and of the external wrench on the machine. The part of a
/// joint accelerates the links beyond it and their carried soil.
///
/// Frames  W.
/// Model   Newton-Euler equations for every link with the accelerations of the state, summed from
///         the tips to the joint and to the base. The rest of a joint's effort, or of the ground's
///         force on the machine, balances weight, ground and contacts.
/// Omits   The extent of carried soil (a point mass); momentum of soil that enters or leaves; the
///         spin of running gear.
class InertialEfforts {
 public:
  /// Starts at rest. `model` must outlive this object.
  explicit InertialEfforts(const MachineModel& model);

  void Update(const MachineState& state);

  /// One per joint; 0 for fixed joints.
  const std::vector<double>& joints_nm() const { return joints_nm_; }
  /// Wrench about the base's origin.
  const Wrench& machine() const { return beyond_[0]; }

 private:
  const MachineModel& model_;
  std::vector<Wrench> beyond_;  ///< for each link with all links beyond it, about the base's origin
  std::vector<double> joints_nm_;
};

}  // namespace tera
