#include "physics/actuation/actuation_faults.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "physics/machine_fixture.h"

// Effects without any action: the machine lacks the part they act through.

namespace tera {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// "sag: ...; rate_gain: ...".
std::string Text(const std::vector<EffectFault>& faults) {
  std::string text;
  for (const EffectFault& fault : faults) {
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", fault.mechanism, fault.finding);
  }
  return text;
}

std::string OfLift(const std::string& effects, const std::vector<std::string>& overrides = {}) {
  return Text(FaultsOfJoint(
      WithEffects(MachineFromText(kLiftArm, overrides), "lift: {" + effects + "}"), 0));
}

TEST(ActuationFaults, AJointsOwnGeometryMustGiveAnEffectItsHold) {
  EXPECT_THAT(OfLift("cylinder_lever: {reference_rad: 0}"), HasSubstr("no cylinder"));
  EXPECT_THAT(OfLift("cylinder_lever: {reference_rad: 0, rod_m: 1}"), HasSubstr("both"));
  // Pins at one place, where the triangle has no angle.
  EXPECT_THAT(OfLift("cylinder_lever: {reference_rad: 0, barrel_m: 0.5, rod_m: 0.5}"),
              HasSubstr("dead centre"));
  EXPECT_THAT(OfLift("cylinder_lever: {reference_rad: 0, barrel_m: 0.4, rod_m: 1}"),
              HasSubstr("dead centre"));
  EXPECT_THAT(OfLift("end_cushion: {zone_rad: 0.1}", {"joints.lift.limits_deg=[0, 0]"}),
              HasSubstr("end stops"));
  EXPECT_THAT(OfLift("asymmetric_gain: {ratio: 1.5}", {"joints.lift.max_rate_degps=[30, 0]"}),
              HasSubstr("negative rates"));
  EXPECT_EQ(OfLift("cylinder_lever: {reference_rad: 1, barrel_m: 0.4, rod_m: 1}, end_cushion: "
                   "{zone_rad: 0.1}, sag: {drift_radps: 0.1}, asymmetric_gain: {ratio: 1.5}"),
            "");
}

TEST(ActuationFaults, AnAngleBesideTheMachinesOwnCylinderIsRefused) {
  const MachineModel model =
      WithEffects(ShippedMachine("tb235"),
                  "boom: {cylinder_lever: {reference_rad: 0.1, angle_at_zero_rad: 0.3}}");
  EXPECT_THAT(Text(FaultsOfJoint(model, static_cast<std::size_t>(model.JointIndex("boom")))),
              HasSubstr("angle_at_zero_rad needs barrel_m and rod_m"));
}

TEST(ActuationFaults, AJointThatSlidesHasNoLeverToTurn) {
  MachineModel model = MachineFromText(kLiftArm);
  model.joints[0].type = JointType::kPrismatic;
  model = WithEffects(model, "lift: {cylinder_lever: {reference_rad: 1, barrel_m: 0.4, rod_m: 1}}");
  EXPECT_THAT(Text(FaultsOfJoint(model, 0)), HasSubstr("this one slides"));
}

TEST(ActuationFaults, ADeadBandLeavesSomethingOfEveryFullLever) {
  EXPECT_EQ(OfLift("dead_band: {width: 0.9}"), "");
  EXPECT_EQ(OfLift("dead_band: {width: 0.49, asymmetry: 1}"), "");
  EXPECT_EQ(OfLift("dead_band: {width: 0.9, asymmetry: 1}"),
            "dead_band: takes up positive levers as far as 1.8, but they end at 1, so that none of "
            "them acts; need less than that in width (1 + |asymmetry|)");
  EXPECT_THAT(OfLift("dead_band: {width: 0.5, asymmetry: -1}"),
              HasSubstr("negative levers as far as 1, but they end at 1,"));
  EXPECT_THAT(OfLift("dead_band: {width: 0.3}, lever_saturation: {limit: 0.3}"),
              HasSubstr("as far as 0.3, but they end at 0.3 by lever_saturation"));
  EXPECT_EQ(OfLift("dead_band: {width: 0.29}, lever_saturation: {limit: 0.3}"), "");
  EXPECT_THAT(OfLift("dead_band: {width: 0.3}, lever_saturation: {limit: 0.5, asymmetry: 0.5}"),
              HasSubstr("negative levers as far as 0.3, but they end at 0.25"));
}

TEST(ActuationFaults, FrictionAloneDoesNotStallAJoint) {
  const std::string droop = "pressure_droop: {stall_nm: 1000}, ";
  EXPECT_EQ(OfLift(droop + "coulomb_friction: {effort_nm: 999}"), "");
  EXPECT_EQ(OfLift(droop + "coulomb_friction: {effort_nm: 1000}"),
            "pressure_droop: has the axis stand still at 1000, but at full positive lever "
            "its friction alone is 1000; need more than that, or less friction");
  EXPECT_THAT(OfLift(droop + "asymmetric_friction: {negative_nm: 1500}"),
              HasSubstr("at full negative lever its friction alone is 1500"));
  // 30 deg/s are 0.5236 rad/s; half of that with the gain.
  EXPECT_THAT(OfLift(droop + "viscous_friction: {coefficient_nmsprad: 2000}"),
              HasSubstr("friction alone is 1047.2"));
  EXPECT_EQ(OfLift(droop + "viscous_friction: {coefficient_nmsprad: 2000}, rate_gain: {gain: 0.5}"),
            "");
  // The extra break-away effort is gone at full rate.
  EXPECT_EQ(OfLift(droop + "stribeck_friction: {excess_nm: 5000}"), "");
}

TEST(ActuationFaults, FrictionMustLeaveAFullLeverSomethingEitherWay) {
  // Full levers command 30 and 20 deg/s, 0.524 and 0.349 rad/s.
  EXPECT_EQ(OfLift("drive_friction: {lost_radps: 0.17, breakaway: 2}"), "");
  EXPECT_THAT(OfLift("drive_friction: {lost_radps: 0.18, breakaway: 2}"),
              HasSubstr("at rest until 0.36 is asked of it, but a full negative lever asks for "
                        "0.349066"));
  EXPECT_THAT(OfLift("drive_friction: {lost_radps: 0.17, breakaway: 2}, rate_gain: {gain: 0.9}"),
              HasSubstr("drive_friction: holds the axis at rest"));
  // Without friction it has no effect, even if something else stops the axis.
  EXPECT_EQ(OfLift("drive_friction: {lost_radps: 0}, rate_gain: {gain: 0}"), "");
}

TEST(ActuationFaults, TheReferenceOfAMachinesOwnCylinderIsWithinTheStops) {
  const auto boom = [](const std::string& reference_rad) {
    const MachineModel model = WithEffects(
        ShippedMachine("tb235"), "boom: {cylinder_lever: {reference_rad: " + reference_rad + "}}");
    return Text(FaultsOfJoint(model, static_cast<std::size_t>(model.JointIndex("boom"))));
  };
  EXPECT_EQ(boom("0.1"), "");
  EXPECT_THAT(boom("3"), HasSubstr("reference_rad beyond the joint's stops"));
  EXPECT_THAT(boom("-3"), HasSubstr("reference_rad beyond the joint's stops"));
}

constexpr const char* kOfTheRate[] = {
    "command_delay: {delay_s: 0.1}",
    "input_hold: {period_s: 0.1}",
    "command_drops: {period_s: 0.1, probability: 0.1}",
    "lever_saturation: {limit: 0.5}",
    "dead_band: {width: 0.1}",
    "valve_curve: {exponent: 2}",
    "asymmetric_gain: {ratio: 1.5}",
    "rate_gain: {gain: 0.9}",
    "rate_limit: {max_change_radps2: 1}",
    "actuator_lag: {time_s: 0.1}",
    "actuator_ring: {}",
    "end_cushion: {zone_rad: 0.1}",
    "cylinder_lever: {reference_rad: 1, barrel_m: 0.4, rod_m: 1}",
    "backlash: {gap_rad: 0.01}",
    "pressure_droop: {stall_nm: 1000}",
    "drive_friction: {lost_radps: 0.01}",
    "structural_flex: {natural_radps: 30}",
};

TEST(ActuationFaults, WhatShapesACommandedRateNeedsALeverARateAndAnEffort) {
  for (const char* effect : kOfTheRate) {
    EXPECT_EQ(OfLift(effect), "") << effect;
    EXPECT_THAT(OfLift(effect, {"levers=[]"}),
                AllOf(HasSubstr("no lever of the machine drives it; name it under levers")))
        << effect;
    EXPECT_THAT(OfLift(effect, {"joints.lift.max_rate_degps=0"}), HasSubstr("rate at full lever"))
        << effect;
    EXPECT_THAT(OfLift(effect, {"joints.lift.max_effort_nm=0"}), HasSubstr("max_effort_nm is 0"))
        << effect;
  }
}

TEST(ActuationFaults, FrictionAndPayloadActOnAJointThatHangsFree) {
  EXPECT_EQ(OfLift("coulomb_friction: {effort_nm: 10}, viscous_friction: {coefficient_nmsprad: 3}, "
                   "stribeck_friction: {excess_nm: 2}, asymmetric_friction: {positive_nm: 2}, "
                   "payload: {mass_kg: 10, x_m: 1}",
                   {"levers=[]", "joints.lift.max_effort_nm=0"}),
            "");
}

TEST(ActuationFaults, SagNeedsAnEffortAndNoLever) {
  EXPECT_EQ(OfLift("sag: {drift_radps: 0.1}", {"levers=[]"}), "");
  EXPECT_THAT(OfLift("sag: {drift_radps: 0.1}", {"joints.lift.max_effort_nm=0"}),
              HasSubstr("sag: is stated at full effort, but max_effort_nm is 0; need more than 0"));
}

TEST(ActuationFaults, AllOfAJointAreReportedNotTheFirstAlone) {
  const std::string text =
      OfLift("sag: {drift_radps: 0.1}, dead_band: {width: 0.1}, cylinder_lever: {reference_rad: 0}",
             {"joints.lift.max_effort_nm=0"});
  EXPECT_THAT(text, AllOf(HasSubstr("sag: "), HasSubstr("dead_band: "), HasSubstr("no cylinder")));
}

/// A lift arm with a track and a pump that feeds `feeds`.
MachineModel TrackedArm(const std::string& effects, const std::vector<std::string>& overrides = {},
                        const std::string& feeds = "[left]") {
  return WithEffects(MachineFromText(kLiftArm + R"(
tracks:
  left: {link: post, center_m: [0, 1, 0.2], wheelbase_m: 1, radius_m: 0.25, width_m: 0.3,
         max_speed_mps: 1, max_torque_nm: 500, inertia_kgm2: 3, displacement_m3prad: 1e-4}
pumps: {one: {max_flow_m3ps: 1e-3, feeds: )" +
                                         feeds + "}}\n",
                                     [&] {
                                       std::vector<std::string> all = {"levers=[lift, left]"};
                                       all.insert(all.end(), overrides.begin(), overrides.end());
                                       return all;
                                     }()),
                     effects);
}

TEST(ActuationFaults, ATrackIsHeldToTheSame) {
  const std::string sag = "left: {sag: {drift_radps: 0.1}, dead_band: {width: 0.1}}";
  EXPECT_THAT(FaultsOfGear(TrackedArm(sag), 0), IsEmpty());
  EXPECT_THAT(Text(FaultsOfGear(TrackedArm(sag, {"tracks.left.max_torque_nm=0"}), 0)),
              AllOf(HasSubstr("sag: is stated at full effort, but max_torque_nm is 0"),
                    HasSubstr("dead_band: shapes a commanded rate")));
  EXPECT_THAT(Text(FaultsOfGear(TrackedArm(sag, {"levers=[lift]"}), 0)),
              HasSubstr("dead_band: shapes a commanded rate, but no lever"));
}

TEST(ActuationFaults, APumpThatFeedsNothingDrivenSharesNothing) {
  const std::string sharing = "one: {flow_sharing: {}, power_limit: {power_w: 1000}}";
  EXPECT_THAT(FaultsOfPump(TrackedArm(sharing), 0), IsEmpty());
  EXPECT_EQ(FaultsOfPump(TrackedArm(sharing, {"levers=[lift]"}), 0).size(), 2u);
  EXPECT_EQ(FaultsOfPump(TrackedArm(sharing, {}, "[]"), 0).size(), 2u);
}

}  // namespace
}  // namespace tera
