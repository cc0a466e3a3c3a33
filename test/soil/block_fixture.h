#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "soil_fixture.h"

/// A block on two tracks, 4 t, for tests of running gear.

namespace tera::testing_soil {

inline constexpr double kMass_kg = 4000, kLength_m = 1.6, kWidth_m = 0.3, kGauge_m = 1.2;
inline constexpr int kPatches = 8;

/// Dry sand of Wong 2008, table 2.3, as a site 12 m x 4 m.
inline constexpr char kDrySand[] =
    "size_m: [12, 4]\n"
    "soil: dry_sand\n"
    "custom_soils: [{preset: tera:config/soils/sand.yaml, name: dry_sand, k_c_npm_n1: 990,\n"
    "                k_phi_npm_n2: 1528430, sinkage_exponent: 1.1, shear_cohesion_pa: 1040,\n"
    "                shear_friction_deg: 28, shear_modulus_m: 0.025}]\n";

/// A block on two flat tracks that moves along x and z only, turned by `yaw_rad` with its path.
struct Block {
  struct Tracks {
    double nose_m = 0, wheel_pitch_m = 0, grouser_m = 0, grouser_pitch_m = 0;
    int patches = kPatches;
  };
  double mass_kg = kMass_kg;
  std::unique_ptr<Soil> soil;
  int machine = 0;
  std::vector<BodyState> links = std::vector<BodyState>(1);
  GroundToolsMotion motion;
  SoilReaction reaction;

  Block(const std::string& site, const Vec2& start_m, double yaw_rad = 0)
      : Block(site, start_m, yaw_rad, Tracks{}) {}
  Block(const std::string& site, const Vec2& start_m, double yaw_rad, const Tracks& tracks)
      : Block(MakeGround(site), start_m, yaw_rad, tracks) {}
  Block(std::unique_ptr<Soil> ground, const Vec2& start_m, double yaw_rad = 0)
      : Block(std::move(ground), start_m, yaw_rad, Tracks{}) {}
  Block(std::unique_ptr<Soil> ground, const Vec2& start_m, double yaw_rad, const Tracks& tracks)
      : soil(std::move(ground)) {
    GroundTools tools;
    for (const double y_m : {kGauge_m / 2, -kGauge_m / 2}) {
      RunningGear gear = tracks.nose_m > 0
                             ? NosedTrack(y_m, kLength_m, kWidth_m, tracks.patches, tracks.nose_m)
                             : FlatTrack(y_m, kLength_m, kWidth_m, tracks.patches);
      if (tracks.wheel_pitch_m > 0) PutRoadWheels(tracks.wheel_pitch_m, &gear);
      gear.grouser_m = tracks.grouser_m;
      gear.grouser_pitch_m = tracks.grouser_pitch_m;
      tools.gears.push_back(gear);
    }
    machine = soil->AddMachine(tools);
    links[0].X_WB = MakePose(Vec3(start_m.x(), start_m.y(), 0.001), 0, 0, yaw_rad);
    motion.links = &links;
    motion.gear_rate_radps = {0, 0};
  }
  Vec3 Act() {
    reaction = soil->Act(machine, motion, kStep_s);
    soil->Flow(kStep_s);
    return reaction.link_wrench[0].force_W_n;
  }
  /// Moves under the ground's reaction and its weight.
  void Move() {
    const Vec3 force_n = Act() - Vec3(0, 0, mass_kg * kStandardGravity_mps2);
    links[0].v_WB_mps += kStep_s / mass_kg * Vec3(force_n.x(), 0, force_n.z());
    links[0].X_WB.translation() += kStep_s * links[0].v_WB_mps;
  }
  /// Sinks at a speed in proportion to the missing support, without overshoot.
  Vec3 ActAndSinkGently() {
    const Vec3 force_n = ActAndFall();
    links[0].X_WB.translation() += kStep_s * links[0].v_WB_mps;
    return force_n;
  }
  /// The same without the step itself.
  Vec3 ActAndFall() {
    const double weight_n = mass_kg * kStandardGravity_mps2;
    const Vec3 force_n = Act();
    links[0].v_WB_mps.z() = -0.1 * (1 - force_n.z() / weight_n);  // 10 cm/s when falling
    return force_n;
  }
  void Stand(int steps = 1000) {
    for (int k = 0; k < steps; ++k) ActAndSinkGently();
  }
  /// Drives along x over `distance_m`; each(force_n) for each step.
  template <typename Each>
  void Drive(double distance_m, double speed_mps, double slip, Each each) {
    const double shoe_mps = speed_mps / (1 - slip);
    motion.gear_rate_radps = {shoe_mps / 0.25, shoe_mps / 0.25};
    for (int k = 0; k < std::lround(distance_m / std::abs(speed_mps) / kStep_s); ++k) {
      const Vec3 force_n = Act();
      links[0].v_WB_mps.x() = speed_mps;
      links[0].v_WB_mps.z() += kStep_s * (force_n.z() / mass_kg - kStandardGravity_mps2);
      links[0].X_WB.translation() += kStep_s * links[0].v_WB_mps;
      each(force_n);
    }
    links[0].v_WB_mps.setZero();
    motion.gear_rate_radps = {0, 0};
  }
  double Rut_m(double x_m) const { return -soil->surface().HeightAt(x_m, kGauge_m / 2); }
};

}  // namespace tera::testing_soil
