#include "sim/events/person_events.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "physics/dynamics/box_distance.h"

namespace tera {
namespace {

constexpr TimeNs kPersonPause_ns = 200'000'000;
constexpr double kUpright = 0.9;

bool Turns(const Joint& joint) {
  return joint.gear < 0 &&
         (joint.type == JointType::kRevolute || joint.type == JointType::kContinuous);
}

double Length_m(const Vec3& offset_m, bool level) {
  return level ? offset_m.head<2>().norm() : offset_m.norm();
}

/// Largest distance of a link's boxes from one of its points; without z with `level`.
double ExtentOfBoxes_m(const Link& link, const Vec3& from_B_m, bool level) {
  double extent_m = 0;
  for (const CollisionBox& box : link.collision) {
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 sign(corner & 1 ? 0.5 : -0.5, corner & 2 ? 0.5 : -0.5, corner & 4 ? 0.5 : -0.5);
      const Vec3 corner_B_m = box.X_BG * Vec3(sign.cwiseProduct(box.size_m));
      extent_m = std::max(extent_m, Length_m(corner_B_m - from_B_m, level));
    }
  }
  return extent_m;
}

/// Largest distance of a part of `link`, or of what it carries, from the link's origin. Offsets in
/// the link itself count without their z with `level`.
double Extent_m(const MachineModel& model, int link, bool level) {
  double extent_m =
      ExtentOfBoxes_m(model.links[static_cast<std::size_t>(link)], Vec3::Zero(), level);
  for (const Joint& joint : model.joints) {
    if (joint.parent != link) continue;
    const double slide_m = joint.type == JointType::kPrismatic
                               ? std::max(std::abs(joint.lower_rad), std::abs(joint.upper_rad))
                               : 0;
    extent_m = std::max(extent_m, Length_m(joint.X_PJ.translation(), level) + slide_m +
                                      Extent_m(model, joint.child, false));
  }
  return extent_m;
}

/// Least distance between boxes of a machine and a person; nothing without boxes.
std::optional<double> PersonDistance_m(const MachineModel& model, const MachineState& state,
                                       const ScenarioObstacle& person, const Pose& X_WP) {
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    for (const CollisionBox& part : model.links[i].collision) {
      for (const CollisionBox& body : person.collision) {
        least_m = std::min(least_m, BoxDistance_m(part, state.links[i].X_WB, body, X_WP));
      }
    }
  }
  return std::isfinite(least_m) ? std::optional(least_m) : std::nullopt;
}

}  // namespace

SweptCircle CircleOf(const MachineModel& model) {
  const Joint* slewing = nullptr;
  double extent_m = 0;
  for (const Joint& joint : model.joints) {
    const Vec3 axis_P = joint.X_PJ.linear() * joint.axis_J;
    if (joint.parent != 0 || !Turns(joint) || std::abs(axis_P.z()) < kUpright) continue;
    const double of_joint_m = Extent_m(model, joint.child, true);
    if (slewing && of_joint_m <= extent_m) continue;
    slewing = &joint;
    extent_m = of_joint_m;
  }
  if (!slewing) return {Vec3::Zero(), Extent_m(model, 0, true)};
  const Vec3 axis_B_m = slewing->X_PJ.translation();
  return {axis_B_m, std::max(extent_m, ExtentOfBoxes_m(model.links[0], axis_B_m, true))};
}

PersonEvents::PersonEvents(const Scenario& scenario)
    : scenario_(scenario),
      near_({.kind = EventKind::kPersonNear, .pause_ns = kPersonPause_ns, .keeps_least = true}) {
  for (const ScenarioMachine& machine : scenario.machines) {
    circles_.push_back(CircleOf(machine.placement.model));
  }
  for (std::size_t o = 0; o < scenario.obstacles.size(); ++o) {
    if (scenario.obstacles[o].label == SemanticClass::kPerson) people_.push_back(o);
  }
}

void PersonEvents::Observe(const Instant& now) {
  for (std::size_t m = 0; m < circles_.size(); ++m) {
    const MachinePlacement& machine = scenario_.machines[m].placement;
    const Vec3 axis_W_m = now.machines[m].links[0].X_WB * circles_[m].axis_B_m;
    for (const std::size_t o : people_) {
      const ScenarioObstacle& person = scenario_.obstacles[o];
      const Pose& X_WP = now.obstacles[o].X_WB;
      if ((X_WP.translation() - axis_W_m).head<2>().norm() >= circles_[m].radius_m) continue;
      const auto distance_m = PersonDistance_m(machine.model, now.machines[m], person, X_WP);
      if (!distance_m) continue;
      near_.Hold({machine.name, "", person.name}, now.t_ns, now.t_ns, *distance_m);
    }
  }
  near_.Close(now.t_ns);
}

}  // namespace tera
