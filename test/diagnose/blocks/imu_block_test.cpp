#include "diagnose/blocks/imu_block.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "core/units.h"
#include "diagnose/search/block/block_diagnosis.h"
#include "sim/drive_fixture.h"

namespace tera {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr TimeNs kMillisecond_ns = 1'000'000;

struct Case {
  double duration_s = 120;
  bool moves = true;
  double poses_late_s = 0, pose_noise_m = 0;
  Mat3 R_WL = Mat3::Identity();  ///< from the level's axes to the poses' map
  Vec3 gyro_bias_radps = Vec3::Zero(), accel_bias_mps2 = Vec3::Zero();
};

/// A unit on a base that stands or follows a winding path, and the base's poses.
struct Recorded {
  explicit Recorded(const Case& how) {
    const Stream noise(3, "noise");
    model = Drive::Read("tb235.yaml", "{}", "soil: asphalt", "").machines[0].placement.model;
    sensor.name = "imu";
    sensor.link = model.links[0].name;
    sensor.X_BS = MakePose({0.2, 0.1, 1.0});
    sensor.model = ImuModel{};
    const auto base = [&](double t_s) {
      return how.moves ? MakePose({3 * std::sin(0.31 * t_s), 0.2 * t_s, 0}, 0,
                                  0.02 * std::sin(0.9 * t_s), 0.8 * std::sin(0.47 * t_s))
                       : Pose::Identity();
    };
    Imu imu({.gyro_bias_radps = how.gyro_bias_radps, .accel_bias_mps2 = how.accel_bias_mps2},
            sensor.X_BS, {50, 0}, 0, 1, "imu");
    BodyState before, after;
    before.X_WB = base(0);
    for (int k = 1; k <= how.duration_s * 100; ++k) {
      const TimeNs from_ns = (k - 1) * 10 * kMillisecond_ns, to_ns = k * 10 * kMillisecond_ns;
      after.X_WB = base(ToSeconds(to_ns));
      imu.Advance(from_ns, before, to_ns, after, {0, 0, -kStandardGravity_mps2}, &samples);
      before = after;
    }
    for (std::size_t k = 0; k < samples.size(); ++k) {
      samples[k].w_WS_S_radps += 0.002 * noise.Gaussian3(2 * k);
      samples[k].f_S_mps2 += 0.03 * noise.Gaussian3(2 * k + 1);
    }
    for (int k = 0; k <= how.duration_s * 10; ++k) {
      const TimeNs t_ns = k * 100 * kMillisecond_ns;
      Pose X_WB = base(std::max(0.0, ToSeconds(t_ns) - how.poses_late_s));
      X_WB = MakePose(Vec3::Zero(), how.R_WL) * X_WB;
      X_WB.translation() += how.pose_noise_m * noise.Gaussian3((1ull << 40) + k);
      poses.push_back({.t_ns = t_ns, .X_WB = X_WB});
    }
  }
  BlockDiagnosis Diagnose(bool poses_were_measured) {
    block = *MakeImuBlock(sensor, MakeImuLog(model, sensor, samples, {}, poses, 0.2), "m/imu",
                          poses_were_measured);
    return DiagnoseBlock(block, {}, Stream(1, "diagnose"));
  }

  MachineModel model;
  SensorDescription sensor;
  std::vector<ImuSample> samples;
  std::vector<TruthPose> poses;
  ReplayBlock block;
};

/// "imu clock_offset" and its rivals.
std::vector<std::string> ImuBlockNamesOf(const BlockDiagnosis& diagnosis) {
  std::vector<std::string> names;
  for (const Finding& finding : diagnosis.findings) {
    for (const Candidate* candidate : finding.evidence.rivals) {
      names.push_back(candidate->target + " " + std::string(candidate->mechanism->id));
    }
  }
  return names;
}

TEST(ImuBlock, AtRestNamesABias) {
  Recorded recorded({.moves = false, .accel_bias_mps2 = {0.05, -0.03, 0.06}});
  const BlockDiagnosis diagnosis = recorded.Diagnose(false);
  EXPECT_TRUE(diagnosis.is_testable);
  ASSERT_THAT(ImuBlockNamesOf(diagnosis), ElementsAre("imu bias"));
  EXPECT_NEAR(diagnosis.findings[0].parameters[3].value, 0.05, 0.002);
  EXPECT_NEAR(diagnosis.findings[0].parameters[5].value, 0.06, 0.002);
}

TEST(ImuBlock, AtRestAndAsDocumentedHasNothingToSay) {
  Recorded recorded({.moves = false});
  const BlockDiagnosis diagnosis = recorded.Diagnose(false);
  EXPECT_TRUE(diagnosis.is_testable);
  EXPECT_THAT(ImuBlockNamesOf(diagnosis), IsEmpty());
  EXPECT_THAT(diagnosis.unexplained, IsEmpty());
}

TEST(ImuBlock, DoesNotTellLatePosesFromAClockThatIsBehind) {
  Recorded recorded({.duration_s = 40, .poses_late_s = 0.25});
  const BlockDiagnosis diagnosis = recorded.Diagnose(true);
  ASSERT_EQ(diagnosis.findings.size(), 1u);
  EXPECT_THAT(ImuBlockNamesOf(diagnosis), ElementsAre("poses latency", "imu clock_offset"));
  EXPECT_NEAR(diagnosis.findings[0].parameters[0].value, 0.25, 0.01);
}

TEST(ImuBlock, TellsAMapThatLeansFromAUnitThatDoes) {
  Recorded recorded(
      {.duration_s = 30, .R_WL = RotationFromRpy(2 * kDeg, -1 * kDeg, 0).transpose()});
  const BlockDiagnosis diagnosis = recorded.Diagnose(true);
  ASSERT_THAT(ImuBlockNamesOf(diagnosis), ElementsAre("poses mount_rotation"));
  EXPECT_NEAR(diagnosis.findings[0].parameters[0].value, 2, 0.05);
  EXPECT_NEAR(diagnosis.findings[0].parameters[1].value, -1, 0.05);
}

TEST(ImuInterval, IsLongEnoughForTheNoiseOfThePoses) {
  // Accelerations from positions h apart have a standard deviation of sqrt(6) sigma / h^2.
  const Recorded rough({.duration_s = 200, .moves = false, .pose_noise_m = 0.005});
  const double half_s = 0.5 * ImuInterval_s(rough.poses);
  EXPECT_NEAR(std::sqrt(6.0) * 0.005 / (half_s * half_s), 0.05, 0.005);
  EXPECT_EQ(ImuInterval_s({}), 0);
}

}  // namespace
}  // namespace tera
