#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>
#include <vector>

#include "core/config.h"
#include "core/units.h"
#include "sim/simulation.h"

// Long shifts: digging on the quickstart's site, and all levers at random on three soils. In the
// environment, TERA_ENDURANCE_S sets their length in simulated seconds, TERA_ENDURANCE_SEEDS how
// many random ones there are, TERA_ENDURANCE_FIRST_SEED where their seeds begin.

namespace tera {
namespace {

constexpr double kUsual_s = 120, kUsualRandom_s = 30;
constexpr int kUsualSeeds = 2;

double Length_s(double usual_s = kUsual_s) {
  const char* given = std::getenv("TERA_ENDURANCE_S");
  return given ? std::atof(given) : usual_s;
}

int Count(const char* name, int usual) {
  const char* given = std::getenv(name);
  return given ? std::atoi(given) : usual;
}

bool IsFinite(const MachineState& state) {
  for (const BodyState& link : state.links) {
    if (!link.X_WB.matrix().allFinite() || !link.v_WB_mps.allFinite() ||
        !link.w_WB_radps.allFinite() || !link.a_WB_mps2.allFinite()) {
      return false;
    }
  }
  return true;
}

/// Kinetic energy, which no digging machine has much of: its links never pass 4 m/s.
double KineticEnergy_j(const MachineModel& model, const MachineState& state) {
  double energy_j = 0;
  for (std::size_t i = 0; i < state.links.size(); ++i) {
    const Link& link = model.links[i];
    const BodyState& body = state.links[i];
    const Vec3 w_B_radps = body.X_WB.linear().transpose() * body.w_WB_radps;
    energy_j += 0.5 * link.mass_kg * PointVelocity(body, link.com_B_m).squaredNorm() +
                0.5 * w_B_radps.dot(link.inertia_B_kgm2 * w_B_radps);
  }
  return energy_j;
}

TEST(Endurance, DiggingGoesOnUprightFiniteAndWithAllItsSoil) {
  const Config config = Config::FromFile(DataRoot() / "config/scenarios/quickstart.yaml",
                                         {"machines[0].rig={sensors: []}"});
  Scenario scenario = ReadScenario(config.root());
  Simulation simulation(&scenario);
  const MachineModel& model = scenario.machines[0].placement.model;
  const Vec3 start_m = simulation.state().machines[0].links[0].X_WB.translation();
  const double links_at_4_mps_j = 0.5 * model.TotalMass_kg() * 4 * 4;

  double most_j = 0, steepest_rad = 0, heaviest_load_kg = 0;
  const auto steps = std::llround(Length_s() * scenario.physics_rate_hz);
  for (std::int64_t step = 0; step < steps; ++step) {
    simulation.Step();
    const MachineState& machine = simulation.state().machines[0];
    ASSERT_TRUE(IsFinite(machine)) << "at " << ToSeconds(simulation.state().t_ns) << " s";
    most_j = std::max(most_j, KineticEnergy_j(model, machine));
    steepest_rad =
        std::max(steepest_rad, std::acos(std::min(1.0, machine.links[0].X_WB.linear()(2, 2))));
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
      Length_s(), most_j, steepest_rad / kDeg, heaviest_load_kg, moved_m.x(), moved_m.y(),
      moved_m.z(), ledger.shifted_kg, -ledger.total_kg() / ledger.shifted_kg, ledger.outside_kg,
      simulation.physics_wall_s(), simulation.soil_wall_s());
  EXPECT_LT(most_j, links_at_4_mps_j);
  // In the course of an hour it digs away what it stands on, and may tip over.
  if (Length_s() <= kUsual_s) {
    EXPECT_LT(steepest_rad, 20 * kDeg);
  }
  EXPECT_GT(heaviest_load_kg, 10);  // it did dig
  EXPECT_NEAR(ledger.total_kg() / ledger.shifted_kg, 0, 1e-9);
}

/// The lowest that the ground has been so far, place by place: what lies deeper is in soil that no
/// tool has ever opened, however much soil has been heaped upon it.
class UnopenedGround {
 public:
  explicit UnopenedGround(const TerrainSurface& ground)
      : lowest_(ground), version_(ground.tile_count()) {}

  void Follow(const TerrainSurface& ground) {
    for (int b = 0; b < ground.tiles_y(); ++b) {
      for (int a = 0; a < ground.tiles_x(); ++a) {
        std::uint32_t& seen = version_[ground.tile_index(a, b)];
        if (std::exchange(seen, ground.tile_version(a, b)) == ground.tile_version(a, b)) continue;
        if (ground.IsRefined(a, b)) FollowTile(a, b, ground);
      }
    }
  }

  /// How far a point lies below the unopened ground within a stride of it.
  double DepthOf_m(const Vec3& p_W_m) const {
    constexpr double kStride_m = 0.2;
    double depth_m = lowest_.HeightAt(p_W_m.x(), p_W_m.y()) - p_W_m.z();
    for (int i = 0; depth_m > 0 && i < 8; ++i) {
      const double around_rad = i * kPi / 4;
      const Vec2 beside_m =
          p_W_m.head<2>() + kStride_m * Vec2(std::cos(around_rad), std::sin(around_rad));
      depth_m = std::min(depth_m, lowest_.HeightAt(beside_m.x(), beside_m.y()) - p_W_m.z());
    }
    return depth_m;
  }

 private:
  void FollowTile(int a, int b, const TerrainSurface& ground) {
    constexpr int kCells = TerrainGrid::kTileCells;
    for (int j = b * kCells; j <= std::min(ground.ny - 1, (b + 1) * kCells); ++j) {
      for (int i = a * kCells; i <= std::min(ground.nx - 1, (a + 1) * kCells); ++i) {
        if (ground.height_m(i, j) < lowest_.height_m(i, j)) lowest_.Set(i, j, ground.at(i, j));
      }
    }
  }

  TerrainSurface lowest_;
  std::vector<std::uint32_t> version_;
};

/// Points all over the undercarriage, which have a say also when the machine lies on its side: the
/// corners of the tracks' shoes below and, mirrored, above the sprockets' height, and those of the
/// boxes that are no track's. (A track's box is square where the track is round.)
std::vector<Vec3> UndercarriageOutline(const MachineModel& model) {
  std::vector<Vec3> outline;
  for (const RunningGear& gear : model.ground_tools.gears) {
    for (const ContactPatch& patch : gear.patches) {
      for (const double along : {-0.5, 0.5}) {
        for (const double across : {-0.5, 0.5}) {
          Vec3 p_B_m = patch.p_B_m + along * patch.length_m * patch.travel_B +
                       across * patch.width_m * Vec3::UnitY();
          outline.push_back(p_B_m);
          p_B_m.z() = 2 * gear.drive_radius_m - p_B_m.z();
          outline.push_back(p_B_m);
        }
      }
    }
  }
  for (const CollisionBox& box : model.links[0].collision) {
    if (box.X_BG.translation().y() != 0) continue;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 side(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
      outline.push_back(box.X_BG * (0.5 * box.size_m.cwiseProduct(side)));
    }
  }
  return outline;
}

/// What came of all levers at random for a while.
struct Shaken {
  double until_s = 0;  ///< to here all was finite
  double most_j = 0, fall_j = 0;
  double steepest_rad = 0;
  double deepest_m = 0, deepest_at_s = 0;
  double lost = 0;  ///< of the soil that was shifted
};

/// The excavator may dig itself in and tip over, but everything must stay finite, above ground, and
/// no faster than levers and a fall make it.
Shaken ShakeAtRandom(int seed, double length_s) {
  const Config config =
      Config::FromFile(DataRoot() / "config/scenarios/random_levers.yaml",
                       {fmt::format("seed={}", seed), "machines[0].rig={sensors: []}"});
  Scenario scenario = ReadScenario(config.root());
  Simulation simulation(&scenario);
  const MachineModel& model = scenario.machines[0].placement.model;
  const std::vector<Vec3> outline = UndercarriageOutline(model);
  UnopenedGround unopened(simulation.ground());
  Shaken shaken;
  // From a metre.
  shaken.fall_j = model.TotalMass_kg() * kStandardGravity_mps2 * 1.0;
  const auto steps = std::llround(length_s * scenario.physics_rate_hz);
  for (std::int64_t step = 0; step < steps; ++step) {
    simulation.Step();
    const MachineState& machine = simulation.state().machines[0];
    if (!IsFinite(machine)) return shaken;
    shaken.until_s = ToSeconds(simulation.state().t_ns);
    shaken.most_j = std::max(shaken.most_j, KineticEnergy_j(model, machine));
    const BodyState& undercarriage = machine.links[0];
    shaken.steepest_rad = std::max(
        shaken.steepest_rad, std::acos(std::clamp(undercarriage.X_WB.linear()(2, 2), -1., 1.)));
    constexpr int kStepsPerLook = 10;
    if (step % kStepsPerLook != 0) continue;
    unopened.Follow(simulation.ground());
    for (const Vec3& p_B_m : outline) {
      const double depth_m = unopened.DepthOf_m(undercarriage.X_WB * p_B_m);
      if (depth_m <= shaken.deepest_m) continue;
      shaken.deepest_m = depth_m;
      shaken.deepest_at_s = shaken.until_s;
    }
  }
  const MassLedger ledger = scenario.soil->ledger();
  shaken.lost = -ledger.total_kg() / ledger.shifted_kg;
  fmt::print(
      "seed {}, {:.0f} s: kinetic energy up to {:.0f} J, tilt up to {:.0f} deg, undercarriage "
      "up to {:.3f} m in unopened ground (at {:.1f} s), {:.0f} kg of soil shifted and {:.1g} of it "
      "lost; {:.1f} x real time\n",
      seed, length_s, shaken.most_j, shaken.steepest_rad / kDeg, shaken.deepest_m,
      shaken.deepest_at_s, ledger.shifted_kg, shaken.lost,
      length_s / (simulation.physics_wall_s() + simulation.soil_wall_s()));
  std::fflush(stdout);
  return shaken;
}

TEST(Endurance, RandomLeversOnThreeSoilsEndInNothingImpossible) {
  const int first = Count("TERA_ENDURANCE_FIRST_SEED", 1);
  const int seeds = Count("TERA_ENDURANCE_SEEDS", kUsualSeeds);
  const double length_s = Length_s(kUsualRandom_s);
  for (int seed = first; seed < first + seeds; ++seed) {
    const Shaken shaken = ShakeAtRandom(seed, length_s);
    EXPECT_NEAR(shaken.until_s, length_s, 1e-6) << "not finite after that, seed " << seed;
    EXPECT_LT(shaken.most_j, shaken.fall_j) << "seed " << seed;
    // A stiff spring's worth, not through the ground.
    EXPECT_LT(shaken.deepest_m, 0.1) << "seed " << seed;
    EXPECT_NEAR(shaken.lost, 0, 1e-9) << "seed " << seed;
  }
}

}  // namespace
}  // namespace tera
