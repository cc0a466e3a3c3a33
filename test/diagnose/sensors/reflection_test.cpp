#include "diagnose/sensors/reflection.h"

#include <gtest/gtest.h>

#include "core/units.h"
#include "diagnose/sensors/made_recording.h"
#include "diagnose/sensors/sensor_parameters.h"
#include "sensors/gnss/gnss_errors.h"
#include "sensors/sensor_mechanisms.h"

namespace tera {
namespace {

Effects MultipathOf(double horizontal_m, double vertical_m, double azimuth_deg) {
  for (const Mechanism& mechanism : SensorMechanisms()) {
    if (mechanism.id == "multipath") {
      return {Effect{&mechanism, {horizontal_m, vertical_m, azimuth_deg}}};
    }
  }
  ADD_FAILURE() << "no multipath";
  return {};
}

TEST(RaisedPart, HasTheAzimuthOfABoomOnATurnedMachine) {
  // Base turned by 40 degrees and level, swing by 30, boom raised by 25.
  MachineModel model = TurningMachine();
  model.joints[1].X_PJ = MakePose({0.8, 0.1, 0.4});
  const auto part = RaisedPartOf(model, model.LinkIndex("upper"), {0, 1});
  ASSERT_TRUE(part);
  Eigen::VectorXd numbers = Eigen::VectorXd::Zero(kBaseNumbers + 2);
  numbers[kYaw] = 40 * kDeg;
  numbers.tail<2>() = Eigen::Vector2d(30, 25) * kDeg;
  const Eigen::Vector2d raised = part->At(numbers);
  EXPECT_NEAR(raised.x(), std::sin(25 * kDeg) * std::cos(70 * kDeg), 1e-12);
  EXPECT_NEAR(raised.y(), std::sin(25 * kDeg) * std::sin(70 * kDeg), 1e-12);
}

TEST(RaisedPart, ThatHangsReflectsNothing) {
  MachineModel model = TurningMachine();
  const auto part = RaisedPartOf(model, model.LinkIndex("upper"), {0, 1});
  ASSERT_TRUE(part);
  Eigen::VectorXd numbers = Eigen::VectorXd::Zero(kBaseNumbers + 2);
  numbers.tail<2>() = Eigen::Vector2d(0.5, -0.4);
  EXPECT_EQ(part->At(numbers), Eigen::Vector2d::Zero());
}

/// Upper bounds of the search for a receiver's reflections with this fix.
std::vector<double> LargestOf(GnssFix fix) {
  SensorDescription receiver;
  receiver.name = "left";
  receiver.model = GnssModel{.fix = fix};
  ParameterTable table;
  ReceiverChannel channel;
  AddReflectionParameters(receiver, &table, &channel);
  std::vector<double> largest_m;
  for (const SensorParameter& one : table.parameters) largest_m.push_back(one.upper);
  return largest_m;
}

// A quarter of 299792458 m/s over 1575.42 and 1227.60 MHz, in the combination without ionosphere.
TEST(Reflection, OfAFixedReceiverIsNoMoreThanPhasesCanBeOff) {
  const double f1 = 1575.42e6, f2 = 1227.60e6, c = 299792458;
  const double most_m = (f1 * f1 * (c / f1 / 4) + f2 * f2 * (c / f2 / 4)) / (f1 * f1 - f2 * f2);
  for (const double largest_m : LargestOf(GnssFix::kRtkFixed)) {
    EXPECT_NEAR(largest_m, most_m, 0.005);
  }
  for (const GnssFix fix : {GnssFix::kRtkFloat, GnssFix::kSingle}) {
    for (const double largest_m : LargestOf(fix)) EXPECT_EQ(largest_m, 5);
  }
}

// A library with a range up to 0.3 m allows any azimuth.
TEST(Reflection, HasNumbersOfEitherSignInTheRangeOfALibrary) {
  SensorDescription receiver;
  receiver.name = "left";
  receiver.model = GnssModel{};
  ParameterTable table;
  ReceiverChannel channel;
  AddReflectionParameters(receiver, &table, &channel);
  CandidateLibrary library;
  library.ranges = {{MultipathOf(0, 0, 0).front().mechanism, {{0, 0, 0.3}}}};
  table.LimitTo(library);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(table.parameters[i].lower, -0.3);
    EXPECT_EQ(table.parameters[i].upper, 0.3);
  }
}

TEST(Reflection, IsThatOfAReceiver) {
  const Stream draw(3, "reflection");
  for (int k = 0; k < 50; ++k) {
    const double h_m = draw.Uniform(k, 0), v_m = draw.Uniform(k, 1),
                 azimuth_deg = 360 * draw.Uniform(k, 2) - 180;
    const Vec3 boom_W = draw.Gaussian3(k, 3).normalized();
    const Vec3 expected_m = MultipathError(MultipathOf(h_m, v_m, azimuth_deg), RaisedBoom{boom_W});
    const Eigen::Vector4d n = LinearReflection({h_m, v_m, azimuth_deg * kDeg});
    const Eigen::Vector2d r =
        std::max(0.0, boom_W.z()) * boom_W.head<2>() / boom_W.head<2>().norm();
    EXPECT_LT((ByReflection(r) * n - expected_m).norm(), 1e-12);
    const Reflection back = ReflectionOf(n);
    EXPECT_NEAR(back.horizontal_m, h_m, 1e-12);
    EXPECT_NEAR(back.vertical_m, v_m, 1e-12);
    EXPECT_NEAR(back.azimuth_rad, azimuth_deg * kDeg, 1e-12);
  }
}

}  // namespace
}  // namespace tera
