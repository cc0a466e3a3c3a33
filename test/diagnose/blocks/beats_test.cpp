#include "diagnose/blocks/beats.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"

namespace tera {
namespace {

/// A wave sampled once a period, with noise, over `length_s` at 100 Hz.
struct Held {
  Held(double period_s, double phase, double noise, double length_s) {
    const Stream stream(3, "noise");
    const auto samples = static_cast<std::size_t>(100 * length_s);
    for (std::size_t k = 0; k < samples; ++k) {
      const double t = 0.01 * static_cast<double>(k);
      const double looked_s =
          period_s > 0 ? (std::floor(t / period_s - phase) + phase) * period_s : t;
      t_s.push_back(t);
      value.push_back(0.4 * std::sin(1.3 * looked_s) + 0.3 * std::sin(0.47 * looked_s) +
                      noise * stream.Gaussian(k));
    }
  }
  std::vector<double> t_s, value;
};

TEST(Beats, FindThePeriodAndThePhaseOfAHold) {
  for (const double period_s : {0.07, 0.16, 0.283}) {
    const Held held(period_s, 0.3, 0.003, 45);
    const std::vector<Beat> beats = BeatsOf(held.t_s, held.value, {});
    bool found = false;
    for (const Beat& beat : beats) {
      // After 45 s the beat is still within a tenth of a period.
      const bool is_it = std::abs(beat.period_s - period_s) * 45 / period_s < 0.1 * period_s &&
                         std::abs(std::remainder(beat.phase - 0.3, 1)) < 0.1;
      found = found || is_it;
    }
    EXPECT_TRUE(found) << period_s;
  }
}

TEST(Beats, AreKnownAsWellAfterTenMinutes) {
  const Held held(0.16, 0.3, 0.003, 600);
  const std::vector<Beat> beats = BeatsOf(held.t_s, held.value, {});
  ASSERT_FALSE(beats.empty());
  const double periods = 600 / 0.16;
  double least = 1;
  for (const Beat& beat : beats) {
    least = std::min(least, std::abs(beat.period_s - 0.16) * periods / 0.16);
  }
  EXPECT_LT(least, 0.1);
}

TEST(Beats, AreFaintWhereNothingIsHeld) {
  const Held smooth(0, 0, 0.003, 45), held(0.16, 0, 0.003, 45);
  const std::vector<Beat> none = BeatsOf(smooth.t_s, smooth.value, {});
  const std::vector<Beat> some = BeatsOf(held.t_s, held.value, {});
  ASSERT_FALSE(none.empty());
  ASSERT_FALSE(some.empty());
  EXPECT_LT(none.front().strength, 0.15);
  EXPECT_GT(some.front().strength, 0.4);
}

TEST(Beats, NeedTenOfTheLongestPeriods) {
  const Held brief(0.16, 0, 0, 5);
  EXPECT_TRUE(BeatsOf(brief.t_s, brief.value, {}).empty());
}

}  // namespace
}  // namespace tera
