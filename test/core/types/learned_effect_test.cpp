#include "core/types/learned_effect.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/config/config.h"
#include "core/faults.h"

namespace tera {
namespace {

using enum FaultKind;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

const std::vector<LearnedVariable> kVariables = {
    {"lever/boom", "1", LearnedVariable::Kind::kLever, 1},
    {"position/boom", "rad", LearnedVariable::Kind::kPosition, 1}};

/// "learned" of one target, with other lines instead of the usual ones.
std::string Table(const std::string& at = "[-1, 0, 2]", const std::string& value = "[0.5, 0, 1]",
                  const std::string& head = "variable: position/boom, unit: rad, as: added",
                  const std::string& band = "low: [0, -1, 0], high: [1, 1, 2]") {
  return "learned: {" + head + ", at: " + at + ", value: " + value + ", " + band + "}\n";
}

std::optional<LearnedEffect> Read(const std::string& yaml) {
  const Config config = Config::FromText(yaml, "effects.yaml");
  auto learned = ReadLearnedEffect(config.root(), kVariables);
  config.Finish();
  return learned;
}

std::vector<InputFault> FaultsOf(const std::string& yaml) {
  return FaultsIn([&] { Read(yaml); });
}

TEST(LearnedEffect, IsStraightBetweenKnotsAndGoesToZeroWithinTheNextInterval) {
  const LearnedEffect learned{kVariables[1], false, {-1, 0, 2}, {0.5, 0, 1}, {}, {}};
  EXPECT_EQ(learned.At(-1), 0.5);
  EXPECT_EQ(learned.At(-0.25), 0.125);
  EXPECT_EQ(learned.At(0), 0);
  EXPECT_EQ(learned.At(0.5), 0.25);
  EXPECT_EQ(learned.At(2), 1);
  // The first interval is 1 long, the last one 2.
  EXPECT_EQ(learned.At(-1.5), 0.25);
  EXPECT_EQ(learned.At(-2), 0);
  EXPECT_EQ(learned.At(-50), 0);
  EXPECT_EQ(learned.At(3), 0.5);
  EXPECT_EQ(learned.At(4), 0);
  EXPECT_EQ(learned.At(1e9), 0);
}

TEST(LearnedEffect, IsReadAsItIsWritten) {
  const auto learned = Read(Table());
  ASSERT_TRUE(learned.has_value());
  EXPECT_EQ(learned->variable.name, "position/boom");
  EXPECT_EQ(learned->variable.kind, LearnedVariable::Kind::kPosition);
  EXPECT_EQ(learned->variable.axis, 1u);
  EXPECT_FALSE(learned->is_share);
  EXPECT_THAT(learned->at, ElementsAre(-1, 0, 2));
  EXPECT_THAT(learned->value, ElementsAre(0.5, 0, 1));
  EXPECT_THAT(learned->low, ElementsAre(0, -1, 0));
  EXPECT_THAT(learned->high, ElementsAre(1, 1, 2));
  EXPECT_FALSE(Read("{}").has_value());
}

TEST(LearnedEffect, WithoutABandIsItsOwnAndWithHalfOfOneIsRefused) {
  const std::string head = "variable: position/boom, unit: rad, as: added";
  const auto learned = Read("learned: {" + head + ", at: [0, 1], value: [0.5, 2]}\n");
  ASSERT_TRUE(learned.has_value());
  EXPECT_THAT(learned->low, ElementsAre(0.5, 2));
  EXPECT_THAT(learned->high, ElementsAre(0.5, 2));
  EXPECT_THAT(FaultsOf(Table("[-1, 0, 2]", "[0.5, 0, 1]", head, "low: [0, -1, 0]")),
              HasFault(kMissing, "learned.high"));
}

TEST(LearnedEffect, IsTheSameWhenTheResolvedDocumentIsReadAgain) {
  const Config config = Config::FromText(Table(), "effects.yaml");
  ReadLearnedEffect(config.root(), kVariables);
  config.Finish();
  const auto again = Read(config.ResolvedYaml());
  ASSERT_TRUE(again.has_value());
  EXPECT_EQ(again->variable.name, "position/boom");
  EXPECT_THAT(again->value, ElementsAre(0.5, 0, 1));
  EXPECT_THAT(again->high, ElementsAre(1, 1, 2));
}

TEST(LearnedEffect, OfAVariableThatNoSimulationKnowsIsRefusedWithThoseItKnows) {
  EXPECT_THAT(
      FaultsOf(Table("[-1, 0, 2]", "[0.5, 0, 1]", "variable: temperature, unit: C, as: added")),
      HasFault(kNoSuchName, "learned.variable"));
  EXPECT_THAT(FaultsOf(Table("[-1, 0, 2]", "[0.5, 0, 1]", "unit: rad, as: added")),
              HasFault(kMissing, "learned.variable"));
}

TEST(LearnedEffect, InAnotherUnitThanItsVariableIsRefused) {
  EXPECT_THAT(
      FaultsOf(Table("[-1, 0, 2]", "[0.5, 0, 1]", "variable: position/boom, unit: deg, as: added")),
      HasFault(kInconsistent, "learned.unit"));
}

TEST(LearnedEffect, IsAddedOrAShareAndNothingElse) {
  EXPECT_THAT(
      FaultsOf(Table("[-1, 0, 2]", "[0.5, 0, 1]", "variable: position/boom, unit: rad, as: gain")),
      HasFault(kNoSuchName, "learned.as"));
}

TEST(LearnedEffect, NeedsKnotsThatIncrease) {
  EXPECT_THAT(FaultsOf(Table("[-1, -1, 2]")), HasFault(kInconsistent, "learned.at"));
  EXPECT_THAT(FaultsOf(Table("[-1, 3, 2]")), HasFault(kInconsistent, "learned.at"));
}

TEST(LearnedEffect, NeedsANumberForEachKnotInEveryList) {
  EXPECT_THAT(FaultsOf(Table("[-1, 0, 2]", "[0.5, 0]")), HasFault(kInconsistent, "learned.value"));
  EXPECT_THAT(
      FaultsOf(Table("[-1, 0, 2]", "[0.5, 0, 1]", "variable: position/boom, unit: rad, as: added",
                     "low: [0, -1, 0], high: [1, 1, 2, 3]")),
      HasFault(kInconsistent, "learned.high"));
  EXPECT_THAT(FaultsOf(Table("[1]", "[0.5]")), HasFault(kMistyped, "learned.at"));
}

TEST(LearnedEffect, NeedsFiniteNumbersAndSharesThatDoNotTurnARateBack) {
  EXPECT_THAT(FaultsOf(Table("[-1, 0, .inf]")), HasFault(kMistyped, "learned.at[2]"));
  EXPECT_THAT(FaultsOf(Table("[-1, 0, 2]", "[0.5, .nan, 1]")),
              HasFault(kMistyped, "learned.value[1]"));
  EXPECT_THAT(FaultsOf(Table("[-1, 0, 2]", "[-1.2, 0, 1]",
                             "variable: position/boom, unit: rad, as: share")),
              HasFault(kOutOfRange, "learned.value[0]"));
  EXPECT_THAT(
      FaultsOf(Table("[-1, 0, 2]", "[-1, 0, 1]", "variable: position/boom, unit: rad, as: share",
                     "low: [-1.4, -1, 0], high: [1, 1, 2]")),
      IsEmpty());
}

TEST(LearnedEffect, LiesWithinItsBand) {
  EXPECT_THAT(FaultsOf(Table("[-1, 0, 2]", "[0.5, 0, 3]")),
              HasFault(kInconsistent, "learned.value"));
}

TEST(LearnedEffect, ThatIsNoTableIsRefusedAsSuch) {
  EXPECT_THAT(FaultsOf("learned: 3\n"), HasFault(kMistyped, "learned"));
}

}  // namespace
}  // namespace tera
