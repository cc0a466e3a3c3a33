#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "diagnose/sensors/made_recording.h"
#include "diagnose/sensors/sensor_diagnosis.h"

// Hostile recordings without any sensor error: nothing is named, only InputError is thrown, and all
// numbers are finite.

namespace tera {
namespace {

using ::testing::IsEmpty;

void ExpectNothingNamed(const DiagnosisInput& input, const Measurements& measured) {
  StageClock clock;
  SensorDiagnosis told;
  try {
    told = DiagnoseSensors(input, measured, {}, &clock);
  } catch (const InputError& error) {
    SUCCEED() << error.what();
    return;
  }
  std::vector<std::string> named;
  for (const SensorFinding& finding : told.findings) {
    named.push_back(finding.Name());
  }
  EXPECT_THAT(named, IsEmpty());
  for (const ChannelError& channel : told.channels) {
    for (const double number : {channel.noise, channel.inflation, channel.differences,
                                channel.rms_before, channel.rms_after}) {
      EXPECT_TRUE(std::isfinite(number)) << channel.name;
    }
  }
  for (const EstimatedMotion& motion : told.motion) {
    EXPECT_TRUE(motion.coefficients.allFinite());
    EXPECT_TRUE(motion.BaseAt(motion.start_ns).matrix().allFinite());
    EXPECT_TRUE(motion.BaseAt(motion.end_ns).matrix().allFinite());
  }
}

void ExpectNothingNamed(MadeRecording made) { ExpectNothingNamed(made.Input(), made.measured); }

TEST(HostileRecording, OfThreeSamplesOfEachSensor) {
  MadeRecording made({});
  for (auto& samples : made.measured.imus) samples.resize(std::min<std::size_t>(3, samples.size()));
  for (auto& samples : made.measured.gnss) samples.resize(std::min<std::size_t>(3, samples.size()));
  made.measured.encoders[0].recording.samples.resize(3);
  made.measured.poses.resize(3);
  ExpectNothingNamed(made);
}

TEST(HostileRecording, OfOneSampleOfEachSensor) {
  MadeRecording made({});
  for (auto& samples : made.measured.imus) samples.resize(std::min<std::size_t>(1, samples.size()));
  for (auto& samples : made.measured.gnss) samples.resize(std::min<std::size_t>(1, samples.size()));
  made.measured.encoders[0].recording.samples.resize(1);
  made.measured.poses.resize(1);
  ExpectNothingNamed(made);
}

TEST(HostileRecording, OfNoSampleAtAll) {
  MadeRecording made({});
  for (auto& samples : made.measured.imus) samples.clear();
  for (auto& samples : made.measured.gnss) samples.clear();
  made.measured.encoders.clear();
  made.measured.poses.clear();
  ExpectNothingNamed(made);
}

TEST(HostileRecording, OfSamplesThatAreAllIdentical) {
  MadeRecording made({.noise = 0, .base_moves = 0, .slew_moves = 0, .boom_moves = 0});
  ExpectNothingNamed(made);
}

TEST(HostileRecording, OfPosesThatNeverChangeBesideNoisySensors) {
  MadeRecording made({.base_moves = 0});
  for (TruthPose& pose : made.measured.poses) pose.X_WB = made.Base(0);
  ExpectNothingNamed(made);
}

TEST(HostileRecording, OfAMachineThatStands) {
  ExpectNothingNamed(MadeRecording({.seed = 3, .base_moves = 0, .slew_moves = 0, .boom_moves = 0}));
}

TEST(HostileRecording, OfABoomThatNeverMoves) {
  MadeRecording made({.seed = 4, .boom_moves = 0});
  for (EncoderSample& sample : made.measured.encoders[0].recording.samples) {
    sample.q_rad[1] = 0.3;
  }
  ExpectNothingNamed(made);
}

TEST(HostileRecording, OfUnitsThatEndBeforeReceiversBegin) {
  MadeRecording made({.seed = 5});
  for (auto& samples : made.measured.imus) samples.resize(samples.size() / 2);
  for (auto& samples : made.measured.gnss) {
    samples.erase(samples.begin(), samples.begin() + samples.size() / 2);
  }
  ExpectNothingNamed(made);
}

TEST(HostileRecording, OfPosesAnHourAfterAllOtherSensors) {
  MadeRecording made({.seed = 6});
  for (TruthPose& pose : made.measured.poses) pose.t_ns += 3600 * kNsPerSecond;
  ExpectNothingNamed(made);
}

TEST(HostileRecording, AThousandKilometresFromTheSitesOrigin) {
  ExpectNothingNamed(MadeRecording({.seed = 7, .place_m = {1e6, -1e6, 100}}));
}

TEST(HostileRecording, OfNanosecondsSince1970) {
  ExpectNothingNamed(MadeRecording({.seed = 8, .epoch_ns = 1'700'000'000'000'000'000}));
}

TEST(HostileRecording, WithoutPoses) {
  ExpectNothingNamed(MadeRecording({.seed = 9, .has_poses = false}));
}

TEST(HostileRecording, OfAUnitOnTheBaseAlone) {
  MadeRecording made({.seed = 10});
  made.measured.encoders.clear();
  made.measured.imus[1].clear();
  made.measured.gnss[2].clear();
  made.measured.gnss[3].clear();
  ExpectNothingNamed(made);
}

TEST(HostileRecording, OfAUnitOnALinkThatIsFixed) {
  MadeRecording made({.seed = 11, .boom_moves = 0});
  made.model.joints[1].type = JointType::kFixed;
  made.model.levers.resize(1);
  made.model.joints[1].X_PJ =
      made.model.joints[1].X_PJ * JointMotion(Hinge("", 0, Pose::Identity(), -Vec3::UnitY()), 0.3);
  NamedEncoders& named = made.measured.encoders[0];
  named.recording.axes.resize(1);
  for (EncoderSample& sample : named.recording.samples) {
    sample.q_rad.resize(1);
    sample.qd_radps.resize(1);
  }
  std::get<EncoderModel>(made.input.sensors[4].model).joints = {"swing"};
  ExpectNothingNamed(made);
}

TEST(HostileRecording, OfALongGapInAllSensors) {
  MadeRecording made({.seed = 12, .duration_s = 60});
  const auto is_gone = [](const auto& sample) {
    return sample.t_ns > 15 * kNsPerSecond && sample.t_ns < 40 * kNsPerSecond;
  };
  for (auto& samples : made.measured.imus) std::erase_if(samples, is_gone);
  for (auto& samples : made.measured.gnss) std::erase_if(samples, is_gone);
  std::erase_if(made.measured.encoders[0].recording.samples, is_gone);
  std::erase_if(made.measured.poses, is_gone);
  ExpectNothingNamed(made);
}

// The boom's unit records only the last two seconds.
TEST(HostileRecording, OfAUnitThatMeasuresForTwoSeconds) {
  MadeRecording made({.seed = 13});
  std::erase_if(made.measured.imus[1],
                [](const ImuSample& sample) { return sample.t_ns < 38 * kNsPerSecond; });
  ExpectNothingNamed(made);
}

// Everything is recorded twice, a microsecond apart.
TEST(HostileRecording, OfSamplesAMicrosecondApart) {
  MadeRecording made({.seed = 14, .duration_s = 25});
  for (auto& samples : made.measured.imus) {
    std::vector<ImuSample> twice;
    for (const ImuSample& sample : samples) {
      twice.push_back(sample);
      twice.push_back(sample);
      twice.back().t_ns += 1000;
    }
    samples = twice;
  }
  ExpectNothingNamed(made);
}

}  // namespace
}  // namespace tera
