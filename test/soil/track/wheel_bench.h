#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "soil/soil_fixture.h"

/// A single wheel in a soil bin. A frame drives it along level ground at a set slip and slip angle,
/// and lets it sink under its load.

namespace tera::testing_soil {

struct RigidWheel {
  double radius_m, width_m, load_n;
  double grouser_m = 0;
  int patches = 21;
};

/// The wheel as patches around its lower half, its axle at the link's origin.
inline RunningGear WheelGear(const RigidWheel& wheel) {
  constexpr double kReach_rad = 80 * kDeg;
  const int count = wheel.patches;
  RunningGear gear;
  gear.name = "wheel";
  gear.drive_radius_m = wheel.radius_m;
  gear.grouser_m = wheel.grouser_m;
  for (int k = 0; k < count; ++k) {
    const double angle_rad = kReach_rad * (2 * (k + 0.5) / count - 1);
    const double s = std::sin(angle_rad), c = std::cos(angle_rad);
    ContactPatch patch;
    patch.outward_B = Vec3(s, 0, -c);
    patch.travel_B = Vec3(-c, 0, -s);
    patch.p_B_m = wheel.radius_m * patch.outward_B;
    patch.length_m = wheel.radius_m * 2 * kReach_rad / count;
    patch.width_m = wheel.width_m;
    gear.patches.push_back(patch);
  }
  return gear;
}

/// Means over the last quarter of a run of 12 radii, in the wheel's frame: x ahead, y to its left.
struct WheelTest {
  double still_m = 0;     ///< sinkage of its lowest point before it starts
  double sinkage_m = 0;   ///< the same as it runs
  double drawbar_n = 0;   ///< on the frame, ahead
  double side_n = 0;      ///< on the frame, against its motion to the left
  double traction_n = 0;  ///< torque over radius
};

/// `soil_yaml` is the site's but for size and cells. `rim_over_way` is the rim's speed over that of
/// the axle along the way.
inline WheelTest RunWheelAt(const RigidWheel& wheel, const std::string& soil_yaml,
                            double rim_over_way, double slip_angle_rad = 0) {
  constexpr double kCellsAcross = 12, kLeastCell_m = 0.01;
  const double speed_mps = 0.1 + 0.2 * wheel.radius_m;
  // As it falls freely: in a step by less than the ground rebounds.
  const double sinking_mps = std::max(0.02, 0.08 * wheel.radius_m);
  const int settle = 2000, run = static_cast<int>(12 * wheel.radius_m / speed_mps / kStep_s);
  const auto soil =
      MakeGround(fmt::format("size_m: [{0}, {0}]\ncell_m: {1}\n{2}", 24 * wheel.radius_m,
                             std::max(kLeastCell_m, wheel.width_m / kCellsAcross), soil_yaml));
  GroundTools tools;
  tools.gears.push_back(WheelGear(wheel));
  const int machine = soil->AddMachine(tools);
  const double yaw_rad = 0.2;
  const Mat3 R_WB = RotationFromRpy(0, 0, yaw_rad);
  const Vec3 ahead_W = R_WB.col(0), left_W = R_WB.col(1);
  const Vec3 v_W_mps =
      speed_mps * (std::cos(slip_angle_rad) * ahead_W + std::sin(slip_angle_rad) * left_W);
  const double rate_radps = rim_over_way * speed_mps / wheel.radius_m;

  std::vector<BodyState> links(1);
  links[0].X_WB =
      MakePose(-0.5 * run * kStep_s * v_W_mps + Vec3(0, 0, wheel.radius_m), 0, 0, yaw_rad);
  GroundToolsMotion motion;
  motion.links = &links;
  motion.gear_rate_radps = {0};
  WheelTest test;
  const int measured = run / 4;
  for (int k = 0; k < settle + run; ++k) {
    if (k == settle) {
      test.still_m = wheel.radius_m - links[0].X_WB.translation().z();
      links[0].v_WB_mps = v_W_mps;
      motion.gear_rate_radps = {rate_radps};
    }
    const SoilReaction reaction = soil->Act(machine, motion, kStep_s);
    soil->Flow(kStep_s);
    const Vec3 force_n = reaction.link_wrench[0].force_W_n;
    links[0].v_WB_mps.z() = -sinking_mps * std::clamp(1 - force_n.z() / wheel.load_n, -1.0, 1.0);
    links[0].X_WB.translation() += kStep_s * links[0].v_WB_mps;
    if (k < settle + run - measured) continue;
    test.sinkage_m += (wheel.radius_m - links[0].X_WB.translation().z()) / measured;
    test.drawbar_n += force_n.dot(ahead_W) / measured;
    test.side_n -= force_n.dot(left_W) / measured;
    test.traction_n += reaction.gear_traction_n[0] / measured;
  }
  return test;
}

/// Straight across, at a slip angle of 90 deg, the wheel is locked.
inline WheelTest RunWheel(const RigidWheel& wheel, const std::string& soil_yaml, double slip,
                          double slip_angle_rad = 0) {
  return RunWheelAt(wheel, soil_yaml, std::cos(slip_angle_rad) / (1 - slip), slip_angle_rad);
}

}  // namespace tera::testing_soil
