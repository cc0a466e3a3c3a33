#include "diagnose/motion/reduce_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"

namespace tera {
namespace {

constexpr TimeNs kPeriod_ns = 10'000'000;
constexpr TimeNs kEpoch_ns = 1'700'000'000'000'000'000;

int OneSegment(TimeNs) { return 0; }

/// Samples whose k-th has the values k, 2 k, ... of its own time.
std::vector<ImuSample> Samples(int count, TimeNs start_ns = kEpoch_ns) {
  std::vector<ImuSample> samples;
  for (int k = 0; k < count; ++k) {
    samples.push_back({.t_ns = start_ns + k * kPeriod_ns,
                       .w_WS_S_radps = Vec3(k, -k, 0.5 * k),
                       .f_S_mps2 = Vec3(2 * k, 9.8, -k)});
  }
  return samples;
}

/// Requirements for windows of any samples: they are in sequence, overlap by no more than stamps
/// may err, and lie within the samples.
void ExpectSound(const std::vector<ImuWindow>& windows, const std::vector<ImuSample>& samples,
                 double longest_s, TimeNs stamps_ns = 0) {
  double least = 1e300, most = -1e300;
  for (const ImuSample& sample : samples) {
    least = std::min(least, sample.w_WS_S_radps.x());
    most = std::max(most, sample.w_WS_S_radps.x());
  }
  for (std::size_t k = 0; k < windows.size(); ++k) {
    EXPECT_LE(windows[k].from_ns, windows[k].to_ns) << k;
    EXPECT_LE(ToSeconds(windows[k].to_ns - windows[k].from_ns), longest_s + 1e-9) << k;
    if (k > 0) {
      EXPECT_GE(windows[k].from_ns, windows[k - 1].to_ns - stamps_ns) << k;
      EXPECT_GE(windows[k].to_ns, windows[k - 1].to_ns) << k;
    }
    EXPECT_GE(windows[k].w_S_radps.x(), least - 1e-9) << k;
    EXPECT_LE(windows[k].w_S_radps.x(), most + 1e-9) << k;
    EXPECT_TRUE(windows[k].f_S_mps2.allFinite()) << k;
  }
}

TEST(UsualPeriod, IsThatOfMostSamplesHoweverManyAreLost) {
  std::vector<TimeNs> t_ns;
  for (int k = 0; k < 100; ++k) {
    if (k % 7 != 3) t_ns.push_back(kEpoch_ns + k * kPeriod_ns);
  }
  EXPECT_EQ(UsualPeriod_ns(t_ns), kPeriod_ns);
}

TEST(UsualPeriod, OfFewerThanTwoIsNone) {
  EXPECT_EQ(UsualPeriod_ns({}), 0);
  EXPECT_EQ(UsualPeriod_ns({5}), 0);
  EXPECT_EQ(UsualPeriod_ns({5, 25}), 20);
}

TEST(ImuWindows, AreMeansOfSamplesOverTheTimesOfThese) {
  const std::vector<ImuSample> samples = Samples(50);
  const std::vector<ImuWindow> windows = WindowsOf(samples, 0.05, OneSegment);
  ASSERT_EQ(windows.size(), 10u);
  ExpectSound(windows, samples, 0.05);
  for (int k = 0; k < 10; ++k) {
    // Samples 5 k to 5 k + 4, the first a mean over the period before its stamp.
    EXPECT_EQ(windows[k].from_ns, kEpoch_ns + (5 * k - 1) * kPeriod_ns) << k;
    EXPECT_EQ(windows[k].to_ns, kEpoch_ns + (5 * k + 4) * kPeriod_ns) << k;
    EXPECT_LT((windows[k].w_S_radps - (5 * k + 2) * Vec3(1, -1, 0.5)).norm(), 1e-9) << k;
    EXPECT_LT((windows[k].f_S_mps2 - Vec3(10 * k + 4, 9.8, -5 * k - 2)).norm(), 1e-9) << k;
  }
}

TEST(ImuWindows, OfSamplesThatGrowEvenlyHaveNoModelError) {
  for (const ImuWindow& window : WindowsOf(Samples(50), 0.05, OneSegment)) {
    EXPECT_LT(window.model_error.norm(), 1e-9);
    EXPECT_EQ(window.share, 1);
  }
}

// A blow of 10 m/s^2 over one window of five samples: second differences of 10, -20 and 10.
TEST(ImuWindows, DoNotFollowABlow) {
  std::vector<ImuSample> samples = Samples(500);
  for (int k = 250; k < 255; ++k) samples[k].f_S_mps2.y() += 10;
  const std::vector<ImuWindow> windows = WindowsOf(samples, 0.05, OneSegment);
  for (int k = 0; k < 100; ++k) {
    const int away = std::abs(k - 50);
    const double expected = away <= 1 ? 5 : away == 2 ? 2.5 : 0;
    EXPECT_NEAR(windows[k].model_error[4], expected, 1e-9) << k;
    EXPECT_LT(windows[k].model_error[3], 1e-9) << k;
  }
}

TEST(ImuWindows, EndAtALostRowWhichNoneIsAMeanOver) {
  std::vector<ImuSample> samples = Samples(50);
  samples.erase(samples.begin() + 12);
  const std::vector<ImuWindow> windows = WindowsOf(samples, 0.05, OneSegment);
  ExpectSound(windows, samples, 0.05);
  const TimeNs from_ns = kEpoch_ns + 11 * kPeriod_ns, to_ns = kEpoch_ns + 12 * kPeriod_ns;
  for (const ImuWindow& window : windows) {
    EXPECT_TRUE(window.to_ns <= from_ns || window.from_ns >= to_ns)
        << "the lost sample was of " << (from_ns - kEpoch_ns) << " to " << (to_ns - kEpoch_ns)
        << ", a window of " << window.from_ns - kEpoch_ns << " to " << window.to_ns - kEpoch_ns;
  }
}

TEST(ImuWindows, EndWhereTheSegmentDoes) {
  const TimeNs cut_ns = kEpoch_ns + 22 * kPeriod_ns + kPeriod_ns / 2;
  const auto segment_of = [&](TimeNs t_ns) { return t_ns < cut_ns ? 0 : 1; };
  const std::vector<ImuSample> samples = Samples(50);
  const std::vector<ImuWindow> windows = WindowsOf(samples, 0.05, segment_of);
  ExpectSound(windows, samples, 0.05);
  for (const ImuWindow& window : windows) {
    EXPECT_FALSE(window.from_ns + kPeriod_ns < cut_ns && window.to_ns > cut_ns + kPeriod_ns);
  }
}

// Stamps with a jitter of some milliseconds do not determine the time of measurement.
TEST(ImuWindows, OfStampsThatJitterLastAsLongAsTheirSamples) {
  std::vector<ImuSample> samples = Samples(400);
  const Stream draw(1, "jitter");
  for (std::size_t k = 0; k < samples.size(); ++k) {
    samples[k].t_ns += static_cast<TimeNs>(2e6 * (2 * draw.Uniform(k) - 1));
  }
  const std::vector<ImuWindow> windows = WindowsOf(samples, 0.05, OneSegment);
  ExpectSound(windows, samples, 0.054, 4'000'000);
  double covered_s = 0;
  for (const ImuWindow& window : windows) covered_s += ToSeconds(window.to_ns - window.from_ns);
  EXPECT_NEAR(covered_s, 4, 0.2) << "none of four seconds was lost";
}

// A logger that writes four samples at once, every 40 ms.
TEST(ImuWindows, OfBurstsAreSound) {
  std::vector<ImuSample> samples = Samples(200);
  for (std::size_t k = 0; k < samples.size(); ++k) {
    samples[k].t_ns = kEpoch_ns + static_cast<TimeNs>(k / 4) * 4 * kPeriod_ns +
                      static_cast<TimeNs>(k % 4) * 100'000;
  }
  ExpectSound(WindowsOf(samples, 0.05, OneSegment), samples, 0.05 + 1e-3);
}

TEST(ImuWindows, OfEqualStampsAreSound) {
  std::vector<ImuSample> twice = Samples(100), all_equal = Samples(100);
  for (std::size_t k = 0; k < twice.size(); ++k) {
    twice[k].t_ns = kEpoch_ns + static_cast<TimeNs>(k / 2) * 2 * kPeriod_ns;
    all_equal[k].t_ns = kEpoch_ns;
  }
  ExpectSound(WindowsOf(twice, 0.05, OneSegment), twice, 0.05);
  ExpectSound(WindowsOf(all_equal, 0.05, OneSegment), all_equal, 0.05);
}

TEST(ImuWindows, OfNoneOrOneSampleAreNoneOrLast) {
  EXPECT_TRUE(WindowsOf({}, 0.05, OneSegment).empty());
  ExpectSound(WindowsOf(Samples(1), 0.05, OneSegment), Samples(1), 0.05);
  const std::vector<ImuWindow> of_two = WindowsOf(Samples(2), 0.05, OneSegment);
  ExpectSound(of_two, Samples(2), 0.05);
}

TEST(ImuWindows, OfSamplesRarerThanTheLongestWindowAreOneEach) {
  const std::vector<ImuSample> samples = Samples(20);
  const std::vector<ImuWindow> windows = WindowsOf(samples, 0.004, OneSegment);
  ASSERT_EQ(windows.size(), 20u);
  for (int k = 0; k < 20; ++k) {
    EXPECT_EQ(windows[k].to_ns, samples[k].t_ns);
    EXPECT_EQ(windows[k].from_ns, samples[k].t_ns - kPeriod_ns);
  }
}

/// A gear with `rate_radps`, or with `angle`, sampled at 50 Hz.
template <typename Angle>
GearTrack Gear(double radius_m, double left_m, const Angle& angle, double duration_s = 10) {
  GearTrack gear{.radius_m = radius_m, .left_m = left_m};
  for (int k = 0; k <= 50 * duration_s; ++k) {
    gear.angle_rad.t_s.push_back(0.02 * k);
    gear.angle_rad.value.push_back(angle(0.02 * k));
  }
  return gear;
}

void ExpectTravel(const std::vector<TravelWindow>& travel, double forward_mps, double turning_radps,
                  double tolerance = 1e-6) {
  ASSERT_FALSE(travel.empty());
  for (std::size_t k = 0; k < travel.size(); ++k) {
    EXPECT_GE(travel[k].to_s - travel[k].from_s, 0.1 - 1e-9) << k;
    if (k > 0) {
      EXPECT_GE(travel[k].from_s, travel[k - 1].to_s - 1e-9) << k;
    }
    EXPECT_NEAR(travel[k].forward_mps, forward_mps, tolerance) << k;
    EXPECT_NEAR(travel[k].turning_radps, turning_radps, tolerance) << k;
  }
}

// The left track runs at 0.6, the right at 1.2 m/s, 1.6 m apart: 0.9 m/s ahead and 0.375 rad/s to
// the left.
TEST(TravelOfGears, OfTwoTracksIsTheirMeanAndTheirDifferenceOverTheGauge) {
  ExpectTravel(TravelOf({Gear(0.3, 0.8, [](double t) { return 2 * t; }),
                         Gear(0.3, -0.8, [](double t) { return 4 * t; })}),
               0.9, 0.375);
}

// Gears of different speeds at unequal distances: the base's middle is at a quarter.
TEST(TravelOfGears, OfTracksAtUnlikeDistancesIsThatOfTheMiddle) {
  ExpectTravel(TravelOf({Gear(0.3, 0.4, [](double t) { return 2 * t; }),
                         Gear(0.3, -1.2, [](double t) { return 4 * t; })}),
               0.75, 0.375);
}

TEST(TravelOfGears, OfOneGearIsItsOwnAndDoesNotTurn) {
  ExpectTravel(TravelOf({Gear(0.5, 0, [](double t) { return 3 * t; })}), 1.5, 0);
}

TEST(TravelOfGears, OfTwoGearsOneBehindTheOtherDoesNotTurn) {
  ExpectTravel(TravelOf({Gear(0.5, 0, [](double t) { return 3 * t; }),
                         Gear(0.5, 0, [](double t) { return 3 * t; })}),
               1.5, 0);
}

// Both gears on the left side: the machine's turning is unknown.
TEST(TravelOfGears, OfTwoGearsOnTheSameSideIsFiniteAndNoFasterThanThey) {
  for (const double apart_m : {0.0, 1e-12, 1e-6}) {
    const std::vector<TravelWindow> travel =
        TravelOf({Gear(0.5, 0.8, [](double t) { return 3 * t; }),
                  Gear(0.5, 0.8 + apart_m, [](double t) { return 3.01 * t; })});
    for (const TravelWindow& window : travel) {
      EXPECT_TRUE(std::isfinite(window.forward_mps)) << apart_m;
      EXPECT_TRUE(std::isfinite(window.turning_radps)) << apart_m;
      EXPECT_LE(std::abs(window.turning_radps), 4) << apart_m;
      EXPECT_LE(std::abs(window.forward_mps), 4) << apart_m;
    }
  }
}

TEST(TravelOfGears, OfStandingGearIsStillWhateverItsNoise) {
  const Stream draw(3, "encoder");
  int drawn = 0;
  const auto noisy = [&](double) { return 1.2 + 0.003 * draw.Gaussian(++drawn); };
  const auto constant = [](double) { return 7.5; };
  int still = 0, all = 0;
  for (const std::vector<GearTrack>& gears :
       {std::vector<GearTrack>{Gear(0.3, 0.8, noisy), Gear(0.3, -0.8, noisy)},
        std::vector<GearTrack>{Gear(0.3, 0.8, constant), Gear(0.3, -0.8, constant)}}) {
    for (const TravelWindow& window : TravelOf(gears)) {
      still += window.is_still;
      ++all;
    }
  }
  EXPECT_GT(all, 100);
  EXPECT_GE(still, 0.95 * all);
}

// The last step of an angle, 0.01 rad, flickers with noise in one of five samples.
TEST(TravelOfGears, OfStandingGearIsStillWhateverItsQuantisation) {
  const Stream draw(3, "encoder");
  int drawn = 0, still = 0;
  const auto quantised = [&](double) {
    return 0.01 * std::round(120 + 0.4 * draw.Gaussian(++drawn));
  };
  std::vector<GearTrack> gears = {Gear(0.3, 0.8, quantised), Gear(0.3, -0.8, quantised)};
  for (GearTrack& gear : gears) gear.resolution_rad = 0.01;
  const std::vector<TravelWindow> travel = TravelOf(gears);
  for (const TravelWindow& window : travel) still += window.is_still;
  EXPECT_GE(still, 0.95 * static_cast<double>(travel.size()));
}

// It drives from 4 to 6 s, slowly at first. The gear counts as still while none of its angles moves
// within 0.3 s.
TEST(TravelOfGears, IsNotStillWithinThreeTenthsOfASecondOfAMotion) {
  const auto angle = [](double t) { return 2 * std::clamp(t - 4, 0.0, 2.0); };
  const std::vector<TravelWindow> travel =
      TravelOf({Gear(0.3, 0.8, angle), Gear(0.3, -0.8, [](double) { return 0.0; })});
  double still_s = 0;
  for (const TravelWindow& window : travel) {
    if (!window.is_still) continue;
    still_s += window.to_s - window.from_s;
    EXPECT_TRUE(window.to_s < 3.8 || window.from_s > 6.2) << window.from_s;
  }
  EXPECT_GT(still_s, 6);
}

TEST(TravelOfGears, OfNothingOrASampleOrTwoDoesNotFail) {
  EXPECT_TRUE(TravelOf({}).empty());
  GearTrack none{.radius_m = 0.3, .left_m = 0.8}, one = none, two = none, equal = none;
  one.angle_rad = {{1.0}, {2.0}};
  two.angle_rad = {{1.0, 1.5}, {2.0, 2.5}};
  equal.angle_rad = {{1.0, 1.0, 1.0}, {2.0, 2.5, 2.5}};
  for (const std::vector<GearTrack>& gears : {std::vector{none}, std::vector{one}, std::vector{two},
                                              std::vector{none, two}, std::vector{equal, two}}) {
    for (const TravelWindow& window : TravelOf(gears)) {
      EXPECT_TRUE(std::isfinite(window.forward_mps));
      EXPECT_TRUE(std::isfinite(window.turning_radps));
      EXPECT_LT(window.from_s, window.to_s);
    }
  }
}

// One of two sets of encoders wrote nothing.
TEST(TravelOfGears, OfAGearWithoutASampleDoesNotFail) {
  GearTrack none{.radius_m = 0.3, .left_m = -0.8};
  for (const TravelWindow& window :
       TravelOf({Gear(0.3, 0.8, [](double t) { return 2 * t; }), none})) {
    EXPECT_TRUE(std::isfinite(window.forward_mps));
    EXPECT_TRUE(std::isfinite(window.turning_radps));
  }
}

}  // namespace
}  // namespace tera
