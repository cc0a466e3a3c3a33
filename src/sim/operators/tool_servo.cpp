#include "sim/operators/tool_servo.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace tera {
namespace {

constexpr double kTimeConstant_s = 0.4;
constexpr double kFastest_mps = 1.0, kFastest_radps = 0.8;
/// Displacement of the frame's origin that weighs as much as a rotation by one radian.
constexpr double kTurn_m = 0.5;
/// Damping of the inverse, in metres of the frame per radian of a joint. Small compared with the
/// arm.
constexpr double kDamping_m = 0.05;

// Linear velocity in m/s, then kTurn_m times angular velocity.
using Twist = Eigen::Matrix<double, 6, 1>;

Vec3 NoFasterThan(const Vec3& v, double fastest) {
  return v.norm() > fastest ? Vec3(v * (fastest / v.norm())) : v;
}

bool Carries(const MachineModel& model, int joint, int link) {
  for (int l = link; l > 0; l = model.joints[l - 1].parent) {
    if (l - 1 == joint) return true;
  }
  return false;
}

/// Twist of the frame with its origin at `p_W_m`, in the axes of B, for a unit rate of `joint`.
Twist JacobianColumn(const MachineModel& model, const MachineState& state, int joint,
                     const Vec3& p_W_m, const Mat3& R_WB) {
  const Joint& j = model.joints[joint];
  const Pose X_WJ = state.links[j.parent].X_WB * j.X_PJ;
  const Vec3 axis_W = X_WJ.linear() * j.axis_J;
  const bool slides = j.type == JointType::kPrismatic;
  const Vec3 v_W = slides ? axis_W : Vec3(axis_W.cross(p_W_m - X_WJ.translation()));
  Twist column;
  column << R_WB.transpose() * v_W,
      kTurn_m * (slides ? Vec3::Zero() : Vec3(R_WB.transpose() * axis_W));
  return column;
}

}  // namespace

std::vector<double> ToolRates(const MachineModel& model, const MachineState& state,
                              const NamedFrame& frame, const ToolTarget& target,
                              const std::vector<int>& joints) {
  const Pose X_WF = state.links[frame.link].X_WB * frame.X_BF;
  const Pose X_BF = state.links[0].X_WB.inverse() * X_WF;
  Twist twist = Twist::Zero();
  twist.head<3>() =
      NoFasterThan((target.p_BF_m - X_BF.translation()) / kTimeConstant_s, kFastest_mps);
  if (target.R_BF) {
    const Eigen::AngleAxisd turn(Mat3(*target.R_BF * X_BF.linear().transpose()));
    twist.tail<3>() =
        kTurn_m * NoFasterThan(turn.axis() * turn.angle() / kTimeConstant_s, kFastest_radps);
  }
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(6, static_cast<int>(joints.size()));
  for (std::size_t k = 0; k < joints.size(); ++k) {
    const Joint& j = model.joints[joints[k]];
    const bool driven = j.max_rate_positive_radps > 0 && j.max_rate_negative_radps > 0;
    if (!driven || !Carries(model, joints[k], frame.link)) continue;
    jacobian.col(static_cast<int>(k)) =
        JacobianColumn(model, state, joints[k], X_WF.translation(), state.links[0].X_WB.linear());
  }
  if (!target.R_BF) jacobian.bottomRows<3>().setZero();
  const Eigen::Matrix<double, 6, 6> damped =
      jacobian * jacobian.transpose() +
      kDamping_m * kDamping_m * Eigen::Matrix<double, 6, 6>::Identity();
  const Eigen::VectorXd rates = jacobian.transpose() * damped.ldlt().solve(twist);
  double slowest = 1;
  for (std::size_t k = 0; k < joints.size(); ++k) {
    const Joint& j = model.joints[joints[k]];
    const double rate = rates[static_cast<int>(k)];
    const double full = rate > 0 ? j.max_rate_positive_radps : j.max_rate_negative_radps;
    if (full > 0 && std::abs(rate) > full) slowest = std::min(slowest, full / std::abs(rate));
  }
  std::vector<double> scaled(rates.data(), rates.data() + rates.size());
  for (double& rate : scaled) rate *= slowest;
  return scaled;
}

}  // namespace tera
