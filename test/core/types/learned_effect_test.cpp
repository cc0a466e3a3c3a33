#include "core/types/learned_effect.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/config/config.h"
#include "core/error.h"

namespace tera {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::vector<LearnedVariable> kVariables = {
    {"lever/boom", "1", LearnedVariable::Kind::kLever, 1},
    {"position/boom", "rad", LearnedVariable::Kind::kPosition, 1}};

/// "learned" of one target, with other lines in place of its own.
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

std::string FaultsOf(const std::string& yaml) {
  try {
    Read(yaml);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
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
              HasSubstr("learned.high: missing"));
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
      HasSubstr("learned.variable: 'temperature' is no variable that a simulation knows "
                "here, need one of lever/boom, position/boom"));
  EXPECT_THAT(FaultsOf(Table("[-1, 0, 2]", "[0.5, 0, 1]", "unit: rad, as: added")),
              HasSubstr("learned.variable: missing"));
}

TEST(LearnedEffect, InAnotherUnitThanItsVariableIsRefused) {
  EXPECT_THAT(
      FaultsOf(Table("[-1, 0, 2]", "[0.5, 0, 1]", "variable: position/boom, unit: deg, as: added")),
      HasSubstr("learned.unit: 'deg' found, but position/boom is in rad; need that, and the knots "
                "in it"));
}

TEST(LearnedEffect, IsAddedOrAShareAndNothingElse) {
  EXPECT_THAT(
      FaultsOf(Table("[-1, 0, 2]", "[0.5, 0, 1]", "variable: position/boom, unit: rad, as: gain")),
      HasSubstr("learned.as: "));
}

TEST(LearnedEffect, NeedsKnotsThatIncrease) {
  EXPECT_THAT(FaultsOf(Table("[-1, -1, 2]")),
              HasSubstr("learned.at: -1 follows -1, need knots that increase from each to the "
                        "next"));
  EXPECT_THAT(FaultsOf(Table("[-1, 3, 2]")), HasSubstr("learned.at: 2 follows 3"));
}

TEST(LearnedEffect, NeedsANumberForEachKnotInEveryList) {
  EXPECT_THAT(FaultsOf(Table("[-1, 0, 2]", "[0.5, 0]")),
              HasSubstr("learned.value: 2 numbers found, but 'at' has 3 knots; need one for each"));
  EXPECT_THAT(
      FaultsOf(Table("[-1, 0, 2]", "[0.5, 0, 1]", "variable: position/boom, unit: rad, as: added",
                     "low: [0, -1, 0], high: [1, 1, 2, 3]")),
      HasSubstr("learned.high: 4 numbers found"));
  EXPECT_THAT(FaultsOf(Table("[1]", "[0.5]")), HasSubstr("learned.at: "));
}

TEST(LearnedEffect, NeedsFiniteNumbersAndSharesThatDoNotTurnARateBack) {
  EXPECT_THAT(FaultsOf(Table("[-1, 0, .inf]")), HasSubstr("learned.at"));
  EXPECT_THAT(FaultsOf(Table("[-1, 0, 2]", "[0.5, .nan, 1]")), HasSubstr("learned.value"));
  EXPECT_THAT(FaultsOf(Table("[-1, 0, 2]", "[-1.2, 0, 1]",
                             "variable: position/boom, unit: rad, as: share")),
              HasSubstr("-1.2 is out of range, need -1 to 9"));
  EXPECT_EQ(
      FaultsOf(Table("[-1, 0, 2]", "[-1, 0, 1]", "variable: position/boom, unit: rad, as: share",
                     "low: [-1.4, -1, 0], high: [1, 1, 2]")),
      "");
}

TEST(LearnedEffect, LiesWithinItsBand) {
  EXPECT_THAT(FaultsOf(Table("[-1, 0, 2]", "[0.5, 0, 3]")),
              HasSubstr("learned.value: 3 at 2 is not within its band from 0 to 2, need low <= "
                        "value <= high at every knot"));
}

TEST(LearnedEffect, ThatIsNoTableIsRefusedAsSuch) {
  EXPECT_THAT(FaultsOf("learned: 3\n"),
              HasSubstr("need a table, {variable: NAME, unit: UNIT, as: added or share"));
}

}  // namespace
}  // namespace tera
