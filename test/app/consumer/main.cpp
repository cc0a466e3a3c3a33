#include <cstdio>

#include "core/config/config.h"
#include "sim/scenario/scenario.h"
#include "sim/simulation.h"

// A rover without a driver stays in place.
int main() {
  const tera::Config config = tera::Config::FromFile(SCENARIO);
  const tera::Scenario scenario = tera::ReadScenario(config.root());
  config.Finish();
  tera::Simulation simulation(scenario);
  for (int step = 0; step < 50; ++step) simulation.Step();
  const tera::Vec3 p_WB = simulation.state().machines.at(0).links.at(0).X_WB.translation();
  std::printf("%.3f %.3f %.3f\n", p_WB.x(), p_WB.y(), p_WB.z());
  return p_WB.norm() < 0.05 ? 0 : 1;
}
