#include "sim/scenario/machine_start.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/config/config_faults.h"
#include "core/config/spelling.h"
#include "core/units.h"

namespace tera {
namespace {

/// Height and tilt of the ground under a rectangle of half extents `half_m` about `xy_m`.
Pose RestingPose(const TerrainSurface& ground, const Vec2& xy_m, double yaw_rad,
                 const Vec2& half_m) {
  const Mat3 R_yaw = RotationFromRpy(0, 0, yaw_rad);
  const auto height = [&](double x_m, double y_m) {
    const Vec3 p = R_yaw * Vec3(x_m, y_m, 0);
    return ground.HeightAt(xy_m.x() + p.x(), xy_m.y() + p.y());
  };
  const double front = 0.5 * (height(half_m.x(), half_m.y()) + height(half_m.x(), -half_m.y()));
  const double rear = 0.5 * (height(-half_m.x(), half_m.y()) + height(-half_m.x(), -half_m.y()));
  const double left = 0.5 * (height(half_m.x(), half_m.y()) + height(-half_m.x(), half_m.y()));
  const double right = 0.5 * (height(half_m.x(), -half_m.y()) + height(-half_m.x(), -half_m.y()));
  const double pitch = half_m.x() > 0 ? -std::atan2(front - rear, 2 * half_m.x()) : 0.0;
  const double roll = half_m.y() > 0 ? std::atan2(left - right, 2 * half_m.y()) : 0.0;
  return MakePose(Vec3(xy_m.x(), xy_m.y(), 0.5 * (front + rear)),
                  RotationFromRpy(roll, pitch, yaw_rad));
}

/// Half length and half width of the ground contact, in the root's frame.
Vec2 FootprintHalf(const MachineModel& model) {
  Vec2 half = Vec2::Zero();
  for (const RunningGear& gear : model.ground_tools.gears) {
    for (const ContactPatch& patch : gear.patches) {
      half = half.cwiseMax(patch.p_B_m.head<2>().cwiseAbs());
    }
  }
  return half;
}

/// Properties of a start key: `joints_deg` for revolute or `joints_m` for prismatic joints.
struct StartPlaces {
  std::string_view key, unit, other_key;
  bool slide;
  double unit_si;
};
constexpr StartPlaces kStartPlaces[] = {{"joints_deg", "deg", "joints_m", false, kDeg},
                                        {"joints_m", "m", "joints_deg", true, 1}};

/// The joint that a start entry names, if it is of the key's kind.
std::optional<int> JointOfStart(const ConfigMap& start, const StartPlaces& places,
                                const std::string& name, const MachineModel& model) {
  const int joint = model.JointIndex(name);
  if (joint < 0) {
    std::vector<std::string> names;
    for (const Joint& j : model.joints) names.push_back(j.name);
    start.Fault(places.key, {FaultKind::kNoSuchName, "machine '" + model.kind + "' has no joint '" +
                                                         name + "'" + DidYouMean(name, names)});
    return std::nullopt;
  }
  if (model.joints[joint].type == JointType::kFixed) {
    start.Fault(places.key, fmt::format("'{}' does not move; remove it", name));
    return std::nullopt;
  }
  if (const int leader = LeaderOf(model, joint); leader != joint) {
    start.Fault(places.key, fmt::format("'{}' follows joint '{}'; give the position of that joint",
                                        name, model.joints[leader].name));
    return std::nullopt;
  }
  if ((model.joints[joint].type == JointType::kPrismatic) != places.slide) {
    start.Fault(places.key, fmt::format("'{}' {}; need it under {}", name,
                                        places.slide ? "turns" : "slides", places.other_key));
    return std::nullopt;
  }
  return joint;
}

/// Angles, or positions of prismatic joints.
void ReadStartPlaces(const ConfigMap& start, const MachineModel& model, std::vector<double>* q) {
  for (const StartPlaces& places : kStartPlaces) {
    const std::size_t before = FaultCount(start);
    const auto given = start.NamedNumbers(places.key, Any(std::string(places.unit)));
    if (FaultCount(start) != before) continue;  // limits are checked only for valid values
    for (const auto& [name, value] : given) {
      const std::optional<int> joint = JointOfStart(start, places, name, model);
      if (!joint) continue;
      const Joint& j = model.joints[*joint];
      (*q)[*joint] = value * places.unit_si;
      const bool limited = j.type == JointType::kRevolute || j.type == JointType::kPrismatic;
      if (limited && ((*q)[*joint] < j.lower_rad || (*q)[*joint] > j.upper_rad)) {
        start.Fault(
            places.key,
            {FaultKind::kOutOfRange,
             fmt::format("'{0}' at {1} {2} is beyond its limits, need {3} to {4} {2}", name, value,
                         places.unit, j.lower_rad / places.unit_si, j.upper_rad / places.unit_si)});
      }
    }
  }
}

}  // namespace

void ReadStart(const ConfigMap& config, MachinePlacement* placement) {
  for (const Joint& joint : placement->model.joints) placement->q_rad.push_back(joint.initial_rad);
  Vec2 xy_m = Vec2::Zero();
  double yaw_rad = 0;
  if (const auto start = config.OptionalMap("start")) {
    xy_m = start->Vector2("xy_m", Any("m"), Vec2::Zero());
    yaw_rad = start->Number("yaw_deg", Between(-360, 360, "deg"), 0) * kDeg;
    ReadStartPlaces(*start, placement->model, &placement->q_rad);
    PlaceFollowers(placement->model, &placement->q_rad);
  }
  placement->X_WB = MakePose(Vec3(xy_m.x(), xy_m.y(), 0), RotationFromRpy(0, 0, yaw_rad));
}

void SetOnGround(const TerrainSurface& ground, MachinePlacement* placement) {
  const Vec3 start_m = placement->X_WB.translation();
  const double yaw_rad = RpyFromRotation(placement->X_WB.linear()).z();
  placement->X_WB =
      RestingPose(ground, start_m.head<2>(), yaw_rad, FootprintHalf(placement->model));
}

}  // namespace tera
