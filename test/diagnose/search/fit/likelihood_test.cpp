#include "diagnose/search/fit/likelihood.h"

#include <gtest/gtest.h>

#include <cmath>

#include "diagnose/search/toy_block.h"
#include "diagnose/statistics/series/simulated.h"

namespace tera {
namespace {

TEST(Likelihood, TakesOffsetGainAndDelayForWhatTheyMayBe) {
  // Prediction, and the same shifted by a third of a sample, 1 % larger and 0.004 higher.
  constexpr std::size_t kSize = 4000;
  std::vector<double> predicted(kSize), measured(kSize);
  for (std::size_t k = 0; k < kSize; ++k) {
    const auto at = [](double t_s) { return std::sin(2 * t_s) + 0.4 * std::sin(5.1 * t_s); };
    const double t_s = 0.01 * static_cast<double>(k);
    predicted[k] = at(t_s);
    measured[k] = 1.01 * at(t_s - 0.0033) + 0.004 + 1e-3 * Stream(3, "noise").Gaussian(k);
  }
  ReplayBlock block = ToyBlock(predicted, MakeSeries(0.01, measured), {});
  block.channels[0].nuisances = {.offset = 0.01, .gain = 0.02, .delay_s = 0.01};
  const Likelihood likelihood(block, {{.scale = 1e-3}}, Mask(kSize, 1));
  const Misfit misfit = likelihood.Evaluate({predicted});
  EXPECT_NEAR(misfit.nuisances[0][0] * 0.01, 0.004, 2e-4);
  EXPECT_NEAR(misfit.nuisances[0][1] * 0.02, 0.01, 2e-4);
  EXPECT_NEAR(misfit.nuisances[0][2] * 0.01, 0.0033, 2e-4);
  double square = 0;
  for (std::size_t k = 100; k < kSize - 100; ++k)
    square += std::pow(misfit.residual[0].value[k], 2);
  EXPECT_NEAR(std::sqrt(square / (kSize - 200)), 1e-3, 5e-5);
}

TEST(Likelihood, DiscernsWhatIsBeyondNuisancesAlone) {
  const std::vector<double> lever = ToyLever(4000, 5);
  std::vector<double> larger = lever, squared = lever;
  for (double& x : larger) x *= 1.02;
  for (double& x : squared) x += 0.02 * x * x;
  const ReplayBlock block = ToyBlock(lever, ToyMeasured(lever, 0.02, 5), {});
  const Likelihood likelihood(block, {{.scale = 0.02}}, Mask(lever.size(), 1));
  EXPECT_LT(likelihood.NoiselessGain({lever}, {larger}), 1.0);
  EXPECT_GT(likelihood.NoiselessGain({lever}, {squared}), 10.0);
}

TEST(Likelihood, TakesANominalNumberForWhatItMayBe) {
  // A lag known to be 0.2 s within 0.02 s, in truth 0.23 s; judged from the first half.
  const std::vector<double> lever = ToyLever(4000, 6);
  const std::vector<double> nominal = ToyResponse(lever, 0, 0, 0.2);
  const std::vector<double> slower = ToyResponse(lever, 0, 0, 0.22);
  ReplayBlock block = ToyBlock(lever, ToyMeasured(ToyResponse(lever, 0, 0, 0.23), 1e-3, 6), {});
  Mask first(lever.size(), 0);
  std::fill_n(first.begin(), 2000, 1);
  const auto left = [&] {
    const Misfit misfit = Likelihood(block, {{.scale = 1e-3}}, first).Evaluate({nominal});
    double square = 0;
    for (std::size_t k = 2100; k < 3900; ++k) square += std::pow(misfit.residual[0].value[k], 2);
    return std::sqrt(square / 1800);
  };
  const double without = left();
  block.channels[0].nominal.resize(4000, 1);
  for (Eigen::Index k = 0; k < 4000; ++k) {
    const auto at = static_cast<std::size_t>(k);
    block.channels[0].nominal(k, 0) = slower[at] - nominal[at];
  }
  const Misfit misfit = Likelihood(block, {{.scale = 1e-3}}, first).Evaluate({nominal});
  EXPECT_NEAR(misfit.nuisances[0][3], 1.5, 0.15);  // 0.03 s over 0.02 s, except for curvature
  EXPECT_GT(without, 0.01);
  EXPECT_LT(left(), 0.2 * without);
}

TEST(Likelihood, NoNuisanceIsMoreThanTwoStandardDeviations) {
  // A gain known to 2 % but off by 30 % leaves 26 %, and shifts no other nuisance.
  const std::vector<double> lever = ToyLever(4000, 7);
  std::vector<double> larger = lever;
  for (double& x : larger) x *= 1.3;
  ReplayBlock block = ToyBlock(lever, ToyMeasured(larger, 1e-3, 7), {});
  block.channels[0].nuisances = {.offset = 1e-6, .gain = 0.02};
  const Misfit misfit =
      Likelihood(block, {{.scale = 1e-2, .dof = 1e9}}, Mask(lever.size(), 1)).Evaluate({lever});
  EXPECT_DOUBLE_EQ(misfit.nuisances[0][1], 2);
  double of_lever = 0, square = 0;
  for (std::size_t k = 0; k < lever.size(); ++k) {
    of_lever += misfit.residual[0].value[k] * lever[k];
    square += block.channels[0].measured.valid[k] ? lever[k] * lever[k] : 0;
  }
  EXPECT_NEAR(of_lever / square, 0.26, 0.01);
}

TEST(Likelihood, FitsToTheMaskWhatItThenJudgesEverywhere) {
  // An offset of the second half only: a fit to the first half leaves it in the second.
  constexpr std::size_t kSize = 2000;
  std::vector<double> predicted(kSize, 0.0), measured(kSize, 0.0);
  Mask first(kSize, 0);
  for (std::size_t k = 0; k < kSize; ++k) {
    predicted[k] = std::sin(0.02 * static_cast<double>(k));
    first[k] = k < kSize / 2;
    measured[k] = predicted[k] + (first[k] ? 0 : 0.1);
  }
  ReplayBlock block = ToyBlock(predicted, MakeSeries(0.01, measured), {});
  block.channels[0].nuisances = {.offset = 1, .gain = 0.02};
  const Likelihood likelihood(block, {{.scale = 1e-3}}, first);
  const Misfit misfit = likelihood.Evaluate({predicted});
  EXPECT_NEAR(misfit.residual[0].value[100], 0, 1e-6);
  EXPECT_NEAR(misfit.residual[0].value[1900], 0.1, 1e-6);
  EXPECT_EQ(likelihood.fitted_samples(0).size(), kSize / 2);
  // The fit maximises the sum over the fitted samples minus the nuisances.
  EXPECT_NEAR(likelihood.LogLikelihood({predicted}),
              likelihood.Sum(misfit, {0, kSize / 2}) - 0.5 * misfit.nuisances[0].squaredNorm(),
              1e-9);
}

}  // namespace
}  // namespace tera
