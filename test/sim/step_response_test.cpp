#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/config/config.h"
#include "core/units.h"
#include "sim/simulation.h"

namespace tera {
namespace {

// Eq. (1) of the TERA paper for a lever of 60 %, eta = 20 rad/s, beta = 6 1/s, phi = 0, on the
// shipped excavator with its own cylinders, reliefs and masses. Before 0.1 s the equation requires
// a jump.
TEST(StepResponse, OfTheShippedExcavatorIsThePapersToOnePercent) {
  const Config config = Config::FromFile(DataRoot() / "config/scenarios/step_60.yaml",
                                         {"machines[0].rig={sensors: []}"});
  Scenario scenario = ReadScenario(config.root());
  config.Finish();
  Simulation simulation(scenario);
  const MachineModel& model = scenario.machines[0].placement.model;
  struct Step {
    std::string joint;
    double at_s, full_degps;  // rates as its file has them
  };
  for (const Step& step : {Step{"arm", 1, 43.3}, Step{"boom", 4, 25.8}, Step{"bucket", 7, 43.3}}) {
    const auto joint = static_cast<std::size_t>(model.JointIndex(step.joint));
    const double steady_radps = 0.6 * step.full_degps * kDeg;
    double most_radps = 0, worst_radps = 0;
    while (ToSeconds(simulation.state().t_ns) < step.at_s + 1.4) {
      simulation.Step();
      const double t_s = ToSeconds(simulation.state().t_ns) - step.at_s;
      const double rate_radps = simulation.state().machines[0].qd_radps[joint];
      most_radps = std::max(most_radps, rate_radps);
      if (t_s < 0.1) continue;
      const double law_radps = steady_radps * (1 + std::sin(20 * t_s) * std::exp(-6 * t_s));
      worst_radps = std::max(worst_radps, std::abs(rate_radps - law_radps));
    }
    EXPECT_LT(worst_radps, 0.01 * steady_radps) << step.joint;
    EXPECT_NEAR(most_radps, 1.65 * steady_radps, 0.03 * steady_radps) << step.joint;  // at 0.064 s
  }
}

}  // namespace
}  // namespace tera
