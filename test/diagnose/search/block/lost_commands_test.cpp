#include "diagnose/search/block/lost_commands.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "diagnose/search/fit/flexible_regressor.h"
#include "diagnose/search/toy_block.h"
#include "diagnose/statistics/series/simulated.h"

namespace tera {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr std::size_t kLostCommandsSamples = 8000;
constexpr double kLostCommandsNoise = 0.03;

const Mechanism& Loss() {
  static const Mechanism loss = {"drops",
                                 Slot::kCommandTiming,
                                 {},
                                 {{"period_s", "s", 1e-3, 5, {}}, {"probability", "1", 0, 1, {}}}};
  return loss;
}

/// The lever at a drive that occasionally misses all messages for some time.
std::vector<double> Received(const std::vector<double>& lever, double mean_gap_s, double held_s,
                             std::uint64_t seed) {
  const Stream draw(seed, "losses");
  std::vector<double> received = lever;
  double next_s = 0;
  for (std::uint64_t loss = 0;; ++loss) {
    next_s += -mean_gap_s * std::log(1 - draw.Uniform(loss));
    const double length_s = held_s * (0.5 + draw.Uniform(loss, 1));
    const auto from = static_cast<std::size_t>(next_s / 0.01),
               to = from + static_cast<std::size_t>(length_s / 0.01);
    if (to >= lever.size()) return received;
    for (std::size_t k = from; k < to; ++k) received[k] = received[from];
    next_s += length_s;
  }
}

/// Play of a lever: the driven part follows once the gap is closed.
std::vector<double> WithPlay(const std::vector<double>& lever, double gap) {
  std::vector<double> driven(lever.size(), 0.0);
  for (std::size_t k = 1; k < lever.size(); ++k) {
    driven[k] = std::clamp(driven[k - 1], lever[k] - gap / 2, lever[k] + gap / 2);
  }
  return driven;
}

BlockDiagnosis Diagnosed(const std::vector<double>& lever, const std::vector<double>& driven,
                         std::uint64_t seed, ReplayBlock* block) {
  *block =
      ToyBlock(lever, ToyMeasured(ToyResponse(driven, 0, 0, 0), kLostCommandsNoise, seed), {0, 3});
  block->of_chance = {{&Loss(), "toy", {}, {{0.1, 0.05}}, {}}};
  return DiagnoseBlock(*block, {}, Stream(seed, "diagnose"));
}

// A loss every 1.8 s, of 0.3 s on average.
TEST(LostCommands, AreNamedWhereADriveMissesMessages) {
  for (const std::uint64_t seed : {11u, 12u, 13u}) {
    const std::vector<double> lever = ToyLever(kLostCommandsSamples, seed);
    ReplayBlock block;
    const BlockDiagnosis diagnosis =
        Diagnosed(lever, Received(lever, 1.5, 0.3, seed), seed, &block);
    ASSERT_THAT(NamesOf(diagnosis.findings), ElementsAre("drops")) << seed;
    const Finding& found = diagnosis.findings[0];
    EXPECT_LT(found.evidence.p, 1e-6);
    EXPECT_LT(found.held_out.rmse_after, found.held_out.rmse_before);
    EXPECT_THAT(found.location.intervals, Not(IsEmpty()));
    EXPECT_THAT(diagnosis.unexplained, IsEmpty());
  }
}

TEST(LostCommands, AreNotNamedWhereNothingIsLost) {
  for (const std::uint64_t seed : {21u, 22u, 23u}) {
    const std::vector<double> lever = ToyLever(kLostCommandsSamples, seed);
    ReplayBlock block;
    EXPECT_THAT(Diagnosed(lever, lever, seed, &block).findings, IsEmpty()) << seed;
  }
}

// Play holds its output at each reversal, repeatably with the lever; no candidate has it.
TEST(LostCommands, AreNotNamedForPlay) {
  for (const std::uint64_t seed : {31u, 32u, 33u}) {
    const std::vector<double> lever = ToyLever(kLostCommandsSamples, seed);
    ReplayBlock block;
    const BlockDiagnosis diagnosis = Diagnosed(lever, WithPlay(lever, 0.3), seed, &block);
    EXPECT_THAT(NamesOf(diagnosis.findings), Not(::testing::Contains("drops"))) << seed;
  }
}

/// Lost commands of a search with a single candidate that predicts `alone`.
std::optional<LostCommands> LostBeside(const std::vector<double>& alone) {
  const std::vector<double> lever = ToyLever(kLostCommandsSamples, 11);
  ReplayBlock block = ToyBlock(
      lever,
      ToyMeasured(ToyResponse(Received(lever, 1.5, 0.3, 11), 0, 0, 0), kLostCommandsNoise, 11),
      {0});
  block.replay = WholeReplay([&](const Structure& terms) {
    return std::vector<std::vector<double>>{terms.empty() ? lever : alone};
  });
  const std::vector<Manoeuvre> manoeuvres = EqualManoeuvres(32, kLostCommandsSamples / 32);
  const SearchOptions options;
  const Stream stream(11, "diagnose");
  const EvaluationContext context(block, options, stream, manoeuvres,
                                  NoiseOfBlock(block, manoeuvres));
  SearchResult search;
  search.found.misfit = context.likelihood.Evaluate(block.predict({}));
  search.singles = {{&block.candidates[0], {0.1}, 10, 10}};
  return LostCommandsOf(context, search, kLostCommandsNoise, 0);
}

TEST(LostCommands, AreNoneWhereOneMechanismHoldsTheSame) {
  const std::vector<double> lever = ToyLever(kLostCommandsSamples, 11);
  EXPECT_TRUE(LostBeside(lever).has_value());
  EXPECT_FALSE(LostBeside(Received(lever, 1.5, 0.3, 11)).has_value());
}

// A predicted step from 0 to 1 at 2 s that the measurement follows half a second later.
TEST(LostCommands, HoldsAreFoundWhereTheRateStays) {
  Series residual = MakeSeries(0.02, std::vector<double>(300, 0.0));
  std::vector<double> predicted(300, 0.0);
  const Stream draw(1, "noise");
  for (std::size_t k = 0; k < 300; ++k) {
    predicted[k] = k >= 100 ? 1 : 0;
    residual.value[k] = 0.1 * draw.Gaussian(k) - (k >= 100 && k < 125 ? 1 : 0);
  }
  const std::vector<Hold> holds = HoldsOf(residual, predicted, {0.1});
  ASSERT_EQ(holds.size(), 1u);
  EXPECT_LE(holds[0].samples.begin, 100u);
  EXPECT_NEAR(static_cast<double>(holds[0].samples.end), 125, 1);
  EXPECT_THAT(HoldsOf(residual, predicted, {0.1}, true), IsEmpty());
  const Series held = WithHolds(residual, predicted, holds);
  EXPECT_LT(MeanSquare(held, Mask(300, 1)), 2 * 0.01);
}

}  // namespace
}  // namespace tera
