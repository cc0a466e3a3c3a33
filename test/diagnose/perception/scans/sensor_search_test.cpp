#include "diagnose/perception/scans/sensor_search.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnose/perception/analytic_scene.h"
#include "diagnose/perception/perception_diagnosis.h"

namespace tera {
namespace {

using testing::AnalyticScene;
using testing::LidarOfTest;
using testing::RecordedBy;
using enum SensorNumbers::Index;

PerceptionDiagnosis DiagnosisOf(const LidarOfTest& lidar, const AnalyticScene& scene = {}) {
  return DiagnosePerception(RecordedBy(lidar, scene, scene), 3);
}

const ParameterEstimate& NumberOf(const PerceptionFinding& finding, const std::string& name) {
  for (const ParameterEstimate& estimate : finding.parameters) {
    if (estimate.name == name) return estimate;
  }
  ADD_FAILURE() << "no parameter " << name;
  return finding.parameters.front();
}

TEST(PerceivedSensor, OfAnotherRangeIsFoundToTheMillimetre) {
  LidarOfTest lidar;
  lidar.numbers.value[kRange] = 0.04;
  const PerceptionDiagnosis diagnosis = DiagnosisOf(lidar);
  ASSERT_EQ(diagnosis.findings.size(), 1u);
  const PerceptionFinding& finding = diagnosis.findings[0];
  EXPECT_EQ(finding.mechanism, "range_bias");
  EXPECT_EQ(finding.rivals, std::vector<std::string>{"range_bias"});
  EXPECT_NEAR(NumberOf(finding, "range_m").value, 0.04, 0.001);
  EXPECT_LT(finding.p_confirmed, 0.01);
}

TEST(PerceivedSensor, ThatSitsAskewIsFoundWithItsAnglesAndPlace) {
  LidarOfTest lidar;
  lidar.numbers.value[kRoll] = 1.2 * kDeg;
  lidar.numbers.value[kPitch] = -0.8 * kDeg;
  lidar.numbers.value[kYaw] = 2.5 * kDeg;
  lidar.numbers.value[kZ] = 0.06;
  const PerceptionDiagnosis diagnosis = DiagnosisOf(lidar);
  ASSERT_EQ(diagnosis.findings.size(), 1u);
  const PerceptionFinding& finding = diagnosis.findings[0];
  EXPECT_EQ(finding.mechanism, "extrinsic");
  EXPECT_NEAR(NumberOf(finding, "roll_deg").value, 1.2, 0.05);
  EXPECT_NEAR(NumberOf(finding, "pitch_deg").value, -0.8, 0.05);
  EXPECT_NEAR(NumberOf(finding, "yaw_deg").value, 2.5, 0.05);
  EXPECT_NEAR(NumberOf(finding, "z_m").value, 0.06, 0.01);
}

TEST(PerceivedSensor, WithAnotherClockIsFoundWhileItTurns) {
  LidarOfTest lidar;
  lidar.numbers.value[kOffset] = 0.15;
  const PerceptionDiagnosis diagnosis = DiagnosisOf(lidar);
  ASSERT_EQ(diagnosis.findings.size(), 1u);
  EXPECT_EQ(diagnosis.findings[0].mechanism, "clock_offset");
  EXPECT_NEAR(NumberOf(diagnosis.findings[0], "offset_s").value, 0.15, 0.005);
}

TEST(PerceivedSensor, AtRestTellsNothingOfItsClock) {
  LidarOfTest lidar;
  lidar.moves = false;
  lidar.numbers.value[kOffset] = 0.15;
  const PerceptionDiagnosis diagnosis = DiagnosisOf(lidar);
  EXPECT_TRUE(diagnosis.findings.empty());
  bool told = false;
  for (const SensorDetectability& one : diagnosis.sensor.detectability) {
    if (one.mechanism == "clock_offset") told = one.smallest.has_value();
  }
  EXPECT_FALSE(told);
}

TEST(PerceivedSensor, AsDescribedGivesNoFinding) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    LidarOfTest lidar;
    lidar.seed = seed;
    const PerceptionDiagnosis diagnosis = DiagnosisOf(lidar);
    EXPECT_TRUE(diagnosis.findings.empty()) << seed;
    EXPECT_TRUE(diagnosis.unconfirmed.empty()) << seed;
    // 1 cm of range, met at an angle.
    EXPECT_LT(diagnosis.sensor.noise_rmse, 0.012);
  }
}

TEST(PerceivedSensor, OfAFewSecondsIsNotJudged) {
  LidarOfTest lidar;
  lidar.duration_s = 6;
  const PerceptionDiagnosis diagnosis = DiagnosisOf(lidar);
  EXPECT_THAT(diagnosis.not_judged, ::testing::HasSubstr("6 blocks of a second; need 10"));
}

}  // namespace
}  // namespace tera
