#include "diagnose/input_checks.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

/// 40 s at 50 Hz: a lever that goes to and fro at 0.6 Hz, measured late.
ReplayBlock ToAndFro(double late_s) {
  constexpr double kPeriod_s = 0.02;
  std::vector<double> expected, measured;
  for (int k = 0; k < 2000; ++k) {
    const auto rate = [](double t_s) { return std::sin(2 * kPi * 0.6 * t_s); };
    expected.push_back(rate(k * kPeriod_s));
    measured.push_back(rate(std::max(0.0, k * kPeriod_s - late_s)));
  }
  ReplayBlock block;
  block.channels = {
      {"m/encoders/boom_radps", "rad/s", MakeSeries(kPeriod_s, measured), {}, {}, {}}};
  block.replay = WholeReplay(
      [expected](const Structure&) { return std::vector<std::vector<double>>{expected}; });
  return block;
}

TEST(InputChecks, ARateThatIsHalfAStrokeLateDoesNotGoAgainstItsLever) {
  EXPECT_NO_THROW(CheckUnitsOf({"real", "m"}, {ToAndFro(0)}));
  // Half a stroke late it goes the other way at once, and follows 0.83 s later.
  EXPECT_NO_THROW(CheckUnitsOf({"real", "m"}, {ToAndFro(0.83)}));
}

}  // namespace
}  // namespace tera
