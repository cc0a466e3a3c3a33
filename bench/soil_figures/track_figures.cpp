#include <cmath>
#include <string>
#include <vector>

#include "soil/block_fixture.h"
#include "soil/track/hull_contact.h"
#include "soil/track/wheel_bench.h"
#include "soil_figures/figures.h"

namespace tera::bench {
namespace {

using namespace testing_soil;

/// Noses, road wheels and grousers as a compact excavator has them.
constexpr Block::Tracks kTracks{.nose_m = 0.25, .wheel_pitch_m = 0.4, .grouser_m = 0.025};

std::string SiteOf(const std::string& soil) { return "size_m: [12, 4]\nsoil: " + soil + "\n"; }

/// Driven at 1 m/s with a slip of 0.2, over the second half of 5 m: how deep it lies, and its pull
/// over its weight.
Figures Pull(const std::string& soil) {
  Block block(SiteOf(soil), Vec2(-3, 0.1), 0, kTracks);
  block.Stand();
  double pull_n = 0, depth_m = 0;
  int count = 0;
  constexpr int kSkipped = 1250;
  block.Drive(5, 1.0, 0.2, [&](const Vec3& force_n) {
    if (++count <= kSkipped) return;
    pull_n += force_n.x();
    depth_m -= block.links[0].X_WB.translation().z();
  });
  const double mean = 1.0 / (count - kSkipped);
  return {{"track_sinkage_" + soil + "_mm", 1e3 * mean * depth_m},
          {"track_pull_" + soil, mean * pull_n / (kMass_kg * kStandardGravity_mps2)}};
}

/// Speed lost to the shoes in free rolling on level sand.
Figure FreeSlip() {
  Block block(SiteOf("sand"), Vec2(-3.5, 0.1), 0, kTracks);
  for (int k = 0; k < 500; ++k) block.Move();
  block.motion.gear_rate_radps = {4, 4};
  block.links[0].v_WB_mps.x() = 1;
  for (int k = 0; k < 1500; ++k) block.Move();
  const double start_m = block.links[0].X_WB.translation().x();
  constexpr int kSteps = 1000;
  for (int k = 0; k < kSteps; ++k) block.Move();
  const double moved_m = block.links[0].X_WB.translation().x() - start_m;
  return {"track_free_slip_percent", 100 * (1 - moved_m / (kSteps * kStep_s))};
}

/// Moment against turning on the spot at 0.4 rad/s, shoes that roll as fast.
Figure Turning() {
  Block block("size_m: [8, 8]\nsoil: sand\n", Vec2(0.2, -0.1), 0.3, kTracks);
  block.Stand();
  const double rate_radps = 0.4, shoe_mps = rate_radps * kGauge_m / 2;
  block.motion.gear_rate_radps = {-shoe_mps / 0.25, shoe_mps / 0.25};
  block.links[0].w_WB_radps.z() = rate_radps;
  double sum_nm = 0;
  constexpr int kSteps = 2000;
  for (int k = 0; k < kSteps; ++k) {
    block.ActAndSinkGently();
    block.links[0].X_WB.linear() =
        RotationFromRpy(0, 0, rate_radps * kStep_s) * block.links[0].X_WB.linear();
    if (k >= kSteps / 2) sum_nm -= block.reaction.link_wrench[0].torque_W_nm.z();
  }
  return {"track_turning_nm", 2 * sum_nm / kSteps};
}

/// The rover's wheel of Ishigami et al. 2007 on regolith simulant.
Figures WheelFigures() {
  constexpr RigidWheel kWheel{.radius_m = 0.092, .width_m = 0.107, .load_n = 64.68};
  const std::string simulant =
      "soil: s\ncustom_soils: [{preset: tera:config/soils/sand.yaml, name: s, "
      "bank_density_kgpm3: 1600, k_c_npm_n1: 1370, k_phi_npm_n2: 814000, sinkage_exponent: 1, "
      "shear_cohesion_pa: 800, shear_friction_deg: 37.2, shear_modulus_m: 0.036}]\n";
  const WheelTest rolls = RunWheel(kWheel, simulant, 0), slips = RunWheel(kWheel, simulant, 0.3);
  const WheelTest aside = RunWheel(kWheel, simulant, 0, 15 * kDeg);
  return {{"wheel_sinkage_mm", 1e3 * rolls.sinkage_m},
          {"wheel_resistance", -rolls.drawbar_n / kWheel.load_n},
          {"wheel_slip_sinkage_mm", 1e3 * slips.sinkage_m},
          {"wheel_side_force", aside.side_n / kWheel.load_n}};
}

/// Structure of a machine of 3.5 t: how deep a tonne goes in that falls on one corner from 0.3 m,
/// and how far it slides on four from 1 m/s.
Figures HullFigures() {
  constexpr double kMachine_kg = 3500, kTonne_kg = 1000;
  const Columns ground = LevelColumns(Shipped("sand"), 0.1, 61);
  HullContact corner({0, Vec3::Zero()}, kMachine_kg);
  const auto fall = [&](int steps, BodyState* body) {
    double deepest_m = 0;
    for (int k = 0; k < steps; ++k) {
      const Vec3 force_W_n = corner.Act(*body, kStep_s, ground, LowObstacles()).force_W_n;
      body->v_WB_mps += kStep_s * (force_W_n / kTonne_kg - kStandardGravity_mps2 * Vec3::UnitZ());
      body->X_WB.translation() += kStep_s * body->v_WB_mps;
      deepest_m = std::max(deepest_m, -body->X_WB.translation().z());
    }
    return deepest_m;
  };
  BodyState body;
  body.v_WB_mps = Vec3(0, 0, -std::sqrt(2 * kStandardGravity_mps2 * 0.3));
  const double deepest_m = fall(1000, &body);
  body.v_WB_mps.x() = 1;
  const double start_m = body.X_WB.translation().x();
  fall(1000, &body);
  return {{"hull_depth_mm", 1e3 * deepest_m},
          {"hull_slide_mm", 1e3 * (body.X_WB.translation().x() - start_m)}};
}

}  // namespace

Figures TrackFigures() {
  Figures all = {FreeSlip(), Turning()};
  for (const Figures& some :
       {Pull("sand"), Pull("dirt"), Pull("loose_sand"), WheelFigures(), HullFigures()}) {
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

}  // namespace tera::bench
