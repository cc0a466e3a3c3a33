#include "physics/dynamics/joint_inertia.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"
#include "physics/machine_fixture.h"

namespace tera {
namespace {

/// Two links of 10 and 4 kg that turn about -y, and a slider of 2 kg along the second one's x.
const char* const kTwoLinksAndASlider = R"(
kind: arm
fixed_base: true
links:
  base: {mass_kg: 50, inertia_kgm2: [1, 1, 1]}
  upper: {mass_kg: 10, com_m: [0.5, 0, 0], inertia_kgm2: [1.5, 1.5, 2.5]}
  lower: {mass_kg: 4, com_m: [0.3, 0, 0], inertia_kgm2: [0.6, 0.7, 0.2]}
  slide: {mass_kg: 2, com_m: [0.1, 0, 0], inertia_kgm2: [0.2, 0.3, 0.2]}
joints:
  shoulder: {type: revolute, parent: base, child: upper, axis: [0, -1, 0], limits_deg: [-90, 90],
             max_rate_degps: 30, max_effort_nm: 500}
  elbow: {type: revolute, parent: upper, child: lower, xyz_m: [1, 0, 0], axis: [0, -1, 0],
          limits_deg: [-90, 90], max_rate_degps: 30, max_effort_nm: 500}
  extension: {type: prismatic, parent: lower, child: slide, xyz_m: [0.6, 0, 0], axis: [1, 0, 0],
              limits_m: [0, 1], max_rate_mps: 0.3, max_effort_n: 500}
levers: [shoulder, elbow, extension]
)";

TEST(JointInertia, IsThatOfAllMassesBeyondAboutTheAxis) {
  const MachineModel model = MachineFromText(kTwoLinksAndASlider);
  const double b = 40 * kDeg, out_m = 0.25;
  const auto inertia_kgm2 = JointInertias_kgm2(model, {25 * kDeg, b, out_m});
  // Steiner: I_c + m r^2, the slider's centre 0.6 + 0.25 + 0.1 m beyond the elbow.
  const double slide_m = 0.6 + out_m + 0.1;
  const double elbow_kgm2 = 0.7 + 4 * 0.3 * 0.3 + 0.3 + 2 * slide_m * slide_m;
  const auto from_shoulder_m2 = [&](double r_m) { return 1 + r_m * r_m + 2 * r_m * std::cos(b); };
  const double shoulder_kgm2 =
      1.5 + 10 * 0.25 + 0.7 + 4 * from_shoulder_m2(0.3) + 0.3 + 2 * from_shoulder_m2(slide_m);
  EXPECT_NEAR(inertia_kgm2[0], shoulder_kgm2, 1e-9);
  EXPECT_NEAR(inertia_kgm2[1], elbow_kgm2, 1e-9);
  EXPECT_NEAR(inertia_kgm2[2], 2, 1e-12);
}

TEST(YawInertia, IsAboutTheCentreOfMassOfTheMachineAsItStands) {
  // Arm straight out along x: masses of 50, 10, 4 and 2 kg at 0, 0.5, 1.3 and 1.7 m.
  const MachineModel model = MachineFromText(kTwoLinksAndASlider);
  const double moment_kgm = 10 * 0.5 + 4 * 1.3 + 2 * 1.7;
  const double about_root_kgm2 =
      1 + 2.5 + 0.2 + 0.2 + 10 * 0.5 * 0.5 + 4 * 1.3 * 1.3 + 2 * 1.7 * 1.7;
  EXPECT_NEAR(YawInertia_kgm2(model, {0, 0, 0}), about_root_kgm2 - moment_kgm * moment_kgm / 66,
              1e-9);
  // Upright, a link turns about its own x; nothing is far from the axis.
  EXPECT_NEAR(YawInertia_kgm2(model, {90 * kDeg, 0, 0}), 1 + 1.5 + 0.6 + 0.2, 1e-9);
}

}  // namespace
}  // namespace tera
