#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/machine_doubts.h"

namespace tera {
namespace {

constexpr double kGravity_mps2 = 9.81;

/// Warns of a joint that covers its whole range implausibly fast.
std::optional<std::string> DoubtOfRate(const Joint& joint) {
  constexpr double kQuickest_s = 0.2;
  const double rate_radps = std::max(joint.max_rate_positive_radps, joint.max_rate_negative_radps);
  const double way_rad = joint.upper_rad - joint.lower_rad;
  if (joint.type != JointType::kRevolute || way_rad <= 0 || way_rad > kQuickest_s * rate_radps) {
    return std::nullopt;
  }
  return fmt::format(
      ", joint {} turns {:.4g} rad at {:.4g} rad/s, in {:.2g} s: is its velocity in deg/s?",
      joint.name, way_rad, rate_radps, way_rad / rate_radps);
}

/// Mass and first moment in W of a link with all its descendants.
struct Hanging {
  double mass_kg = 0;
  Vec3 moment_kgm = Vec3::Zero();
};

std::vector<Hanging> HangingOn(const MachineModel& model, const std::vector<Pose>& X_WL) {
  std::vector<Hanging> hanging(model.links.size());
  for (std::size_t i = model.links.size(); i-- > 0;) {
    const Link& link = model.links[i];
    hanging[i].mass_kg += link.mass_kg;
    hanging[i].moment_kgm += link.mass_kg * (X_WL[i] * link.com_B_m);
    if (i == 0) break;
    Hanging& parent = hanging[static_cast<std::size_t>(model.joints[i - 1].parent)];
    parent.mass_kg += hanging[i].mass_kg;
    parent.moment_kgm += hanging[i].moment_kgm;
  }
  return hanging;
}

std::optional<std::string> DoubtOfHolding(const Joint& joint, const Pose& X_WP,
                                          const Hanging& hanging) {
  const bool turns = joint.type == JointType::kRevolute;
  if ((!turns && joint.type != JointType::kPrismatic) || joint.max_effort_nm <= 0) {
    return std::nullopt;
  }
  const Pose X_WJ = X_WP * joint.X_PJ;
  const Vec3 axis_W = X_WJ.linear() * joint.axis_J;
  const Vec3 weight_n(0, 0, -kGravity_mps2 * hanging.mass_kg);
  const Vec3 arm_kgm = hanging.moment_kgm - hanging.mass_kg * X_WJ.translation();
  const double needed = std::abs(turns ? axis_W.dot(arm_kgm.cross(Vec3(0, 0, -kGravity_mps2)))
                                       : axis_W.dot(weight_n));
  if (needed <= joint.max_effort_nm) return std::nullopt;
  return fmt::format(
      ", joint {} needs {:.3g} {} to hold its load at the start, and its effort is {:.3g}: is that "
      "in k{}?",
      joint.name, needed, turns ? "N m" : "N", joint.max_effort_nm, turns ? "N m" : "N");
}

std::optional<std::string> DoubtOfLever(const MachineModel& model, const Lever& lever) {
  double rate = 0, effort = 0;
  if (lever.joint >= 0) {
    const Joint& joint = model.joints[static_cast<std::size_t>(lever.joint)];
    if (joint.lower_rad == joint.upper_rad && joint.type != JointType::kContinuous) {
      return std::nullopt;  // DoubtOfLimits already reports this joint
    }
    rate = std::max(joint.max_rate_positive_radps, joint.max_rate_negative_radps);
    effort = joint.max_effort_nm;
  } else {
    const GearDrive& drive = model.gear_drives[static_cast<std::size_t>(lever.gear)];
    rate = drive.max_rate_radps;
    effort = drive.max_torque_nm;
  }
  if (rate > 0 && effort > 0) return std::nullopt;
  return fmt::format(", lever {} moves nothing: the {} is 0: left by the exporter?", lever.name,
                     rate > 0 ? "effort" : "velocity");
}

double MiddleOf_m(const RunningGear& gear) {
  double sum_m = 0;
  for (const ContactPatch& patch : gear.patches) sum_m += patch.p_B_m.y();
  return gear.patches.empty() ? 0 : sum_m / static_cast<double>(gear.patches.size());
}

std::optional<std::string> DoubtOfGear(const RunningGear& gear, const GearDrive& drive) {
  constexpr double kFastest_mps = 30;
  const double speed_mps = drive.max_rate_radps * gear.ShoeRadius_m(), y_m = MiddleOf_m(gear);
  if (speed_mps > kFastest_mps) {
    return fmt::format(", {} runs at {:.3g} m/s: is its speed in km/h?", gear.name, speed_mps);
  }
  const bool is_left = gear.name.find("left") != std::string::npos;
  const bool is_right = gear.name.find("right") != std::string::npos;
  if (is_left == is_right || (is_left ? y_m >= 0 : y_m <= 0)) return std::nullopt;
  return fmt::format(", {} is on the {} side, at y {:.3g} m: y points to the left", gear.name,
                     is_left ? "right" : "left", y_m);
}

std::optional<std::string> DoubtOfGauge(const MachineModel& model) {
  constexpr double kMostRatio = 2;
  double low_m = 0, high_m = 0;
  for (const RunningGear& gear : model.ground_tools.gears) {
    low_m = std::min(low_m, MiddleOf_m(gear));
    high_m = std::max(high_m, MiddleOf_m(gear));
  }
  const double apart_m = high_m - low_m;
  if (model.gauge_m <= 0 || apart_m <= 0 ||
      (model.gauge_m < kMostRatio * apart_m && apart_m < kMostRatio * model.gauge_m)) {
    return std::nullopt;
  }
  return fmt::format(": gauge_m is {:.3g} m, and its running gear lies {:.3g} m apart",
                     model.gauge_m, apart_m);
}

double LowestOf_m(const RunningGear& gear) {
  double low_m = std::numeric_limits<double>::infinity();
  for (const ContactPatch& patch : gear.patches) low_m = std::min(low_m, patch.p_B_m.z());
  return low_m;
}

/// Warns of running gear above the lowest point of its own link's boxes.
std::optional<std::string> DoubtOfClearance(const MachineModel& model, const RunningGear& gear) {
  const Link& link = model.links[static_cast<std::size_t>(gear.link)];
  double below_m = 0;
  for (const CollisionBox& part : link.collision) {
    const Mat3 R = part.X_BG.linear().cwiseAbs();
    const double bottom_m = part.X_BG.translation().z() - 0.5 * R.row(2).dot(part.size_m);
    below_m = std::max(below_m, LowestOf_m(gear) - bottom_m);
  }
  // Allowance for grousers and lugs, which boxes include and patches do not.
  constexpr double kRim_m = 0.05;
  if (below_m <= kRim_m) return std::nullopt;
  return fmt::format(", {} ends {:.2g} m above the bottom of {}, which would drag: z points up",
                     gear.name, below_m, link.name);
}

/// Warns of a driven joint without limits whose axis is horizontal and which turns most of the
/// machine. A slew whose axis is given as y has this symptom.
std::optional<std::string> DoubtOfSlew(const Joint& joint, const Pose& X_WP, double share) {
  constexpr double kMostOfIt = 0.5, kLying = 0.5;  // cosine between axis and vertical
  const bool goes_round = joint.type == JointType::kContinuous && joint.max_effort_nm > 0;
  const Vec3 axis_W = X_WP.linear() * joint.X_PJ.linear() * joint.axis_J;
  if (!goes_round || share < kMostOfIt || std::abs(axis_W.z()) > kLying) return std::nullopt;
  return fmt::format(
      ", joint {} turns {:.0f} % of the machine's mass about a lying axis, all the way round: a "
      "slew's axis is z",
      joint.name, 100 * share);
}

/// Warns of a profile that begins at its upper end: the end near the pin of a bucket, or the higher
/// end of a blade.
std::optional<std::string> DoubtOfEdge(const Shovel& shovel, const Pose& X_WL) {
  if (shovel.profile_B_m.size() < 2) return std::nullopt;
  const Vec2 &edge = shovel.profile_B_m.front(), &top = shovel.profile_B_m.back();
  const auto height_m = [&](const Vec2& p) { return (X_WL * Vec3(p.x(), 0, p.y())).z(); };
  const bool holds = shovel.capacity_m3 > 0;
  if (holds ? edge.norm() >= top.norm() : height_m(edge) <= height_m(top)) return std::nullopt;
  return fmt::format(
      ", shovel {} has its edge {} the other end of its profile_m: the profile begins at the edge",
      shovel.name, holds ? "nearer to its pin than" : "above");
}

std::optional<std::string> DoubtOfShovel(const Shovel& shovel) {
  constexpr double kMostRatio = 10;  // a blade also moves soil in front of it
  Eigen::AlignedBox2d box;
  for (const Vec2& p : shovel.profile_B_m) box.extend(p);
  const double room_m3 = box.isEmpty() ? 0 : box.volume() * shovel.width_m;
  if (room_m3 <= 0 || shovel.capacity_m3 <= kMostRatio * room_m3) return std::nullopt;
  return fmt::format(
      ", shovel {} holds {:.3g} m3, and its profile and width enclose {:.3g} m3: is its capacity "
      "in "
      "litres?",
      shovel.name, shovel.capacity_m3, room_m3);
}

}  // namespace

std::vector<std::string> DrivesInDoubt(const MachinePlacement& placement) {
  const MachineModel& model = placement.model;
  std::vector<std::string> doubts;
  const auto add = [&](const std::optional<std::string>& doubt) {
    if (doubt) doubts.push_back(placement.name + *doubt);
  };
  const std::vector<Pose> X_WL = ForwardKinematics(model, placement.X_WB, placement.q_rad);
  const std::vector<Hanging> hanging = HangingOn(model, X_WL);
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const Joint& joint = model.joints[j];
    if (joint.following) continue;
    add(DoubtOfRate(joint));
    const Pose& X_WP = X_WL[static_cast<std::size_t>(joint.parent)];
    add(DoubtOfHolding(joint, X_WP, hanging[j + 1]));
    const double all_kg = hanging.front().mass_kg;
    if (all_kg > 0) add(DoubtOfSlew(joint, X_WP, hanging[j + 1].mass_kg / all_kg));
  }
  for (const Lever& lever : model.levers) add(DoubtOfLever(model, lever));
  for (std::size_t g = 0; g < model.ground_tools.gears.size(); ++g) {
    add(DoubtOfGear(model.ground_tools.gears[g], model.gear_drives[g]));
    add(DoubtOfClearance(model, model.ground_tools.gears[g]));
  }
  add(DoubtOfGauge(model));
  for (const Shovel& shovel : model.ground_tools.shovels) {
    add(DoubtOfShovel(shovel));
    add(DoubtOfEdge(shovel, X_WL[static_cast<std::size_t>(shovel.link)]));
  }
  return doubts;
}

}  // namespace tera
