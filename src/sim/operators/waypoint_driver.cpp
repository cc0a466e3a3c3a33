#include "sim/operators/waypoint_driver.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

constexpr double kTurnOnSpot_rad = 50 * kDeg;  // at a larger bearing the machine turns on the spot
constexpr double kTurnRate_radps = 0.5;
constexpr double kSlowDownDistance_m = 1.0;  // distance from the last waypoint
constexpr double kMinApproachSpeed = 0.15;   // share of the cruising speed
// A careful hand goes from neutral to full lever in 0.7 s.
constexpr double kCarefulLeverRate_1ps = 1.5;

}  // namespace

std::vector<double> WaypointDriver::Levers(const OperatorView& view) {
  std::vector<double> levers = Wanted(view);
  levers_now_.resize(levers.size(), 0.0);
  const double reach = kCarefulLeverRate_1ps * ToSeconds(view.t_ns - last_ns_.value_or(view.t_ns));
  last_ns_ = view.t_ns;
  for (std::size_t i = 0; i < levers.size(); ++i) {
    levers[i] = std::clamp(levers[i], levers_now_[i] - reach, levers_now_[i] + reach);
  }
  levers_now_ = levers;
  return levers;
}

std::vector<double> WaypointDriver::Wanted(const OperatorView& view) {
  std::vector<double> levers(view.model.levers.size(), 0.0);
  const Pose& X_WB = view.state.links[0].X_WB;
  const Vec2 here = X_WB.translation().head<2>();
  while (next_ < plan_.waypoints_W_m.size() &&
         (plan_.waypoints_W_m[next_] - here).norm() < plan_.reached_m) {
    ++next_;
  }
  if (next_ == plan_.waypoints_W_m.size()) return levers;

  const Vec2 to_goal_W = plan_.waypoints_W_m[next_] - here;
  const double yaw_rad = std::atan2(X_WB.linear()(1, 0), X_WB.linear()(0, 0));
  const double bearing_rad =
      std::remainder(std::atan2(to_goal_W.y(), to_goal_W.x()) - yaw_rad, 2 * kPi);
  const double distance_m = to_goal_W.norm();
  if (std::abs(bearing_rad) > kTurnOnSpot_rad) {
    SetSkidSteer(view.model, plan_.levers, 0.0, std::copysign(kTurnRate_radps, bearing_rad),
                 &levers);
    return levers;
  }
  const bool last = next_ + 1 == plan_.waypoints_W_m.size();
  const double ease =
      last ? std::clamp(distance_m / kSlowDownDistance_m, kMinApproachSpeed, 1.0) : 1.0;
  const double forward_mps = plan_.speed_mps * ease;
  const double curvature_1pm = 2.0 * std::sin(bearing_rad) / distance_m;
  SetSkidSteer(view.model, plan_.levers, forward_mps, forward_mps * curvature_1pm, &levers);
  return levers;
}

WaypointPlan ReadWaypointPlan(const ConfigMap& config, const MachineModel& model) {
  WaypointPlan plan;
  for (const ConfigMap& point : config.List("waypoints")) {
    plan.waypoints_W_m.push_back(point.Vector2("xy_m", Any("m")));
  }
  if (plan.waypoints_W_m.empty()) {
    config.Fault("waypoints", {FaultKind::kMissing, "no waypoint given, need at least one {xy_m}"});
  }
  plan.speed_mps = config.Number("speed_mps", Positive("m/s"), plan.speed_mps);
  plan.reached_m = config.Number("reached_m", Positive("m"), plan.reached_m);
  plan.levers = ReadSkidSteerLevers(config, model);
  return plan;
}

}  // namespace tera
