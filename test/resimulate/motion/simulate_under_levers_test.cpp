#include "resimulate/motion/simulate_under_levers.h"

#include <gtest/gtest.h>

#include "core/config/config.h"
#include "core/units.h"

namespace tera {
namespace {

constexpr std::size_t kElbow = 1;

/// Two arms on the same site; an operator turns the first one's elbow.
Scenario TwoArms() {
  const Config config = Config::FromText(R"(
name: arms
duration_s: 10
terrain: {size_m: [12, 12], cell_m: 0.5, soil: asphalt}
machines:
  - name: left
    machine: tera:config/machines/fixed_arm.yaml
    start: {xy_m: [-2, 1], yaw_deg: 70}
    operator: {type: random_levers}
  - name: right
    machine: tera:config/machines/fixed_arm.yaml
    start: {xy_m: [2, 1], yaw_deg: -20}
    operator: {type: idle}
)",
                                         "arms.yaml");
  Scenario scenario = ReadScenario(config.root());
  config.Finish();
  return scenario;
}

/// Nothing until 6 s of the recording, then the elbow's lever at `elbow`.
TableRecording LeversFrom6s(double elbow) {
  return {.columns = {"horn", "elbow"},
          .t_ns = {FromSeconds(4), FromSeconds(6)},
          .rows = {{1, 0}, {1, elbow}}};
}

double ElbowRate_radps(const SimulatedCourse& course, double t_s) {
  return course.RateAt(FromSeconds(t_s), kElbow);
}

TEST(SimulateUnderLevers, TheMachineThatIsAskedForObeysThemAtTheRecordingsOwnTime) {
  const SimulatedCourse course =
      SimulateUnderLevers(TwoArms(), 1, LeversFrom6s(0.5), {FromSeconds(5), 2});
  EXPECT_EQ(course.zero_ns, FromSeconds(5));
  EXPECT_EQ(course.end_ns(), FromSeconds(7));
  EXPECT_NEAR(ElbowRate_radps(course, 5.9), 0, 1e-3);
  EXPECT_NEAR(ElbowRate_radps(course, 6.8), 30 * kDeg, 1 * kDeg);  // half of its 60 deg/s
  EXPECT_LT((course.PoseAt(FromSeconds(6)).translation() - Vec3(2, 1, 0)).norm(), 1e-6);
}

TEST(SimulateUnderLevers, TheOtherMachineObeysItsOwnOperator) {
  const SimulatedCourse left = SimulateUnderLevers(TwoArms(), 0, LeversFrom6s(0), {0, 3});
  for (const double t_s : {0.5, 1.5, 2.9}) EXPECT_NEAR(ElbowRate_radps(left, t_s), 0, 1e-3);
  EXPECT_LT((left.PoseAt(0).translation() - Vec3(-2, 1, 0)).norm(), 1e-6);
}

TEST(SimulateUnderLevers, BeyondFullLeverIsFullLever) {
  const SimulatedCourse beyond =
      SimulateUnderLevers(TwoArms(), 1, LeversFrom6s(-3), {FromSeconds(5.5), 1});
  EXPECT_NEAR(ElbowRate_radps(beyond, 6.4), -60 * kDeg, 2 * kDeg);
}

}  // namespace
}  // namespace tera
