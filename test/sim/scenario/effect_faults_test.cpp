#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/faults.h"
#include "own_folder.h"
#include "sim/scenario/scenario_text.h"

// Effects of a scenario that cannot act or are written wrongly, and the places of their faults.

namespace tera {
namespace {

using enum FaultKind;
using ::testing::AllOf;

/// Faults of effects on a rig with one sensor of each kind and two antennas.
std::vector<InputFault> EffectFaults(const std::string& effects, const std::string& more = "") {
  const auto sensor = [](const std::string& name, const std::string& preset,
                         const std::string& place) {
    return "{name: " + name + ", preset: tera:config/sensors/" + preset + ".yaml" + place + "}, ";
  };
  return ScenarioFaults(WithRig(sensor("imu", "xsens_mti_670", ", link: boom") +
                                sensor("left", "rtk_f9p", ", link: upper") +
                                sensor("right", "rtk_f9p", ", link: upper") +
                                sensor("camera", "rgb_640", ", link: upper") +
                                sensor("lidar", "vlp16", ", link: upper") +
                                sensor("encoders", "encoder", "") + more) +
                        "effects: {excavator1: {" + effects + "}}\n");
}

TEST(EffectFaults, TakesEffectsOfEverySensorAndOfOneAxis) {
  EXPECT_THAT(EffectFaults("imu: {bias: {gyro_x_degps: 1}, clock_drift: {drift_ppm: 20}}, "
                           "left: {antenna_swap: {}, antenna_yaw: {yaw_deg: 3}, multipath: {}}, "
                           "camera: {extrinsic: {x_m: 0.1}}, lidar: {range_bias: {range_m: 0.1}}, "
                           "encoders: {latency: {delay_s: 0.1}}, encoders/boom: {axis_flip: {}}, "
                           "encoders/arm: {scale: {rate_factor: 1.1}}"),
              testing::IsEmpty());
}

TEST(EffectFaults, RefusesAMechanismThatASensorCannotHaveAndListsThoseThatItCan) {
  EXPECT_THAT(EffectFaults("imu: {height_datum: {offset_m: 3}}"),
              HasFault(kInconsistent, "effects.excavator1.imu.height_datum"));
  EXPECT_THAT(EffectFaults("lidar: {bias: {}}"), HasFault(kInconsistent, "lidar.bias"));
  EXPECT_THAT(EffectFaults("camera: {filter_delay: {time_constant_s: 1}}"),
              HasFault(kInconsistent, "camera.filter_delay"));
  EXPECT_THAT(EffectFaults("left: {mount_rotation: {}}"),
              HasFault(kInconsistent, "left.mount_rotation"));
  EXPECT_THAT(EffectFaults("encoders/boom: {clock_offset: {offset_s: 18}}"),
              HasFault(kInconsistent, "encoders/boom.clock_offset"));
  EXPECT_THAT(EffectFaults("imu: {clock_ofset: {offset_s: 18}}"),
              HasFault(kUnknown, "imu.clock_ofset"));
}

TEST(EffectFaults, RefusesNumbersOfSensorEffectsOutOfTheirRanges) {
  EXPECT_THAT(EffectFaults("imu: {clock_offset: {offset_s: 180}}"),
              HasFault(kOutOfRange, "effects.excavator1.imu.clock_offset.offset_s"));
  EXPECT_THAT(EffectFaults("imu: {clock_drift: {}}"), HasFault(kMissing, "clock_drift.drift_ppm"));
  EXPECT_THAT(EffectFaults("imu: {axis_flip: {x: 0.5}}"), HasFault(kMistyped, "imu.axis_flip.x"));
  EXPECT_THAT(EffectFaults("left: {outliers: {probability: 1.5}}"),
              HasFault(kOutOfRange, "left.outliers.probability"));
  EXPECT_THAT(EffectFaults("imu: {bias: {gyro_x_radps: 1}}"),
              HasFault(kUnknown, "imu.bias.gyro_x_radps"));
}

TEST(EffectFaults, RefusesEffectsOfAPairOfAntennasThatIsNone) {
  EXPECT_THAT(EffectFaults("left: {antenna_swap: {}}",
                           "{name: third, preset: tera:config/sensors/rtk_f9p.yaml, link: boom}"),
              HasFault(kInconsistent, "effects.excavator1.left.antenna_swap"));
  EXPECT_THAT(EffectFaults("left: {antenna_yaw: {yaw_deg: 1}}, right: {antenna_yaw: {yaw_deg: 1}}"),
              HasFault(kInconsistent));
  EXPECT_THAT(
      ScenarioFaults(WithRig("{name: a, preset: tera:config/sensors/rtk_f9p.yaml, link: upper}, "
                             "{name: b, preset: tera:config/sensors/rtk_f9p.yaml, link: boom}") +
                     "effects: {excavator1: {a: {antenna_yaw: {yaw_deg: 1}}}}\n"),
      HasFault(kInconsistent));
}

/// A learned effect of a joint as a share of its rate over one variable.
std::string LearnedOver(const std::string& variable, const std::string& unit) {
  return "{learned: {variable: " + variable + ", unit: " + unit +
         ", as: share, at: [0, 1], value: [0.1, 0.2], low: [0, 0], high: [1, 1]}}";
}

TEST(EffectFaults, TakesWhatWasLearnedOfJointsAndTracksOverWhatASimulationKnowsThere) {
  EXPECT_THAT(EffectFaults("boom: " + LearnedOver("load/boom", "N m") +
                           ", arm: " + LearnedOver("lever/boom", "1") +
                           ", left_track: " + LearnedOver("rate", "rad/s")),
              testing::IsEmpty());
  EXPECT_THAT(EffectFaults("boom: " + LearnedOver("position/arm", "rad")),
              HasFault(kNoSuchName, "effects.excavator1.boom.learned.variable"));
}

TEST(EffectFaults, RefusesWhatWasLearnedOfWhatNoLeverDrives) {
  EXPECT_THAT(EffectFaults("pump_1: " + LearnedOver("time", "s")),
              HasFaultAt("effects.excavator1.pump_1.learned"));
  EXPECT_THAT(EffectFaults("imu: " + LearnedOver("time", "s")), HasFaultAt("imu.learned"));
}

TEST(EffectFaults, RefusesAnEffectOfAnAxisThatTheEncodersDoNotRead) {
  EXPECT_THAT(EffectFaults("encoders/bom: {axis_flip: {}}"),
              HasFault(kUnknown, "effects.excavator1.encoders/bom"));
}

TEST(EffectFaults, RefusesMultipathOnAMachineWithoutABoom) {
  const std::string mast = R"(
machines:
  - name: mast1
    machine: tera:config/machines/mast.yaml
    operator: {type: idle}
    rig: {sensors: [{name: a, preset: tera:config/sensors/rtk_f9p.yaml, link: mast}]}
effects: {mast1: {a: {multipath: {}}}}
)";
  EXPECT_THAT(ScenarioFaults(kSite + mast), HasFault(kInconsistent, "effects.mast1.a.multipath"));
}

TEST(EffectFaults, RefusesALeverArmOfAnImuThatNeverTurns) {
  const auto faults = [](const std::string& link) {
    return ScenarioFaults(std::string(kSite) + R"(
machines:
  - name: bench
    machine: tera:config/machines/fixed_arm.yaml
    operator: {type: idle}
    rig: {sensors: [{name: i, preset: tera:config/sensors/xsens_mti_670.yaml, link: )" +
                          link + "}]}\neffects: {bench: {i: {imu_lever_arm: {x_m: 0.1}}}}\n");
  };
  EXPECT_THAT(faults("link1"), testing::IsEmpty());
  EXPECT_THAT(faults("base"), HasFault(kInconsistent, "imu_lever_arm"));
}

TEST(EffectFaults, TakesMultipathOnAMachineWithOtherJointNames) {
  EXPECT_THAT(ScenarioFaults(std::string(kSite) + R"(
machines:
  - name: bench
    machine: tera:config/machines/fixed_arm.yaml
    operator: {type: idle}
    rig: {sensors: [{name: a, preset: tera:config/sensors/rtk_f9p.yaml, link: base}]}
effects: {bench: {a: {multipath: {}}}}
)"),
              testing::IsEmpty());
}

TEST(EffectFaults, RefusesTwoSwapsOfOnePair) {
  EXPECT_THAT(EffectFaults("left: {antenna_swap: {}}, right: {antenna_swap: {}}"),
              HasFault(kInconsistent, "left.antenna_swap"));
}

TEST(EffectFaults, RefusesErrorsOfWhatASensorDoesNotMeasure) {
  // rgb_640 has no depth.
  for (const char* effect : {"range_bias: {depth_m: 0.1}", "scale: {depth_factor: 1.1}",
                             "quantisation: {}", "outliers: {probability: 0.1}"}) {
    EXPECT_THAT(EffectFaults(std::string("camera: {") + effect + "}"), HasFault(kInconsistent))
        << effect;
  }
  EXPECT_THAT(EffectFaults("deep: {range_bias: {depth_m: 0.1}}",
                           "{name: deep, preset: tera:config/sensors/rgb_640.yaml, link: upper, "
                           "depth: true}"),
              testing::IsEmpty());
  EXPECT_THAT(EffectFaults("imu: {axis_flip: {}}"),
              HasFault(kInconsistent, "effects.excavator1.imu.axis_flip"));
}

TEST(EffectFaults, RefusesStepsOfASensorBeyondItsLimit) {
  EXPECT_THAT(EffectFaults("imu: {saturation: {}, quantisation: {}}, encoders: {saturation: "
                           "{angle_limit_deg: 90}, quantisation: {angle_step_deg: 90}}"),
              testing::IsEmpty());
  EXPECT_THAT(
      EffectFaults("imu: {saturation: {gyro_limit_degps: 5}, quantisation: {gyro_step_degps: 6}}"),
      HasFault(kOutOfRange, "imu.quantisation"));
  EXPECT_THAT(EffectFaults("encoders: {quantisation: {angle_step_deg: 10}}, "
                           "encoders/boom: {saturation: {angle_limit_deg: 8}}"),
              HasFault(kOutOfRange, "encoders/boom.saturation"));
}

TEST(EffectFaults, RefusesErrorsOfPositionsThatAReceiverDoesNotHave) {
  const auto faults = [](const std::string& fix, const std::string& effects) {
    return ScenarioFaults(
        WithRig("{name: a, preset: tera:config/sensors/rtk_f9p.yaml, link: upper, fix: " + fix +
                "}") +
        "effects: {excavator1: {a: {" + effects + "}}}\n");
  };
  EXPECT_THAT(faults("rtk_fixed", "float_jump: {}"), testing::IsEmpty());
  EXPECT_THAT(faults("single", "float_jump: {}"), HasFault(kInconsistent, "float_jump"));
  EXPECT_THAT(faults("none", "clock_offset: {offset_s: 1}, latency: {delay_s: 0.1}"),
              testing::IsEmpty());
  EXPECT_THAT(
      faults("none", "height_datum: {offset_m: 1}, filter_delay: {time_constant_s: 1}"),
      AllOf(HasFault(kInconsistent, "a.height_datum"), HasFault(kInconsistent, "a.filter_delay")));
}

TEST(EffectFaults, RefusesErrorsOfEncodersInUnitsOfAnotherKindOfAxis) {
  // All axes of the excavator turn.
  EXPECT_THAT(EffectFaults("encoders: {bias: {travel_m: 0.1}}"),
              HasFaultAt("encoders.bias.travel_m"));
  EXPECT_THAT(EffectFaults("encoders/boom: {quantisation: {angle_step_deg: 1, speed_step_mps: 1}}"),
              HasOnlyFault(kInconsistent, "quantisation.speed_step_mps"));
  EXPECT_THAT(EffectFaults("encoders/boom: {outliers: {probability: 0.1}}"), testing::IsEmpty());

  const std::string gantry =
      Gantry("gantry", "{name: e, preset: tera:config/sensors/encoder.yaml}");
  const auto faults = [&](const std::string& effects) {
    return ScenarioFaults(kSite + gantry + "effects: {gantry: {" + effects + "}}\n");
  };
  EXPECT_THAT(faults("e: {bias: {travel_m: 0.1, angle_deg: 1}}"), testing::IsEmpty());
  EXPECT_THAT(faults("e/slide: {bias: {travel_m: 0.1}}, e/turn: {bias: {angle_deg: 1}}"),
              testing::IsEmpty());
  EXPECT_THAT(faults("e/slide: {bias: {angle_deg: 1}}, e/turn: {bias: {speed_mps: 1}}"),
              AllOf(HasFaultAt("e/slide.bias.angle_deg"), HasFaultAt("e/turn.bias.speed_mps")));
}

TEST(EffectFaults, RefusesAllEffectsThatCannotActEachAtItsPlace) {
  const auto faults = EffectFaults(
      "swing: {end_cushion: {zone_rad: 0.1}}, slew: {end_cushion: {zone_rad: 0.1}, "
      "cylinder_lever: {reference_rad: 0}}, arm: {cylinder_lever: {reference_rad: 0, rod_m: 1}}");
  EXPECT_THAT(faults, AllOf(HasFaultAt("effects.excavator1.slew.end_cushion"),
                            HasFaultAt("effects.excavator1.slew.cylinder_lever"),
                            HasFaultAt("effects.excavator1.arm.cylinder_lever"),
                            ::testing::Not(HasFaultAt("swing.end_cushion"))));
  EXPECT_THAT(ScenarioFaults(std::string(kSite) + kExcavator +
                                 "effects: {excavator1: {boom: {dead_band: {width: 0.1}}}}\n",
                             {"machines[0].machine.levers=[left_track, right_track, slew]"}),
              AllOf(HasFaultAt("boom.dead_band"), HasFaultAt("boom.actuator_ring"),
                    HasFaultAt("bucket.actuator_ring")));
}

/// A site with the excavator and an overlay of another file's effects.
std::vector<InputFault> OverlayFaults(const std::string& overlay,
                                      const std::vector<std::string>& overrides) {
  const std::filesystem::path& folder = OwnFolder();
  std::ofstream(folder / "s.yaml")
      << kSite << kExcavator << "effects: {excavator1: {boom: {command_delay: {delay_s: 0.1}}}}\n";
  std::ofstream(folder / "over.yaml") << "effects:\n  excavator1:\n    " << overlay << "\n";
  return FaultsIn([&] {
    const Config config =
        Config::FromFile(folder / "s.yaml", overrides, {{folder / "over.yaml", "effects"}});
    ReadScenario(config.root());
    config.Finish();
  });
}

TEST(EffectFaults, AreToldAtTheKeyThatTheUserWroteWhereverThatWas) {
  EXPECT_THAT(ScenarioFaults(std::string(kSite) + kExcavator +
                             "effects: {excavator1: {boom: {dead_band: {width: 2}}}}\n"),
              HasOnlyFault(kOutOfRange, "s.yaml:10:50: effects.excavator1.boom.dead_band.width"));
  EXPECT_THAT(OverlayFaults("boom: {dead_band: {width: 2}}", {}),
              HasOnlyFault(kOutOfRange, "over.yaml:3:31: effects.excavator1.boom.dead_band.width"));
  EXPECT_THAT(OverlayFaults("{}", {"effects.excavator1.boom.dead_band.width=2"}),
              HasOnlyFault(kOutOfRange, "--set: effects.excavator1.boom.dead_band.width"));
  EXPECT_THAT(OverlayFaults("{}", {"machines[0].machine.effects.boom.dead_band.width=2"}),
              HasOnlyFault(kOutOfRange, "--set: machines[0].machine.effects.boom.dead_band.width"));
  EXPECT_THAT(OverlayFaults("bom: {dead_band: {width: 2}}", {}),
              HasOnlyFault(kUnknown, "over.yaml:3:5: effects.excavator1.bom"));
  // One effect at two places, with a fault at each.
  EXPECT_THAT(OverlayFaults("boom: {dead_band: {width: 0.3}}",
                            {"effects.excavator1.boom.dead_band.asymmetry=2"}),
              HasOnlyFault(kOutOfRange, "--set: effects.excavator1.boom.dead_band.asymmetry"));
  // Faults found later, by checks of the machine.
  EXPECT_THAT(OverlayFaults("slew: {end_cushion: {zone_rad: 0.1}}", {}),
              HasFaultAt("over.yaml:3:25: effects.excavator1.slew.end_cushion"));
  EXPECT_THAT(OverlayFaults("base: {track_slip: {slip: 0.1}}", {}),
              HasFaultAt("over.yaml:3:24: effects.excavator1.base.track_slip"));
}

TEST(EffectFaults, OfAValueInPlaceOfAMappingSayWhatBelongsThere) {
  const auto faults = [](const std::string& override) { return OverlayFaults("{}", {override}); };
  EXPECT_THAT(faults("effects.excavator1.boom.dead_band=0.1"),
              HasFaultAt("--set: effects.excavator1.boom.dead_band"));
  EXPECT_THAT(faults("effects.excavator1.boom=0.1"), HasFaultAt("--set: effects.excavator1.boom"));
  EXPECT_THAT(faults("effects.excavator1=none"), HasFaultAt("--set: effects.excavator1"));
  EXPECT_THAT(faults("effects=0.1"), HasFaultAt("--set: effects"));
  EXPECT_THAT(faults("effects.excavator1.boom=[1]"), HasFault(kMistyped, "boom"));
}

TEST(EffectFaults, RefuseToTakeAwayWhatIsNotThere) {
  EXPECT_THAT(OverlayFaults("boom: {command_delay: none}", {}),
              testing::IsEmpty());  // the scenario's
  EXPECT_THAT(OverlayFaults("boom: {actuator_ring: none}", {}),
              testing::IsEmpty());  // the machine's
  EXPECT_THAT(OverlayFaults("boom: {dead_band: none}", {}),
              HasFaultAt("over.yaml:3:23: effects.excavator1.boom.dead_band"));
  EXPECT_THAT(OverlayFaults("{}", {"effects.excavator1.boom.dead_band=none"}),
              HasFaultAt("--set: effects.excavator1.boom.dead_band"));
}

TEST(EffectFaults, RefusesSlipsThatLeaveNothingOfTheTracksSpeed) {
  const auto faults = [](const std::string& effects) {
    return ScenarioFaults(std::string(kSite) + kExcavator +
                          "    ground: kinematic\neffects: {excavator1: {base: {" + effects +
                          "}}}\n");
  };
  const std::string slope = "slope_slip: {slip: 0.5, slip_per_slope: 0}";
  EXPECT_THAT(faults("track_slip: {slip: 0.49}, " + slope), testing::IsEmpty());
  EXPECT_THAT(faults("track_slip: {slip: 0.5}, " + slope),
              HasFaultAt("effects.excavator1.base.slope_slip"));
  // Resistance beyond the friction of Janosi and Hanamoto's law spins the tracks on the spot.
  const std::string resistance = "rolling_resistance: {coefficient: 0.3}";
  EXPECT_THAT(faults("track_slip: {shear_modulus_m: 0.02, friction: 0.5}, " + resistance),
              testing::IsEmpty());
  EXPECT_THAT(faults("track_slip: {shear_modulus_m: 0.02, friction: 0.3}, " + resistance),
              HasFaultAt("base.rolling_resistance"));
}

TEST(EffectFaults, RefusesRaisedGroundBeyondTheSite) {
  const auto faults = [](const std::string& place) {
    return ScenarioFaults(std::string(kSite) + kExcavator +
                          "effects: {excavator1: {base: "
                          "{terrain_height: {" +
                          place + ", height_m: 0.2, edge_m: 1}}}}\n");
  };
  // The site reaches from -6 to 6 m.
  EXPECT_THAT(faults("x_m: 8, y_m: 0, radius_m: 1.5"), testing::IsEmpty());
  EXPECT_THAT(faults("x_m: 8.5, y_m: 0, radius_m: 1"),
              HasFaultAt("effects.excavator1.base.terrain_height"));
}

}  // namespace
}  // namespace tera
