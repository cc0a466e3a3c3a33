#include "physics/traction/track_kinematics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/units.h"
#include "physics/traction/ground_mechanisms.h"

/// The ground slot against closed forms. A machine of 3.5 t on tracks of 1.6 m, 1.2 m apart.

namespace tera {
namespace {

constexpr TrackGeometry kGeometry{.gauge_m = 1.2, .contact_length_m = 1.6, .weight_n = 34300};

/// One effect with all its numbers in the mechanism's order.
Effects One(std::string_view id, std::vector<double> values) {
  for (const Mechanism& mechanism : GroundMechanisms()) {
    if (mechanism.id == id) return {Effect{&mechanism, std::move(values)}};
  }
  ADD_FAILURE() << "no mechanism " << id;
  return {};
}

PlanarTwist Move(const TrackSpeeds& commanded, const TrackKinematicsParameters& parameters,
                 const TrackCircumstances& circumstances = {}) {
  return MoveOnTracks(ShoeSpeeds(commanded, parameters), circumstances, kGeometry, parameters);
}

PlanarTwist Move(const TrackSpeeds& commanded, const Effects& effects,
                 const TrackCircumstances& circumstances = {}) {
  return Move(commanded, TrackKinematicsOf(effects), circumstances);
}

/// Nose up by `slope_rad`.
TrackCircumstances Climbing(double slope_rad) { return {.pitch_rad = -slope_rad}; }

/// Place of a machine after `duration_s` from the origin, by small steps.
struct Place {
  Vec2 p_m = Vec2::Zero();
  double yaw_rad = 0;
};
Place TrackKinematicsTravel(double duration_s, const std::function<PlanarTwist()>& twist) {
  Place place;
  constexpr double kStep_s = 1e-3;
  for (int k = 0; k < std::lround(duration_s / kStep_s); ++k) {
    const PlanarTwist t = twist();
    const double middle_rad = place.yaw_rad + 0.5 * t.yaw_radps * kStep_s;
    place.p_m += kStep_s * (Eigen::Rotation2Dd(middle_rad) * Vec2(t.forward_mps, t.left_mps));
    place.yaw_rad += t.yaw_radps * kStep_s;
  }
  return place;
}

TEST(TrackKinematics, WithoutEffectsIsADifferentialDrive) {
  // Tracks at 0.4 and 1.0 m/s: circles of radii 0.8 and 2.0 m about one point, 1.2 m apart.
  const PlanarTwist arc = Move({0.4, 1.0}, Effects());
  EXPECT_DOUBLE_EQ(arc.forward_mps / arc.yaw_radps, 1.4);
  EXPECT_DOUBLE_EQ(arc.yaw_radps * 0.8, 0.4);
  EXPECT_EQ(arc.left_mps, 0);
  // Independent of the ground and of its tools.
  const PlanarTwist leaning = Move({0.4, 1.0}, Effects(),
                                   {.roll_rad = 0.3,
                                    .pitch_rad = -0.2,
                                    .tool_force_B_n = {-9000, 400},
                                    .tool_torque_B_nm = 7e3});
  EXPECT_EQ(leaning.forward_mps, arc.forward_mps);
  EXPECT_EQ(leaning.left_mps, 0);
  EXPECT_EQ(leaning.yaw_radps, arc.yaw_radps);
}

TEST(TrackKinematics, EffectiveGaugeWidensTheCircle) {
  // A full circle of the middle at 0.7 m/s with r B = 2.1 m takes 2 pi r B / 0.6 s. Its radius is
  // 0.7 r B / 0.6 = 2.45 m, and it closes.
  const Effects effects = One("effective_gauge", {1.75});
  const double period_s = 2 * kPi * 2.1 / 0.6;
  const auto twist = [&] { return Move({0.4, 1.0}, effects); };
  const Place half = TrackKinematicsTravel(period_s / 2, twist),
              whole = TrackKinematicsTravel(period_s, twist);
  EXPECT_NEAR(half.p_m.y(), 2 * 2.45, 0.01);
  EXPECT_NEAR(half.yaw_rad, kPi, 1e-3);
  EXPECT_LT(whole.p_m.norm(), 0.01);
}

TEST(TrackKinematics, ScaleAndSlipShortenTheWay) {
  // 20 s at 0.5 m/s are 10 m.
  EXPECT_NEAR(TrackKinematicsTravel(20,
                                    [] {
                                      return Move({0.5, 0.5}, One("track_scale", {0.96}));
                                    })
                  .p_m.x(),
              9.6, 1e-9);
  EXPECT_NEAR(TrackKinematicsTravel(20,
                                    [] {
                                      return Move({0.5, 0.5}, One("track_slip", {0.12, 0, 0.7, 0}));
                                    })
                  .p_m.x(),
              8.8, 1e-9);
  EXPECT_NEAR(
      TrackKinematicsTravel(20,
                            [] {
                              return Move({-0.5, -0.5}, One("track_slip", {0.12, 0, 0.7, 0}));
                            })
          .p_m.x(),
      -8.8, 1e-9);
}

TEST(TrackKinematics, ATurnTakesForwardSpeedAndNoYawRate) {
  // Sides at 0.4 and 1.0 m/s: 0.6 over 1.4 of the loss with one side at rest.
  const Effects effects = One("track_slip", {0.1, 0, 0.7, 0.7});
  const PlanarTwist arc = Move({0.4, 1.0}, effects), straight = Move({0.7, 0.7}, effects);
  EXPECT_NEAR(straight.forward_mps, 0.63, 1e-12);
  EXPECT_NEAR(arc.forward_mps, 0.63 * 0.7, 1e-12);
  EXPECT_NEAR(arc.yaw_radps, 0.9 * 0.6 / 1.2, 1e-12);
  EXPECT_NEAR(Move({0, 1}, effects).forward_mps, 0.9 * 0.5 * 0.3, 1e-12);
  EXPECT_NEAR(Move({-0.4, -1.0}, effects).forward_mps, -arc.forward_mps, 1e-12);
  EXPECT_EQ(Move({0, 0}, effects).forward_mps, 0);
}

TEST(TrackKinematics, AsymmetryBendsAStraightLineIntoACircle) {
  // Right track 3 % faster than the mean, left 3 % slower: the outer track's circle is longer by 6
  // % of the mean radius. The gauge of 1.2 m is thus 6 % of the radius of 20 m.
  const PlanarTwist twist = Move({0.5, 0.5}, One("track_asymmetry", {0.06}));
  EXPECT_NEAR(twist.forward_mps / twist.yaw_radps, 20, 1e-9);
  EXPECT_NEAR(twist.forward_mps, 0.5, 1e-12);
  EXPECT_LT(Move({-0.5, -0.5}, One("track_asymmetry", {0.06})).yaw_radps, 0);
}

TEST(TrackKinematics, SlipUnderThrustIsJanosisOverTheWeightOnTheSlope) {
  // Climbing at 20 deg on mu = tan 39 deg = 0.8098 needs tan 20 / tan 39 = 0.4495 of the strength.
  // 1 - (1 - e^-x) / x = 0.4495 has the root x = 1.3444 (bisection by hand; see also
  // Drive.SlipGrowsWithTheSlopeItClimbsAsJanosiSays), i = x K / L with K = 18 mm.
  const double mu = std::tan(39 * kDeg);
  const Effects janosi = One("track_slip", {0, 0.018, mu, 0});
  const double climbing = 1 - Move({0.5, 0.5}, janosi, Climbing(20 * kDeg)).forward_mps / 0.5;
  double low = 0.01, high = 10;
  for (int k = 0; k < 60; ++k) {
    const double x = 0.5 * (low + high);
    (1 - (1 - std::exp(-x)) / x < std::tan(20 * kDeg) / mu ? low : high) = x;
  }
  EXPECT_NEAR(climbing, low * 0.018 / 1.6, 1e-9);
  EXPECT_NEAR(climbing, 1.3444 * 0.018 / 1.6, 2e-4);
  // Downhill it skids as much; on level ground it needs nothing; beyond its strength it spins.
  EXPECT_NEAR(1 - Move({0.5, 0.5}, janosi, Climbing(-20 * kDeg)).forward_mps / 0.5, -climbing,
              1e-12);
  EXPECT_NEAR(Move({0.5, 0.5}, janosi).forward_mps, 0.5, 1e-12);
  EXPECT_NEAR(Move({0.5, 0.5}, janosi, Climbing(40 * kDeg)).forward_mps, 0, 1e-12);
  // Backwards down the slope it brakes.
  EXPECT_LT(Move({-0.5, -0.5}, janosi, Climbing(20 * kDeg)).forward_mps, -0.5);
}

TEST(TrackKinematics, SlopeSlipGrowsWithTheTangentAlongTheTravel) {
  const Effects effects = One("slope_slip", {0.02, 0.5});
  const double slope_rad = std::atan(0.3);
  EXPECT_NEAR(Move({0.5, 0.5}, effects).forward_mps, 0.49, 1e-12);
  EXPECT_NEAR(Move({0.5, 0.5}, effects, Climbing(slope_rad)).forward_mps, 0.5 * (1 - 0.17), 1e-12);
  EXPECT_NEAR(Move({0.5, 0.5}, effects, Climbing(-slope_rad)).forward_mps, 0.5 * (1 + 0.13), 1e-12);
  EXPECT_NEAR(Move({-0.5, -0.5}, effects, Climbing(slope_rad)).forward_mps, -0.5 * (1 + 0.13),
              1e-12);
}

TEST(TrackKinematics, DriftsDownASideSlopeAtAnAngleInProportion) {
  // Rising to its left by tan = 0.25 with k = 0.4: the path points 0.1 below the heading.
  const double side_rad = std::atan(0.25);
  const PlanarTwist twist = Move({0.8, 0.8}, One("side_slip", {0.4}), {.roll_rad = side_rad});
  EXPECT_NEAR(std::atan2(twist.left_mps, twist.forward_mps), -std::atan(0.1), 1e-12);
  // In the opposite orientation, and backwards, downhill is still downhill.
  EXPECT_GT(Move({0.8, 0.8}, One("side_slip", {0.4}), {.roll_rad = -side_rad}).left_mps, 0);
  EXPECT_LT(Move({-0.8, -0.8}, One("side_slip", {0.4}), {.roll_rad = side_rad}).left_mps, 0);
  EXPECT_EQ(Move({0, 0}, One("side_slip", {0.4}), {.roll_rad = side_rad}).left_mps, 0);
}

TEST(TrackKinematics, IcrOfAMachineThatTurnsOnTheSpotIsWhereItWasShifted) {
  // The point (0.3, -0.1) of the base stands still: v + w x r = 0.
  const PlanarTwist twist = Move({-0.6, 0.6}, One("icr_shift", {0.3, -0.1}));
  EXPECT_NEAR(twist.yaw_radps, 1.0, 1e-12);
  EXPECT_NEAR(twist.forward_mps - twist.yaw_radps * -0.1, 0, 1e-12);
  EXPECT_NEAR(twist.left_mps + twist.yaw_radps * 0.3, 0, 1e-12);
  // The left shoes and the ground have equal speeds at y = 0.6 - 0.1, the right ones at -0.6 - 0.1.
  const PlanarTwist arc = Move({0.4, 1.0}, One("icr_shift", {0.3, -0.1}));
  EXPECT_NEAR(arc.forward_mps - arc.yaw_radps * 0.5, 0.4, 1e-12);
  EXPECT_NEAR(arc.forward_mps + arc.yaw_radps * 0.7, 1.0, 1e-12);
}

TEST(TrackKinematics, RollingResistanceCostsSlipInProportionToAllThrust) {
  // f = 0.1 and stiffness 20: 0.005 on the level; at a slope of tan = 0.3, (0.1 + 0.3) / 20.
  const Effects effects = One("rolling_resistance", {0.1, 20});
  EXPECT_NEAR(Move({0.5, 0.5}, effects).forward_mps, 0.5 * (1 - 0.005), 1e-12);
  EXPECT_NEAR(Move({-0.5, -0.5}, effects).forward_mps, -0.5 * (1 - 0.005), 1e-12);
  EXPECT_NEAR(Move({0.5, 0.5}, effects, Climbing(std::atan(0.3))).forward_mps, 0.5 * (1 - 0.02),
              1e-12);
  // A push of a tenth of the weight against the blade costs another tenth.
  EXPECT_NEAR(Move({0.5, 0.5}, effects, {.tool_force_B_n = {-3430, 0}}).forward_mps,
              0.5 * (1 - 0.01), 1e-12);
}

TEST(TrackKinematics, RollingResistanceFadesWithoutAStep) {
  // At f = 0 the slip of the other thrust remains, tan = 0.3 over 20.
  const TrackCircumstances loads[] = {Climbing(std::atan(0.3)),
                                      {.tool_force_B_n = {-3430, 500}, .tool_torque_B_nm = 900}};
  for (const TrackCircumstances& load : loads) {
    for (const TrackSpeeds& speeds : {TrackSpeeds{0.5, 0.5}, TrackSpeeds{-0.2, 0.4}}) {
      const PlanarTwist none = Move(speeds, One("rolling_resistance", {0, 20}), load);
      const PlanarTwist faint = Move(speeds, One("rolling_resistance", {1e-9, 20}), load);
      EXPECT_NEAR(faint.forward_mps, none.forward_mps, 1e-9);
      EXPECT_NEAR(faint.yaw_radps, none.yaw_radps, 1e-9);
    }
  }
  EXPECT_NEAR(Move({0.5, 0.5}, One("rolling_resistance", {0, 20}), loads[0]).forward_mps,
              0.5 * (1 - 0.015), 1e-12);
  EXPECT_EQ(Move({0.5, 0.5}, One("rolling_resistance", {0, 20})).forward_mps, 0.5);
}

TEST(TrackKinematics, AForceBesideTheMiddleLoadsTheTrackOnItsSide) {
  // A torque to the left resists the right track: it slips more, the left one less.
  const Effects effects = One("rolling_resistance", {0.1, 20});
  const PlanarTwist twist = Move({0.5, 0.5}, effects, {.tool_torque_B_nm = -2000});
  EXPECT_LT(twist.yaw_radps, 0);
  // Its thrusts, +-2000 / 1.2 N, over half the weight, over the stiffness.
  EXPECT_NEAR(twist.yaw_radps * 1.2 / 0.5, -2 * 2000 / 1.2 / (0.5 * 34300) / 20, 1e-12);
  EXPECT_NEAR(twist.forward_mps, 0.5 * (1 - 0.005), 1e-12);
}

TEST(TrackKinematics, DiggingDragsAMachineThatItsTracksCannotHold) {
  const Effects effects = One("digging_force", {0.8, 0.3});
  EXPECT_EQ(Move({0, 0}, effects, {.tool_force_B_n = {0.29 * 34300, 0}}).forward_mps, 0);
  // Half the weight along a 3-4-5 direction: 0.2 beyond the holding force, at 0.8 m/s per weight.
  const PlanarTwist dragged =
      Move({0, 0}, effects, {.tool_force_B_n = 0.5 * 34300 * Vec2(0.6, -0.8)});
  EXPECT_NEAR(dragged.forward_mps, 0.16 * 0.6, 1e-12);
  EXPECT_NEAR(dragged.left_mps, -0.16 * 0.8, 1e-12);
  EXPECT_EQ(dragged.yaw_radps, 0);
  // A torque: half the weight at a quarter of the tracks' length turns at 0.16 m/s over that arm.
  const PlanarTwist turned = Move({0, 0}, effects, {.tool_torque_B_nm = -0.5 * 34300 * 0.4});
  EXPECT_NEAR(turned.yaw_radps, -0.16 / 0.4, 1e-12);
}

TEST(TrackKinematics, EveryParameterOfTheSlotActs) {
  const TrackCircumstances work{.roll_rad = 0.2,
                                .pitch_rad = -0.2,
                                .tool_force_B_n = {-9000, 2000},
                                .tool_torque_B_nm = 4000};
  const std::vector<std::pair<std::string_view, std::vector<double>>> effects = {
      {"track_scale", {0.9}},
      {"track_asymmetry", {0.05}},
      {"track_slip", {0.1, 0.02, 0.9, 0.4}},
      {"slope_slip", {0.05, 0.4}},
      {"side_slip", {0.5}},
      {"effective_gauge", {1.5}},
      {"icr_shift", {0.2, -0.1}},
      {"rolling_resistance", {0.1, 20}},
      {"digging_force", {0.8, 0.2}}};
  for (const auto& [id, values] : effects) {
    const PlanarTwist before = Move({0.3, 0.7}, One(id, values), work);
    for (std::size_t k = 0; k < values.size(); ++k) {
      std::vector<double> other = values;
      other[k] *= 1.1;
      const PlanarTwist after = Move({0.3, 0.7}, One(id, other), work);
      const double change = std::abs(after.forward_mps - before.forward_mps) +
                            std::abs(after.left_mps - before.left_mps) +
                            std::abs(after.yaw_radps - before.yaw_radps);
      EXPECT_GT(change, 1e-4) << id << " " << k;
    }
  }
  // The soil's own act in the simulation.
  EXPECT_EQ(effects.size() + 2, GroundMechanisms().size());
}

TEST(TrackKinematics, StaysFiniteAtTheEndsOfEveryRangeAndUpsideDown) {
  for (const Mechanism& mechanism : GroundMechanisms()) {
    if (mechanism.id == "terrain_height") continue;
    for (int corner = 0; corner < (1 << mechanism.parameters.size()); ++corner) {
      std::vector<double> values;
      for (std::size_t k = 0; k < mechanism.parameters.size(); ++k) {
        const EffectParameter& p = mechanism.parameters[k];
        values.push_back((corner >> k) % 2 ? p.upper : p.lower);
      }
      for (const double angle_rad : {0.0, kPi / 2, -kPi / 2, 3.0}) {
        const PlanarTwist twist =
            Move({-1, 2}, One(mechanism.id, values),
                 {.roll_rad = angle_rad, .pitch_rad = 0.5 * angle_rad, .tool_force_B_n = {1e5, 0}});
        EXPECT_TRUE(std::isfinite(twist.forward_mps + twist.left_mps + twist.yaw_radps))
            << mechanism.id << " " << angle_rad;
      }
    }
  }
}

}  // namespace
}  // namespace tera
