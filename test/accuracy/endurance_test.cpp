#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "accuracy/long_shift.h"
#include "core/config/config.h"
#include "core/units.h"
#include "kinetic_energy.h"
#include "sim/simulation.h"

// A long shift of digging on the quickstart's site, by a stationary operator. TERA_ENDURANCE_S in
// the environment sets its length in simulated seconds.

namespace tera {
namespace {

constexpr double kEnduranceUsual_s = 120;
/// A machine that works stands on both tracks: slopes and its own rocking tilt it by less.
constexpr double kStanding_rad = 20 * kDeg;
/// In a longer shift a cut sometimes gets stuck, and the boom lifts the machine on its bucket, as a
/// real excavator's can. A machine on its side would exceed this.
constexpr double kEnduranceLying_rad = 60 * kDeg;

/// Where the machine leant most.
struct Lean {
  double tilt_rad = 0, at_s = 0;
  double deep_m = 0;  ///< depth of the bucket's tip below the original ground
};

Vec3 BucketTip_W_m(const MachineModel& model, const MachineState& machine) {
  for (const NamedFrame& frame : model.frames) {
    if (frame.name == "bucket_tip") {
      return machine.links[frame.link].X_WB * frame.X_BF.translation();
    }
  }
  throw std::logic_error("the machine has no bucket_tip");
}

/// Largest sinkage of the ground below the patches of the running gear.
double Undermined_m(const MachineModel& model, const MachineState& machine,
                    const TerrainSurface& before, const TerrainSurface& now) {
  double most_m = 0;
  for (const RunningGear& gear : model.ground_tools.gears) {
    for (const ContactPatch& patch : gear.patches) {
      const Vec3 p_W_m = machine.links[gear.link].X_WB * patch.p_B_m;
      most_m = std::max(most_m,
                        before.HeightAt(p_W_m.x(), p_W_m.y()) - now.HeightAt(p_W_m.x(), p_W_m.y()));
    }
  }
  return most_m;
}

TEST(Endurance, DiggingGoesOnUprightFiniteAndWithAllItsSoil) {
  const Config config = Config::FromFile(DataRoot() / "config/scenarios/quickstart.yaml",
                                         {"machines[0].rig={sensors: []}"});
  Scenario scenario = ReadScenario(config.root());
  Simulation simulation(scenario);
  const MachineModel& model = scenario.machines[0].placement.model;
  const Vec3 start_m = simulation.state().machines[0].links[0].X_WB.translation();
  const TerrainSurface before = simulation.ground();
  const double links_at_4_mps_j = 0.5 * model.TotalMass_kg() * 4 * 4;

  const double length_s = FromEnvironment("TERA_ENDURANCE_S", kEnduranceUsual_s);
  Lean most;
  double most_j = 0, leaning_s = 0, heaviest_load_kg = 0, undermined_m = 0, furthest_m = 0;
  const auto steps = std::llround(length_s * scenario.physics_rate_hz);
  for (std::int64_t step = 0; step < steps; ++step) {
    simulation.Step();
    const MachineState& machine = simulation.state().machines[0];
    const double t_s = ToSeconds(simulation.state().t_ns);
    ASSERT_TRUE(IsFinite(machine)) << "at " << t_s << " s";
    most_j = std::max(most_j, KineticEnergy_j(model, machine));
    if (Tilt_rad(machine) > kStanding_rad) leaning_s += 1 / scenario.physics_rate_hz;
    if (Tilt_rad(machine) > most.tilt_rad) {
      const Vec3 tip_m = BucketTip_W_m(model, machine);
      most = {Tilt_rad(machine), t_s, before.HeightAt(tip_m.x(), tip_m.y()) - tip_m.z()};
    }
    constexpr int kStepsPerWeighing = 50;  // the ledger sums up all columns
    if (step % kStepsPerWeighing != 0) continue;
    heaviest_load_kg = std::max(heaviest_load_kg, simulation.state().ground().ledger().carried_kg);
    undermined_m =
        std::max(undermined_m, Undermined_m(model, machine, before, simulation.ground()));
    const Vec3 moved_m = machine.links[0].X_WB.translation() - start_m;
    furthest_m = std::max(furthest_m, moved_m.head<2>().norm());
  }
  const MassLedger ledger = simulation.state().ground().ledger();
  fmt::print(
      "{:.0f} s: kinetic energy up to {:.0f} J, load up to {:.0f} kg\n"
      "tilt up to {:.1f} deg, at {:.1f} s, on a bucket {:.2f} m deep in what was ground; beyond "
      "{:.0f} deg "
      "for {:.1f} s\n"
      "undercarriage up to {:.2f} m away, ground below it up to {:.2f} m lower\n"
      "soil shifted {:.6g} kg, lost {:.3g} of it; outside {:.3g} kg\n"
      "physics {:.1f} s, soil {:.1f} s of wall clock\n",
      length_s, most_j, heaviest_load_kg, most.tilt_rad / kDeg, most.at_s, most.deep_m,
      kStanding_rad / kDeg, leaning_s, furthest_m, undermined_m, ledger.shifted_kg,
      -ledger.total_kg() / ledger.shifted_kg, ledger.outside_kg, simulation.physics_wall_s(),
      simulation.soil_wall_s());
  EXPECT_LT(most_j, links_at_4_mps_j);
  EXPECT_LT(most.tilt_rad, length_s <= kEnduranceUsual_s ? kStanding_rad : kEnduranceLying_rad);
  EXPECT_LE(leaning_s, 0.1 * length_s);
  EXPECT_LT(furthest_m, 1.0);       // beyond it, the machine would be in its own pit
  EXPECT_LT(undermined_m, 0.5);     // as high as its tracks
  EXPECT_GT(heaviest_load_kg, 10);  // it did dig
  EXPECT_NEAR(ledger.total_kg() / ledger.shifted_kg, 0, 1e-9);
}

}  // namespace
}  // namespace tera
