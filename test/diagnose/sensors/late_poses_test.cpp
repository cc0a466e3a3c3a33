#include "diagnose/sensors/late_poses.h"

#include <gtest/gtest.h>

#include "diagnose/sensors/named_clock.h"

namespace tera {
namespace {

/// Poses that come at 1 s and 1.1 s.
Measurements TwoPoses() {
  Measurements measured;
  measured.poses.resize(2);
  measured.poses[0].t_ns = 1'000'000'000;
  measured.poses[1].t_ns = 1'100'000'000;
  return measured;
}

TEST(LatePoses, AreStampedWhenTheyWereMeasured) {
  Measurements measured = TwoPoses();
  EXPECT_TRUE(StampPosesAnew(NamedClock("poses", 0.16), &measured));
  EXPECT_EQ(measured.poses[0].t_ns, 840'000'000);
  EXPECT_EQ(measured.poses[1].t_ns, 940'000'000);
}

TEST(LatePoses, KeepTheirStampsWhereSomethingElseMayBeLateOrIs) {
  SensorDiagnosis either = NamedClock("poses", 0.16);
  either.findings[0].rivals = {
      {"imu_chassis", &SensorMechanism("clock_offset", EffectTarget::kImu)}};
  SensorDiagnosis turned = NamedClock("poses", 0.16);
  turned.findings[0].mechanism = &SensorMechanism("mount_rotation", EffectTarget::kImu);
  for (const SensorDiagnosis& estimate : {either, turned, NamedClock("gnss_left", 0.16)}) {
    Measurements measured = TwoPoses();
    EXPECT_FALSE(StampPosesAnew(estimate, &measured));
    EXPECT_EQ(measured.poses[0].t_ns, 1'000'000'000);
  }
}

}  // namespace
}  // namespace tera
