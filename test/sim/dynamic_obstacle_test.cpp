#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/faults.h"
#include "core/units.h"
#include "drive_fixture.h"

/// Obstacles moved by forces, against closed forms.

namespace tera {
namespace {

constexpr double kGravity_mps2 = 9.80665, kFriction = 0.5;

/// A box of `size_m` and 100 kg that stands on the ground at (x, y).
std::string BoxAt(const std::string& name, double x_m, double y_m, const Vec3& size_m,
                  const std::string& more = "dynamic: {mass_kg: 100}") {
  return fmt::format(
      "  - {{name: {}, label: structure, mesh: tera:assets/rock.glb, xy_m: [{}, {}], "
      "collision: [{{xyz_m: [0, 0, {}], size_m: [{}, {}, {}]}}], {}}}\n",
      name, x_m, y_m, 0.5 * size_m.z(), size_m.x(), size_m.y(), size_m.z(), more);
}

/// A parked machine far from `obstacles` on firm ground that falls towards +x.
Drive WithObstacles(const std::string& obstacles, double slope_deg = 0) {
  return Drive("tb235.yaml", "{xy_m: [-10, 7]}",
               fmt::format("cell_m: 0.1, soil: asphalt, relief: {{slope_deg: {}, "
                           "slope_direction_deg: 180}}",
                           slope_deg),
               0, 0, "settle_s: 1\nobstacles:\n" + obstacles);
}

const BodyState& Thing(const Drive& drive, std::size_t o = 0) {
  return drive.simulation->state().obstacles[o];
}
double Lean_rad(const BodyState& body) { return std::acos(body.X_WB.linear()(2, 2)); }

TEST(DynamicObstacle, RestsOnTheGround) {
  Drive drive = WithObstacles(BoxAt("box", 3, 0, {0.6, 0.4, 0.5}));
  drive.Run(2);
  const BodyState& box = Thing(drive);
  EXPECT_NEAR(box.X_WB.translation().x(), 3, 1e-3);
  EXPECT_NEAR(box.X_WB.translation().z(), 0, 0.005);
  EXPECT_LT(box.v_WB_mps.norm(), 1e-4);
  EXPECT_LT(box.w_WB_radps.norm(), 1e-3);
}

TEST(DynamicObstacle, SlidesDownASlopeSteeperThanItsFriction) {
  constexpr double kSlope_rad = 33 * kDeg;
  Drive drive = WithObstacles(BoxAt("box", -2, 0, {0.8, 0.8, 0.2}), 33);
  const double v_mps = Thing(drive).v_WB_mps.norm();
  drive.Run(1);
  const double expected_mps2 =
      kGravity_mps2 * (std::sin(kSlope_rad) - kFriction * std::cos(kSlope_rad));
  EXPECT_NEAR(Thing(drive).v_WB_mps.norm() - v_mps, expected_mps2, 0.05 * expected_mps2);
}

TEST(DynamicObstacle, StaysOnAFlatterSlope) {
  Drive drive = WithObstacles(BoxAt("box", -2, 0, {0.8, 0.8, 0.2}), 20);
  const double x_m = Thing(drive).X_WB.translation().x();
  drive.Run(3);
  EXPECT_NEAR(Thing(drive).X_WB.translation().x(), x_m, 0.01);
}

TEST(DynamicObstacle, TipsWhereItsCentreLeavesItsFoot) {
  // Width over height is the tangent of 14.0 deg, below the friction angle of 26.6 deg.
  Drive standing = WithObstacles(BoxAt("post", 0, 0, {0.2, 0.8, 0.8}), 9);
  standing.Run(4);
  EXPECT_NEAR(Lean_rad(Thing(standing)) / kDeg, 9, 3);
  Drive tipping = WithObstacles(BoxAt("post", 0, 0, {0.2, 0.8, 0.8}), 15.5);
  tipping.Run(4);
  EXPECT_GT(Lean_rad(Thing(tipping)) / kDeg, 60);
}

TEST(DynamicObstacle, StandsOnAnother) {
  const std::string below = "height_above_ground_m: 0, dynamic: {mass_kg: 100}";
  const std::string above = "height_above_ground_m: 0.52, dynamic: {mass_kg: 40}";
  Drive drive = WithObstacles(BoxAt("below", 3, 0, {0.6, 0.6, 0.5}, below) +
                              BoxAt("above", 3, 0, {0.4, 0.4, 0.4}, above));
  drive.Run(3);
  EXPECT_NEAR(Thing(drive, 1).X_WB.translation().z(), 0.5, 0.03);
  EXPECT_LT(Thing(drive, 1).v_WB_mps.norm(), 1e-3);
}

TEST(DynamicObstacle, IsPushedAsideByAMachineThatItStopsWhenItIsFixed) {
  const auto drive_at = [](const std::string& more) {
    return Drive("tb235.yaml",
                 "{xy_m: [-2.5, 0], joints_deg: {boom: 55, arm: -130, bucket: -40, blade: 25}}",
                 "cell_m: 0.1, soil: asphalt", 0.5, 0.5,
                 "obstacles:\n" + BoxAt("cone", 0.3, 0, {0.3, 0.3, 0.7}, more));
  };
  Drive free = drive_at("dynamic: {mass_kg: 4, com_m: [0, 0, 0.15]}");
  free.Run(6);
  Drive fixed = drive_at("yaw_deg: 0");
  fixed.Run(6);
  EXPECT_LT(fixed.place().x(), -0.3);
  EXPECT_NEAR(free.place().x(), -2.5 + 6 * 0.625, 0.4);
  EXPECT_GT(Thing(free).X_WB.translation().x(), 0.6);
}

/// Position of a link's point while the parked machine holds its boom up.
constexpr char kReach[] =
    "{xy_m: [0, 0], joints_deg: {boom: 40, arm: -90, bucket: -60, blade: -10}}";
const Vec3 kHook_B_m(0, 0, 0);

Drive Hanging(const std::string& obstacles, const std::string& slings) {
  return Drive("tb235.yaml", kReach, "cell_m: 0.1, soil: asphalt", 0, 0, obstacles + slings);
}

Vec3 HookOf(const Drive& drive) {
  const int link = drive.scenario.machines[0].placement.model.LinkIndex("bucket");
  return drive.machine().links[static_cast<std::size_t>(link)].X_WB * kHook_B_m;
}

/// A sling from the bucket's pin to the middle of a cube of 0.3 m that hangs `aside_m` to its side.
std::string Load(const Vec3& hook_W_m, double length_m, double aside_m) {
  const double down_m = std::sqrt(length_m * length_m - aside_m * aside_m);
  return BoxAt("load", hook_W_m.x(), hook_W_m.y() + aside_m, {0.3, 0.3, 0.3},
               fmt::format("height_above_ground_m: {}, dynamic: {{mass_kg: 100}}",
                           hook_W_m.z() - down_m - 0.15));
}
std::string SlingTo(double length_m, const std::string& more = "") {
  return fmt::format(
      "slings:\n  - {{machine: m, link: bucket, xyz_m: [0, 0, 0], obstacle: load, "
      "points_m: [[0, 0, 0.15]], length_m: {}{}}}\n",
      length_m, more);
}

TEST(Sling, ALoadSwingsAsAPendulum) {
  const Vec3 hook_W_m = HookOf(Hanging("", ""));
  constexpr double kLength_m = 0.8;
  ASSERT_GT(hook_W_m.z(), kLength_m + 0.3);
  Drive drive = Hanging("obstacles:\n" + Load(hook_W_m, kLength_m, 0.12), SlingTo(kLength_m));
  int crossings = 0;
  double first_s = 0, last_s = 0, before_m = 0;
  drive.Run(12, [&] {
    const double aside_m = Thing(drive).X_WB.translation().y() - HookOf(drive).y();
    if (before_m * aside_m < 0) {
      last_s = ToSeconds(drive.simulation->state().t_ns);
      if (crossings++ == 0) first_s = last_s;
    }
    before_m = aside_m;
  });
  ASSERT_GT(crossings, 6);
  // The rope's end is the cube's middle; 1 % stretch lengthens it.
  const double period_s = 2 * kPi * std::sqrt(1.01 * kLength_m / kGravity_mps2);
  EXPECT_NEAR(2 * (last_s - first_s) / (crossings - 1), period_s, 0.02 * period_s);
}

TEST(Sling, TheLoadWeighsOnTheJointsThatHoldIt) {
  Drive empty = Hanging("", "");
  const Vec3 hook_W_m = HookOf(empty);
  Drive loaded = Hanging("obstacles:\n" + Load(hook_W_m, 1.0, 0), SlingTo(1.0));
  empty.Run(4);
  loaded.Run(4);
  const MachineModel& model = empty.scenario.machines[0].placement.model;
  const int boom = model.JointIndex("boom");
  const Vec3 pivot_W_m =
      empty.machine().links[static_cast<std::size_t>(model.joints[boom].child)].X_WB.translation();
  const double lever_m = (HookOf(empty) - pivot_W_m).head<2>().norm();
  EXPECT_NEAR(std::abs(loaded.machine().effort_nm[boom] - empty.machine().effort_nm[boom]),
              100 * kGravity_mps2 * lever_m, 0.05 * 100 * kGravity_mps2 * lever_m);
}

TEST(Sling, LiftsALoadAndLetsItGo) {
  const Vec3 hook_W_m = HookOf(Hanging("", ""));
  Drive drive = Hanging("obstacles:\n" + BoxAt("load", hook_W_m.x(), hook_W_m.y(), {0.3, 0.3, 0.3}),
                        SlingTo(hook_W_m.z() - 0.1, ", until_s: 4"));
  drive.Operate([](double t_s) { return NamedLevers{{"boom", t_s < 2 ? 0.4 : 0}}; });
  drive.Run(3.5);
  EXPECT_GT(Thing(drive).X_WB.translation().z(), 0.3);
  drive.Run(2.5);
  EXPECT_NEAR(Thing(drive).X_WB.translation().z(), 0, 0.35);
  EXPECT_LT(Thing(drive).v_WB_mps.norm(), 0.01);
}

TEST(Sling, RefusesAnUnknownHookOrLoadAndAnEndBeforeItsBegin) {
  const std::string load = "obstacles:\n" + BoxAt("load", 3, 0, {0.3, 0.3, 0.3});
  const auto read = [&](const std::string& slings) {
    return [=] { Drive::Read("tb235.yaml", kReach, "cell_m: 0.1", load + slings); };
  };
  const std::string rope =
      "slings:\n  - {machine: m, link: bucket, xyz_m: [0, 0, 0], "
      "points_m: [[0, 0, 0]], length_m: 1, ";
  EXPECT_THAT(read(rope + "obstacle: pipe}\n"), ThrowsFault(FaultKind::kNoSuchName, "obstacle"));
  EXPECT_THAT(read(rope + "obstacle: load, from_s: 3, until_s: 2}\n"),
              ThrowsFault(FaultKind::kInconsistent, "until_s"));
  EXPECT_THAT(read("slings:\n  - {machine: m, link: hook, xyz_m: [0, 0, 0], "
                   "points_m: [[0, 0, 0]], length_m: 1, obstacle: load}\n"),
              ThrowsFault(FaultKind::kNoSuchName, "link"));
}

TEST(DynamicObstacle, RefusesPathsAndBedsAndMassesOfNothing) {
  const auto read = [](const std::string& more) {
    return [more] {
      Drive::Read("tb235.yaml", "{xy_m: [0, 0]}", "cell_m: 0.1, soil: asphalt",
                  "obstacles:\n" + BoxAt("box", 3, 0, {1, 1, 1}, more));
    };
  };
  EXPECT_THAT(read("dynamic: {mass_kg: 0}"), ThrowsFault(FaultKind::kOutOfRange, "mass_kg"));
  EXPECT_THAT(read("dynamic: {mass_kg: 5}, path: [{t_s: 0, xy_m: [3, 0]}, {t_s: 1, xy_m: [4, 0]}]"),
              ThrowsFault(FaultKind::kInconsistent, "path"));
  EXPECT_THAT(read("dynamic: {mass_kg: 5}, bed: {xyz_m: [0, 0, 1], size_m: [1, 1], wall_m: 0.2}"),
              ThrowsFault(FaultKind::kInconsistent, "bed"));
}

}  // namespace
}  // namespace tera
