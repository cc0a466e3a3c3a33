#include "physics/actuation/joint_of_stroke.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"
#include "physics/actuation/cylinder_fixture.h"
#include "physics/machine_fixture.h"

namespace tera {
namespace {

/// By the law of cosines, with the pins of kCylinderArm.
double Length_m(double q_deg) {
  const double between_rad = (126.870 - 22.620 - q_deg) * kDeg;
  return std::sqrt(0.5 * 0.5 + 1.3 * 1.3 - 2 * 0.5 * 1.3 * std::cos(between_rad));
}

TEST(JointOfStroke, IsWhatTheLawOfCosinesSays) {
  const MachineModel model = MachineFromText(kCylinderArm);
  const Cylinder& ram = model.cylinders.front();
  // The cylinder is above the arm: raised, it is shortest.
  for (const double q_deg : {-40.0, -39.0, -12.3, 0.0, 33.3, 69.0, 70.0}) {
    const double stroke_m = Length_m(q_deg) - Length_m(70);
    EXPECT_NEAR(JointOfStroke(model, ram, stroke_m) / kDeg, q_deg, 1e-3) << q_deg;
  }
}

TEST(JointOfStroke, TravelGivesItsCylinderStrokesFromEndToEnd) {
  const MachineModel model = MachineFromText(kCylinderArm);
  const StrokeRange strokes = StrokesOf(model, model.cylinders.front());
  EXPECT_NEAR(strokes.least_m, 0, 1e-5);
  EXPECT_NEAR(strokes.most_m, Length_m(-40) - Length_m(70), 1e-5);
}

TEST(JointOfStroke, GoesStraightOnBeyondTheTravel) {
  const MachineModel model = MachineFromText(kCylinderArm);
  const Cylinder& ram = model.cylinders.front();
  const double slope_mprad = (Length_m(-39.99) - Length_m(-40.01)) / (0.02 * kDeg);
  const double beyond_rad = JointOfStroke(model, ram, Length_m(-40) - Length_m(70) + 0.004);
  EXPECT_NEAR(beyond_rad, -40 * kDeg + 0.004 / slope_mprad, 1e-4);
}

}  // namespace
}  // namespace tera
