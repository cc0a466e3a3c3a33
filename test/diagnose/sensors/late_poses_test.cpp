#include "diagnose/sensors/late_poses.h"

#include <gtest/gtest.h>

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

SensorDiagnosis Late(const std::string& target, double offset_s) {
  SensorDiagnosis estimate;
  SensorFinding found;
  found.target = target;
  found.mechanism = "clock_offset";
  found.numbers = {{"offset_s", "s", offset_s, 0.01, 0, 0.04, true}};
  estimate.findings = {found};
  return estimate;
}

TEST(LatePoses, AreStampedWhenTheyWereMeasured) {
  Measurements measured = TwoPoses();
  StampPosesAnew(Late("poses", 0.16), &measured);
  EXPECT_EQ(measured.poses[0].t_ns, 840'000'000);
  EXPECT_EQ(measured.poses[1].t_ns, 940'000'000);
}

TEST(LatePoses, KeepTheirStampsWhereSomethingElseMayBeLateOrIs) {
  SensorDiagnosis either = Late("poses", 0.16);
  either.findings[0].rivals = {"imu_chassis/clock_offset"};
  SensorDiagnosis turned = Late("poses", 0.16);
  turned.findings[0].mechanism = "mount_rotation";
  for (const SensorDiagnosis& estimate : {either, turned, Late("gnss_left", 0.16)}) {
    Measurements measured = TwoPoses();
    StampPosesAnew(estimate, &measured);
    EXPECT_EQ(measured.poses[0].t_ns, 1'000'000'000);
  }
}

}  // namespace
}  // namespace tera
