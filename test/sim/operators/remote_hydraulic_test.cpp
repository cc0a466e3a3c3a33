#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "remote_machine.h"

// The control modes above levers, on a machine with dead bands, curves, delay, friction, droop and
// sag: the shipped overlay of its hydraulics.

namespace tera {
namespace {

class RemoteHydraulicTest : public RemoteMachineTest {
 protected:
  RemoteHydraulicTest() : RemoteMachineTest({"config/effects/tb235_hydraulic.yaml"}) {}

  /// Largest motion of any joint while `message` continues for `duration_s`.
  double Unrest_rad(const ControlMessage& message, double duration_s) {
    std::vector<double> least_rad = state().q_rad, most_rad = state().q_rad;
    for (int piece = 0; piece < duration_s * 10; ++piece) {
      Drive(message, 0.1);
      for (std::size_t j = 0; j < least_rad.size(); ++j) {
        least_rad[j] = std::min(least_rad[j], state().q_rad[j]);
        most_rad[j] = std::max(most_rad[j], state().q_rad[j]);
      }
    }
    double widest_rad = 0;
    for (std::size_t j = 0; j < least_rad.size(); ++j) {
      widest_rad = std::max(widest_rad, most_rad[j] - least_rad[j]);
    }
    return widest_rad;
  }
};

TEST_F(RemoteHydraulicTest, TakesTheBucketTipToPlacesAndRests) {
  // Across, a small step, and up: 8 s are enough for the slowest of them.
  for (const Vec3& target_m : {Vec3(3.2, 1.1, 0.8), Vec3(4.5, -1.5, 0.3), Vec3(4.4, -1.4, 0.4),
                               Vec3(2.8, 2.0, 1.8), Vec3(3.2, 1.1, 0.8)}) {
    const ControlMessage message{
        .command = ControlMessage::ToolPose{"bucket_tip", {target_m, std::nullopt}}};
    Drive(message, 10.0);
    EXPECT_LT((TipInRoot() - target_m).norm(), 0.03) << target_m.transpose();
    EXPECT_LT(Unrest_rad(message, 4.0), 0.3 * kDeg) << target_m.transpose();
  }
}

TEST_F(RemoteHydraulicTest, TakesJointsToAnglesAndRests) {
  using Angles = std::vector<std::pair<std::string, double>>;
  for (const Angles& angles :
       {Angles{{"boom", 0.4}, {"arm", -0.9}, {"bucket", 0.5}, {"slew", 0.4}, {"blade", 0.1}},
        Angles{{"boom", 0.72}, {"arm", -1.7}, {"bucket", -0.14}, {"slew", -1.2}, {"swing", 0.2}},
        Angles{{"boom", 0.7}, {"arm", -1.65}, {"bucket", -0.1}, {"slew", -1.1}, {"swing", 0.1}}}) {
    const ControlMessage message{.command = ControlMessage::JointPositions{ByLever(angles)}};
    Drive(message, 10.0);
    for (const auto& [joint, angle_rad] : angles) {
      EXPECT_NEAR(Angle(joint.c_str()), angle_rad, 0.5 * kDeg) << joint;
    }
    EXPECT_LT(Unrest_rad(message, 4.0), 0.3 * kDeg);
  }
}

TEST_F(RemoteHydraulicTest, TurnsJointsAtTheRatesAskedFor) {
  const auto rates = ByLever({{"boom", 0.05}, {"arm", -0.10}, {"slew", 0.15}});
  const ControlMessage message{.command = ControlMessage::JointRates{rates}};
  Drive(message, 2.0);
  const double boom_rad = Angle("boom"), arm_rad = Angle("arm"), slew_rad = Angle("slew");
  Drive(message, 2.0);
  EXPECT_NEAR(Angle("boom") - boom_rad, 0.10, 0.005);
  EXPECT_NEAR(Angle("arm") - arm_rad, -0.20, 0.01);
  EXPECT_NEAR(Angle("slew") - slew_rad, 0.30, 0.015);
}

}  // namespace
}  // namespace tera
