#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "accuracy/long_shift.h"
#include "core/config/config.h"
#include "core/units.h"
#include "kinetic_energy.h"
#include "sim/simulation.h"

// A long shift of digging on the quickstart's site. TERA_ENDURANCE_S in the environment sets its
// length in simulated seconds.

namespace tera {
namespace {

constexpr double kUsual_s = 120;

TEST(Endurance, DiggingGoesOnUprightFiniteAndWithAllItsSoil) {
  const Config config = Config::FromFile(DataRoot() / "config/scenarios/quickstart.yaml",
                                         {"machines[0].rig={sensors: []}"});
  Scenario scenario = ReadScenario(config.root());
  Simulation simulation(&scenario);
  const MachineModel& model = scenario.machines[0].placement.model;
  const Vec3 start_m = simulation.state().machines[0].links[0].X_WB.translation();
  const double links_at_4_mps_j = 0.5 * model.TotalMass_kg() * 4 * 4;

  const double length_s = FromEnvironment("TERA_ENDURANCE_S", kUsual_s);
  double most_j = 0, steepest_rad = 0, heaviest_load_kg = 0;
  const auto steps = std::llround(length_s * scenario.physics_rate_hz);
  for (std::int64_t step = 0; step < steps; ++step) {
    simulation.Step();
    const MachineState& machine = simulation.state().machines[0];
    ASSERT_TRUE(IsFinite(machine)) << "at " << ToSeconds(simulation.state().t_ns) << " s";
    most_j = std::max(most_j, KineticEnergy_j(model, machine));
    steepest_rad = std::max(steepest_rad, Tilt_rad(machine));
    constexpr int kStepsPerWeighing = 50;  // the ledger sums up all columns
    if (step % kStepsPerWeighing != 0) continue;
    heaviest_load_kg = std::max(heaviest_load_kg, scenario.soil->ledger().carried_kg);
  }
  const MassLedger ledger = scenario.soil->ledger();
  const Vec3 moved_m = simulation.state().machines[0].links[0].X_WB.translation() - start_m;
  fmt::print(
      "{:.0f} s: kinetic energy up to {:.0f} J, tilt up to {:.1f} deg, load up to {:.0f} kg\n"
      "machine moved by ({:.2f}, {:.2f}, {:.2f}) m; soil shifted {:.6g} kg, lost {:.3g} of it; "
      "outside {:.3g} kg\n"
      "physics {:.1f} s, soil {:.1f} s of wall clock\n",
      length_s, most_j, steepest_rad / kDeg, heaviest_load_kg, moved_m.x(), moved_m.y(),
      moved_m.z(), ledger.shifted_kg, -ledger.total_kg() / ledger.shifted_kg, ledger.outside_kg,
      simulation.physics_wall_s(), simulation.soil_wall_s());
  EXPECT_LT(most_j, links_at_4_mps_j);
  // In the course of an hour it digs away what it stands on, and may tip over.
  if (length_s <= kUsual_s) {
    EXPECT_LT(steepest_rad, 20 * kDeg);
  }
  EXPECT_GT(heaviest_load_kg, 10);  // it did dig
  EXPECT_NEAR(ledger.total_kg() / ledger.shifted_kg, 0, 1e-9);
}

}  // namespace
}  // namespace tera
