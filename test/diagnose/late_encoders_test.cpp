#include "diagnose/late_encoders.h"

#include <gtest/gtest.h>

#include "diagnose/driven_joints.h"
#include "diagnose/sensors/named_clock.h"

namespace tera {
namespace {

/// By how much the stamps of the encoders are changed.
double StampedEarlierBy_s(DrivenJoints driven, const SensorDiagnosis& estimate) {
  Measurements measured = driven.made.measured;
  const bool has_changed =
      StampEncodersAnew(driven.made.Input(), estimate, {.threads = 1}, &measured);
  const auto first = [](const Measurements& one) {
    return one.encoders[0].recording.samples.front().t_ns;
  };
  const double earlier_s = ToSeconds(first(driven.made.measured) - first(measured));
  EXPECT_EQ(has_changed, earlier_s != 0);
  return earlier_s;
}

TEST(LateEncoders, AreStampedAnewWhereTheLeversBearItOut) {
  EXPECT_NEAR(StampedEarlierBy_s(DrivenJoints(false), NamedClock("encoders", kLate_s)), kLate_s,
              1e-9);
}

// Then all other sensors are early, and joints answer at once by the stamps as they are.
TEST(LateEncoders, KeepTheirStampsWhereTheLeversShareTheirClock) {
  EXPECT_EQ(StampedEarlierBy_s(DrivenJoints(true), NamedClock("encoders", kLate_s)), 0);
}

TEST(LateEncoders, KeepTheirStampsWhereSomethingElseMayBeLateOrIs) {
  SensorDiagnosis either = NamedClock("encoders", kLate_s);
  either.findings[0].rivals = {{"imu_boom", &SensorMechanism("clock_offset", EffectTarget::kImu)}};
  EXPECT_EQ(StampedEarlierBy_s(DrivenJoints(false), either), 0);
  EXPECT_EQ(StampedEarlierBy_s(DrivenJoints(false), NamedClock("imu_boom", kLate_s)), 0);
}

}  // namespace
}  // namespace tera
