#include "diagnose/search/structure/prefix_search.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnose/search/block/block_diagnosis.h"
#include "diagnose/search/toy_block.h"

namespace tera {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

constexpr std::size_t kFourMinutes = 24000;
constexpr double kPrefixSearchNoise = 0.05;

/// Manoeuvres of equal length, every second one at rest.
std::vector<Manoeuvre> MovingHalfTheTime(std::size_t count, std::size_t length) {
  std::vector<Manoeuvre> manoeuvres;
  for (std::size_t m = 0; m < count; ++m) {
    manoeuvres.push_back({{m * length, (m + 1) * length}, m % 2});
  }
  return manoeuvres;
}

TEST(Prefix, EndsWithTheManoeuvreThatCompletesAMinuteOfMotion) {
  // 5 s each: the 12th moving manoeuvre is the 24th of all.
  EXPECT_EQ(PrefixLength(MovingHalfTheTime(100, 500), 0.01), 24 * 500u);
}

TEST(Prefix, IsAllWhereItWouldSpareLittleOrTooLittleMoves) {
  EXPECT_EQ(PrefixLength(MovingHalfTheTime(34, 500), 0.01), 34 * 500u);
  EXPECT_EQ(PrefixLength(MovingHalfTheTime(100, 50), 0.01), 100 * 50u);
}

TEST(Prefix, IsTheSameBlockForAShorterTime) {
  const std::vector<double> lever = ToyLever(3000, 5);
  const ReplayBlock block = ToyBlock(lever, ToyMeasured(lever, kPrefixSearchNoise, 5), {0, 3});
  const ReplayBlock prefix = PrefixOf(block, 1000);
  EXPECT_EQ(prefix.samples(), 1000u);
  EXPECT_EQ(prefix.commands[0].size(), 1000u);
  EXPECT_EQ(prefix.channels[0].variables[1].series.size(), 1000u);
  EXPECT_EQ(prefix.channels[0].flexible_regressor.rows(), 1000);
  const Structure terms = {{&block.candidates[1], {0.3}}};
  std::vector<double> whole = block.predict(terms)[0];
  whole.resize(1000);
  EXPECT_THAT(prefix.predict(terms), ElementsAre(whole));
}

// The square acts throughout, the step after two minutes of four.
TEST(Prefix, DoesNotHideWhatActsLater) {
  const std::vector<double> lever = ToyLever(kFourMinutes, 21);
  std::vector<double> clean = ToyResponse(lever, 0.2, 0, 0);
  const std::vector<double> later = ToyResponse(lever, 0.2, 0.15, 0);
  for (std::size_t k = kFourMinutes / 2; k < kFourMinutes; ++k) clean[k] = later[k];
  ReplayBlock block = ToyBlock(lever, ToyMeasured(clean, kPrefixSearchNoise, 21), {0, 3});
  // A candidate that acts from then on.
  block.candidates.push_back({&ToyMechanisms()[2], "toy", {{0, -2, 2}}, {{0.1}, {-0.1}}});
  const Replay always = block.replay;
  block.replay = WholeReplay([always](const Structure& terms) {
    std::vector<std::vector<double>> predicted = always(terms, kFourMinutes);
    Structure before = terms;
    std::erase_if(before, [](const Term& term) { return term.candidate->mechanism->id == "step"; });
    const std::vector<double> early = always(before, kFourMinutes)[0];
    std::copy_n(early.begin(), kFourMinutes / 2, predicted[0].begin());
    return predicted;
  });
  ASSERT_LT(PrefixLength(ManoeuvresOf(block, Stream(21, "diagnose")), 0.01), kFourMinutes / 2);
  const BlockDiagnosis diagnosis = DiagnoseBlock(block, {}, Stream(21, "diagnose"));
  EXPECT_THAT(NamesOf(diagnosis.findings), UnorderedElementsAre("square", "step"));
  for (const Finding& finding : diagnosis.findings) {
    const bool is_step = finding.term.candidate->mechanism->id == "step";
    EXPECT_NEAR(finding.parameters[0].value, is_step ? 0.15 : 0.2, 0.02);
  }
}

// The whole recording determines a parameter that the prefix does not: `late` acts only in the last
// two minutes.
TEST(Prefix, NumbersThatItDoesNotDetermineAreFreeAgain) {
  static const Mechanism kBoth{
      "both", Slot::kLeverMap, {}, {{"size", "1", -2, 2, 0.0}, {"late", "1", -2, 2, 0.0}}};
  const std::vector<double> lever = ToyLever(kFourMinutes, 23);
  const auto response = [&](double size, double late) {
    std::vector<double> y = ToyResponse(lever, size, 0, 0);
    const std::vector<double> more = ToyResponse(lever, size, late, 0);
    std::copy(more.begin() + kFourMinutes / 2, more.end(), y.begin() + kFourMinutes / 2);
    return y;
  };
  ReplayBlock block = ToyBlock(lever, ToyMeasured(response(0.2, 0.1), kPrefixSearchNoise, 23), {});
  block.candidates = {{&kBoth, "toy", {{0, -2, 2}, {1, -2, 2}}, {{0.1, 0.01}, {-0.1, 0.01}}, {}}};
  block.replay = WholeReplay([&](const Structure& terms) {
    return std::vector<std::vector<double>>{
        terms.empty() ? lever : response(terms[0].values[0], terms[0].values[1])};
  });
  const BlockDiagnosis diagnosis = DiagnoseBlock(block, {}, Stream(23, "diagnose"));
  ASSERT_EQ(diagnosis.findings.size(), 1u);
  EXPECT_THAT(diagnosis.findings[0].term.held, IsEmpty());
  EXPECT_NEAR(diagnosis.findings[0].parameters[1].value, 0.1, 0.01);
}

// Candidates of the prefix's search and of its extension are the block's own: all pointers are into
// its list.
TEST(Prefix, NamesTheBlocksOwnCandidates) {
  const std::vector<double> lever = ToyLever(kFourMinutes, 22);
  const ReplayBlock block = ToyBlock(
      lever, ToyMeasured(ToyResponse(lever, 0.2, 0, 0), kPrefixSearchNoise, 22), {0, 1, 2, 3});
  const BlockDiagnosis diagnosis = DiagnoseBlock(block, {}, Stream(22, "diagnose"));
  const auto is_own = [&](const Candidate* candidate) {
    return candidate >= block.candidates.data() &&
           candidate < block.candidates.data() + block.candidates.size();
  };
  ASSERT_EQ(diagnosis.findings.size(), 1u);
  const TermEvidence& evidence = diagnosis.findings[0].evidence;
  ASSERT_EQ(evidence.rivals.size(), 2u);  // `twin` equals `square`
  EXPECT_FALSE(evidence.rejected.empty());
  for (const Candidate* rival : evidence.rivals) EXPECT_TRUE(is_own(rival));
  for (const Rival& rival : evidence.rejected) EXPECT_TRUE(is_own(rival.candidate));
  for (const SingleEvidence& single : diagnosis.search.singles)
    EXPECT_TRUE(is_own(single.candidate));
}

}  // namespace
}  // namespace tera
