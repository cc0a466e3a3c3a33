#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "drive_fixture.h"

/// Objects on the ground that a machine drives over, or not.

namespace tera {
namespace {

/// Its start, with raised blade, at half speed.
constexpr double kStart_m = -2.5, kLever = 0.5, kSpeed_mps = 0.625;

struct Way {
  const char* soil;
  const char* ground;
};
constexpr Way kWays[] = {
    {"asphalt", "terramechanics"}, {"dirt", "terramechanics"}, {"asphalt", "ideal"}};

/// A box of that size on the ground at (x, 0), turned a little.
std::string Box(double x_m, const Vec3& size_m, const std::string& more = "") {
  return fmt::format(
      "obstacles:\n  - {{name: box, label: structure, mesh: tera:assets/rock.glb, xy_m: [{}, 0], "
      "yaw_deg: 3, collision: [{{xyz_m: [0, 0, {}], size_m: [{}, {}, {}]}}]{}}}\n",
      x_m, 0.5 * size_m.z(), size_m.x(), size_m.y(), size_m.z(), more);
}

Drive Over(const Way& way, const std::string& obstacle, double slew_deg = 0) {
  return Drive(
      "tb235.yaml",
      fmt::format("{{xy_m: [{}, 0], joints_deg: {{boom: 55, arm: -130, bucket: -40, blade: 25, "
                  "slew: {}}}}}",
                  kStart_m, slew_deg),
      fmt::format("cell_m: 0.1, soil: {}", way.soil), kLever, kLever,
      fmt::format("    ground: {}\n", way.ground) + obstacle);
}

double ClimbTilt_rad(const Drive& drive) { return std::acos(drive.body().X_WB.linear()(2, 2)); }

TEST(Climb, TracksDriveOverAPlankOfTenCentimetres) {
  for (const Way& way : kWays) {
    SCOPED_TRACE(fmt::format("{}, {}", way.soil, way.ground));
    Drive drive = Over(way, Box(0.5, {0.5, 4, 0.1}));
    double most_rad = 0;
    drive.Run(10.0, [&] { most_rad = std::max(most_rad, ClimbTilt_rad(drive)); });
    EXPECT_NEAR(drive.place().x(), kStart_m + 10 * kSpeed_mps, 0.4);
    EXPECT_NEAR(drive.place().z(), 0, 0.08);  // on the ground again, in ruts on dirt
    // Its tracks are 1.6 m long between their round ends. They rock over the plank, and in dirt
    // their heel sinks.
    EXPECT_GT(most_rad, 0.95 * std::asin(0.1 / 1.6));
    EXPECT_LT(most_rad / kDeg, 20);
  }
}

TEST(Climb, TracksDriveOnAPlateOfSixCentimetresAndLeaveTheGroundBelowAlone) {
  for (const Way& way : kWays) {
    SCOPED_TRACE(fmt::format("{}, {}", way.soil, way.ground));
    Drive drive = Over(way, Box(2.2, {5, 4, 0.06}));
    const TerrainSurface before = drive.simulation->ground();
    drive.Run(7.0);
    EXPECT_NEAR(drive.place().x(), kStart_m + 7 * kSpeed_mps, 0.4);
    EXPECT_NEAR(drive.place().z(), 0.06, 0.015);
    EXPECT_NEAR(ClimbTilt_rad(drive) / kDeg, 0, 1);
    for (const double x_m : {0.6, 1.2, 1.8, 2.4}) {
      for (const double y_m : {-0.6, -0.5, 0.5, 0.6}) {
        EXPECT_EQ(drive.simulation->ground().HeightAt(x_m, y_m), before.HeightAt(x_m, y_m));
      }
    }
    const MassLedger ledger = drive.simulation->state().ground().ledger();
    EXPECT_NEAR(ledger.total_kg(), 0, 1e-9 * std::max(1.0, ledger.shifted_kg));
  }
}

TEST(Climb, ABlockAsHighAsTheSprocketAndAContainerStopThem) {
  // The boom points to the rear: against a wall it would lift the machine's front.
  for (const Vec3& size_m : {Vec3(0.5, 4, 0.24), Vec3(6, 2.4, 2.6)}) {
    Drive drive = Over(kWays[0], Box(0.5 + 0.5 * size_m.x(), size_m), 180);
    drive.Run(6.0);
    // Its tracks' nose, 1.05 m ahead, or its blade, 1.6 m ahead, touches the face; by the yaw one
    // side is 6 cm nearer.
    EXPECT_LT(drive.place().x(), 0.5 - 0.9) << size_m.z();
    EXPECT_GT(drive.place().x(), 0.5 - 1.7) << size_m.z();
  }
}

TEST(Climb, ARampIsDrivenUpAtItsSlope) {
  // A board tilted by 4 deg about y, its upper end 0.17 m above its lower one.
  Drive drive = Over(kWays[0],
                     "obstacles:\n  - {name: ramp, label: structure, mesh: tera:assets/rock.glb, "
                     "xy_m: [1, 0], collision: [{xyz_m: [0, 0, 0.07], rpy_deg: [0, -4, 0], "
                     "size_m: [2.6, 4, 0.04]}]}\n");
  drive.Run(5.6);
  ASSERT_NEAR(drive.place().x(), 1.0, 0.15);
  const Vec3 forward_W = drive.body().X_WB.linear().col(0);
  EXPECT_NEAR(std::asin(forward_W.z()) / kDeg, 4, 0.5);
}

TEST(Climb, AMovingPlateCarriesWhatStandsOnIt) {
  Drive drive =
      Over(kWays[0],
           Box(0, {4, 4, 0.06}, ", path: [{t_s: 6, xy_m: [0, 0]}, {t_s: 11, xy_m: [1.0, 0.5]}]"));
  drive.Operate([](double t_s) -> NamedLevers {
    if (t_s > 4.5) return {};
    return {{"left_track", kLever}, {"right_track", kLever}};
  });
  drive.Run(6.0);
  const Vec3 at_first = drive.place();
  ASSERT_NEAR(at_first.z(), 0.06, 0.015);
  drive.Run(6.0);
  const Vec3 moved = drive.place() - at_first;
  EXPECT_NEAR(moved.x(), 1.0, 0.05);
  EXPECT_NEAR(moved.y(), 0.5, 0.05);
}

}  // namespace
}  // namespace tera
