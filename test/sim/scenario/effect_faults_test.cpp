#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "own_folder.h"
#include "sim/scenario/scenario_text.h"

// Effects of a scenario that cannot act, or that are written wrongly, and where that is said.

namespace tera {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// Faults of effects on a rig with one sensor of each kind and two antennas.
std::string EffectFaults(const std::string& effects, const std::string& more = "") {
  const auto sensor = [](const std::string& name, const std::string& preset,
                         const std::string& place) {
    return "{name: " + name + ", preset: tera:config/sensors/" + preset + ".yaml" + place + "}, ";
  };
  return FaultsOf(WithRig(sensor("imu", "xsens_mti_670", ", link: boom") +
                          sensor("left", "rtk_f9p", ", link: upper") +
                          sensor("right", "rtk_f9p", ", link: upper") +
                          sensor("camera", "rgb_640", ", link: upper") +
                          sensor("lidar", "vlp16", ", link: upper") +
                          sensor("encoders", "encoder", "") + more) +
                  "effects: {excavator1: {" + effects + "}}\n");
}

TEST(EffectFaults, TakesEffectsOfEverySensorAndOfOneAxis) {
  EXPECT_EQ(EffectFaults("imu: {bias: {gyro_x_degps: 1}, clock_drift: {drift_ppm: 20}}, "
                         "left: {antenna_swap: {}, antenna_yaw: {yaw_deg: 3}, multipath: {}}, "
                         "camera: {extrinsic: {x_m: 0.1}}, lidar: {range_bias: {range_m: 0.1}}, "
                         "encoders: {latency: {delay_s: 0.1}}, encoders/boom: {axis_flip: {}}, "
                         "encoders/arm: {scale: {rate_factor: 1.1}}"),
            "");
}

TEST(EffectFaults, RefusesAMechanismThatASensorCannotHaveAndListsThoseThatItCan) {
  EXPECT_THAT(
      EffectFaults("imu: {height_datum: {offset_m: 3}}"),
      AllOf(HasSubstr("effects.excavator1.imu.height_datum: 'height_datum' does not act on this "
                      "target, an imu; those that do: mount_rotation, axis_flip"),
            HasSubstr("filter_delay")));
  EXPECT_THAT(EffectFaults("lidar: {bias: {}}"), HasSubstr("a lidar; those that do: extrinsic"));
  EXPECT_THAT(EffectFaults("camera: {filter_delay: {time_constant_s: 1}}"), HasSubstr("a camera"));
  EXPECT_THAT(EffectFaults("left: {mount_rotation: {}}"), HasSubstr("a gnss; those that do"));
  EXPECT_THAT(EffectFaults("encoders/boom: {clock_offset: {offset_s: 18}}"),
              HasSubstr("one axis of a set of encoders; those that do: axis_flip, bias"));
  EXPECT_THAT(EffectFaults("imu: {clock_ofset: {offset_s: 18}}"),
              HasSubstr("unknown key (did you mean 'clock_offset'?)"));
}

TEST(EffectFaults, RefusesNumbersOfSensorEffectsOutOfTheirRanges) {
  EXPECT_THAT(
      EffectFaults("imu: {clock_offset: {offset_s: 180}}"),
      HasSubstr(
          "effects.excavator1.imu.clock_offset.offset_s: 180 is out of range, need -60 to 60 s"));
  EXPECT_THAT(EffectFaults("imu: {clock_drift: {}}"), HasSubstr("clock_drift.drift_ppm: missing"));
  EXPECT_THAT(EffectFaults("imu: {axis_flip: {x: 0.5}}"), HasSubstr("not a whole number"));
  EXPECT_THAT(EffectFaults("left: {outliers: {probability: 1.5}}"), HasSubstr("need 0 to 1"));
  EXPECT_THAT(EffectFaults("imu: {bias: {gyro_x_radps: 1}}"),
              HasSubstr("imu.bias.gyro_x_radps: unknown key"));
}

TEST(EffectFaults, RefusesEffectsOfAPairOfAntennasThatIsNone) {
  EXPECT_THAT(
      EffectFaults("left: {antenna_swap: {}}",
                   "{name: third, preset: tera:config/sensors/rtk_f9p.yaml, link: boom}"),
      HasSubstr(
          "effects.excavator1.left.antenna_swap: 'antenna_swap' acts on a pair; need exactly two"));
  EXPECT_THAT(EffectFaults("left: {antenna_yaw: {yaw_deg: 1}}, right: {antenna_yaw: {yaw_deg: 1}}"),
              HasSubstr("acts on both antennas and stands at 'right' too; keep one"));
  EXPECT_THAT(FaultsOf(WithRig("{name: a, preset: tera:config/sensors/rtk_f9p.yaml, link: upper}, "
                               "{name: b, preset: tera:config/sensors/rtk_f9p.yaml, link: boom}") +
                       "effects: {excavator1: {a: {antenna_yaw: {yaw_deg: 1}}}}\n"),
              HasSubstr("'a' is on 'upper' and 'b' on 'boom'; need both on one link"));
}

/// What was learned of a joint as a share of its rate over one variable.
std::string LearnedOver(const std::string& variable, const std::string& unit) {
  return "{learned: {variable: " + variable + ", unit: " + unit +
         ", as: share, at: [0, 1], value: [0.1, 0.2], low: [0, 0], high: [1, 1]}}";
}

TEST(EffectFaults, TakesWhatWasLearnedOfJointsAndTracksOverWhatASimulationKnowsThere) {
  EXPECT_EQ(EffectFaults("boom: " + LearnedOver("load/boom", "N m") +
                         ", arm: " + LearnedOver("lever/boom", "1") +
                         ", left_track: " + LearnedOver("rate", "rad/s")),
            "");
  EXPECT_THAT(EffectFaults("boom: " + LearnedOver("position/arm", "rad")),
              AllOf(HasSubstr("effects.excavator1.boom.learned.variable: 'position/arm' is no "
                              "variable that a simulation knows here, need one of lever/"),
                    HasSubstr("position/boom, load/boom, rate, time")));
}

TEST(EffectFaults, RefusesWhatWasLearnedOfWhatNoLeverDrives) {
  EXPECT_THAT(EffectFaults("pump_1: " + LearnedOver("time", "s")),
              HasSubstr("effects.excavator1.pump_1.learned: 'learned' does not act on this target, "
                        "a pump; it acts on a joint, a track or a wheel set"));
  EXPECT_THAT(EffectFaults("imu: " + LearnedOver("time", "s")),
              HasSubstr("imu.learned: 'learned' does not act on this target, an imu"));
}

TEST(EffectFaults, RefusesAnEffectOfAnAxisThatTheEncodersDoNotRead) {
  EXPECT_THAT(
      EffectFaults("encoders/bom: {axis_flip: {}}"),
      HasSubstr("effects.excavator1.encoders/bom: unknown key (did you mean 'encoders/boom'?)"));
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
  EXPECT_THAT(FaultsOf(kSite + mast),
              AllOf(HasSubstr("effects.mast1.a.multipath: "),
                    HasSubstr("none is beyond link 'mast' or those below it; need such a joint")));
}

TEST(EffectFaults, RefusesALeverArmOfAnImuThatNeverTurns) {
  const auto faults = [](const std::string& link) {
    return FaultsOf(std::string(kSite) + R"(
machines:
  - name: bench
    machine: tera:config/machines/fixed_arm.yaml
    operator: {type: idle}
    rig: {sensors: [{name: i, preset: tera:config/sensors/xsens_mti_670.yaml, link: )" +
                    link + "}]}\neffects: {bench: {i: {imu_lever_arm: {x_m: 0.1}}}}\n");
  };
  EXPECT_EQ(faults("link1"), "");
  EXPECT_THAT(faults("base"), HasSubstr("shows where a link turns, which 'base' cannot"));
}

TEST(EffectFaults, TakesMultipathOnAMachineWithOtherJointNames) {
  EXPECT_EQ(FaultsOf(std::string(kSite) + R"(
machines:
  - name: bench
    machine: tera:config/machines/fixed_arm.yaml
    operator: {type: idle}
    rig: {sensors: [{name: a, preset: tera:config/sensors/rtk_f9p.yaml, link: base}]}
effects: {bench: {a: {multipath: {}}}}
)"),
            "");
}

TEST(EffectFaults, RefusesTwoSwapsOfOnePair) {
  EXPECT_THAT(EffectFaults("left: {antenna_swap: {}}, right: {antenna_swap: {}}"),
              HasSubstr("left.antenna_swap: acts on both antennas and stands at 'right' too"));
}

TEST(EffectFaults, RefusesErrorsOfWhatASensorDoesNotMeasure) {
  // rgb_640 has no depth.
  for (const char* effect : {"range_bias: {depth_m: 0.1}", "scale: {depth_factor: 1.1}",
                             "quantisation: {}", "outliers: {probability: 0.1}"}) {
    EXPECT_THAT(EffectFaults(std::string("camera: {") + effect + "}"),
                HasSubstr("changes depth, which this camera does not give; need depth: true"))
        << effect;
  }
  EXPECT_EQ(EffectFaults("deep: {range_bias: {depth_m: 0.1}}",
                         "{name: deep, preset: tera:config/sensors/rgb_640.yaml, link: upper, "
                         "depth: true}"),
            "");
  EXPECT_THAT(EffectFaults("imu: {axis_flip: {}}"),
              HasSubstr("effects.excavator1.imu.axis_flip: flips no axis; need 1 for x, y or z"));
}

TEST(EffectFaults, RefusesStepsOfASensorBeyondItsLimit) {
  EXPECT_EQ(EffectFaults("imu: {saturation: {}, quantisation: {}}, encoders: {saturation: "
                         "{angle_limit_deg: 90}, quantisation: {angle_step_deg: 90}}"),
            "");
  EXPECT_THAT(
      EffectFaults("imu: {saturation: {gyro_limit_degps: 5}, quantisation: {gyro_step_degps: 6}}"),
      HasSubstr("imu.quantisation: gyro_step_degps 6 of quantisation is beyond gyro_limit_degps 5 "
                "of saturation, which leaves no value between; need a step of at most the limit"));
  EXPECT_THAT(EffectFaults("encoders: {quantisation: {angle_step_deg: 10}}, "
                           "encoders/boom: {saturation: {angle_limit_deg: 8}}"),
              HasSubstr("encoders/boom.saturation: angle_step_deg 10 of quantisation is beyond"));
}

TEST(EffectFaults, RefusesErrorsOfPositionsThatAReceiverDoesNotHave) {
  const auto faults = [](const std::string& fix, const std::string& effects) {
    return FaultsOf(
        WithRig("{name: a, preset: tera:config/sensors/rtk_f9p.yaml, link: upper, fix: " + fix +
                "}") +
        "effects: {excavator1: {a: {" + effects + "}}}\n");
  };
  EXPECT_EQ(faults("rtk_fixed", "float_jump: {}"), "");
  EXPECT_THAT(faults("single", "float_jump: {}"),
              HasSubstr("this receiver has single; need fix: rtk_fixed"));
  EXPECT_EQ(faults("none", "clock_offset: {offset_s: 1}, latency: {delay_s: 0.1}"), "");
  EXPECT_THAT(faults("none", "height_datum: {offset_m: 1}, filter_delay: {time_constant_s: 1}"),
              AllOf(HasSubstr("a.height_datum: changes positions"),
                    HasSubstr("a.filter_delay: changes positions")));
}

TEST(EffectFaults, RefusesErrorsOfEncodersInUnitsOfAnotherKindOfAxis) {
  // All axes of the excavator turn.
  EXPECT_THAT(EffectFaults("encoders: {bias: {travel_m: 0.1}}"),
              HasSubstr("encoders.bias.travel_m: is in m, but no axis here slides; need the "
                        "parameter in degrees"));
  EXPECT_THAT(EffectFaults("encoders/boom: {quantisation: {angle_step_deg: 1, speed_step_mps: 1}}"),
              AllOf(HasSubstr("quantisation.speed_step_mps: is in m/s"),
                    ::testing::Not(HasSubstr("angle_step_deg"))));
  EXPECT_EQ(EffectFaults("encoders/boom: {outliers: {probability: 0.1}}"), "");

  const std::string gantry =
      Gantry("gantry", "{name: e, preset: tera:config/sensors/encoder.yaml}");
  const auto faults = [&](const std::string& effects) {
    return FaultsOf(kSite + gantry + "effects: {gantry: {" + effects + "}}\n");
  };
  EXPECT_EQ(faults("e: {bias: {travel_m: 0.1, angle_deg: 1}}"), "");
  EXPECT_EQ(faults("e/slide: {bias: {travel_m: 0.1}}, e/turn: {bias: {angle_deg: 1}}"), "");
  EXPECT_THAT(faults("e/slide: {bias: {angle_deg: 1}}, e/turn: {bias: {speed_mps: 1}}"),
              AllOf(HasSubstr("e/slide.bias.angle_deg: is in deg, but no axis here turns"),
                    HasSubstr("e/turn.bias.speed_mps: is in m/s, but no axis here slides")));
}

TEST(EffectFaults, RefusesAllEffectsThatCannotActEachAtItsPlace) {
  const std::string faults = EffectFaults(
      "swing: {end_cushion: {zone_rad: 0.1}}, slew: {end_cushion: {zone_rad: 0.1}, "
      "cylinder_lever: {reference_rad: 0}}, arm: {cylinder_lever: {reference_rad: 0, rod_m: 1}}");
  EXPECT_THAT(faults,
              AllOf(HasSubstr("effects.excavator1.slew.end_cushion: 'end_cushion' slows a joint"),
                    HasSubstr("effects.excavator1.slew.cylinder_lever: 'cylinder_lever' needs"),
                    HasSubstr("effects.excavator1.arm.cylinder_lever: "),
                    ::testing::Not(HasSubstr("swing"))));
  EXPECT_THAT(FaultsOf(std::string(kSite) + kExcavator +
                           "effects: {excavator1: {boom: {dead_band: {width: 0.1}}}}\n",
                       {"machines[0].machine.levers=[left_track, right_track, slew]"}),
              AllOf(HasSubstr("boom.dead_band: 'dead_band' shapes a commanded rate, but no lever"),
                    HasSubstr("boom.actuator_ring: "), HasSubstr("bucket.actuator_ring: ")));
}

/// A site with the excavator and another file's effects over it.
std::string OverlayFaults(const std::string& overlay, const std::vector<std::string>& overrides) {
  const std::filesystem::path& folder = OwnFolder();
  std::ofstream(folder / "s.yaml")
      << kSite << kExcavator << "effects: {excavator1: {boom: {command_delay: {delay_s: 0.1}}}}\n";
  std::ofstream(folder / "over.yaml") << "effects:\n  excavator1:\n    " << overlay << "\n";
  try {
    const Config config =
        Config::FromFile(folder / "s.yaml", overrides, {{folder / "over.yaml", "effects"}});
    ReadScenario(config.root());
    config.Finish();
  } catch (const InputError& e) {
    std::string faults = e.what();
    for (auto at = faults.find(folder.string()); at != faults.npos;
         at = faults.find(folder.string())) {
      faults.erase(at, folder.string().size() + 1);
    }
    return faults;
  }
  return "";
}

TEST(EffectFaults, AreToldAtTheKeyThatTheUserWroteWhereverThatWas) {
  EXPECT_EQ(
      FaultsOf(std::string(kSite) + kExcavator +
               "effects: {excavator1: {boom: {dead_band: {width: 2}}}}\n"),
      "s.yaml:10:50: effects.excavator1.boom.dead_band.width: 2 is out of range, need 0 to 0.9");
  EXPECT_EQ(
      OverlayFaults("boom: {dead_band: {width: 2}}", {}),
      "over.yaml:3:31: effects.excavator1.boom.dead_band.width: 2 is out of range, need 0 to 0.9");
  EXPECT_EQ(OverlayFaults("{}", {"effects.excavator1.boom.dead_band.width=2"}),
            "--set: effects.excavator1.boom.dead_band.width: 2 is out of range, need 0 to 0.9");
  EXPECT_EQ(
      OverlayFaults("{}", {"machines[0].machine.effects.boom.dead_band.width=2"}),
      "--set: machines[0].machine.effects.boom.dead_band.width: 2 is out of range, need 0 to 0.9");
  EXPECT_EQ(OverlayFaults("bom: {dead_band: {width: 2}}", {}),
            "over.yaml:3:5: effects.excavator1.bom: unknown key (did you mean 'boom'?)");
  // Of one effect from two places, each at its own.
  EXPECT_EQ(OverlayFaults("boom: {dead_band: {width: 0.3}}",
                          {"effects.excavator1.boom.dead_band.asymmetry=2"}),
            "--set: effects.excavator1.boom.dead_band.asymmetry: 2 is out of range, need -1 to 1");
  // What is found out later, by checks of the machine.
  EXPECT_THAT(
      OverlayFaults("slew: {end_cushion: {zone_rad: 0.1}}", {}),
      StartsWith("over.yaml:3:25: effects.excavator1.slew.end_cushion: 'end_cushion' slows"));
  EXPECT_THAT(
      OverlayFaults("base: {track_slip: {slip: 0.1}}", {}),
      StartsWith("over.yaml:3:24: effects.excavator1.base.track_slip: 'track_slip' acts only"));
}

TEST(EffectFaults, OfAValueInPlaceOfAMappingSayWhatBelongsThere) {
  const auto faults = [](const std::string& override) { return OverlayFaults("{}", {override}); };
  EXPECT_EQ(
      faults("effects.excavator1.boom.dead_band=0.1"),
      "--set: effects.excavator1.boom.dead_band: '0.1' found, need its parameters, {width: 0 to "
      "0.9, asymmetry: -1 to 1}, or none to take it away");
  EXPECT_EQ(faults("effects.excavator1.boom=0.1"),
            "--set: effects.excavator1.boom: '0.1' found, need mechanisms, {MECHANISM: {PARAMETER: "
            "VALUE}}, and none for one to take away");
  EXPECT_THAT(
      faults("effects.excavator1=none"),
      StartsWith(
          "--set: effects.excavator1: 'none' found, need what its effects act on, {TARGET:"));
  EXPECT_THAT(faults("effects=0.1"), StartsWith("--set: effects: '0.1' found, need machines by"));
  EXPECT_THAT(faults("effects.excavator1.boom=[1]"), HasSubstr("boom: a list of 1 found, need"));
}

TEST(EffectFaults, RefuseToTakeAwayWhatIsNotThere) {
  EXPECT_EQ(OverlayFaults("boom: {command_delay: none}", {}), "");  // the scenario's
  EXPECT_EQ(OverlayFaults("boom: {actuator_ring: none}", {}), "");  // the machine's
  EXPECT_THAT(
      OverlayFaults("boom: {dead_band: none}", {}),
      StartsWith(
          "over.yaml:3:23: effects.excavator1.boom.dead_band: 'none' takes away an effect of a "
          "lower layer"));
  EXPECT_THAT(OverlayFaults("{}", {"effects.excavator1.boom.dead_band=none"}),
              StartsWith("--set: effects.excavator1.boom.dead_band: 'none' takes away"));
}

TEST(EffectFaults, RefusesSlipsThatLeaveNothingOfTheTracksSpeed) {
  const auto faults = [](const std::string& effects) {
    return FaultsOf(std::string(kSite) + kExcavator +
                    "    ground: kinematic\neffects: {excavator1: {base: {" + effects + "}}}\n");
  };
  const std::string slope = "slope_slip: {slip: 0.5, slip_per_slope: 0}";
  EXPECT_EQ(faults("track_slip: {slip: 0.49}, " + slope), "");
  EXPECT_THAT(faults("track_slip: {slip: 0.5}, " + slope),
              HasSubstr("effects.excavator1.base.slope_slip: 'slope_slip' leaves nothing of the "
                        "tracks' speed on level ground, so that the machine never moves; need "
                        "slips of track_slip, slope_slip below 1 in sum, or more friction"));
  // Resistance beyond the friction of Janosi and Hanamoto's law spins the tracks on the spot.
  const std::string resistance = "rolling_resistance: {coefficient: 0.3}";
  EXPECT_EQ(faults("track_slip: {shear_modulus_m: 0.02, friction: 0.5}, " + resistance), "");
  EXPECT_THAT(faults("track_slip: {shear_modulus_m: 0.02, friction: 0.3}, " + resistance),
              HasSubstr("base.rolling_resistance: 'rolling_resistance' leaves nothing of the "));
}

TEST(EffectFaults, RefusesRaisedGroundBeyondTheSite) {
  const auto faults = [](const std::string& place) {
    return FaultsOf(std::string(kSite) + kExcavator +
                    "effects: {excavator1: {base: "
                    "{terrain_height: {" +
                    place + ", height_m: 0.2, edge_m: 1}}}}\n");
  };
  // The site reaches from -6 to 6 m.
  EXPECT_EQ(faults("x_m: 8, y_m: 0, radius_m: 1.5"), "");
  EXPECT_THAT(faults("x_m: 8.5, y_m: 0, radius_m: 1"),
              HasSubstr("effects.excavator1.base.terrain_height: 'terrain_height' raises ground "
                        "beyond the site alone; need a place "
                        "within 2 m of x -6 to 6 m, y -6 to 6 m"));
}

}  // namespace
}  // namespace tera
