#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "physics/actuation/actuation.h"
#include "physics/actuation/actuation_faults.h"
#include "physics/machine_fixture.h"
#include "physics/traction/ground_mechanisms.h"
#include "physics/traction/track_drive.h"

// Every mechanism, and every pair, with all numbers at the ends of their ranges: accepted ones give
// finite results, and a full lever moves the machine.

namespace tera {
namespace {

constexpr double kLittleLost_radps = 1e-3;

/// The mechanism at each corner of its ranges.
std::vector<Effect> CornersOf(const Mechanism& mechanism) {
  std::vector<Effect> corners = {{&mechanism, {}}};
  for (const EffectParameter& parameter : mechanism.parameters) {
    std::vector<Effect> longer;
    for (const Effect& corner : corners) {
      std::vector<double> values = {parameter.lower, parameter.upper};
      // At its lower end drive_friction has no effect, and the upper end is refused.
      if (parameter.name == "lost_radps") values.push_back(kLittleLost_radps);
      for (const double value : values) {
        longer.push_back(corner);
        longer.back().values.push_back(value);
      }
    }
    corners = std::move(longer);
  }
  return corners;
}

/// Each corner of each mechanism alone, and with each of every other mechanism.
std::vector<Effects> OnesAndTwos(std::span<const Mechanism> library) {
  std::vector<Effect> corners;
  for (const Mechanism& mechanism : library) {
    for (Effect& corner : CornersOf(mechanism)) corners.push_back(std::move(corner));
  }
  std::vector<Effects> all;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    all.push_back({corners[i]});
    for (std::size_t k = 0; k < i; ++k) {
      if (corners[k].mechanism != corners[i].mechanism) all.push_back({corners[i], corners[k]});
    }
  }
  return all;
}

std::string Text(const Effects& effects) {
  std::string text;
  for (const Effect& effect : effects) {
    text += fmt::format("{} {{{}}} ", effect.mechanism->id, fmt::join(effect.values, ", "));
  }
  return text;
}

/// Numbers that by themselves prevent any motion: a dead valve, a cut line.
bool StatesThatNothingMoves(const Effects& effects) {
  const Effect* gain = FindEffect(effects, "rate_gain");
  const Effect* drops = FindEffect(effects, "command_drops");
  return (gain && (*gain)["gain"] == 0) || (drops && (*drops)["probability"] == 1);
}

/// A joint on a pump, with effects of both.
MachineModel PumpedArm(const Effects& effects) {
  static const MachineModel plain = [] {
    MachineModel model = MachineFromText(kLiftArm);
    model.joints[0].displacement_m3prad = 2e-3;
    model.pumps = {{"one", 1e-3, {0}, {}}};
    return WithEffects(model, "{}");
  }();
  MachineModel model = plain;
  for (const Effect& effect : effects) {
    const bool pump = effect.mechanism->ActsOn(EffectTarget::kPump);
    (pump ? model.effects.pumps : model.effects.joints).at(0).push_back(effect);
  }
  return model;
}

/// Response to the rate that a lever commands.
struct Motion {
  bool finite = true;
  double fastest_radps = 0;  ///< along the lever
};

Motion Move(const MachineModel& model, double lever, double load_nm) {
  constexpr double kLong_s = 0.01;
  Actuation chain(model, {"m", 1});
  Motion motion;
  // A gap of 0.5 rad takes some time at a two-hundredth of the rate.
  for (int i = 0; i < 300 || (i < 30000 && motion.fastest_radps == 0); ++i) {
    const double swing = std::sin(0.05 * i);
    const std::vector<AxisMotion> motions = {{0.2 * swing, lever * swing, load_nm * swing}};
    chain.Step(std::vector<double>{lever}, motions, kLong_s);
    const AxisDrive& drive = chain.drives()[0];
    motion.finite = motion.finite && std::isfinite(drive.rate_radps) &&
                    std::isfinite(drive.friction.against_positive_nm) &&
                    std::isfinite(drive.friction.against_negative_nm) &&
                    std::isfinite(drive.friction.viscous_nmsprad);
    motion.fastest_radps =
        std::max(motion.fastest_radps, std::copysign(1.0, lever) * drive.rate_radps);
  }
  return motion;
}

TEST(CornerCases, OfAJointAndItsPumpAreFiniteAndLetAFullLeverAct) {
  std::size_t tried = 0;
  for (const Effects& effects : OnesAndTwos(ActuationMechanisms())) {
    const MachineModel model = PumpedArm(effects);
    if (!FaultsOfJoint(model, 0).empty() || !FaultsOfPump(model, 0).empty()) continue;
    ++tried;
    for (const double lever : {1.0, -1.0}) {
      EXPECT_TRUE(Move(model, lever, 1e5).finite) << Text(effects);
      const Motion motion = Move(model, lever, 0);
      EXPECT_TRUE(motion.finite) << Text(effects);
      EXPECT_EQ(motion.fastest_radps > 0, !StatesThatNothingMoves(effects)) << Text(effects);
    }
  }
  EXPECT_GT(tried, 3000u);
}

TEST(CornerCases, OfTheGroundAreFiniteAndLetDrivenTracksMoveTheMachine) {
  MachineModel model = ShippedMachine("dozer");
  std::size_t tried = 0;
  for (const Effects& effects : OnesAndTwos(GroundMechanisms())) {
    model.effects.base = effects;
    const TrackDrive drive(model);
    if (!drive.MovesOnLevelGround()) continue;
    const TrackGeometry& geometry = drive.geometry();
    ++tried;
    const TrackKinematicsParameters p = TrackKinematicsOf(effects);
    // With icr_shift the middle may go backwards in a curve.
    const PlanarTwist level = MoveOnTracks(ShoeSpeeds({1, 1}, p), {}, geometry, p);
    EXPECT_TRUE(level.forward_mps > 0 || level.yaw_radps != 0) << Text(effects);
    for (const double tilt_rad : {-kPi / 2, -1.0, 0.0, 1.0, kPi / 2}) {
      for (const double force_n : {-1e6, 0.0, 1e6}) {
        const PlanarTwist twist = MoveOnTracks(
            ShoeSpeeds({1, -0.5}, p), {tilt_rad, -0.5 * tilt_rad, Vec2(force_n, -force_n), force_n},
            geometry, p);
        EXPECT_TRUE(std::isfinite(twist.forward_mps) && std::isfinite(twist.left_mps) &&
                    std::isfinite(twist.yaw_radps))
            << Text(effects);
      }
    }
  }
  EXPECT_GT(tried, 500u);
}

}  // namespace
}  // namespace tera
