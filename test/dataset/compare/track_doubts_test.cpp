#include "dataset/compare/track_doubts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/units.h"

namespace tera {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A drive of two minutes that never repeats itself, each place with noise of 2 cm.
Trajectory Drive(unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise_m(0, 0.02);
  Trajectory track;
  for (int k = 0; k <= 1200; ++k) {
    const double t_s = 0.1 * k;
    const Vec3 p_m(0.4 * t_s, 9 * std::sin(0.11 * t_s + 0.001 * t_s * t_s),
                   0.3 * std::cos(t_s / 7));
    track.push_back({FromSeconds(t_s),
                     MakePose(p_m + Vec3(noise_m(random), noise_m(random), noise_m(random)))});
  }
  return track;
}

Trajectory Scaled(Trajectory track, double by) {
  for (TimedPose& pose : track) pose.X_WB.translation() *= by;
  return track;
}

Trajectory Shifted(Trajectory track, double by_s) {
  for (TimedPose& pose : track) pose.t_ns += FromSeconds(by_s);
  return track;
}

Trajectory Moved(Trajectory track, const Pose& X) {
  for (TimedPose& pose : track) pose.X_WB = X * pose.X_WB;
  return track;
}

std::vector<std::string> Doubts(const Trajectory& a, const Trajectory& b) {
  return TrackDoubts(a, b, kNsPerSecond);
}

TEST(TrackDoubts, AreNoneOfTwoGoodTracks) {
  EXPECT_THAT(Doubts(Drive(1), Drive(2)), IsEmpty());
  EXPECT_THAT(Doubts(Drive(1), Moved(Drive(2), MakePose({300, -80, 2}, 0, 0, 1.2))), IsEmpty());
  EXPECT_THAT(Doubts(Drive(1), Scaled(Drive(2), 1.07)), IsEmpty());
  EXPECT_THAT(Doubts(Drive(1), Shifted(Drive(2), 7)), IsEmpty());
}

TEST(TrackDoubts, NameUnitsByTheirFactor) {
  const Pose turned = MakePose({5, 6, 7}, 0, 0, 0.7);
  EXPECT_THAT(Doubts(Drive(1), Scaled(Moved(Drive(2), turned), 1000)),
              ElementsAre(HasSubstr("second in millimetres")));
  EXPECT_THAT(Doubts(Drive(1), Scaled(Moved(Drive(2), turned), 1 / 0.3048)),
              ElementsAre(HasSubstr("second in feet")));
  EXPECT_THAT(Doubts(Drive(1), Scaled(Drive(2), 0.3048)),
              ElementsAre(HasSubstr("reference in feet")));
}

// GPS time is 18 s ahead of UTC since 2017, and TAI 37 s (IERS Bulletin C).
TEST(TrackDoubts, NameTheScalesOfTimeByWhatTheyDiffer) {
  const auto told = [](const char* scales, const char* way) {
    return ElementsAre(AllOf(HasSubstr(scales), HasSubstr(way)));
  };
  EXPECT_THAT(Doubts(Drive(1), Shifted(Drive(2), -18)), told("GPS time and UTC", "18 s later"));
  EXPECT_THAT(Doubts(Drive(1), Shifted(Drive(2), 18)), told("GPS time and UTC", "18 s earlier"));
  const Pose elsewhere = MakePose({40, -7, 1}, 0, 0, -0.4);
  EXPECT_THAT(Doubts(Drive(1), Shifted(Moved(Drive(2), elsewhere), 37)),
              told("TAI and UTC", "37 s earlier"));
}

TEST(TrackDoubts, NameAMachineThatIsParkedNothing) {
  const auto parked = [](unsigned seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> noise_m(0, 0.02);
    Trajectory track;
    for (int k = 0; k < 900; ++k) {
      track.push_back({k * kNsPerSecond / 10, MakePose({noise_m(random), noise_m(random), 0})});
    }
    return track;
  };
  EXPECT_THAT(Doubts(parked(3), parked(4)), IsEmpty());
}

TEST(TrackDoubts, NameADistanceAsOfMaps) {
  EXPECT_THAT(Doubts(Drive(1), Moved(Drive(2), MakePose({432'100, 5'245'700, 460}))),
              ElementsAre(HasSubstr("5263 km")));  // hypot(432, 5246)
}

}  // namespace
}  // namespace tera
