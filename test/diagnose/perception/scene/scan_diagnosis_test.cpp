#include "diagnose/perception/scene/scan_diagnosis.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnose/perception/analytic_scene.h"
#include "diagnose/perception/perception_diagnosis.h"

namespace tera {
namespace {

using testing::AnalyticScene;
using testing::IdOf;
using testing::LidarOfTest;
using testing::NumberOf;
using testing::RecordedBy;
PerceptionDiagnosis DiagnosisOf(const LidarOfTest& lidar, const AnalyticScene& scene = {}) {
  return DiagnoseScans(RecordedBy(lidar, scene, scene), 3);
}

TEST(PerceivedSensor, OfAnotherRangeIsFoundToTheMillimetre) {
  LidarOfTest lidar;
  lidar.is.range_bias_m = 0.04;
  const PerceptionDiagnosis diagnosis = DiagnosisOf(lidar);
  ASSERT_EQ(diagnosis.findings.size(), 1u);
  const PerceptionFinding& found = diagnosis.findings[0];
  EXPECT_EQ(IdOf(found), "range_bias");
  EXPECT_EQ(found.finding.evidence.rivals,
            std::vector<const Candidate*>{found.finding.term.candidate});
  EXPECT_NEAR(NumberOf(found, "range_m"), 0.04, 0.001);
  EXPECT_LT(found.finding.held_out.p, 0.01);
}

TEST(PerceivedSensor, ThatSitsAskewIsFoundWithItsAnglesAndPlace) {
  LidarOfTest lidar;
  lidar.is.rpy_deg.x() = 1.2;
  lidar.is.rpy_deg.y() = -0.8;
  lidar.is.rpy_deg.z() = 2.5;
  lidar.is.shift_B_m.z() = 0.06;
  const PerceptionDiagnosis diagnosis = DiagnosisOf(lidar);
  ASSERT_EQ(diagnosis.findings.size(), 1u);
  const PerceptionFinding& found = diagnosis.findings[0];
  EXPECT_EQ(IdOf(found), "extrinsic");
  EXPECT_NEAR(NumberOf(found, "roll_deg"), 1.2, 0.05);
  EXPECT_NEAR(NumberOf(found, "pitch_deg"), -0.8, 0.05);
  EXPECT_NEAR(NumberOf(found, "yaw_deg"), 2.5, 0.05);
  EXPECT_NEAR(NumberOf(found, "z_m"), 0.06, 0.01);
}

TEST(PerceivedSensor, WithAnotherClockIsFoundWhileItTurns) {
  LidarOfTest lidar;
  lidar.is.clock_offset_s = 0.15;
  const PerceptionDiagnosis diagnosis = DiagnosisOf(lidar);
  ASSERT_EQ(diagnosis.findings.size(), 1u);
  EXPECT_EQ(IdOf(diagnosis.findings[0]), "clock_offset");
  EXPECT_NEAR(NumberOf(diagnosis.findings[0], "offset_s"), 0.15, 0.005);
}

TEST(PerceivedSensor, AtRestTellsNothingOfItsClock) {
  LidarOfTest lidar;
  lidar.moves = false;
  lidar.is.clock_offset_s = 0.15;
  const PerceptionDiagnosis diagnosis = DiagnosisOf(lidar);
  EXPECT_TRUE(diagnosis.findings.empty());
  bool told = false;
  for (const ParameterDetectability& one : diagnosis.detectability) {
    if (one.candidate->mechanism->id == "clock_offset") told = one.smallest.has_value();
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
    // 1 cm of range, with oblique incidence.
    EXPECT_LT(diagnosis.noise_rmse, 0.012);
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
