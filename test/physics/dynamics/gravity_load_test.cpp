#include "physics/dynamics/gravity_load.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"
#include "physics/machine_fixture.h"

namespace tera {
namespace {

/// Two links of 10 and 4 kg that turn about -y, so that positive angles raise them.
const char* const kTwoLinks = R"(
kind: arm
fixed_base: true
links:
  base: {mass_kg: 50, inertia_kgm2: [1, 1, 1]}
  upper: {mass_kg: 10, com_m: [0.5, 0, 0], inertia_kgm2: [1, 1, 1]}
  lower: {mass_kg: 4, com_m: [0.3, 0, 0], inertia_kgm2: [1, 1, 1]}
joints:
  shoulder: {type: revolute, parent: base, child: upper, axis: [0, -1, 0], limits_deg: [-90, 90],
             max_rate_degps: 30, max_effort_nm: 500}
  elbow: {type: revolute, parent: upper, child: lower, xyz_m: [1, 0, 0], axis: [0, -1, 0],
          limits_deg: [-90, 90], max_rate_degps: 30, max_effort_nm: 500}
levers: [shoulder, elbow]
)";

TEST(GravityLoad, IsWeightTimesHorizontalDistance) {
  const MachineModel model = MachineFromText(kTwoLinks);
  const double a = 30 * kDeg, b = 25 * kDeg, g = kStandardGravity_mps2;
  const double elbow_nm = 4 * g * 0.3 * std::cos(a + b);
  const double shoulder_nm = 10 * g * 0.5 * std::cos(a) + 4 * g * std::cos(a) + elbow_nm;
  const auto loads_nm = GravityLoads_nm(model, Pose::Identity(), {a, b});
  EXPECT_NEAR(loads_nm[0], shoulder_nm, 1e-9);
  EXPECT_NEAR(loads_nm[1], elbow_nm, 1e-9);
}

TEST(GravityLoad, OfALeaningMachineIsThatOfItsTrueAttitude) {
  const MachineModel model = MachineFromText(kTwoLinks);
  Pose X_WB = Pose::Identity();
  X_WB.rotate(Eigen::AngleAxisd(-20 * kDeg, Vec3::UnitY()));  // nose up
  X_WB.translation() = Vec3(3, -2, 1);
  const auto leaning_nm = GravityLoads_nm(model, X_WB, {10 * kDeg, 25 * kDeg});
  const auto level_nm = GravityLoads_nm(model, Pose::Identity(), {30 * kDeg, 25 * kDeg});
  EXPECT_NEAR(leaning_nm[0], level_nm[0], 1e-9);
  EXPECT_NEAR(leaning_nm[1], level_nm[1], 1e-9);
}

}  // namespace
}  // namespace tera
