#include "physics/traction/turning_centre.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "physics/machine_fixture.h"

namespace tera {
namespace {

/// A chassis of 1000 kg with its mass `ahead_m` of the middle of its tracks. 500 kg on it turn
/// about a point 0.1 m ahead of that middle, at a distance of 0.4 m.
std::string Crawler(double ahead_m) {
  return fmt::format(R"(
kind: crawler
links:
  chassis: {{mass_kg: 1000, com_m: [{}, 0, 0], inertia_kgm2: [300, 500, 600]}}
  upper: {{mass_kg: 500, com_m: [0.4, 0, 0.5], inertia_kgm2: [90, 90, 90]}}
joints:
  slew: {{type: continuous, parent: chassis, child: upper, xyz_m: [0.1, 0, 0.5], axis: [0, 0, 1], max_rate_degps: 50, max_effort_nm: 1.0e5}}
gauge_m: 1.2
tracks:
  left: {{link: chassis, center_m: [0, 0.6, 0.3], wheelbase_m: 2, radius_m: 0.3, width_m: 0.3, max_speed_mps: 1, max_torque_nm: 1000, inertia_kgm2: 25}}
  right: {{link: chassis, center_m: [0, -0.6, 0.3], wheelbase_m: 2, radius_m: 0.3, width_m: 0.3, max_speed_mps: 1, max_torque_nm: 1000, inertia_kgm2: 25}}
levers: [left, right, slew]
)",
                     ahead_m);
}

// Turned forward, the centre of mass is (1000 * 0.03 + 500 * 0.5) / 1500 m ahead; turned back,
// (1000 * 0.03 - 500 * 0.3) / 1500.
TEST(TurningCentre, FollowsFromTheMassesWhereTheyReachFarthest) {
  const MachineModel model = MachineFromText(Crawler(0.03));
  EXPECT_NEAR(TurningCentreReach_m(model), 1.5 * 280 / 1500, 1e-12);
  EXPECT_NEAR(TurningCentreReach_m(MachineFromText(Crawler(-0.2))), 1.5 * 350 / 1500, 1e-12);
}

// The median and the centre of a linearly falling load of a track, by sums over a million slices.
TEST(TurningCentre, LiesHalfAsFarAgainFromTheMiddleAsTheCentreOfTheLoad) {
  constexpr int kSlices = 1'000'000;
  constexpr double kSlope = 0.1;  // the load is 1 + 0.1 x over a track from -1 to 1
  double load = 0, moment = 0;
  for (int i = 0; i < kSlices; ++i) {
    const double x = -1 + 2 * (i + 0.5) / kSlices;
    load += 1 + kSlope * x;
    moment += (1 + kSlope * x) * x;
  }
  double before = 0, median = -1;
  for (int i = 0; i < kSlices && before < load / 2; ++i) {
    median = -1 + 2 * (i + 0.5) / kSlices;
    before += 1 + kSlope * median;
  }
  EXPECT_NEAR(median / (moment / load), 1.5, 0.01);
}

}  // namespace
}  // namespace tera
