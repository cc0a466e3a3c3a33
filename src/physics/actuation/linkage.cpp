#include "physics/actuation/linkage.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/check.h"

namespace tera {
namespace {

/// Pose with its origin at `origin`, x towards `target` and y along `axis`, which is perpendicular
/// to x.
Pose AlongBar(const Vec3& origin, const Vec3& target, const Vec3& axis) {
  Mat3 R;
  R.col(0) = (target - origin).normalized();
  R.col(1) = axis;
  R.col(2) = R.col(0).cross(axis);
  return MakePose(origin, R);
}

/// Pose and axis of a joint in its parent link P.
struct JointPlace {
  JointPlace(const Joint& joint, double q_rad)
      : X_PB(joint.X_PJ * JointMotion(joint, q_rad)), axis_P(joint.X_PJ.linear() * joint.axis_J) {}

  Pose X_PB;
  Vec3 axis_P;
};

/// Intersection of two circles about `a` and `b` in the plane normal to `axis`. `side` +1 selects
/// the side of the line from a to b to which a positive turn about the axis leads.
std::optional<Vec3> MeetingPoint(const Vec3& a, double a_radius_m, const Vec3& b, double b_radius_m,
                                 const Vec3& axis, int side) {
  const Vec3 line = b - a;
  const double apart_m = line.norm();
  if (apart_m > a_radius_m + b_radius_m || apart_m < std::abs(a_radius_m - b_radius_m) ||
      apart_m == 0) {
    return std::nullopt;
  }
  const Vec3 along = line / apart_m;
  const double foot_m =
      0.5 * (apart_m + (a_radius_m * a_radius_m - b_radius_m * b_radius_m) / apart_m);
  const double height_m = std::sqrt(std::max(0.0, a_radius_m * a_radius_m - foot_m * foot_m));
  return a + foot_m * along + side * height_m * axis.cross(along);
}

std::optional<Vec3> Knee_P_m(const FourBar& linkage, const JointPlace& place) {
  return MeetingPoint(linkage.rocker_pin_P_m, linkage.rocker_m,
                      place.X_PB * linkage.coupler_pin_B_m, linkage.coupler_m, place.axis_P,
                      linkage.branch);
}

Vec3 ClosedKnee_P_m(const FourBar& linkage, const JointPlace& place) {
  const auto knee_P_m = Knee_P_m(linkage, place);
  TERA_CHECK(knee_P_m.has_value(), linkage.name);
  return *knee_P_m;
}

/// Rate of the rocker's angle in P over that of the joint. The coupler keeps its length:
/// (K - C) . (phi' a x (K - R) - a x (C - O)) = 0
/// with the joint's pin O, the rocker's pin R, the coupler's pin C, the knee K and the axis a.
double RockerRatio(const FourBar& linkage, const JointPlace& place, const Vec3& knee_P_m) {
  const Vec3 coupler_P_m = place.X_PB * linkage.coupler_pin_B_m;
  const Vec3 coupler = knee_P_m - coupler_P_m;
  return coupler.dot(place.axis_P.cross(coupler_P_m - place.X_PB.translation())) /
         coupler.dot(place.axis_P.cross(knee_P_m - linkage.rocker_pin_P_m));
}

/// A point in P and its derivative with respect to the joint's position.
struct MovingPin {
  Vec3 p_P_m = Vec3::Zero(), rate_P_m = Vec3::Zero();
};

MovingPin PinOnLink(const Joint& joint, const JointPlace& place, int link, const Vec3& pin_m) {
  if (link != joint.child) return {.p_P_m = pin_m};
  const Vec3 p_P_m = place.X_PB * pin_m;
  if (joint.type == JointType::kPrismatic) return {p_P_m, place.axis_P};
  return {p_P_m, place.axis_P.cross(p_P_m - place.X_PB.translation())};
}

MovingPin PinOnRocker(const FourBar& linkage, const JointPlace& place, const Vec3& pin_R_m) {
  const Vec3 knee_P_m = ClosedKnee_P_m(linkage, place);
  const Vec3& pivot_P_m = linkage.rocker_pin_P_m;
  const Vec3 p_P_m = AlongBar(pivot_P_m, knee_P_m, place.axis_P) * pin_R_m;
  return {p_P_m, RockerRatio(linkage, place, knee_P_m) * place.axis_P.cross(p_P_m - pivot_P_m)};
}

struct MovingPins {
  MovingPins(const MachineModel& model, const Cylinder& cylinder, double q_rad) {
    const Joint& joint = model.joints[cylinder.joint];
    const JointPlace place(joint, q_rad);
    barrel = PinOnLink(joint, place, cylinder.barrel_link, cylinder.barrel_pin_m);
    rod = cylinder.linkage < 0
              ? PinOnLink(joint, place, cylinder.rod_link, cylinder.rod_pin_m)
              : PinOnRocker(model.linkages[cylinder.linkage], place, cylinder.rod_pin_m);
  }

  MovingPin barrel, rod;
};

double DiscArea_m2(double diameter_m) { return 0.25 * std::numbers::pi * diameter_m * diameter_m; }

}  // namespace

std::optional<FourBarPose> SolveFourBar(const MachineModel& model, const FourBar& linkage,
                                        double q_rad) {
  const JointPlace place(model.joints[linkage.joint], q_rad);
  const auto knee_P_m = Knee_P_m(linkage, place);
  if (!knee_P_m) return std::nullopt;
  return FourBarPose{
      .X_PR = AlongBar(linkage.rocker_pin_P_m, *knee_P_m, place.axis_P),
      .X_PC = AlongBar(place.X_PB * linkage.coupler_pin_B_m, *knee_P_m, place.axis_P)};
}

FourBarPose PoseOf(const MachineModel& model, const FourBar& linkage, double q_rad) {
  const auto pose = SolveFourBar(model, linkage, q_rad);
  TERA_CHECK(pose.has_value(), linkage.name, q_rad);
  return *pose;
}

CylinderPins PinsOf(const MachineModel& model, const Cylinder& cylinder, double q_rad) {
  const MovingPins pins(model, cylinder, q_rad);
  return {pins.barrel.p_P_m, pins.rod.p_P_m};
}

CylinderReach ReachOf(const MachineModel& model, const Cylinder& cylinder, double q_rad) {
  const MovingPins pins(model, cylinder, q_rad);
  const Vec3 line = pins.rod.p_P_m - pins.barrel.p_P_m;
  const double length_m = line.norm();
  return {length_m, line.dot(pins.rod.rate_P_m - pins.barrel.rate_P_m) / length_m};
}

double HeadArea_m2(const Cylinder& cylinder) { return DiscArea_m2(cylinder.bore_m); }

double RodArea_m2(const Cylinder& cylinder) {
  return DiscArea_m2(cylinder.bore_m) - DiscArea_m2(cylinder.rod_diameter_m);
}

double CylinderDisplacement_m3prad(const MachineModel& model, int joint, double q_rad, int sign) {
  double displacement_m3prad = 0;
  for (const Cylinder& cylinder : model.cylinders) {
    if (cylinder.joint != joint || cylinder.bore_m == 0) continue;
    const double arm_m = ReachOf(model, cylinder, q_rad).arm_m;
    const double area_m2 = sign * arm_m > 0 ? HeadArea_m2(cylinder) : RodArea_m2(cylinder);
    displacement_m3prad += cylinder.count * area_m2 * std::abs(arm_m);
  }
  return displacement_m3prad;
}

}  // namespace tera
