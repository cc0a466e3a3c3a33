#include "physics/actuation/pump_flow.h"

#include <gtest/gtest.h>

#include <cmath>

#include "physics/actuation/slot_fixture.h"

namespace tera {
namespace {

PumpFlow PumpFrom(const std::string& yaml, double pump_flow_m3ps = 2e-3) {
  return PumpFlow(PumpFlowOf(EffectsFrom(yaml, EffectTarget::kPump), pump_flow_m3ps));
}

TEST(PumpFlow, WithoutEffectsDeliversAll) { EXPECT_EQ(PumpFrom("{}").Step(1e3, 1e9, 0.002), 1); }

TEST(PumpFlow, DeliversNoMoreThanItsFlow) {
  // 2 l/s between consumers with a demand of 3 l/s: two thirds to each; all if they demand less.
  PumpFlow pump = PumpFrom("flow_sharing: {}");
  EXPECT_NEAR(pump.Step(3e-3, 0, 0.002), 2.0 / 3, 1e-12);
  EXPECT_EQ(pump.Step(1.9e-3, 0, 0.002), 1);
  EXPECT_NEAR(PumpFrom("flow_sharing: {capacity: 0.5}").Step(3e-3, 0, 0.002), 1.0 / 3, 1e-12);
}

TEST(PumpFlow, DeliversNoMoreThanItsPowerOnceItsRegulatorHasMoved) {
  PumpFlow pump = PumpFrom("power_limit: {power_w: 20000, regulator_s: 0.2}");
  // 50 kW asked: seen as 50 (1 - e^(-t / 0.2)) kW, which passes 20 kW at 0.2 ln(5/3) = 0.1022 s.
  double limited_s = 0, share = 1;
  for (int i = 1; i <= 1000; ++i) {
    share = pump.Step(0, 50000, 0.002);
    if (share < 1 && limited_s == 0) limited_s = i * 0.002;
  }
  EXPECT_NEAR(limited_s, 0.1022, 0.002);
  EXPECT_NEAR(share, 0.4, 1e-4);
  EXPECT_NEAR(PumpFrom("power_limit: {power_w: 20000, regulator_s: 0}").Step(0, 50000, 0.002), 0.4,
              1e-12);
}

TEST(PumpFlow, TheSmallerOfBothLimitsHolds) {
  PumpFlow pump = PumpFrom("{flow_sharing: {}, power_limit: {power_w: 20000, regulator_s: 0}}");
  EXPECT_NEAR(pump.Step(4e-3, 25000, 0.002), 0.5, 1e-12);
  EXPECT_NEAR(pump.Step(2.1e-3, 80000, 0.002), 0.25, 1e-12);
}

}  // namespace
}  // namespace tera
