#include "diagnose/tolerances/lever_interval.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tera {
namespace {

/// A lever at 0.5 for a second in every four, for twenty seconds.
double LeverAt(double t_s) { return std::fmod(t_s, 4) < 1 ? 0.5 : 0; }

TEST(LeverInterval, IsThatOfALoggerThatAsksAgainAndAgain) {
  TableRecording levers{.columns = {"boom"}};
  for (int k = 0; k < 200; ++k) {
    levers.t_ns.push_back(FromSeconds(0.1 * k + (k % 3 == 0 ? 0.004 : 0)));
    levers.rows.push_back({LeverAt(0.1 * k)});
  }
  EXPECT_NEAR(LeverInterval_s(levers), 0.1, 0.005);
}

TEST(LeverInterval, OfRowsThatComeWithChangesAloneIsNone) {
  TableRecording levers{.columns = {"boom"}};
  EXPECT_EQ(LeverInterval_s(levers), 0);
  for (int k = 0; k < 10; ++k) {
    const double t_s = 4 * (k / 2) + k % 2;
    levers.t_ns.push_back(FromSeconds(t_s));
    levers.rows.push_back({LeverAt(t_s)});
  }
  EXPECT_EQ(LeverInterval_s(levers), 0);
}

}  // namespace
}  // namespace tera
