#include "sim/operators/waypoint_driver.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

constexpr double kTurnOnSpot_rad = 50 * kDeg;  // beyond this bearing, turn before driving on
constexpr double kTurnRate_radps = 0.5;
constexpr double kSlowDownDistance_m = 1.0;  // before the last waypoint
constexpr double kMinApproachSpeed = 0.15;   // of the cruising speed
constexpr double kLeverRate_1ps = 1.5;       // a careful hand: neutral to full lever in 0.7 s

}  // namespace

WaypointDriver::WaypointDriver(std::vector<Vec2> waypoints_W_m, double speed_mps, double reached_m,
                               const SkidSteerLevers& levers)
    : waypoints_W_m_(std::move(waypoints_W_m)),
      speed_mps_(speed_mps),
      reached_m_(reached_m),
      levers_(levers) {}

std::vector<double> WaypointDriver::Levers(const OperatorView& view) {
  std::vector<double> levers = Wanted(view);
  levers_now_.resize(levers.size(), 0.0);
  const double reach = kLeverRate_1ps * ToSeconds(view.t_ns - last_ns_.value_or(view.t_ns));
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
  while (next_ < waypoints_W_m_.size() && (waypoints_W_m_[next_] - here).norm() < reached_m_) {
    ++next_;
  }
  if (next_ == waypoints_W_m_.size()) return levers;

  const Vec2 to_goal_W = waypoints_W_m_[next_] - here;
  const double yaw_rad = std::atan2(X_WB.linear()(1, 0), X_WB.linear()(0, 0));
  const double bearing_rad =
      std::remainder(std::atan2(to_goal_W.y(), to_goal_W.x()) - yaw_rad, 2 * kPi);
  const double distance_m = to_goal_W.norm();
  if (std::abs(bearing_rad) > kTurnOnSpot_rad) {
    SetSkidSteer(view.model, levers_, 0.0, std::copysign(kTurnRate_radps, bearing_rad), &levers);
    return levers;
  }
  const bool last = next_ + 1 == waypoints_W_m_.size();
  const double ease =
      last ? std::clamp(distance_m / kSlowDownDistance_m, kMinApproachSpeed, 1.0) : 1.0;
  const double forward_mps = speed_mps_ * ease;
  const double curvature_1pm = 2.0 * std::sin(bearing_rad) / distance_m;
  SetSkidSteer(view.model, levers_, forward_mps, forward_mps * curvature_1pm, &levers);
  return levers;
}

std::unique_ptr<Operator> ReadWaypointDriver(const ConfigMap& config, const MachineModel& model) {
  std::vector<Vec2> waypoints;
  for (const ConfigMap& point : config.List("waypoints")) {
    waypoints.push_back(point.Vector2("xy_m", Any("m")));
  }
  if (waypoints.empty()) config.Fault("waypoints", "no waypoint given, need at least one {xy_m}");
  const double speed_mps = config.Number("speed_mps", Positive("m/s"), 0.8);
  const double reached_m = config.Number("reached_m", Positive("m"), 0.5);
  return std::make_unique<WaypointDriver>(std::move(waypoints), speed_mps, reached_m,
                                          ReadSkidSteerLevers(config, model));
}

}  // namespace tera
