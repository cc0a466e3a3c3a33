#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "blind/mujoco/plant/arbitration.h"
#include "blind/mujoco/plant/pilot_line.h"
#include "blind/mujoco/plant/radio.h"

namespace tera::blind::mujoco {
namespace {

TEST(Arbitration, AMessageWaitsForItsSlotAndForThoseThatOthersWin) {
  Arbitration bus(0.007, 0.25, Stream(1, "bus"), 3);
  constexpr int kMessages = 20000;
  double waits_s = 0, last_s = -1;
  for (int k = 0; k < kMessages; ++k) {
    const double t_s = 0.02 * k, slot_s = bus.SlotOf(static_cast<std::uint64_t>(k), t_s);
    EXPECT_NEAR(std::remainder(slot_s, 0.007), 0, 1e-9);
    EXPECT_GE(slot_s, t_s - 1e-9);
    EXPECT_GT(slot_s, last_s + 0.0069);
    waits_s += slot_s - t_s;
    last_s = slot_s;
  }
  // The phase is uniform from 0 to 6 ms, plus a geometric number of slots, 0.25 / 0.75 on average,
  // of deviation sqrt(0.25) / 0.75: five standard errors are 0.17 ms. A message that loses three
  // slots or more, one in 64, delays those behind it by about a slot: 0.1 ms.
  const double expected_s = 0.003 + 0.007 * 0.25 / 0.75;
  EXPECT_NEAR(waits_s / kMessages, expected_s + 0.0001, 0.0002);
}

TEST(Radio, FadesAsOftenAndAsLongAsRayleighs) {
  constexpr double kDoppler_hz = 1.2, kStep_s = 0.004, kEach_s = 200;
  const double lost = 0.2, power = -std::log(1 - lost);
  double mean = 0, below_s = 0;
  int fades = 0;
  for (int n = 0; n < 6; ++n) {
    const Radio radio(kDoppler_hz, Stream(2, "radio " + std::to_string(n)), 0);
    bool was_lost = false;
    for (int k = 0; k < kEach_s / kStep_s; ++k) {
      mean += radio.PowerAt(k * kStep_s) * kStep_s / (6 * kEach_s);
      const bool is_lost = radio.Loses(k * kStep_s, lost);
      below_s += is_lost ? kStep_s : 0;
      fades += is_lost && !was_lost ? 1 : 0;
      was_lost = is_lost;
    }
  }
  // Some 1400 fades: one standard error is 3 %, and as much again for 32 paths being few.
  EXPECT_NEAR(mean, 1, 0.08);
  EXPECT_NEAR(below_s / (6 * kEach_s), lost, 0.15 * lost);
  const double lasts_s =
      (std::exp(power) - 1) / (kDoppler_hz * std::sqrt(2 * M_PI * power));  // Rappaport, 5.84
  EXPECT_NEAR(below_s / fades, lasts_s, 0.15 * lasts_s);
}

TEST(PilotLine, IsLateByElmoresTimeAndEndsAsItsSlowestMode) {
  constexpr double kElmore_s = 0.3, kStep_s = 0.001;
  PilotLine line(kElmore_s);
  double area_s = 0;
  std::vector<double> missing;
  for (int k = 0; k < 3000; ++k) {
    missing.push_back(1 - line.After(kStep_s, 1));
    area_s += kStep_s * missing.back();
  }
  EXPECT_NEAR(area_s, kElmore_s, 0.002);
  // Five sections of R C = 0.3 s / 15 each, the last one closed.
  const double slowest_s = 0.02 / (2 - 2 * std::cos(M_PI / 11));
  EXPECT_NEAR(missing[999] / missing[499], std::exp(-0.5 / slowest_s), 0.005);
  EXPECT_GT(missing[20], 0.99);  // zero at first, where a single filter gave 7 %
}

}  // namespace
}  // namespace tera::blind::mujoco
