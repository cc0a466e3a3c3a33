#include "diagnose/search/block_diagnosis.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnose/search/toy_block.h"

namespace tera {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

constexpr std::size_t kSamples = 8000;
constexpr double kNoise = 0.05;

std::vector<std::string> NamesOf(const std::vector<Finding>& findings) {
  std::vector<std::string> names;
  for (const Finding& finding : findings) names.emplace_back(finding.term.suspect->mechanism->id);
  return names;
}

const Finding& FindingOf(const BlockDiagnosis& diagnosis, std::string_view id) {
  for (const Finding& finding : diagnosis.findings) {
    if (finding.term.suspect->mechanism->id == id) return finding;
  }
  throw std::runtime_error("not found: " + std::string(id));
}

struct Toy {
  Toy(std::uint64_t seed, double square, double step, double lag_s,
      std::vector<std::size_t> suspects = {0, 2, 3})
      : lever(ToyLever(kSamples, seed)),
        block(ToyBlock(lever, ToyMeasured(ToyResponse(lever, square, step, lag_s), kNoise, seed),
                       suspects)),
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
  EXPECT_GT(found.confidence, 0.9);
  EXPECT_GT(found.held_out.excess_removed, 0.9);
  EXPECT_LT(found.held_out.rmse_after, found.held_out.rmse_before);
  ASSERT_FALSE(found.location.regimes.empty());
  EXPECT_EQ(found.location.regimes[0].variable, "lever");
  EXPECT_EQ(found.location.regimes[0].shape.parity, CurveParity::kEven);
}

TEST(BlockDiagnosis, NamesTwoThatActTogether) {
  const Toy toy(13, 0.25, 0, 0.12);
  ASSERT_THAT(NamesOf(toy.diagnosis.findings), UnorderedElementsAre("square", "lag"));
  EXPECT_NEAR(FindingOf(toy.diagnosis, "lag").parameters[0].value, 0.12, 0.02);
  EXPECT_NEAR(FindingOf(toy.diagnosis, "square").parameters[0].value, 0.25, 0.03);
}

TEST(BlockDiagnosis, AnswersWithAClassWhereTwoSuspectsDoTheSame) {
  const Toy toy(14, 0.3, 0, 0, {0, 1, 2, 3});
  ASSERT_EQ(toy.diagnosis.findings.size(), 1u);
  std::vector<std::string> alike;
  for (const Suspect* rival : toy.diagnosis.findings[0].evidence.rivals) {
    alike.emplace_back(rival->mechanism->id);
  }
  EXPECT_THAT(alike, UnorderedElementsAre("square", "twin"));
  EXPECT_LE(toy.diagnosis.findings[0].confidence, 0.5);
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

TEST(BlockDiagnosis, SaysWhatALeverAtRestCannotShow) {
  const std::vector<double> lever(kSamples, 0.0);
  const ReplayBlock block = ToyBlock(lever, ToyMeasured(lever, kNoise, 16), {0, 2, 3});
  const BlockDiagnosis diagnosis = DiagnoseBlock(block, {}, Stream(16, "diagnose"));
  for (const Detectability& suspect : diagnosis.detectability) {
    EXPECT_FALSE(suspect.smallest.has_value()) << suspect.suspect->mechanism->id;
  }
  EXPECT_THAT(diagnosis.findings, IsEmpty());
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
