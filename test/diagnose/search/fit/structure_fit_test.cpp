#include "diagnose/search/fit/structure_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "diagnose/search/toy_block.h"

namespace tera {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr std::size_t kStructureFitSamples = 4000;

/// A square of the lever with three parameters: size, position, and one without effect.
const Mechanism kSquare = {
    "square",
    Slot::kLeverMap,
    {},
    {{"size", "1", -2, 2, {}}, {"place", "1", -1, 1, 0.0}, {"idle_deg", "deg", -180, 180, 5.0}}};

struct Fixture {
  explicit Fixture(double size)
      : lever(ToyLever(kStructureFitSamples, 3)),
        block(ToyBlock(lever, ToyMeasured(Response(size, 0.1), 0.05, 3), {})),
        likelihood(block, {{.scale = 0.05, .dof = 4}}, Mask(kStructureFitSamples, 1)),
        fitter(block, likelihood, {{0, kStructureFitSamples}}) {
    candidate = {&kSquare,
                 "toy",
                 {{0, -2, 2}, {1, -1, 1}, {2, -180, 180}},
                 {{0.1, 0, 40}, {0.3, 0, -170}},
                 {}};
    block.replay = WholeReplay([this](const Structure& terms) {
      return std::vector<std::vector<double>>{
          terms.empty() ? lever : Response(terms[0].values[0], terms[0].values[1])};
    });
  }
  FittedStructure Fit(const Structure& terms) const {
    return fitter.Determine(fitter.FitValues(terms));
  }
  std::vector<double> Response(double size, double place) const {
    std::vector<double> y;
    for (const double u : lever) y.push_back(u + size * (u - place) * (u - place));
    return y;
  }

  std::vector<double> lever;
  ReplayBlock block;
  Candidate candidate;
  Likelihood likelihood;
  StructureFitter fitter;
};

TEST(StructureFit, ANumberThatTheMeasurementsSayNothingOfStandsAtItsDefault) {
  const Fixture toy(0.4);
  const FittedStructure fitted = toy.Fit({{&toy.candidate, {0.1, 0, 40}}});
  EXPECT_NEAR(fitted.terms[0].values[0], 0.4, 0.03);
  EXPECT_NEAR(fitted.terms[0].values[1], 0.1, 0.03);
  EXPECT_EQ(fitted.terms[0].values[2], 5);
  EXPECT_THAT(fitted.terms[0].held, ElementsAre(2));
  EXPECT_EQ(fitted.information.rows(), 2);
}

TEST(StructureFit, OrWhereTheModelHasIt) {
  Fixture toy(0.4);
  toy.candidate.present = {0.2, 0, 33};
  const FittedStructure fitted = toy.Fit({{&toy.candidate, {0.1, 0, 40}}});
  EXPECT_EQ(fitted.terms[0].values[2], 33);
}

TEST(StructureFit, NumbersThatAreDeterminedAreFree) {
  Fixture toy(0.4);
  toy.candidate.free.pop_back();
  const FittedStructure fitted = toy.Fit({{&toy.candidate, {0.1, 0, 40}}});
  EXPECT_THAT(fitted.terms[0].held, IsEmpty());
  EXPECT_EQ(fitted.information.rows(), 2);
}

TEST(StructureFit, ANumberThatActsInStairsIsFreeIfItIsSaidToHaveKinks) {
  Fixture toy(0.4);
  toy.candidate.free.pop_back();
  toy.block.replay = WholeReplay([&toy](const Structure& terms) {
    if (terms.empty()) return std::vector<std::vector<double>>{toy.lever};
    const double stair = 0.04 * std::round(terms[0].values[1] / 0.04);
    return std::vector<std::vector<double>>{toy.Response(terms[0].values[0], stair)};
  });
  const FittedStructure stuck = toy.Fit({{&toy.candidate, {0.1, 0, 40}}});
  EXPECT_THAT(stuck.terms[0].held, ElementsAre(1));
  toy.candidate.free[1].kink = 0.06;
  const FittedStructure free = toy.Fit({{&toy.candidate, {0.1, 0, 40}}});
  EXPECT_THAT(free.terms[0].held, IsEmpty());
  EXPECT_NEAR(free.terms[0].values[1], 0.1, 0.04);
}

TEST(StructureFit, ANumberThatMovesInstantsIsFoundFromAfar) {
  // A pulse every 2 s, delayed by half the position, as behind play.
  Fixture toy(0);
  const auto pulses = [](double place) {
    std::vector<double> y;
    for (std::size_t k = 0; k < kStructureFitSamples; ++k) {
      const double since_s = std::fmod(0.01 * static_cast<double>(k), 2.0);
      y.push_back(since_s > 0.5 + 0.5 * place && since_s < 1.5 ? 1 : 0);
    }
    return y;
  };
  toy.block.channels[0].measured = ToyMeasured(pulses(0.3), 0.05, 3);
  toy.block.replay = WholeReplay([&](const Structure& terms) {
    return std::vector<std::vector<double>>{pulses(terms.empty() ? 0 : terms[0].values[1])};
  });
  const Likelihood likelihood(toy.block, {{.scale = 0.05, .dof = 4}},
                              Mask(kStructureFitSamples, 1));
  const StructureFitter fitter(toy.block, likelihood, {{0, kStructureFitSamples}});
  toy.candidate.free = {{1, -1, 1}};
  toy.candidate.starts = {{0.1, -0.2, 40}};
  EXPECT_LT(fitter.FitFrom({{&toy.candidate, {0.1, -0.2, 40}}}).terms[0].values[1], 0);
  toy.candidate.free[0].kink = 0.06;
  EXPECT_NEAR(fitter.FitFrom({{&toy.candidate, {0.1, -0.2, 40}}}).terms[0].values[1], 0.3, 0.02);
}

TEST(StructureFit, AnInstantBetweenTwoStepsOfAReplayIsNoPlaceToEnd) {
  // An effect between two steps of the replay, 0.05 apart, is smeared over both.
  Fixture toy(0);
  const auto smeared = [&](double place) {
    const double between = 20 * place - std::floor(20 * place);
    std::vector<double> y;
    for (const double u : toy.lever) y.push_back(u + place * u + between * (1 - between) * u * u);
    return y;
  };
  toy.block.channels[0].measured = ToyMeasured(smeared(0.3), 0.05, 3);
  toy.block.replay = WholeReplay([&](const Structure& terms) {
    return std::vector<std::vector<double>>{smeared(terms.empty() ? 0 : terms[0].values[1])};
  });
  const Likelihood likelihood(toy.block, {{.scale = 0.05, .dof = 4}},
                              Mask(kStructureFitSamples, 1));
  const StructureFitter fitter(toy.block, likelihood, {{0, kStructureFitSamples}});
  toy.candidate.free = {{1, -1, 1}};
  const Structure start = {{&toy.candidate, {0.1, 0.252, 40}}};
  EXPECT_LT(fitter.FitFrom(start).terms[0].values[1], 0.27);
  toy.candidate.free[0].kink = 0.025;
  EXPECT_NEAR(fitter.FitFrom(start).terms[0].values[1], 0.3, 0.01);
}

}  // namespace
}  // namespace tera
