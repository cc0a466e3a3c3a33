#include "diagnose/search/block/block_diagnosis.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "diagnose/search/fit/flexible_regressor.h"
#include "diagnose/search/toy_block.h"
#include "diagnose/statistics/series/simulated.h"
#include "diagnose/tolerances/within_tolerance.h"

namespace tera {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;
using ::testing::UnorderedElementsAre;

constexpr std::size_t kSamples = 8000;
constexpr double kNoise = 0.05;

const Finding& FindingOf(const BlockDiagnosis& diagnosis, std::string_view id) {
  for (const Finding& finding : diagnosis.findings) {
    if (finding.term.candidate->mechanism->id == id) return finding;
  }
  throw std::runtime_error("not found: " + std::string(id));
}

struct Toy {
  Toy(std::uint64_t seed, double square, double step, double lag_s,
      std::vector<std::size_t> candidates = {0, 2, 3})
      : lever(ToyLever(kSamples, seed)),
        block(ToyBlock(lever, ToyMeasured(ToyResponse(lever, square, step, lag_s), kNoise, seed),
                       candidates)),
        diagnosis(DiagnoseBlock(block, {}, Stream(seed, "diagnose"))) {}

  std::vector<double> lever;
  ReplayBlock block;
  BlockDiagnosis diagnosis;
};

TEST(BlockDiagnosis, FindsNothingWhereNothingIsWrong) {
  const Toy toy(11, 0, 0, 0);
  EXPECT_THAT(toy.diagnosis.findings, IsEmpty());
  EXPECT_THAT(toy.diagnosis.unexplained, IsEmpty());
}

TEST(BlockDiagnosis, NamesTheOneThatActsWithItsSizeAndWhereItIsSeen) {
  const Toy toy(12, 0.2, 0, 0);
  ASSERT_THAT(NamesOf(toy.diagnosis.findings), ElementsAre("square"));
  const Finding& found = toy.diagnosis.findings[0];
  EXPECT_NEAR(found.parameters[0].value, 0.2, 4 * found.parameters[0].sigma.value());
  EXPECT_LT(*found.parameters[0].sigma, 0.02);
  EXPECT_LT(found.held_out.p, 0.01);
  EXPECT_GT(found.held_out.excess_removed, 0.8);
  EXPECT_LT(found.held_out.rmse_after, found.held_out.rmse_before);
  ASSERT_FALSE(found.location.regimes.empty());
  EXPECT_EQ(found.location.regimes[0].variable, "lever");
  EXPECT_EQ(found.location.regimes[0].shape.parity, CurveParity::kEven);
}

/// The toy with a lag of 0.1 s. The square counts as a parameter with the given neutral value and a
/// tolerance of 0.3 about 0.
BlockDiagnosis OfALagBesideASquareThatIsExpected(double neutral) {
  const std::vector<double> lever = ToyLever(kSamples, 12);
  static ReplayBlock block;  // findings point into it
  block = ToyBlock(lever, ToyMeasured(ToyResponse(lever, 0, 0, 0.1), kNoise, 12), {0, 2, 3});
  block.candidates[0].free[0].expected = Expected{0, 0.3, neutral};
  return DiagnoseBlock(block, {}, Stream(12, "diagnose"));
}

/// A toy with two equivalent candidates, one of them with this tolerance.
TermEvidence OfTwinsWithTolerance(double half_width) {
  const std::vector<double> lever = ToyLever(kSamples, 14);
  ReplayBlock block =
      ToyBlock(lever, ToyMeasured(ToyResponse(lever, 0.2, 0, 0), kNoise, 14), {0, 1});
  for (Candidate& candidate : block.candidates) {
    if (candidate.mechanism->id == "twin") candidate.free[0].expected = Expected{0, half_width};
  }
  const BlockDiagnosis diagnosis = DiagnoseBlock(block, {}, Stream(14, "diagnose"));
  EXPECT_EQ(diagnosis.findings.size(), 1u);
  TermEvidence evidence = diagnosis.findings.at(0).evidence;
  EXPECT_EQ(evidence.rivals.size(), 2u);
  // The block is destroyed: only the existence of candidates matters.
  static const Candidate kSomeCandidate;
  for (const Candidate*& rival : evidence.expected_rivals) rival = &kSomeCandidate;
  return evidence;
}

// Either explains it with 0.2: if one may be as large within tolerance, nothing is proven.
TEST(BlockDiagnosis, KnowsWhetherARivalThatDoesAsWellIsAsExpected) {
  EXPECT_THAT(OfTwinsWithTolerance(0.3).expected_rivals, SizeIs(1));
  EXPECT_THAT(OfTwinsWithTolerance(0.1).expected_rivals, IsEmpty());
}

/// A machine with a square in four seconds of every twelve and a faint wave in the others. The
/// twin, with a tolerance of 1, has the wave, and `twin_of` the lever instead of the square. It
/// gains in most manoeuvres, by far less than it loses in the others. A rate factor within its
/// tolerance changes a hundredth.
BlockDiagnosis WithATwinThatHasAFaintWave(const std::function<double(double)>& twin_of) {
  const std::vector<double> lever = ToyLever(kSamples, 14);
  const auto is_early = [](std::size_t k) { return k % 1200 < 400; };
  const auto wave = [](std::size_t k) { return 0.006 * std::sin(0.05 * static_cast<double>(k)); };
  std::vector<double> clean = lever;
  for (std::size_t k = 0; k < kSamples; ++k) {
    clean[k] += is_early(k) ? 0.2 * lever[k] * lever[k] : wave(k);
  }
  static ReplayBlock block;  // findings point into it
  block = ToyBlock(lever, ToyMeasured(clean, 0.002, 14), {0, 1, 2});
  block.candidates[1].free[0].expected = Expected{0, 1};
  block.candidates[2].free[0].expected = Expected{0, 0.01, 1};
  block.replay = WholeReplay([=](const Structure& terms) {
    std::vector<double> y = lever;
    for (const Term& term : terms) {
      const std::string_view id = term.candidate->mechanism->id;
      const double size = term.values[0];
      for (std::size_t k = 0; k < kSamples; ++k) {
        if (id == "step") y[k] += size * std::tanh(20 * lever[k]);
        if (id == "square" && is_early(k)) y[k] += size * lever[k] * lever[k];
        if (id == "twin") y[k] += is_early(k) ? size * twin_of(lever[k]) : wave(k);
      }
    }
    return std::vector<std::vector<double>>{y};
  });
  return DiagnoseBlock(block, {}, Stream(14, "diagnose"));
}

// A twin of half the square plus a ripple leaves less than a rate factor within its tolerance does.
// The lever's magnitude alone leaves more.
TEST(BlockDiagnosis, KnowsWhatARivalThatIsAsExpectedLeaves) {
  const BlockDiagnosis same = WithATwinThatHasAFaintWave(
      [](double lever) { return 0.5 * lever * lever + 0.03 * std::sin(9 * lever); });
  ASSERT_THAT(NamesOf(same.findings), ElementsAre("square"));
  EXPECT_THAT(same.findings[0].evidence.expected_rivals, SizeIs(1));
  EXPECT_FALSE(IsBeyondTolerance(same.findings[0]));
  const BlockDiagnosis other =
      WithATwinThatHasAFaintWave([](double lever) { return std::abs(lever); });
  ASSERT_THAT(NamesOf(other.findings), ElementsAre("square"));
  EXPECT_THAT(other.findings[0].evidence.expected_rivals, SizeIs(1)) << "it is not rejected";
  EXPECT_TRUE(IsBeyondTolerance(other.findings[0]));
}

/// Rivals of a twin that responds 0.05 s late next to its square, if a square and a lag of at most
/// this size are within tolerance, and both act.
std::size_t RivalsOfALateTwin(double expected_lag_s) {
  const std::vector<double> lever = ToyLever(kSamples, 14);
  ReplayBlock block =
      ToyBlock(lever, ToyMeasured(ToyResponse(lever, 0.2, 0, 0.05), kNoise, 14), {0, 1, 3});
  block.candidates.back().free[0].expected = Expected{0, expected_lag_s};
  block.replay = WholeReplay([&lever](const Structure& terms) {
    double square = 0, lag_s = 0;
    for (const Term& term : terms) {
      const std::string_view id = term.candidate->mechanism->id;
      (id == "lag" ? lag_s : square) += term.values[0];
      if (id == "twin") lag_s += 0.05;
    }
    return std::vector<std::vector<double>>{ToyResponse(lever, square, 0, lag_s)};
  });
  const BlockDiagnosis diagnosis = DiagnoseBlock(block, {}, Stream(14, "diagnose"));
  return FindingOf(diagnosis, "twin").evidence.rivals.size();
}

TEST(BlockDiagnosis, RejectsNoRivalForLackingAnExpectedLag) {
  EXPECT_EQ(RivalsOfALateTwin(0.08), 2u);
  EXPECT_EQ(RivalsOfALateTwin(0.01), 1u);
}

// Change of the channel by a square of 0.3; held-out manoeuvres are a third of the recording.
TEST(BlockDiagnosis, KnowsWhatAFactorWithinItsToleranceChangesOfAFindingsChannel) {
  const BlockDiagnosis diagnosis = OfALagBesideASquareThatIsExpected(1);
  ASSERT_THAT(NamesOf(diagnosis.findings), ElementsAre("lag"));
  double sum = 0;
  for (const double u : ToyLever(kSamples, 12)) sum += std::pow(0.3 * u * u, 2);
  const double whole = std::sqrt(sum / kSamples);
  EXPECT_NEAR(diagnosis.findings[0].tolerated, whole, 0.4 * whole);
}

TEST(BlockDiagnosis, WhatIsNoFactorToleratesNoErrorOfOthers) {
  const BlockDiagnosis diagnosis = OfALagBesideASquareThatIsExpected(0);
  ASSERT_THAT(NamesOf(diagnosis.findings), ElementsAre("lag"));
  EXPECT_EQ(diagnosis.findings[0].tolerated, 0);
}

// A twin within 0.15 leaves 0.05 of a square of 0.2, plus noise and nuisances.
TEST(BlockDiagnosis, KnowsWhatIsLeftWhereWhatIsExpectedStandsInAFindingsPlace) {
  const std::vector<double> lever = ToyLever(kSamples, 14);
  ReplayBlock block =
      ToyBlock(lever, ToyMeasured(ToyResponse(lever, 0.2, 0, 0), kNoise, 14), {0, 1});
  for (Candidate& candidate : block.candidates) {
    if (candidate.mechanism->id == "twin") candidate.free[0].expected = Expected{0, 0.15};
  }
  const BlockDiagnosis diagnosis = DiagnoseBlock(block, {}, Stream(14, "diagnose"));
  const Finding& square = FindingOf(diagnosis, "square");
  ASSERT_TRUE(square.as_expected.has_value());
  const double after = square.held_out.rmse_after, before = square.held_out.rmse_before;
  const double share =
      (std::pow(square.as_expected->rmse, 2) - after * after) / (before * before - after * after);
  EXPECT_NEAR(std::sqrt(share), 0.05 / 0.2, 0.05);
}

TEST(BlockDiagnosis, DoesNotNameWhatHasTheNumbersOfAnother) {
  Toy toy(12, 0.2, 0, 0);
  toy.block.candidates[0].is_itself = [](const std::vector<double>& values) {
    return values[0] < 0.1;
  };
  const BlockDiagnosis diagnosis = DiagnoseBlock(toy.block, {}, Stream(12, "diagnose"));
  EXPECT_THAT(NamesOf(diagnosis.findings), Not(Contains("square")));
  EXPECT_THAT(diagnosis.unexplained, Not(IsEmpty()));
}

TEST(BlockDiagnosis, NamesTwoThatActTogether) {
  const Toy toy(13, 0.25, 0, 0.12);
  ASSERT_THAT(NamesOf(toy.diagnosis.findings), UnorderedElementsAre("square", "lag"));
  EXPECT_NEAR(FindingOf(toy.diagnosis, "lag").parameters[0].value, 0.12, 0.02);
  EXPECT_NEAR(FindingOf(toy.diagnosis, "square").parameters[0].value, 0.25, 0.03);
  for (const SingleEvidence& single : toy.diagnosis.search.singles) {
    EXPECT_GT(toy.diagnosis.search.found_gain.value(), single.held_out_gain)
        << "alone it leaves the other";
  }
}

TEST(BlockDiagnosis, FindsTheLesserOfTwoThoughTheGreaterPassedForNoiseAtFirst) {
  // A ripple too fine for the flexible regressor; `step` models it here.
  const std::vector<double> lever = ToyLever(kSamples, 31);
  const auto response = [&](double square, double ripple) {
    std::vector<double> y;
    for (const double u : lever) y.push_back(u + square * u * u + ripple * std::sin(25 * u));
    return y;
  };
  ReplayBlock block = ToyBlock(lever, ToyMeasured(response(0.085, 0.3), kNoise, 31), {0, 2});
  block.replay = WholeReplay([&](const Structure& terms) {
    double square = 0, ripple = 0;
    for (const Term& term : terms) {
      (term.candidate->mechanism->id == "square" ? square : ripple) += term.values[0];
    }
    return std::vector<std::vector<double>>{response(square, ripple)};
  });
  const BlockDiagnosis diagnosis = DiagnoseBlock(block, {}, Stream(31, "diagnose"));
  EXPECT_THAT(NamesOf(diagnosis.findings), UnorderedElementsAre("square", "step"));
  EXPECT_GT(NoiseOfBlock(block, diagnosis.manoeuvres)[0].scale, 1.5 * diagnosis.noise[0].scale);
}

TEST(BlockDiagnosis, KeepsANameThoughOneManoeuvreHeldBackIsOfAnotherKind) {
  const std::vector<double> lever = ToyLever(kSamples, 12);
  ReplayBlock block =
      ToyBlock(lever, ToyMeasured(ToyResponse(lever, 0.2, 0, 0), kNoise, 12), {0, 2, 3});
  const Stream stream(12, "diagnose");
  for (const Manoeuvre& manoeuvre : ManoeuvresOf(block, stream)) {
    if (manoeuvre.part != Part::kFinal || manoeuvre.axes == 0) continue;
    Series& measured = block.channels[0].measured;
    for (std::size_t k = manoeuvre.samples.begin; k < manoeuvre.samples.end; ++k) {
      if (measured.valid[k]) measured.value[k] -= 2 * lever[k] * lever[k];  // it hit something
    }
    break;
  }
  const BlockDiagnosis diagnosis = DiagnoseBlock(block, {}, stream);
  EXPECT_THAT(NamesOf(diagnosis.findings), ElementsAre("square"));
}

TEST(BlockDiagnosis, NamesNothingThatMakesWhatIsKeptBackMuchWorse) {
  // Slightly nearer in many manoeuvres, far off in one of larger levers.
  std::vector<double> lever = ToyLever(kSamples, 12);
  const auto block_of = [&](const std::vector<double>& response) {
    return ToyBlock(lever, ToyMeasured(response, kNoise, 12), {0, 2, 3});
  };
  const Stream stream(12, "diagnose");
  std::vector<double> response = ToyResponse(lever, 0.2, 0, 0);
  for (const Manoeuvre& manoeuvre : ManoeuvresOf(block_of(response), stream)) {
    if (manoeuvre.part != Part::kFinal || manoeuvre.axes == 0) continue;
    for (std::size_t k = manoeuvre.samples.begin; k < manoeuvre.samples.end; ++k) {
      response[k] = lever[k] *= 7;
    }
    break;
  }
  const ReplayBlock block = block_of(response);
  const BlockDiagnosis diagnosis = DiagnoseBlock(block, {}, stream);
  EXPECT_THAT(NamesOf(diagnosis.findings), IsEmpty());
  ASSERT_THAT(NamesOf(diagnosis.unconfirmed), ElementsAre("square"));
  const HeldOutError& error = diagnosis.unconfirmed[0].held_out;
  EXPECT_GT(error.rmse_after, 1.5 * error.rmse_before);
}

TEST(BlockDiagnosis, AnswersWithAClassWhereTwoCandidatesDoTheSame) {
  const Toy toy(14, 0.3, 0, 0, {0, 1, 2, 3});
  ASSERT_EQ(toy.diagnosis.findings.size(), 1u);
  std::vector<std::string> alike;
  for (const Candidate* rival : toy.diagnosis.findings[0].evidence.rivals) {
    alike.emplace_back(rival->mechanism->id);
  }
  EXPECT_THAT(alike, UnorderedElementsAre("square", "twin"));
}

TEST(BlockDiagnosis, SaysThatSomethingIsLeftAndOfWhatItIsAFunction) {
  const std::vector<double> lever = ToyLever(kSamples, 15);
  ReplayBlock block = ToyBlock(lever, ToyMeasured(lever, kNoise, 15), {0, 2, 3});
  const Series& temperature = block.channels[0].variables[1].series;
  Series& measured = block.channels[0].measured;
  for (std::size_t k = 0; k < measured.size(); ++k) {
    if (measured.valid[k]) measured.value[k] += 0.15 * temperature.value[k];
  }
  const BlockDiagnosis diagnosis = DiagnoseBlock(block, {}, Stream(15, "diagnose"));
  EXPECT_THAT(diagnosis.findings, IsEmpty());
  ASSERT_EQ(diagnosis.unexplained.size(), 1u);
  ASSERT_FALSE(diagnosis.unexplained[0].location.regimes.empty());
  EXPECT_EQ(diagnosis.unexplained[0].location.regimes[0].variable, "temperature");
}

/// A toy in which `step` adds a multiple of |lever|.
ReplayBlock ToyOfSizes(const std::vector<double>& lever, const Series& measured,
                       const std::vector<std::size_t>& candidates) {
  ReplayBlock block = ToyBlock(lever, measured, candidates);
  block.replay = WholeReplay([lever](const Structure& terms) {
    std::vector<double> y = lever;
    for (const Term& term : terms) {
      const bool is_size = term.candidate->mechanism->id == "step";
      for (std::size_t k = 0; k < y.size(); ++k) {
        y[k] += term.values[0] * (is_size ? std::abs(lever[k]) : lever[k] * lever[k]);
      }
    }
    return std::vector<std::vector<double>>{y};
  });
  return block;
}

TEST(BlockDiagnosis, WhatOnlyComesNearestStandsInForWhatIsUnexplained) {
  // A multiple of |lever| that varies with the temperature. The library has only its mean, the
  // flexible regressor all of it.
  const std::vector<double> lever = ToyLever(kSamples, 36);
  ReplayBlock block = ToyOfSizes(lever, ToyMeasured(lever, kNoise, 36), {2});
  Channel& channel = block.channels[0];
  for (std::size_t k = 0; k < lever.size(); ++k) {
    const double size = std::abs(lever[k]), t = channel.variables[1].series.value[k];
    if (channel.measured.valid[k]) channel.measured.value[k] += size * 0.3 * (1 + 1.1 * t);
    channel.flexible_regressor(static_cast<Eigen::Index>(k), 12) = size;
    channel.flexible_regressor(static_cast<Eigen::Index>(k), 13) = size * t;
  }
  const BlockDiagnosis diagnosis = DiagnoseBlock(block, {}, Stream(36, "diagnose"));
  EXPECT_THAT(NamesOf(diagnosis.findings), IsEmpty());
  EXPECT_THAT(NamesOf(diagnosis.proxies), ElementsAre("step"));
  EXPECT_EQ(diagnosis.unexplained.size(), 1u);
  EXPECT_THAT(diagnosis.search.found.terms, IsEmpty());
}

TEST(BlockDiagnosis, OfAClassOfFourThatLeavesMuchNoneIsAName) {
  // Several equivalent candidates, a drift that none of them explains, and a ripple that no
  // flexible regressor follows.
  const auto diagnose = [](std::uint64_t seed, const std::vector<std::size_t>& candidates) {
    const std::vector<double> lever = ToyLever(kSamples, seed);
    ReplayBlock block =
        ToyBlock(lever, ToyMeasured(ToyResponse(lever, 0.4, 0, 0), kNoise, seed), candidates);
    const Series& temperature = block.channels[0].variables[1].series;
    Series& measured = block.channels[0].measured;
    for (std::size_t k = 0; k < measured.size(); ++k) {
      measured.value[k] += 0.1 * temperature.value[k] + 0.12 * std::sin(25 * lever[k]);
    }
    return DiagnoseBlock(block, {}, Stream(seed, "diagnose"));
  };
  const BlockDiagnosis of_three = diagnose(35, {0, 1, 1});
  ASSERT_EQ(of_three.findings.size(), 1u);
  EXPECT_LT(of_three.findings[0].held_out.excess_removed, 0.7);
  EXPECT_EQ(of_three.unexplained.size(), 1u);
  const BlockDiagnosis of_four = diagnose(35, {0, 1, 1, 1});
  EXPECT_THAT(of_four.findings, IsEmpty());
  ASSERT_EQ(of_four.proxies.size(), 1u);
  EXPECT_EQ(of_four.proxies[0].evidence.rivals.size(), 4u);
  EXPECT_EQ(of_four.unexplained.size(), 1u);
  // If it explains most, all four are named.
  const BlockDiagnosis most = diagnose(34, {0, 1, 1, 1});
  ASSERT_EQ(most.findings.size(), 1u);
  EXPECT_GT(most.findings[0].held_out.excess_removed, 0.8);
  EXPECT_EQ(most.unexplained.size(), 1u);
}

TEST(BlockDiagnosis, WhatTakesLittleOfWhatIsWrongIsNoName) {
  // A square, and on held-out manoeuvres a ripple that no candidate and no flexible regressor
  // explains.
  const Stream stream(35, "diagnose");
  const std::vector<double> lever = ToyLever(kSamples, 35);
  ReplayBlock block = ToyBlock(lever, ToyMeasured(lever, kNoise, 35), {0});
  const Mask kept_back = MaskOf(ManoeuvresOf(block, stream), Part::kFinal, block.samples());
  const auto diagnose = [&](double square) {
    Series measured = ToyMeasured(ToyResponse(lever, square, 0, 0), kNoise, 35);
    for (std::size_t k = 0; k < measured.size(); ++k) {
      if (measured.valid[k] && kept_back[k]) measured.value[k] += 0.4 * std::sin(25 * lever[k]);
    }
    block.channels[0].measured = measured;
    return DiagnoseBlock(block, {}, stream);
  };
  const BlockDiagnosis much = diagnose(0.8);
  ASSERT_THAT(NamesOf(much.findings), ElementsAre("square"));
  EXPECT_GT(much.findings[0].held_out.excess_removed, 1.0 / 3);
  EXPECT_EQ(much.unexplained.size(), 1u);
  const BlockDiagnosis little = diagnose(0.4);
  EXPECT_THAT(NamesOf(little.findings), IsEmpty());
  ASSERT_THAT(NamesOf(little.proxies), ElementsAre("square"));
  EXPECT_LT(little.proxies[0].held_out.excess_removed, 1.0 / 3);
  EXPECT_EQ(little.unexplained.size(), 1u);
}

TEST(BlockDiagnosis, KeepsANameBesideWhatIsUnexplained) {
  const std::vector<double> lever = ToyLever(kSamples, 34);
  ReplayBlock block =
      ToyBlock(lever, ToyMeasured(ToyResponse(lever, 0.3, 0, 0), kNoise, 34), {0, 2, 3});
  const Series& temperature = block.channels[0].variables[1].series;
  Series& measured = block.channels[0].measured;
  for (std::size_t k = 0; k < measured.size(); ++k) measured.value[k] += 0.1 * temperature.value[k];
  const BlockDiagnosis diagnosis = DiagnoseBlock(block, {}, Stream(34, "diagnose"));
  EXPECT_THAT(NamesOf(diagnosis.findings), ElementsAre("square"));
  ASSERT_EQ(diagnosis.unexplained.size(), 1u);
  EXPECT_EQ(diagnosis.unexplained[0].location.regimes.at(0).variable, "temperature");
}

TEST(BlockDiagnosis, WhatIsLoudInManyButHardlyInThoseKeptBackIsUnexplained) {
  // A ripple without candidate and flexible regressor, until it has decayed.
  const std::vector<double> lever = ToyLever(kSamples, 33);
  ReplayBlock block = ToyBlock(lever, ToyMeasured(lever, kNoise, 33), {0, 2, 3});
  const Stream stream(33, "diagnose");
  std::size_t kept_back = 0, all = 0;
  Series& measured = block.channels[0].measured;
  for (const Manoeuvre& manoeuvre : ManoeuvresOf(block, stream)) {
    if (manoeuvre.axes == 0 || (manoeuvre.part == Part::kFinal && kept_back > 0)) continue;
    kept_back += manoeuvre.part == Part::kFinal ? 1 : 0;
    if (++all > 5) continue;
    for (std::size_t k = manoeuvre.samples.begin; k < manoeuvre.samples.end; ++k) {
      if (measured.valid[k]) measured.value[k] += 1.5 * std::sin(25 * lever[k]);
    }
  }
  const BlockDiagnosis diagnosis = DiagnoseBlock(block, {}, stream);
  ASSERT_EQ(diagnosis.residual_verdicts.size(), 1u);
  EXPECT_LT(2 * diagnosis.residual_verdicts[0].loud, diagnosis.residual_verdicts[0].manoeuvres);
  EXPECT_LT(diagnosis.residual_verdicts[0].loud, 3u);
  EXPECT_EQ(diagnosis.residual_verdicts[0].kind, ResidualVerdict::Kind::kError);
  EXPECT_EQ(diagnosis.unexplained.size(), 1u);
}

TEST(BlockDiagnosis, WhatActsNowAndThenIsToldFromSlowNoiseByAllManoeuvres) {
  // The machine never rests, so that its size does not exclude slow noise. An effect only at the
  // highest temperature is no steady gain on the held-out manoeuvres.
  std::vector<double> lever = ToyLever(kSamples, 15);
  for (double& u : lever) {
    if (std::abs(u) < 0.05) u = std::copysign(0.05, u);
  }
  ReplayBlock block = ToyBlock(lever, ToyMeasured(lever, kNoise, 15), {0, 2, 3});
  const Series& temperature = block.channels[0].variables[1].series;
  Series& measured = block.channels[0].measured;
  for (std::size_t k = 0; k < measured.size(); ++k) {
    if (measured.valid[k]) measured.value[k] += 0.6 * std::max(0.0, temperature.value[k] - 0.8);
  }
  const BlockDiagnosis diagnosis = DiagnoseBlock(block, {}, Stream(15, "diagnose"));
  EXPECT_THAT(diagnosis.findings, IsEmpty());
  ASSERT_EQ(diagnosis.residual_verdicts.size(), 1u);
  EXPECT_EQ(diagnosis.residual_verdicts[0].kind, ResidualVerdict::Kind::kUnknown);
  ASSERT_EQ(diagnosis.unexplained.size(), 1u);
  EXPECT_LT(diagnosis.unexplained[0].p.value_or(1), 0.01);
  ASSERT_FALSE(diagnosis.unexplained[0].location.regimes.empty());
  EXPECT_EQ(diagnosis.unexplained[0].location.regimes[0].variable, "temperature");
}

TEST(BlockDiagnosis, AnErrorThatHappensOnceIsNoStructureOverAVariable) {
  const std::vector<double> lever = ToyLever(kSamples, 36);
  ReplayBlock block = ToyBlock(lever, ToyMeasured(lever, kNoise, 36), {0, 2, 3});
  const Stream stream(36, "diagnose");
  const std::vector<Manoeuvre> manoeuvres = ManoeuvresOf(block, stream);
  const auto seen = std::find_if(manoeuvres.begin(), manoeuvres.end(), [](const Manoeuvre& one) {
    return one.axes > 0 && one.part == Part::kTrain && one.samples.size() > 60;
  });
  ASSERT_NE(seen, manoeuvres.end());
  Series& measured = block.channels[0].measured;
  for (std::size_t k = seen->samples.begin + 20; k < seen->samples.begin + 50; ++k) {
    measured.value[k] += 1;
  }
  const BlockDiagnosis diagnosis = DiagnoseBlock(block, {}, stream);
  EXPECT_THAT(diagnosis.findings, IsEmpty());
  EXPECT_THAT(diagnosis.unexplained, IsEmpty());
}

TEST(BlockDiagnosis, SlowNoiseWithoutRestIsNoErrorOfAnything) {
  // Slow noise, several times as loud as third differences show, and white noise.
  for (std::uint64_t seed = 40; seed < 46; ++seed) {
    std::vector<double> lever = ToyLever(kSamples, seed);
    for (double& u : lever) {
      if (std::abs(u) < 0.05) u = std::copysign(0.05, u);
    }
    const std::vector<double> slow =
        SimulateNoise({.ar = {0.995}, .scale = 0.1 * std::sqrt(1 - 0.995 * 0.995)}, kSamples,
                      Stream(seed, "slow"));
    std::vector<double> measured = lever;
    for (std::size_t k = 0; k < kSamples; ++k) measured[k] += slow[k];
    const ReplayBlock block = ToyBlock(lever, ToyMeasured(measured, kNoise, seed), {0, 2, 3});
    const BlockDiagnosis diagnosis = DiagnoseBlock(block, {}, Stream(seed, "diagnose"));
    ASSERT_EQ(diagnosis.residual_verdicts.size(), 1u);
    EXPECT_EQ(diagnosis.residual_verdicts[0].kind, ResidualVerdict::Kind::kUnknown) << seed;
    EXPECT_THAT(diagnosis.unexplained, IsEmpty()) << seed;
    EXPECT_THAT(diagnosis.findings, IsEmpty()) << seed;
  }
}

TEST(BlockDiagnosis, SaysWhatALeverAtRestCannotShow) {
  const std::vector<double> lever(kSamples, 0.0);
  const ReplayBlock block = ToyBlock(lever, ToyMeasured(lever, kNoise, 16), {0, 2, 3});
  const BlockDiagnosis diagnosis = DiagnoseBlock(block, {}, Stream(16, "diagnose"));
  EXPECT_FALSE(diagnosis.is_testable);
  for (const Detectability& candidate : diagnosis.detectability) {
    EXPECT_FALSE(candidate.smallest.has_value()) << candidate.candidate->mechanism->id;
  }
  EXPECT_THAT(diagnosis.findings, IsEmpty());
}

TEST(BlockDiagnosis, CallsErrorAboveTheNoiseUnexplainedThoughNoFreeCurveFollowsIt) {
  // A wave while the lever moves, no function of any variable of the block.
  const std::vector<double> lever = ToyLever(kSamples, 18);
  ReplayBlock block = ToyBlock(lever, ToyMeasured(lever, kNoise, 18), {0, 2, 3});
  Series& measured = block.channels[0].measured;
  for (std::size_t k = 0; k < measured.size(); ++k) {
    const double t_s = 0.01 * static_cast<double>(k);
    if (!measured.valid[k] || std::abs(lever[k]) < 0.02) continue;
    measured.value[k] += 0.35 * std::sin(7.3 * t_s + 2 * std::sin(t_s));
  }
  const BlockDiagnosis diagnosis = DiagnoseBlock(block, {}, Stream(18, "diagnose"));
  EXPECT_THAT(diagnosis.findings, IsEmpty());
  ASSERT_EQ(diagnosis.unexplained.size(), 1u);
  EXPECT_GT(diagnosis.unexplained[0].rmse, 0.15);
  EXPECT_LT(diagnosis.unexplained[0].noise, 2 * kNoise);
}

TEST(BlockDiagnosis, AsksOfAnAxisWhatThreePerCentOfItsQuantityAre) {
  // A second axis that almost rests, with a wave of 1 % of the first's size. A misalignment by half
  // a degree would cause as much. In another quantity it is error.
  const std::vector<double> lever = ToyLever(kSamples, 18);
  ReplayBlock block = ToyBlock(lever, ToyMeasured(lever, kNoise, 18), {0, 2, 3});
  std::vector<double> wave(kSamples, 0.0);
  for (std::size_t k = 0; k < kSamples; ++k) {
    const double t_s = 0.01 * static_cast<double>(k);
    if (std::abs(lever[k]) >= 0.02) wave[k] = 0.01 * std::sin(7.3 * t_s + 2 * std::sin(t_s));
  }
  Channel other = block.channels[0];
  other.measured = ToyMeasured(wave, 0.0005, 19);
  other.nuisances.offset = 0.0002;
  block.channels.push_back(other);
  block.replay = WholeReplay([one = block.replay](const Structure& terms) {
    auto both = one(terms, kSamples);
    both.push_back(std::vector<double>(kSamples, 0.0));
    return both;
  });
  EXPECT_THAT(DiagnoseBlock(block, {}, Stream(18, "diagnose")).unexplained, IsEmpty());
  block.channels[1].unit = "m";
  EXPECT_EQ(DiagnoseBlock(block, {}, Stream(18, "diagnose")).unexplained.size(), 1u);
}

TEST(BlockDiagnosis, LeavesFinalOutOfEverythingThatChooses) {
  // The same recording with a mechanism that sets in only at FINAL. Nothing but the results on
  // FINAL may differ.
  const std::vector<double> lever = ToyLever(kSamples, 19);
  ReplayBlock block = ToyBlock(lever, ToyMeasured(lever, kNoise, 19), {0, 2, 3});
  const BlockDiagnosis before = DiagnoseBlock(block, {}, Stream(19, "diagnose"));
  const Mask final = MaskOf(before.manoeuvres, Part::kFinal, kSamples);
  Series& measured = block.channels[0].measured;
  for (std::size_t k = 0; k < kSamples; ++k) {
    if (final[k] && measured.valid[k]) measured.value[k] += 0.5 * lever[k] * lever[k];
  }
  const BlockDiagnosis after = DiagnoseBlock(block, {}, Stream(19, "diagnose"));
  EXPECT_EQ(before.noise[0].ar, after.noise[0].ar);
  ASSERT_EQ(before.search.singles.size(), after.search.singles.size());
  for (std::size_t s = 0; s < before.search.singles.size(); ++s) {
    // Except for the first samples of a manoeuvre, whitened by those before it, and for the end of
    // a fit.
    EXPECT_NEAR(before.search.singles[s].values[0], after.search.singles[s].values[0], 3e-3);
    EXPECT_NEAR(before.search.singles[s].held_out_gain, after.search.singles[s].held_out_gain, 0.1);
  }
  EXPECT_NEAR(before.residual_verdicts[0].noise.differences,
              after.residual_verdicts[0].noise.differences, 1e-6);
  EXPECT_GT(after.residual_verdicts[0].rmse, 2 * before.residual_verdicts[0].rmse);
}

TEST(BlockDiagnosis, IsTheSameWithOneThreadAndTwo) {
  const std::vector<double> lever = ToyLever(kSamples, 17);
  const ReplayBlock block =
      ToyBlock(lever, ToyMeasured(ToyResponse(lever, 0.2, 0, 0.1), kNoise, 17), {0, 2, 3});
  const auto one = DiagnoseBlock(block, {.threads = 1}, Stream(17, "diagnose"));
  const auto two = DiagnoseBlock(block, {.threads = 2}, Stream(17, "diagnose"));
  ASSERT_EQ(NamesOf(one.findings), NamesOf(two.findings));
  for (std::size_t f = 0; f < one.findings.size(); ++f) {
    EXPECT_EQ(one.findings[f].term.values, two.findings[f].term.values);
  }
}

}  // namespace
}  // namespace tera
