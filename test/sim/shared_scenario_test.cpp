#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "work_fixture.h"

// Simulations that share a scenario do not affect each other: comparisons are exact.

namespace tera {
namespace {

constexpr int kSteps = 2500;  ///< until a bucket is filled and lifted

/// All motion, step by step, and the final ground.
struct Course {
  std::vector<double> motion;
  std::vector<float> heights_m;
  double carried_kg = 0, shifted_kg = 0;
  bool operator==(const Course&) const = default;
};

void Remember(const Simulation& simulation, Course* course) {
  const auto append = [&](const auto& values) {
    course->motion.insert(course->motion.end(), values.begin(), values.end());
  };
  for (const MachineState& machine : simulation.state().machines) {
    for (const BodyState& link : machine.links) {
      append(link.X_WB.matrix().reshaped());
      append(link.v_WB_mps);
    }
    append(machine.qd_radps);
    append(machine.gear_rate_radps);
    append(machine.levers);
  }
  for (const BodyState& obstacle : simulation.state().obstacles) {
    append(obstacle.X_WB.matrix().reshaped());
  }
  const MassLedger ledger = simulation.state().ground().ledger();
  course->carried_kg = ledger.carried_kg;
  course->shifted_kg = ledger.shifted_kg;
}

void Finish(const Simulation& simulation, Course* course) {
  course->heights_m = HeightsOf(simulation.ground());
}

Course CourseOf(const Scenario& scenario) {
  Course course;
  Simulation simulation(scenario);
  for (int k = 0; k < kSteps; ++k) {
    simulation.Step();
    if (k % 50 == 0) Remember(simulation, &course);
  }
  Finish(simulation, &course);
  return course;
}

TEST(SharedScenario, GivesTheSameRunAsOftenAsItIsRun) {
  const Scenario scenario = WorkScenario();
  const std::vector<float> site_m = HeightsOf(scenario.site->surface());
  const Course first = CourseOf(scenario);
  EXPECT_GT(first.carried_kg, 20);  // something was dug
  EXPECT_NE(first.heights_m, site_m);
  EXPECT_TRUE(CourseOf(scenario) == first);
  EXPECT_EQ(HeightsOf(scenario.site->surface()), site_m);
  EXPECT_TRUE(CourseOf(WorkScenario()) == first);  // of a newly read scenario
  EXPECT_FALSE(CourseOf(WorkScenario({"seed=12"})) == first);
}

TEST(SharedScenario, GivesTheSameRunsStepByStepInTurn) {
  const Scenario scenario = WorkScenario();
  Simulation a(scenario), b(scenario);
  Course of_a, of_b;
  for (int k = 0; k < kSteps; ++k) {
    a.Step();
    // The other simulation is alternately ahead and behind.
    const int steps = k % 100 < 50 ? 2 : 0;
    for (int s = 0; s < steps; ++s) b.Step();
    if (k % 100 == 99) {
      ASSERT_EQ(a.state().t_ns, b.state().t_ns);
      Remember(a, &of_a);
      Remember(b, &of_b);
    }
  }
  Finish(a, &of_a);
  Finish(b, &of_b);
  EXPECT_TRUE(of_a == of_b);
  Course alone;
  Simulation c(scenario);
  for (int k = 0; k < kSteps; ++k) {
    c.Step();
    if (k % 100 == 99) Remember(c, &alone);
  }
  Finish(c, &alone);
  EXPECT_TRUE(of_a == alone);
}

TEST(SharedScenario, GivesTheSameRunsOnTwoThreads) {
  const Scenario scenario = WorkScenario();
  Course of_a, of_b;
  std::thread a([&] { of_a = CourseOf(scenario); });
  std::thread b([&] { of_b = CourseOf(scenario); });
  a.join();
  b.join();
  EXPECT_TRUE(of_a == of_b);
  EXPECT_TRUE(of_a == CourseOf(scenario));
}

}  // namespace
}  // namespace tera
