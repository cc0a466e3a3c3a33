#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "diagnose/statistics/hypothesis_tests/change_points.h"
#include "diagnose/statistics/series/manoeuvres.h"
#include "diagnose/statistics/series/simulated.h"
#include "diagnose/statistics/series/whitening.h"

namespace tera {
namespace {

double Overlap(const Segment& a, const Segment& b) {
  const double both =
      static_cast<double>(std::min(a.end, b.end)) - static_cast<double>(std::max(a.begin, b.begin));
  const double any =
      static_cast<double>(std::max(a.end, b.end)) - static_cast<double>(std::min(a.begin, b.begin));
  return std::max(both, 0.0) / any;
}

TEST(ChangePoints, FindTheStretchesThatAreLouderOrShifted) {
  Series x = NoiseSeries({.dof = 4}, 12000, Stream(1, "innovations"));
  for (std::size_t k = 3000; k < 4500; ++k) x.value[k] *= 1.6;
  for (std::size_t k = 8000; k < 8800; ++k) x.value[k] += 0.8;
  const ChangePoints found = FindChangePoints(x, 4);
  ASSERT_EQ(found.mismatch.size(), 2u);
  EXPECT_GT(Overlap(found.mismatch[0], {3000, 4500}), 0.9);
  EXPECT_GT(Overlap(found.mismatch[1], {8000, 8800}), 0.9);
}

TEST(ChangePoints, ScoresAreMeasuredInTheUnitsOfTheModel) {
  // A location score has slope (dof + 1) / (dof + 3) at 0: the level of a small shift d is that
  // times d.
  Series x = NoiseSeries({.dof = 6}, 100000, Stream(2, "innovations"));
  for (double& e : x.value) e += 0.2;
  const ChangePoints found = FindChangePoints(x, 6);
  ASSERT_EQ(found.segments.size(), 1u);
  EXPECT_NEAR(found.segments[0].level, 0.2 * 7 / 9, 5 * std::sqrt(7.0 / 9 / 1e5) + 0.004);
  EXPECT_TRUE(found.segments[0].mismatch);
}

TEST(ChangePoints, FewRecordingsOfNothingHaveAny) {
  int changed = 0, flagged = 0;
  const int runs = 300;
  for (std::uint64_t seed = 0; seed < runs; ++seed) {
    const Series noise = WithDropouts(NoiseSeries(StubbornNoise(), 4000, Stream(seed, "noise")),
                                      0.02, Stream(seed, "gaps"));
    const NoiseModel fitted = FitNoise(noise, {.highest_order = 3});
    const ChangePoints found = FindChangePoints(Whiten(fitted, noise).scaled, fitted.dof);
    changed += found.segments.size() > 1;
    flagged += !found.mismatch.empty();
  }
  RecordProperty("changed", changed);
  // Nominal 1 %; binomial with 5 standard errors: 0.01 + 5 * 0.0057.
  EXPECT_LE(changed, 0.04 * runs);
  EXPECT_LE(flagged, 0.04 * runs);
}

TEST(ChangePoints, GuardedTakeNoiseThatRemembersForNoChanges) {
  // Unit variance for each sample; cells of 20 scatter by more than a twentieth of that.
  int guarded = 0, trusting = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Series x =
        NoiseSeries({.ar = {0.5}, .scale = 0.87, .dof = 100}, 4000, Stream(seed, "remembers"));
    guarded += FindChangePoints(x, 100).mismatch.empty() ? 0 : 1;
    trusting += FindChangePoints(x, 100, {.guarded = false}).mismatch.empty() ? 0 : 1;
  }
  EXPECT_LE(guarded, 2);
  EXPECT_GE(trusting, 10);
}

TEST(ChangePoints, CellsWithoutSamplesChangeNothing) {
  Series x = NoiseSeries({.dof = 5}, 5000, Stream(3, "innovations"));
  for (std::size_t k = 1000; k < 2500; ++k) x.valid[k] = 0;
  EXPECT_EQ(FindChangePoints(x, 5).segments.size(), 1u);
}

/// Boom and stick alternately, small and large, with 1.5 s of rest between.
std::vector<Series> TwoLevers(std::size_t turns, std::size_t held = 200) {
  std::vector<double> boom, stick;
  for (std::size_t turn = 0; turn < turns; ++turn) {
    const double size = turn % 4 < 2 ? 0.3 : 0.9;
    boom.insert(boom.end(), held, turn % 2 ? 0 : size);
    stick.insert(stick.end(), held, turn % 2 ? -size : 0);
    boom.insert(boom.end(), 150, 0);
    stick.insert(stick.end(), 150, 0);
  }
  return {MakeSeries(0.01, boom), MakeSeries(0.01, stick)};
}

TEST(Manoeuvres, AreRunsOfOneCommandWithTheirDecay) {
  const std::vector<Manoeuvre> all = SplitByManoeuvre(TwoLevers(20), Stream(1, "split"));
  ASSERT_EQ(all.size(), 40u);
  EXPECT_EQ(all[0].samples, (Segment{0, 300}));
  EXPECT_EQ(all[0].axes, 1u);
  EXPECT_DOUBLE_EQ(all[0].amplitude, 0.3);
  EXPECT_EQ(all[1].samples, (Segment{300, 350}));
  EXPECT_EQ(all[1].axes, 0u);
  EXPECT_EQ(all[2].axes, 2u);
  for (std::size_t m = 1; m < all.size(); ++m) {
    EXPECT_EQ(all[m].samples.begin, all[m - 1].samples.end);
  }
  EXPECT_EQ(all.back().samples.end, 20u * 350);
}

TEST(Manoeuvres, EveryPartHasEveryKindInItsShare) {
  const std::vector<Manoeuvre> all = SplitByManoeuvre(TwoLevers(80), Stream(2, "split"));
  std::map<std::pair<std::uint64_t, bool>, std::map<Part, double>> time;
  std::map<Part, double> overall;
  double total = 0;
  for (const Manoeuvre& m : all) {
    const auto size = static_cast<double>(m.samples.size());
    time[{m.axes, m.amplitude > 0.5}][m.part] += size;
    overall[m.part] += size;
    total += size;
  }
  EXPECT_NEAR(overall[Part::kTrain] / total, 0.4, 0.03);
  EXPECT_NEAR(overall[Part::kSelect] / total, 0.3, 0.03);
  EXPECT_NEAR(overall[Part::kFinal] / total, 0.3, 0.03);
  ASSERT_EQ(time.size(), 5u);
  // Twenty equal pieces of each kind: within one of 8, 6 and 6.
  for (auto& [kind, parts] : time) {
    if (kind.first == 0) continue;
    EXPECT_NEAR(parts[Part::kTrain] / 300, 8, 1.01);
    EXPECT_NEAR(parts[Part::kSelect] / 300, 6, 1.01);
    EXPECT_NEAR(parts[Part::kFinal] / 300, 6, 1.01);
  }
}

TEST(Manoeuvres, WithoutRestAreBlocksOfEqualLength) {
  std::vector<double> sweep(2500);
  for (std::size_t k = 0; k < sweep.size(); ++k)
    sweep[k] = 0.5 + 0.1 * std::sin(0.01 * static_cast<double>(k));
  const std::vector<Manoeuvre> all =
      SplitByManoeuvre({MakeSeries(0.01, sweep)}, Stream(3, "split"));
  ASSERT_EQ(all.size(), 5u);
  EXPECT_EQ(all[3].samples, (Segment{1500, 2000}));
}

TEST(Manoeuvres, LongOnesAreCutAndTheSplitIsRepeatable) {
  const std::vector<Series> levers = TwoLevers(20, 500);
  const auto cut = [&](std::uint64_t seed) {
    return SplitByManoeuvre(levers, Stream(seed, "split"));
  };
  const std::vector<Manoeuvre> a = cut(4), b = cut(4);
  ASSERT_EQ(a.size(), 60u);
  for (std::size_t m = 0; m < a.size(); ++m) {
    EXPECT_LE(a[m].samples.size(), 300u);
    EXPECT_EQ(a[m].part, b[m].part);
  }
  EXPECT_EQ(MaskOf(a, Part::kTrain, 13000), MaskOf(b, Part::kTrain, 13000));
  std::size_t covered = 0;
  for (const Part part : {Part::kTrain, Part::kSelect, Part::kFinal}) {
    covered += CountValid(MaskOf(a, part, 13000));
  }
  EXPECT_EQ(covered, 13000u);
}

}  // namespace
}  // namespace tera
