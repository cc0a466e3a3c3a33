#include "diagnose/search/structure/pruning.h"

#include <gtest/gtest.h>

#include <cmath>

#include "diagnose/search/toy_block.h"

namespace tera {
namespace {

constexpr std::size_t kManoeuvres = 12, kLength = 200;
constexpr double kSigma = 0.05;
constexpr std::size_t kSquare = 0, kStep = 1;  ///< the block's candidates

/// The toy with a square and a step of the lever in the measurement.
ReplayBlock BlockWith(double square, double step, std::uint64_t seed) {
  const std::vector<double> lever = ToyLever(kManoeuvres * kLength, seed);
  return ToyBlock(lever, ToyMeasured(ToyResponse(lever, square, step, 0), kSigma, seed), {0, 2});
}

/// The pruned structure of square and step, both fitted, under the true noise.
PrunedStructure Pruned(const ReplayBlock& block, double alpha = 0.01) {
  const std::vector<Manoeuvre> manoeuvres = EqualManoeuvres(kManoeuvres, kLength);
  const std::vector<NoiseModel> noise = {
      {.ar = {0.7}, .scale = kSigma * std::sqrt(1 - 0.7 * 0.7) / std::sqrt(2.0), .dof = 4}};
  SearchOptions options;
  options.alpha = alpha;
  options.threads = 1;
  const Likelihood likelihood(block, noise, MaskOf(manoeuvres, Part::kTrain, block.samples()));
  const StructureFitter fitter(block, likelihood, {}, 1);
  const ScoredFits fits(fitter, likelihood, SegmentsOf(manoeuvres, Part::kSelect), 1);
  const Pruning pruning(block, noise, manoeuvres, likelihood, fitter, fits, options, false);
  const Candidate &square = block.candidates[kSquare], &step = block.candidates[kStep];
  return pruning.Prune(
      fits.Score(fitter.FitValues({{&square, square.starts[0]}, {&step, step.starts[0]}})));
}

std::vector<std::string> NamesIn(const Structure& terms) {
  std::vector<std::string> names;
  for (const Term& term : terms) names.emplace_back(term.candidate->mechanism->id);
  return names;
}

TEST(Pruning, KeepsWhatShowsAndLosesWhatDoesNot) {
  const ReplayBlock both = BlockWith(0.3, 0.2, 1), one = BlockWith(0.3, 0, 2);
  const PrunedStructure of_both = Pruned(both), of_one = Pruned(one);
  EXPECT_EQ(NamesIn(of_both.structure.terms), (std::vector<std::string>{"square", "step"}));
  ASSERT_EQ(NamesIn(of_one.structure.terms), (std::vector<std::string>{"square"}));
  EXPECT_EQ(of_both.evidence.size(), 2u);
  ASSERT_EQ(of_one.evidence.size(), 1u);
  EXPECT_LT(of_one.evidence[0].p, 1e-4);
  EXPECT_FALSE(of_one.evidence[0].joint_p) << "it is needed by itself";
  EXPECT_NEAR(of_one.structure.terms[0].values[0], 0.3, 0.05);
}

TEST(Pruning, LosesWhatIsAnotherMechanismInDisguiseHoweverMuchItExplains) {
  ReplayBlock block = BlockWith(0.3, 0.2, 3);
  block.candidates[kSquare].is_itself = [](const std::vector<double>&) { return false; };
  EXPECT_EQ(NamesIn(Pruned(block).structure.terms), std::vector<std::string>{"step"});
}

// Nothing acts: any remaining term, or the two together, is a false alarm.
TEST(Pruning, KeepsNothingOfNoiseMoreOftenThanItSays) {
  constexpr int kRecordings = 40;
  constexpr double kAlpha = 0.1;
  int kept = 0;
  for (std::uint64_t seed = 0; seed < kRecordings; ++seed) {
    kept += Pruned(BlockWith(0, 0, 100 + seed), kAlpha).structure.terms.empty() ? 0 : 1;
  }
  const double deviation = std::sqrt(kRecordings * kAlpha * (1 - kAlpha));
  EXPECT_LE(kept, kRecordings * kAlpha + 3 * deviation);
}

// Sizes at which about one recording in twenty shows both, but neither alone.
TEST(Pruning, KeepsTwoThatAreNeededOnlyBesideEachOtherByTheProbabilityOfBoth) {
  constexpr double kAlpha = 0.01;
  int pairs = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const PrunedStructure needed = Pruned(BlockWith(0.03, 0.03, 200 + seed), kAlpha);
    for (const TermEvidence& evidence : needed.evidence) {
      EXPECT_LE(evidence.joint_p.value_or(evidence.p), kAlpha);
      if (!evidence.joint_p) continue;
      ++pairs;
      EXPECT_EQ(needed.structure.terms.size(), 2u);
      EXPECT_GT(evidence.p, kAlpha);
    }
  }
  EXPECT_GE(pairs, 1);
}

}  // namespace
}  // namespace tera
