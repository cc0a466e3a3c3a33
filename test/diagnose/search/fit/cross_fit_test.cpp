#include "diagnose/search/fit/cross_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "diagnose/search/toy_block.h"
#include "diagnose/statistics/series/simulated.h"

namespace tera {
namespace {

constexpr std::size_t kManoeuvres = 12, kLength = 400;

double MeanOf(const Series& residual, std::size_t manoeuvre) {
  double sum = 0;
  for (std::size_t k = 0; k < kLength; ++k) sum += residual.value[manoeuvre * kLength + k];
  return sum / kLength;
}

// A prediction of zero and an individual offset in each manoeuvre: each fit predicts the mean of
// the manoeuvres it has seen.
TEST(CrossFit, JudgesEveryManoeuvreByFitsThatHaveNotSeenIt) {
  const std::vector<Manoeuvre> manoeuvres = EqualManoeuvres(kManoeuvres, kLength);
  std::vector<double> measured(kManoeuvres * kLength), offset(kManoeuvres);
  for (std::size_t m = 0; m < kManoeuvres; ++m) {
    offset[m] = 0.1 * Stream(8, "offset").Gaussian(m);
    std::fill_n(measured.begin() + static_cast<std::ptrdiff_t>(m * kLength), kLength, offset[m]);
  }
  const std::vector<double> nothing(measured.size(), 0.0);
  ReplayBlock block = ToyBlock(nothing, MakeSeries(0.01, measured), {});
  block.channels[0].nuisances = {.offset = 1e3, .gain = 0.02};
  // Tails so light that the fit is a mean.
  const Misfit misfit =
      CrossFit(block, {{.scale = 1, .dof = 1e9}}, manoeuvres).Evaluate({Structure()}, 1).front();

  std::vector<std::size_t> seen;
  for (std::size_t m = 0; m < kManoeuvres; ++m) {
    if (manoeuvres[m].part != Part::kFinal) seen.push_back(m);
  }
  for (std::size_t i = 0; i < seen.size(); ++i) {
    double sum = 0, count = 0;
    for (std::size_t other = 0; other < seen.size(); ++other) {
      if (other % 5 == i % 5) continue;
      sum += offset[seen[other]];
      ++count;
    }
    EXPECT_NEAR(MeanOf(misfit.residual[0], seen[i]), offset[seen[i]] - sum / count, 1e-6) << i;
  }
}

// Overfitting yields no gain on unseen manoeuvres.
TEST(CrossFit, AStructureThatFollowsNoiseGainsNothing) {
  const std::vector<double> lever = ToyLever(kManoeuvres * kLength, 4);
  const ReplayBlock block = ToyBlock(lever, ToyMeasured(lever, 0.05, 4), {0});
  const std::vector<Manoeuvre> manoeuvres = EqualManoeuvres(kManoeuvres, kLength);
  const std::vector<NoiseModel> noise = {{.scale = 0.05}};
  const CrossFit crossed(block, noise, manoeuvres);
  const Candidate& candidate = block.candidates[0];
  const std::vector<Misfit> judged = crossed.Evaluate({{{&candidate, candidate.starts[0]}}, {}}, 2);
  const Misfit &with = judged[0], &without = judged[1];
  const Likelihood likelihood(block, noise, Mask(lever.size(), 1));
  double gain = 0;
  for (const Manoeuvre& manoeuvre : manoeuvres) {
    if (manoeuvre.part == Part::kFinal) continue;
    gain += likelihood.Sum(with, manoeuvre.samples) - likelihood.Sum(without, manoeuvre.samples);
  }
  EXPECT_LT(gain, 3);
}

}  // namespace
}  // namespace tera
