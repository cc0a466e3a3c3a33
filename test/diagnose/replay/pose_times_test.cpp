#include "diagnose/replay/pose_times.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/random.h"

namespace tera {
namespace {

constexpr double kPeriod_s = 0.1, kAtBest_s = 0.04, kHandling_s = 0.03;
constexpr double kDrift_s = 0.012;  ///< one per cent of a period for each of a dozen waiting poses

/// Poses measured every 0.1 s for 60 s, at rest until 10 s, then at 1.5 m/s along x. Every `lost`th
/// is lost.
std::vector<double> MeasuredTimes(int lost) {
  std::vector<double> t_s;
  for (int k = 0; k < 600; ++k) {
    if (lost == 0 || k % lost != lost - 1) t_s.push_back(kPeriod_s * k);
  }
  return t_s;
}

/// A queue that delivers nothing in the first `wait_s` of every 3 s.
std::vector<TruthPose> Arrive(const std::vector<double>& measured_s, double wait_s) {
  std::vector<TruthPose> poses;
  double free_s = 0;
  for (const double t_s : measured_s) {
    double at_s = std::max(t_s + kAtBest_s, free_s);
    if (std::fmod(at_s, 3.0) < wait_s) at_s += wait_s - std::fmod(at_s, 3.0);
    free_s = at_s + kHandling_s;
    TruthPose pose{.t_ns = FromSeconds(at_s), .X_WB = Pose::Identity()};
    pose.X_WB.translation().x() = 1.5 * std::max(0.0, t_s - 10);
    poses.push_back(pose);
  }
  return poses;
}

double Longest_s(const std::vector<TruthPose>& poses, const std::vector<TimeNs>& t_ns,
                 const std::vector<double>& measured_s) {
  double longest_s = 0;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    longest_s = std::max(longest_s, std::abs(ToSeconds(t_ns[k]) - measured_s[k] - kAtBest_s));
  }
  return longest_s;
}

TEST(PoseTimes, AreThoseAtWhichWaitingPosesWereMeasured) {
  const std::vector<double> measured_s = MeasuredTimes(0);
  const std::vector<TruthPose> poses = Arrive(measured_s, 0.8);
  std::vector<TimeNs> stamps;
  for (const TruthPose& pose : poses) stamps.push_back(pose.t_ns);
  ASSERT_GT(Longest_s(poses, stamps, measured_s), 0.7);
  const auto times = TimesOfArrivals(poses);
  ASSERT_TRUE(times);
  EXPECT_LT(Longest_s(poses, *times, measured_s), kDrift_s);
}

TEST(PoseTimes, CountThePosesThatWereLostWhileTheMachineMoved) {
  // A loss among waiting poses shifts the earlier ones by a period.
  std::vector<double> measured_s = MeasuredTimes(0);
  measured_s.erase(measured_s.begin() + 303);
  const std::vector<TruthPose> poses = Arrive(measured_s, 0.8);
  const auto times = TimesOfArrivals(poses);
  ASSERT_TRUE(times);
  EXPECT_LT(Longest_s(poses, *times, measured_s), kDrift_s);
}

TEST(PoseTimes, DoNotCountStepsThatGrowWithTheSpeed) {
  const std::vector<double> measured_s = MeasuredTimes(0);
  std::vector<TruthPose> poses = Arrive(measured_s, 0.8);
  for (std::size_t k = 0; k < poses.size(); ++k) {
    poses[k].X_WB.translation().x() = 0.02 * std::pow(measured_s[k], 2);
  }
  const auto times = TimesOfArrivals(poses);
  ASSERT_TRUE(times);
  EXPECT_LT(Longest_s(poses, *times, measured_s), kDrift_s);
}

TEST(PoseTimes, OfAMachineThatTurnsOnTheSpotCountWhatWasLost) {
  std::vector<double> measured_s = MeasuredTimes(0);
  measured_s.erase(measured_s.begin() + 303);
  std::vector<TruthPose> poses = Arrive(measured_s, 0.8);
  for (std::size_t k = 0; k < poses.size(); ++k) {
    poses[k].X_WB = Pose(Eigen::AngleAxisd(0.5 * measured_s[k], Vec3::UnitZ()));
  }
  const auto times = TimesOfArrivals(poses);
  ASSERT_TRUE(times);
  EXPECT_LT(Longest_s(poses, *times, measured_s), kDrift_s);
}

TEST(PoseTimes, OfPosesThatComeEvenlyAreTheirStamps) {
  EXPECT_FALSE(TimesOfArrivals(Arrive(MeasuredTimes(0), 0)));
  EXPECT_FALSE(TimesOfArrivals(Arrive(MeasuredTimes(0), 0.12)));
  EXPECT_FALSE(TimesOfArrivals(Arrive(MeasuredTimes(7), 0)));
  EXPECT_FALSE(TimesOfArrivals({}));
}

/// Ten minutes without waiting, at 1.5 m/s.
std::vector<TruthPose> InTime(double rate_hz, const std::function<double(std::size_t)>& late_s) {
  std::vector<TruthPose> poses;
  for (std::size_t k = 0; k < static_cast<std::size_t>(600 * rate_hz); ++k) {
    const double t_s = static_cast<double>(k) / rate_hz;
    poses.push_back({.t_ns = FromSeconds(t_s + late_s(k)), .X_WB = Pose::Identity()});
    poses.back().X_WB.translation().x() = 1.5 * t_s;
  }
  return poses;
}

TEST(PoseTimes, OfPosesThatAreInTimeAreTheirStamps) {
  const auto rounded = [](std::size_t k) {
    const double t_s = static_cast<double>(k) / 60;
    return std::round(t_s * 1000) / 1000 - t_s;
  };
  EXPECT_FALSE(TimesOfArrivals(InTime(60, rounded)));
  const Stream stream(1, "jitter");
  for (const double sigma_s : {0.003, 0.02}) {
    EXPECT_FALSE(TimesOfArrivals(InTime(
        10, [&](std::size_t k) { return sigma_s * std::clamp(stream.Gaussian(k), -2.0, 2.0); })));
  }
}

TEST(PoseTimes, AreNotMovedByAMapThatIsCorrected) {
  std::vector<TruthPose> poses = InTime(10, [](std::size_t) { return 0.0; });
  for (std::size_t k = 0; k < poses.size(); ++k) {
    // Thrice by six more steps, once by one more.
    poses[k].X_WB.translation().x() +=
        0.9 * std::min<double>(3, std::floor(static_cast<double>(k) / 1500)) + (k > 700 ? 0.15 : 0);
  }
  EXPECT_FALSE(TimesOfArrivals(poses));
}

}  // namespace
}  // namespace tera
