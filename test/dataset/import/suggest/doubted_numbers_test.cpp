#include "dataset/import/suggest/doubted_numbers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"
#include "dataset/import/suggest/rate_guess.h"

namespace tera {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// A column of a sensor that advances by a twentieth of a turn per row, from `lowest` on.
NumbersOfColumn Slew(const std::string& name, double turn, double lowest = 0) {
  NumbersOfColumn column{.name = name};
  for (int k = 0; k < 60; ++k) {
    column.values.push_back(lowest + turn * std::fmod(0.83 + 0.05 * k, 1));
  }
  return column;
}

void ExpectTurn(const NumbersOfColumn& column, const std::string& unit, double scale) {
  const AngleGuess guess = GuessAngle(column);
  EXPECT_TRUE(guess.begins_anew) << column.name;
  EXPECT_EQ(guess.unit.unit, unit) << column.name;
  EXPECT_NEAR(guess.unit.scale, scale, 1e-12) << column.name;
}

TEST(DoubtedNumbers, AnAngleThatBeginsAnewTellsItsUnitByItsTurn) {
  ExpectTurn(Slew("slew", 360), "deg", 1);
  ExpectTurn(Slew("slew", 360, -180), "deg", 1);
  ExpectTurn(Slew("slew_deg", 360), "deg", 1);
  ExpectTurn(Slew("slew", 2 * kPi, -kPi), "rad", 1);
  ExpectTurn(Slew("slew_rad", 2 * kPi), "rad", 1);
  ExpectTurn(Slew("slew", 400), "deg", 0.9);
  ExpectTurn(Slew("slew", 1), "deg", 360);
  ExpectTurn(Slew("slew", 4096), "deg", 360.0 / 4096);
  ExpectTurn(Slew("slew", 36000), "deg", 0.01);
  EXPECT_EQ(GuessAngle(Slew("slew", 4096)).unit.doubt, "one turn is 4096");
}

TEST(DoubtedNumbers, AStepOfATurnAwayFromItsSensorsRangeOrAmongFewRowsIsNone) {
  EXPECT_FALSE(GuessAngle({.name = "arm", .values = {-60, -61}}).begins_anew);
  EXPECT_FALSE(GuessAngle({.name = "arm", .values = {0, 1, 1}}).begins_anew);
  EXPECT_FALSE(
      GuessAngle({.name = "arm", .values = {60, 60, 60, 60, 61, 61, 61, 61, 61}}).begins_anew);
}

TEST(DoubtedNumbers, AnAngleThatGoesOnKeepsItsGuess) {
  NumbersOfColumn boom{.name = "boom"};
  for (int k = 0; k < 60; ++k) boom.values.push_back(30 + 20 * std::sin(0.1 * k));
  const AngleGuess guess = GuessAngle(boom);
  EXPECT_FALSE(guess.begins_anew);
  EXPECT_EQ(guess.unit.unit, GuessAngleUnit({&boom}).unit);
}

TEST(DoubtedNumbers, AJointThatBeginsAnewIsMappedSoWithARemark) {
  const auto yaml = [](const NumbersOfColumn& column) {
    return JointYaml("slew", column.name, GuessAngle(column));
  };
  EXPECT_EQ(
      yaml(Slew("slew_deg", 360)),
      "      - {name: slew, angle: {column: slew_deg, unit: deg}, wrap_deg: 360}   # guessed: "
      "it wraps after a turn\n");
  EXPECT_THAT(yaml(Slew("slew", 400)),
              HasSubstr("unit: deg, scale: 0.9}, wrap_deg: 360}   # guessed: it wraps after a "
                        "turn; one turn is 400"));
}

/// Rows of a still, level unit, except for `az`, that turns about z.
struct Still {
  std::vector<TimeNs> t_ns;
  NumbersOfColumn zero{.name = "zero"}, wz, az;

  Still(double az_value, double wz_value = 0.1, const std::string& rate = "wz_radps")
      : wz{.name = rate}, az{.name = "az"} {
    for (int k = 0; k < 100; ++k) {
      t_ns.push_back(1'700'000'000 * kNsPerSecond + 20'000'000 * k);
      zero.values.push_back(0);
      wz.values.push_back(wz_value);
      az.values.push_back(az_value);
    }
  }
  /// The axis that moves first: its name gives the unit.
  std::string Remarks() const {
    const std::vector<const NumbersOfColumn*> rates = {&wz, &zero, &zero};
    const std::vector<const NumbersOfColumn*> forces = {&zero, &zero, &az};
    return InertialRemarks(t_ns, rates, GuessRateUnit(rates, {t_ns, forces}), forces,
                           GuessAccelerationUnit(forces));
  }
};

TEST(DoubtedNumbers, AnInertialUnitIsJudgedInTheUnitsThatAreGuessed) {
  EXPECT_THAT(Still(9.8).Remarks(), IsEmpty());
  EXPECT_THAT(Still(1).Remarks(), IsEmpty());
  EXPECT_THAT(Still(-1).Remarks(),
              HasSubstr("    # guessed: at rest az is -9.81 m/s2, about -g: does its z point down? "
                        "give it rpy_deg: [180, 0, 0]"));
  EXPECT_THAT(Still(9.8, 40).Remarks(), HasSubstr("are they in deg/s?"));
  EXPECT_THAT(Still(9.8, 40, "wz_dps").Remarks(), IsEmpty());
  EXPECT_THAT(Still(0.02).Remarks(), HasSubstr("was gravity subtracted"));
}

TEST(DoubtedNumbers, NothingIsSaidOfColumnsThatLackNumbers) {
  Still still(-9.8);
  still.az.values.pop_back();
  EXPECT_THAT(still.Remarks(), IsEmpty());
}

}  // namespace
}  // namespace tera
