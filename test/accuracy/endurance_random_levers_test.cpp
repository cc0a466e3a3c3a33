#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "accuracy/long_shift.h"
#include "accuracy/machine_outline.h"
#include "accuracy/unopened_ground.h"
#include "core/config/config.h"
#include "core/units.h"
#include "kinetic_energy.h"
#include "sim/simulation.h"

// All levers at random on three soils, for a long time. In the environment, TERA_ENDURANCE_S sets
// its length in simulated seconds, TERA_ENDURANCE_SEEDS how many seeds there are and
// TERA_ENDURANCE_FIRST_SEED where they begin.

namespace tera {
namespace {

constexpr double kUsual_s = 30;
constexpr int kUsualSeeds = 2;

constexpr double kUpright_rad = 45 * kDeg, kLying_rad = 60 * kDeg;
constexpr double kLongestLying_s = 10;  ///< then it is reset
constexpr double kLongestTurn_s = 600;  ///< on one soil, upright or not

constexpr int kSoils = 3;
/// Starts of the scenario's soils, slightly beyond the borders between them.
constexpr std::array<double, kSoils> kStart_x_m = {-5, 0, 5};

/// Deflection of stiff springs, without passing through the ground.
constexpr double kUndercarriage_m = 0.1;
/// Depth of tools. Bucket and arm enter the walls of the edge's own cut, where slew and tracks
/// press them. Only two points of the arm collide with the ground.
constexpr double kTools_m = 0.4;

/// Levers that continue where the previous simulation ended.
class Onward : public Operator {
 public:
  Onward(Operator* levers, TimeNs before_ns) : levers_(levers), before_ns_(before_ns) {}
  std::vector<double> Levers(const OperatorView& view) override {
    return levers_->Levers({before_ns_ + view.t_ns, view.model, view.state, view.ground});
  }

 private:
  Operator* levers_;
  TimeNs before_ns_;
};

/// Depth of a part in unopened ground, and its time.
struct Deepest {
  double depth_m = 0, at_s = 0;
};

/// Result of random levers over some time.
struct Shaken {
  double until_s = 0;  ///< to here all was finite
  int turns = 0;       ///< number of resets
  double upright_s = 0;
  std::array<double, kSoils> on_s = {};  ///< upright, both tracks wholly on the soil
  double most_j = 0, fall_j = 0;
  double steepest_rad = 0;
  std::map<std::string, Deepest> deepest;  ///< by part
  double shifted_kg = 0;
  double lost = 0;  ///< of the displaced soil, the worst of all turns
  double wall_s = 0;
};

Scenario ReadTurn(int seed, bool hydraulic, int soil) {
  const auto config_folder = DataRoot() / "config";
  std::vector<Config::Overlay> overlays;
  if (hydraulic) overlays.push_back({config_folder / "effects/tb235_hydraulic.yaml", "effects"});
  const Config config =
      Config::FromFile(config_folder / "scenarios/random_levers.yaml",
                       {fmt::format("seed={}", seed), "machines[0].rig={sensors: []}",
                        fmt::format("machines[0].start.xy_m=[{}, 0]", kStart_x_m[soil])},
                       overlays);
  Scenario scenario = ReadScenario(config.root());
  config.Finish();
  return scenario;
}

/// Successive machines on fresh ground. The next one starts when the last has lain for long, or has
/// used its share of the time. The same stream of levers continues through all of them.
class Shake {
 public:
  Shake(int seed, double length_s)
      : seed_(seed), length_s_(length_s), turn_s_(std::min(kLongestTurn_s, length_s / kSoils)) {}

  bool hydraulic() const { return seed_ % 2 == 0; }

  Shaken Run() {
    int soil = (seed_ - 1) % kSoils;
    while (shaken_.until_s < length_s_ - 1e-6) {
      if (!Turn(soil)) break;
      soil = (soil + 1) % kSoils;
    }
    return shaken_;
  }

 private:
  /// False if something became infinite.
  bool Turn(int soil) {
    const Scenario scenario = ReadTurn(seed_, hydraulic(), soil);
    if (!levers_) levers_ = std::move(OperatorsOf(scenario)[0]);
    const double before_s = shaken_.until_s;
    Operators operators;
    operators.push_back(std::make_unique<Onward>(levers_.get(), FromSeconds(before_s)));
    Simulation simulation(scenario, std::move(operators));
    const MachineModel& model = scenario.machines[0].placement.model;
    const std::vector<PartOutline> outlines = OutlinesOf(model);
    UnopenedGround unopened(simulation.ground());
    shaken_.fall_j = model.TotalMass_kg() * kStandardGravity_mps2 * 1.0;  // from a metre
    ++shaken_.turns;
    const double step_s = 1 / scenario.physics_rate_hz;
    double lying_s = 0;
    const auto steps =
        std::llround(std::min(turn_s_, length_s_ - before_s) * scenario.physics_rate_hz);
    for (std::int64_t step = 0; step < steps && lying_s < kLongestLying_s; ++step) {
      simulation.Step();
      const MachineState& machine = simulation.state().machines[0];
      if (!IsFinite(machine)) return false;
      shaken_.until_s = before_s + ToSeconds(simulation.state().t_ns);
      shaken_.most_j = std::max(shaken_.most_j, KineticEnergy_j(model, machine));
      const double tilt_rad = Tilt_rad(machine);
      shaken_.steepest_rad = std::max(shaken_.steepest_rad, tilt_rad);
      lying_s = tilt_rad > kLying_rad ? lying_s + step_s : 0;
      constexpr int kStepsPerLook = 10;
      if (step % kStepsPerLook != 0) continue;
      unopened.Follow(simulation.ground());
      if (tilt_rad < kUpright_rad) Stand(kStepsPerLook * step_s, model, machine, unopened);
      Look(outlines, machine, unopened);
    }
    const MassLedger ledger = simulation.state().ground().ledger();
    shaken_.shifted_kg += ledger.shifted_kg;
    if (ledger.shifted_kg > 0) {
      shaken_.lost = std::max(shaken_.lost, std::abs(ledger.total_kg() / ledger.shifted_kg));
    }
    shaken_.wall_s += simulation.physics_wall_s() + simulation.soil_wall_s();
    return true;
  }

  void Stand(double time_s, const MachineModel& model, const MachineState& machine,
             const UnopenedGround& unopened) {
    shaken_.upright_s += time_s;
    int soil = -1;
    for (const RunningGear& gear : model.ground_tools.gears) {
      for (const ContactPatch& patch : gear.patches) {
        const Vec3 p_W_m = machine.links[gear.link].X_WB * patch.p_B_m;
        const int under = unopened.SoilAt(p_W_m.x(), p_W_m.y());
        if (soil >= 0 && under != soil) return;
        soil = under;
      }
    }
    shaken_.on_s[soil] += time_s;
  }

  void Look(const std::vector<PartOutline>& outlines, const MachineState& machine,
            const UnopenedGround& unopened) {
    for (const PartOutline& outline : outlines) {
      Deepest& deepest = shaken_.deepest[outline.part];
      for (const Vec3& p_B_m : outline.points_B_m) {
        const double depth_m = unopened.DepthOf_m(machine.links[outline.link].X_WB * p_B_m);
        if (depth_m > deepest.depth_m) deepest = {depth_m, shaken_.until_s};
      }
    }
  }

  int seed_;
  double length_s_, turn_s_;
  std::unique_ptr<Operator> levers_;
  Shaken shaken_;
};

void Print(int seed, bool hydraulic, const Shaken& shaken) {
  fmt::print(
      "seed {}{}, {:.0f} s in {} turns: upright {:.0f} s, of it on dirt {:.0f}, on gravel "
      "{:.0f}, on sand {:.0f} s\n"
      "  kinetic energy up to {:.0f} J, tilt up to {:.0f} deg, {:.0f} kg of soil shifted and "
      "{:.1g} of it lost; {:.1f} x real time\n  in unopened ground:",
      seed, hydraulic ? " (hydraulic)" : "", shaken.until_s, shaken.turns, shaken.upright_s,
      shaken.on_s[0], shaken.on_s[1], shaken.on_s[2], shaken.most_j, shaken.steepest_rad / kDeg,
      shaken.shifted_kg, shaken.lost, shaken.until_s / shaken.wall_s);
  for (const auto& [part, deepest] : shaken.deepest) {
    fmt::print(" {} {:.3f} m (at {:.1f} s);", part, deepest.depth_m, deepest.at_s);
  }
  fmt::print("\n");
  std::fflush(stdout);
}

/// The excavator may dig itself in and tip over. Everything must stay finite and above ground, and
/// no faster than levers and a fall allow.
TEST(Endurance, RandomLeversOnThreeSoilsEndInNothingImpossible) {
  const int first = static_cast<int>(FromEnvironment("TERA_ENDURANCE_FIRST_SEED", 1));
  const int seeds = static_cast<int>(FromEnvironment("TERA_ENDURANCE_SEEDS", kUsualSeeds));
  const double length_s = FromEnvironment("TERA_ENDURANCE_S", kUsual_s);
  for (int seed = first; seed < first + seeds; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    Shake shake(seed, length_s);
    const Shaken shaken = shake.Run();
    Print(seed, shake.hydraulic(), shaken);
    EXPECT_NEAR(shaken.until_s, length_s, 1e-6) << "not finite after that";
    for (const double on_s : shaken.on_s) EXPECT_GT(on_s, 0);
    EXPECT_GT(shaken.upright_s, 0.5 * length_s);
    EXPECT_LT(shaken.most_j, shaken.fall_j);
    for (const auto& [part, deepest] : shaken.deepest) {
      const bool undercarriage = part == "undercarriage";
      EXPECT_LT(deepest.depth_m, undercarriage ? kUndercarriage_m : kTools_m) << part;
    }
    EXPECT_NEAR(shaken.lost, 0, 1e-9);
  }
}

}  // namespace
}  // namespace tera
