#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "physics/actuation/actuation.h"
#include "physics/actuation/hydraulics.h"
#include "physics/actuation/linkage.h"
#include "physics/machine_fixture.h"

namespace tera {
namespace {

/// Two joints and a track on one pump, and a joint that it shares with another pump.
MachineModel TwoPumpMachine(const std::string& effects) {
  MachineModel model = MachineFromText(kLiftArm + R"(
tracks:
  left: {link: post, center_m: [0, 1, 0.2], wheelbase_m: 1, radius_m: 0.25, width_m: 0.3,
         max_speed_mps: 1, max_torque_nm: 500, inertia_kgm2: 3}
)",
                                       {"levers=[lift, left]"});
  Joint second = model.joints[0];
  second.name = "second";
  model.joints.push_back(second);
  model.joints[0].displacement_m3prad = 2e-3;
  model.joints[1].displacement_m3prad = 4e-3;
  model.gear_drives[0].displacement_m3prad = 0.25e-3;
  model.pumps = {{"one", 1e-3, {0, 1}, {0}}, {"two", 1e-3, {1}, {}}};
  return WithEffects(model, effects);
}

TEST(ActuationChain, WithoutEffectsEveryAxisIsAskedForItsRateAtOnce) {
  const MachineModel model = ShippedMachine("tb235");
  Actuation chain(model, {"excavator1", 3, -750});
  std::vector<double> levers(model.joints.size() + 2);
  std::vector<AxisMotion> motions(levers.size(), {0.3, -0.2, 4000});
  for (int i = 0; i < 100; ++i) {
    for (std::size_t k = 0; k < levers.size(); ++k) levers[k] = std::sin(0.1 * i + k);
    chain.Step(levers, motions, kStep_s);
    for (std::size_t k = 0; k < model.joints.size(); ++k) {
      const Joint& joint = model.joints[k];
      EXPECT_EQ(chain.drives()[k].rate_radps,
                levers[k] * (levers[k] > 0 ? joint.max_rate_positive_radps
                                           : joint.max_rate_negative_radps));
      EXPECT_FALSE(chain.drives()[k].friction.any());
    }
    EXPECT_EQ(chain.drives().back().rate_radps,
              levers.back() * model.gear_drives[1].max_rate_radps);
  }
}

TEST(ActuationChain, APumpGivesAllItFeedsTheSameShare) {
  // Full levers demand 2e-3 * 0.5236 + half of 4e-3 * 0.5236 + 0.25e-3 * 4 m3/s = 3.0944e-3 of pump
  // one, and 1.0472e-3 of pump two.
  Actuation chain(TwoPumpMachine("{one: {flow_sharing: {}}, two: {flow_sharing: {}}}"), {"m", 1});
  chain.Step(std::vector<double>{1, 1, 1}, std::vector<AxisMotion>(3), kStep_s);
  const double one = 1e-3 / (2e-3 * 30 * kDeg + 2e-3 * 30 * kDeg + 1e-3);
  const double two = 1e-3 / (2e-3 * 30 * kDeg);
  EXPECT_NEAR(chain.drives()[0].rate_radps, 30 * kDeg * one, 1e-12);
  EXPECT_NEAR(chain.drives()[1].rate_radps, 30 * kDeg * 0.5 * (one + two), 1e-12);
  EXPECT_NEAR(chain.drives()[2].rate_radps, 4 * one, 1e-12);
  chain.Step(std::vector<double>{0.5, 0, 0}, std::vector<AxisMotion>(3), kStep_s);
  EXPECT_NEAR(chain.drives()[0].rate_radps, 15 * kDeg, 1e-12);
}

TEST(ActuationChain, APumpsPowerCountsWhatMovesAgainstItsLoad) {
  Actuation chain(TwoPumpMachine("one: {power_limit: {power_w: 1000, regulator_s: 0}}"), {"m", 1});
  // 4000 N m at 0.5236 rad/s are 2094 W; the track is pulled along and demands nothing.
  const std::vector<AxisMotion> motions = {{0, 0, 4000}, {0, 0, 0}, {0, 0, -5000}};
  chain.Step(std::vector<double>{1, 0, 1}, motions, kStep_s);
  EXPECT_NEAR(chain.drives()[0].rate_radps, 1000.0 / 4000, 1e-12);
  EXPECT_NEAR(chain.drives()[2].rate_radps, 4 * 1000 / (4000 * 30 * kDeg), 1e-12);
}

TEST(ActuationChain, AJointsLeverTakesPowerFromThePumpButNoOil) {
  // Pins of 0.4 m and 1 m, 90 deg apart at the reference and 143.13 deg at q = 0.92730. Lever arms
  // 0.4 / sqrt(1.16) = 0.371391 m and 0.24 / sqrt(1.80) = 0.178885 m: the joint there is 2.07614
  // times as fast at the same piston rate.
  const std::string lever =
      "lift: {cylinder_lever: {barrel_m: 0.4, rod_m: 1, angle_at_zero_rad: 1.5707963, "
      "reference_rad: 0}}";
  const double gain = 2.07614, q_rad = 0.9272952;
  const std::vector<AxisMotion> motions = {{q_rad, 0, 4000}, {0, 0, 0}, {0, 0, 0}};
  const auto rate_radps = [&](const std::string& limit) {
    Actuation chain(TwoPumpMachine("{one: {" + limit + "}, " + lever + "}"), {"m", 1});
    chain.Step(std::vector<double>{1, 0, 0}, motions, kStep_s);
    return chain.drives()[0].rate_radps;
  };
  EXPECT_NEAR(rate_radps("power_limit: {power_w: 1000, regulator_s: 0}"), 1000.0 / 4000, 1e-6);
  // 2e-3 m3/rad at the reference: 5e-4 m3/s give 0.25 rad/s there, and gain times that here.
  EXPECT_NEAR(rate_radps("flow_sharing: {capacity: 0.5}"), 0.25 * gain, 1e-5);
}

TEST(ActuationChain, TheSameSeedGivesTheSameRunAndEachAxisItsOwnLosses) {
  const std::string drops = "{command_drops: {period_s: 0.02, probability: 0.4}}";
  const MachineModel model = TwoPumpMachine("{lift: " + drops + ", second: " + drops + "}");
  const auto rates = [&](std::uint64_t seed, std::size_t axis) {
    Actuation chain(model, {"m", seed});
    std::vector<double> all;
    for (int i = 0; i < 1000; ++i) {
      const double u = std::sin(0.05 * i);
      chain.Step(std::vector<double>{u, u, u}, std::vector<AxisMotion>(3), kStep_s);
      all.push_back(chain.drives()[axis].rate_radps);
    }
    return all;
  };
  EXPECT_EQ(rates(5, 0), rates(5, 0));
  EXPECT_NE(rates(5, 0), rates(6, 0));
  EXPECT_NE(rates(5, 0), rates(5, 1));
}

TEST(ActuationChain, AMachinesOwnCylindersExtendSteadily) {
  // Boom by a triangle, bucket by a four-bar: their cylinders' lengths grow at equal, constant
  // rates.
  for (const char* joint : {"boom", "bucket"}) {
    const MachineModel model = WithEffects(
        ShippedMachine("tb235"), std::string(joint) + ": {cylinder_lever: {reference_rad: 0.1}}");
    const auto axis = static_cast<std::size_t>(model.JointIndex(joint));
    const auto cylinder =
        std::find_if(model.cylinders.begin(), model.cylinders.end(),
                     [&](const Cylinder& c) { return c.joint == static_cast<int>(axis); });
    Actuation chain(model, {"m", 1});
    std::vector<double> levers(model.joints.size() + 2);
    std::vector<AxisMotion> motions(levers.size());
    const auto rate_at = [&](double q_rad) {
      levers[axis] = 0.4;
      motions[axis].position_rad = q_rad;
      chain.Step(levers, motions, kStep_s);
      return chain.drives()[axis].rate_radps;
    };
    const double reference_radps = 0.4 * model.joints[axis].max_rate_positive_radps;
    EXPECT_NEAR(rate_at(0.1), reference_radps, 1e-12);
    const double steady_mps = reference_radps * ReachOf(model, *cylinder, 0.1).arm_m;
    for (double q_rad = -0.6; q_rad < 0.8; q_rad += 0.13) {
      const double change_m = ReachOf(model, *cylinder, q_rad + 1e-5).length_m -
                              ReachOf(model, *cylinder, q_rad - 1e-5).length_m;
      EXPECT_NEAR(rate_at(q_rad) * change_m / 2e-5, steady_mps, 1e-3 * std::abs(steady_mps));
    }
  }
}

/// Demand on a joint of the compact excavator at a position and a load.
double RateUnder(const MachineModel& model, std::size_t axis, double lever, double q_rad,
                 double load_nm) {
  Actuation chain(model, {"m", 1});
  std::vector<double> levers(model.joints.size() + 2);
  std::vector<AxisMotion> motions(levers.size());
  levers[axis] = lever;
  motions[axis] = {q_rad, 0, load_nm};
  chain.Step(levers, motions, kStep_s);
  return chain.drives()[axis].rate_radps;
}

TEST(ActuationChain, DroopWithoutANumberStallsWhereReliefLetsGoOfTheCylinder) {
  for (const char* name : {"boom", "bucket"}) {
    const MachineModel model = WithEffects(
        ShippedMachine("tb235"), std::string(name) + ": {pressure_droop: {response_s: 0}}");
    const auto axis = static_cast<std::size_t>(model.JointIndex(name));
    const Joint& joint = model.joints[axis];
    double least_nm = 1e9, most_nm = 0;
    for (const double share : {0.1, 0.4, 0.6, 0.9}) {
      const double q_rad = std::lerp(joint.lower_rad, joint.upper_rad, share);
      const EffortLimits relief = ReliefEffort(model, static_cast<int>(axis), q_rad);
      // Half the rate at three quarters of the pressure, by the root.
      EXPECT_NEAR(RateUnder(model, axis, 1, q_rad, 0.75 * relief.positive_nm),
                  0.5 * joint.max_rate_positive_radps, 1e-3)
          << name;
      EXPECT_NEAR(RateUnder(model, axis, -1, q_rad, -0.75 * relief.negative_nm),
                  -0.5 * joint.max_rate_negative_radps, 1e-3)
          << name;
      EXPECT_EQ(RateUnder(model, axis, 1, q_rad, 1.001 * relief.positive_nm), 0) << name;
      least_nm = std::min({least_nm, relief.positive_nm, relief.negative_nm});
      most_nm = std::max({most_nm, relief.positive_nm, relief.negative_nm});
    }
    EXPECT_GT(most_nm, 1.5 * least_nm) << name;  // so that a single number is insufficient
  }
}

TEST(ActuationChain, DroopWithoutANumberOfWhatNoCylinderMovesStallsAtItsFullEffort) {
  const MachineModel model =
      WithEffects(ShippedMachine("tb235"), "slew: {pressure_droop: {response_s: 0}}");
  const auto slew = static_cast<std::size_t>(model.JointIndex("slew"));
  EXPECT_NEAR(RateUnder(model, slew, 1, 0.4, 0.75 * 3500), 0.5 * 54 * kDeg, 1e-12);
  EXPECT_EQ(RateUnder(model, slew, -1, 0.4, -3500), 0);
}

TEST(ActuationChain, ALeakAtReliefIsOneFlowWhereverTheCylinderStands) {
  const double drift_radps = 4e-4;
  const MachineModel model =
      WithEffects(ShippedMachine("tb235"), "boom: {sag: {drift_radps: 0.0004}}");
  const auto boom = static_cast<std::size_t>(model.JointIndex("boom"));
  const Joint& joint = model.joints[boom];
  // about 1.0e-7 m3/s: the leak under the rated effort's pressure at mid-travel
  std::vector<double> flows;
  for (const double share : {0.05, 0.3, 0.5, 0.8}) {
    const double q_rad = std::lerp(joint.lower_rad, joint.upper_rad, share);
    const EffortLimits relief = ReliefEffort(model, static_cast<int>(boom), q_rad);
    for (const int sign : {1, -1}) {
      const double load_nm = sign > 0 ? relief.positive_nm : -relief.negative_nm;
      const double rate_radps = RateUnder(model, boom, 0, q_rad, load_nm);
      EXPECT_LT(rate_radps * sign, 0);
      const double displacement_m3prad =
          CylinderDisplacement_m3prad(model, static_cast<int>(boom), q_rad, sign);
      flows.push_back(std::abs(rate_radps) * displacement_m3prad);
    }
  }
  const double mid_m3prad =
      0.5 * (CylinderDisplacement_m3prad(model, static_cast<int>(boom),
                                         0.5 * (joint.lower_rad + joint.upper_rad), 1) +
             CylinderDisplacement_m3prad(model, static_cast<int>(boom),
                                         0.5 * (joint.lower_rad + joint.upper_rad), -1));
  // Return pressure, which is not the load's, makes a difference of 2 %.
  for (const double flow : flows) EXPECT_NEAR(flow / (drift_radps * mid_m3prad), 1, 0.03);
}

/// All demands of the chain while levers alternate between neighbouring measured values.
std::vector<double> Outputs(const std::string& effects) {
  Actuation chain(TwoPumpMachine(effects), {"m", 1});
  std::vector<double> all;
  for (int i = 0; i < 2000; ++i) {
    const double t_s = i * kStep_s;
    const double u = std::sin(7 * t_s), q_rad = 2.9 * std::sin(1.5 * t_s);
    const AxisMotion motion = {q_rad, 4.4 * std::cos(1.5 * t_s), 900 * std::cos(t_s)};
    chain.Step(std::vector<double>{u, -u, u}, std::vector<AxisMotion>(3, motion), kStep_s);
    for (const AxisDrive& drive : chain.drives()) {
      all.push_back(drive.rate_radps);
      all.push_back(drive.friction.against_positive_nm);
      all.push_back(drive.friction.against_negative_nm);
      all.push_back(drive.friction.viscous_nmsprad);
      all.push_back(drive.offset_nm);
    }
  }
  return all;
}

/// NaN differs from everything, itself included.
bool AllFinite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

struct Change {
  std::string mechanism, parameter, from, to;
  std::string others = "";
};

TEST(ActuationChain, EveryParameterChangesWhatIsAskedFor) {
  const Change changes[] = {
      {"command_delay", "delay_s", "0.1", "0.1007"},
      {"command_delay", "spread_s", "0", "0.03", "delay_s: 0.1"},
      {"input_hold", "period_s", "0.05", "0.06"},
      {"input_hold", "phase", "0", "0.5", "period_s: 0.05"},
      {"command_drops", "period_s", "0.05", "0.06", "probability: 0.5"},
      {"command_drops", "probability", "0.2", "0.3", "period_s: 0.05"},
      {"lever_saturation", "limit", "0.9", "0.8"},
      {"lever_saturation", "asymmetry", "0", "0.1", "limit: 0.9"},
      {"dead_band", "width", "0.1", "0.11"},
      {"dead_band", "asymmetry", "0", "0.1", "width: 0.1"},
      {"valve_curve", "exponent", "1.1", "1.2"},
      {"asymmetric_gain", "ratio", "1.3", "1.4"},
      {"rate_gain", "gain", "1", "1.02"},
      {"flow_sharing", "capacity", "1", "0.9"},
      {"power_limit", "power_w", "200", "210"},
      {"power_limit", "regulator_s", "0.1", "0.2", "power_w: 200"},
      {"rate_limit", "max_change_radps2", "1", "1.1"},
      {"rate_limit", "band_s", "0", "0.05", "max_change_radps2: 1"},
      {"actuator_lag", "time_s", "0.1", "0.11"},
      {"actuator_lag", "pilot_ratio", "0", "0.2", "time_s: 0.1"},
      {"actuator_ring", "eta_radps", "20", "21"},
      {"actuator_ring", "beta_1ps", "6", "7"},
      {"actuator_ring", "phi_rad", "0", "0.1"},
      {"end_cushion", "zone_rad", "0.3", "0.4"},
      {"end_cushion", "end_ratio", "0.2", "0.3", "zone_rad: 0.3"},
      {"cylinder_lever", "barrel_m", "0.4", "0.5",
       "rod_m: 1, angle_at_zero_rad: 1.2, reference_rad: 0"},
      {"cylinder_lever", "rod_m", "1", "1.1",
       "barrel_m: 0.4, angle_at_zero_rad: 1.2, reference_rad: 0"},
      {"cylinder_lever", "angle_at_zero_rad", "1.2", "1.3",
       "barrel_m: 0.4, rod_m: 1, reference_rad: 0"},
      {"cylinder_lever", "reference_rad", "0", "0.1",
       "barrel_m: 0.4, rod_m: 1, angle_at_zero_rad: 1.2"},
      {"backlash", "gap_rad", "0.01", "0.02"},
      {"pressure_droop", "stall_nm", "2000", "2100"},
      {"pressure_droop", "response_s", "0.05", "0.1", "stall_nm: 2000"},
      {"coulomb_friction", "effort_nm", "10", "11"},
      {"viscous_friction", "coefficient_nmsprad", "10", "11"},
      {"viscous_friction", "oil_degc", "40", "50", "coefficient_nmsprad: 10"},
      {"stribeck_friction", "excess_nm", "10", "11"},
      {"stribeck_friction", "rate_radps", "0.02", "0.5", "excess_nm: 10"},
      {"asymmetric_friction", "positive_nm", "0", "1"},
      {"asymmetric_friction", "negative_nm", "0", "1"},
      {"asymmetric_friction", "positive_nmsprad", "0", "1"},
      {"asymmetric_friction", "negative_nmsprad", "0", "1"},
      {"effort_offset", "effort_nm", "0", "1"},
      {"sag", "drift_radps", "0.001", "0.002"},
      {"sag", "oil_degc", "40", "50", "drift_radps: 0.001"},
      {"drive_friction", "lost_radps", "0.02", "0.03"},
      {"drive_friction", "time_s", "0.05", "0.1", "lost_radps: 0.02"},
      {"drive_friction", "breakaway", "1", "1.5", "lost_radps: 0.02"},
      {"drive_friction", "stribeck_radps", "0.02", "0.5", "lost_radps: 0.02, breakaway: 1.5"},
      {"structural_flex", "natural_radps", "15", "16"},
      {"structural_flex", "damping", "0.05", "0.1", "natural_radps: 15"},
      {"structural_flex", "compliance_radpnm", "0", "1e-6", "natural_radps: 15"},
  };
  std::size_t parameters = 4;  // of payload, in EveryParameterOfAPayloadChangesTheLink
  for (const Change& change : changes) {
    const bool pump = change.mechanism == "flow_sharing" || change.mechanism == "power_limit";
    const auto outputs = [&](const std::string& value) {
      return Outputs((pump ? "one: {" : "lift: {") + change.mechanism + ": {" + change.parameter +
                     ": " + value + (change.others.empty() ? "" : ", ") + change.others + "}}");
    };
    EXPECT_TRUE(AllFinite(outputs(change.from))) << change.mechanism;
    EXPECT_TRUE(AllFinite(outputs(change.to))) << change.mechanism << "." << change.parameter;
    EXPECT_NE(outputs(change.from), outputs(change.to))
        << change.mechanism << "." << change.parameter;
    EXPECT_NE(outputs(change.to), Outputs("{}")) << change.mechanism;
    ++parameters;
  }
  for (const Mechanism& mechanism : ActuationMechanisms())
    parameters -= mechanism.parameters.size();
  EXPECT_EQ(parameters, 0u);  // none was left out
}

}  // namespace
}  // namespace tera
