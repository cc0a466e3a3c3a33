#include "diagnose/report/text/words.h"

#include <gtest/gtest.h>

namespace tera {
namespace {

TEST(Wording, PosesTurnAndStandInPlaces) {
  EXPECT_EQ(QuantityOf("warthog/poses/rz"), "turn of the poses about z");
  EXPECT_EQ(QuantityOf("warthog/poses/x"), "place of the poses along x");
}

TEST(Wording, GivesAsManyDigitsAsANumberIsKnownTo) {
  EXPECT_EQ(WithSigma(0.1812, 0.0213), "0.18 ± 0.02");
  EXPECT_EQ(WithSigma(52345, 870), "52300 ± 900");
  EXPECT_EQ(WithSigma(1.2345, 0.0149), "1.235 ± 0.015");
  EXPECT_EQ(WithSigma(-0.00123, 0.00098), "-0.0012 ± 0.0010");
  EXPECT_EQ(WithSigma(20.04, {}), "20");
  EXPECT_EQ(Significant(0.0996, 2), "0.1");
  EXPECT_EQ(Significant(3.14159, 2), "3.1");
  EXPECT_EQ(Significant(0, 2), "0");
  EXPECT_EQ(Significant(1.234e-7, 2), "1.2e-07");
  EXPECT_EQ(ProbabilityText(1e-9), "p < 0.0001");
}

TEST(Wording, RoundsHalvesAsAReaderDoes) {
  const double delay_s = 0.12 - 0.005;  // a double below 0.115
  EXPECT_EQ(WithSigma(delay_s, 0.021), "0.12 ± 0.02");
  EXPECT_EQ(WithSigma(-delay_s, 0.021), "-0.12 ± 0.02");
  EXPECT_EQ(Significant(0.145, 2), "0.15");
  EXPECT_EQ(Significant(1.005, 3), "1.01");
  EXPECT_EQ(Significant(0.11499999, 2), "0.11");
}

TEST(Wording, CallsAVariableByWhoseItIs) {
  ReplayBlock boom;
  boom.name = "boom";
  boom.channels.emplace_back();
  boom.channels[0].unit = "rad/s";
  EXPECT_EQ(VariableText("lever/boom", boom), "lever");
  EXPECT_EQ(VariableText("lever_way/boom", boom), "lever way");
  EXPECT_EQ(VariableText("lever/left_track", boom), "left track lever");
  EXPECT_EQ(VariableText("position/boom", boom), "angle");
  EXPECT_EQ(VariableText("yaw_rate", boom), "yaw rate");
}

}  // namespace
}  // namespace tera
