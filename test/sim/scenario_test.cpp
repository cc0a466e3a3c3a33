#include "sim/scenario.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/config.h"
#include "core/error.h"
#include "core/units.h"

namespace tera {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char* kSite = R"(
name: test
duration_s: 1
terrain: {size_m: [12, 12], cell_m: 0.1, soil: dirt}
)";

constexpr const char* kExcavator = R"(
machines:
  - name: excavator1
    machine: tera:config/machines/tb235.yaml
    operator: {type: idle}
)";

/// What is wrong with a scenario, or nothing.
std::string FaultsOf(const std::string& yaml, const std::vector<std::string>& overrides = {}) {
  try {
    const Config config = Config::FromText(yaml, "s.yaml", overrides);
    ReadScenario(config.root());
    config.Finish();
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

std::string WithRig(const std::string& sensors) {
  return std::string(kSite) + kExcavator + "    rig: {sensors: [" + sensors + "]}\n";
}

TEST(ReadScenario, AcceptsTheSmallestOne) {
  EXPECT_EQ(FaultsOf(std::string(kSite) + kExcavator), "");
}

TEST(ReadScenario, RefusesAnUnknownKeyWithItsPlace) {
  EXPECT_EQ(FaultsOf(std::string(kSite) + "phisics_rate_hz: 500\n" + kExcavator),
            "s.yaml:5:1: phisics_rate_hz: unknown key (did you mean 'physics_rate_hz'?)");
}

TEST(ReadScenario, RefusesTwoSensorsWithOneName) {
  const std::string imu = "{name: imu, preset: tera:config/sensors/xsens_mti_670.yaml, link: boom}";
  EXPECT_THAT(FaultsOf(WithRig(imu + ", " + imu)),
              AllOf(HasSubstr("s.yaml:10:"), HasSubstr("machines[0].rig.sensors[1].name: 'imu' is "
                                                       "taken by another sensor")));
}

TEST(ReadScenario, RefusesASensorOnALinkThatIsNotThere) {
  EXPECT_THAT(
      FaultsOf(WithRig("{name: imu, preset: tera:config/sensors/xsens_mti_670.yaml, link: bom}")),
      AllOf(HasSubstr("machines[0].rig.sensors[0].link"),
            HasSubstr("has no link 'bom' (did you mean 'boom'?)")));
}

TEST(ReadScenario, RefusesASensorWithoutARate) {
  EXPECT_THAT(FaultsOf(WithRig("{name: imu, preset: tera:config/sensors/xsens_mti_670.yaml, "
                               "link: boom, rate_hz: 0}")),
              HasSubstr("rate_hz: 0 is out of range, need more than 0"));
}

TEST(ReadScenario, RefusesAnEncoderOnAJointThatIsNotThere) {
  EXPECT_THAT(
      FaultsOf(WithRig("{name: e, preset: tera:config/sensors/encoder.yaml, joints: [elbow]}")),
      HasSubstr("no joint, track or wheel 'elbow'"));
}

TEST(ReadScenario, RefusesAMachineFileThatIsNotThere) {
  EXPECT_THAT(FaultsOf(std::string(kSite) + kExcavator, {"machines[0].machine=nowhere.yaml"}),
              HasSubstr("file 'nowhere.yaml' does not exist"));
}

TEST(ReadScenario, RefusesANegativeMassInTheMachineFile) {
  EXPECT_THAT(
      FaultsOf(std::string(kSite) + kExcavator, {"machines[0].machine.links.boom.mass_kg=-3"}),
      HasSubstr("machines[0].machine.links.boom.mass_kg: -3 is out of range"));
}

TEST(ReadScenario, RefusesAMissingMesh) {
  EXPECT_THAT(FaultsOf(std::string(kSite) + kExcavator +
                       "obstacles: [{name: r, label: rock, mesh: no.glb, xy_m: [1, 1]}]\n"),
              AllOf(HasSubstr("obstacles[0].mesh"), HasSubstr("'no.glb' does not exist")));
}

TEST(ReadScenario, RefusesAnUnreadableGeoTiff) {
  EXPECT_THAT(FaultsOf(std::string(kSite) + kExcavator, {"terrain.geotiff=LICENSE"}),
              HasSubstr("terrain.geotiff"));
}

TEST(ReadScenario, RefusesNamesThatAreUsedTwiceOrAreNoFolders) {
  const std::string cone = ", label: cone, mesh: tera:assets/cone.glb, xy_m: [1, 1]}";
  EXPECT_THAT(FaultsOf(std::string(kSite) + kExcavator + "obstacles: [{name: excavator1" + cone +
                       ", {name: a/b" + cone + "]\n"),
              AllOf(HasSubstr("name 'excavator1' is used twice"),
                    HasSubstr("obstacles[1].name: name 'a/b' cannot name a folder")));
}

TEST(ReadScenario, RefusesMachineNamesThatLeaveTheDataset) {
  for (const char* name : {"..", ".", "''", "a b", "a,b", "/tmp/a"}) {
    EXPECT_THAT(
        FaultsOf(std::string(kSite) + kExcavator, {std::string("machines[0].name=") + name}),
        HasSubstr("--set: machines[0].name: "))
        << name;
  }
  EXPECT_THAT(FaultsOf(std::string(kSite) + kExcavator, {"machines[0].name=truth"}),
              HasSubstr("name 'truth' is a folder that every dataset has"));
}

TEST(ReadScenario, RefusesStartAnglesBeyondTheLimits) {
  EXPECT_THAT(FaultsOf(std::string(kSite) + kExcavator,
                       {"machines[0].start.joints_deg={boom: 100, elbow: 3}"}),
              AllOf(HasSubstr("'boom' at 100 deg is beyond its limits"),
                    HasSubstr("has no joint 'elbow'")));
}

TEST(ReadScenario, RefusesASiteWithoutMachines) {
  EXPECT_THAT(FaultsOf(kSite), HasSubstr("no machine given"));
}

TEST(ReadScenario, SetsAMachineOnASlope) {
  const Config config = Config::FromText(std::string(kSite) + kExcavator, "s.yaml",
                                         {"terrain.relief={slope_deg: 10, slope_direction_deg: 0}",
                                          "machines[0].start={yaw_deg: 90}"});
  const Scenario scenario = ReadScenario(config.root());
  config.Finish();
  const TerrainSurface& ground = scenario.soil->surface();
  const Pose& X_WB = scenario.machines[0].placement.X_WB;
  EXPECT_NEAR(std::acos(X_WB.linear().col(2).dot(ground.NormalAt(0, 0))), 0.0, 0.5 * kDeg);
  EXPECT_NEAR(std::acos(X_WB.linear()(2, 2)), 10 * kDeg, 0.5 * kDeg);
}

TEST(ReadScenario, ResolvedScenarioReadsTheSameAgain) {
  const Config config =
      Config::FromFile("config/scenarios/quickstart.yaml", {"terrain.cell_m=0.2"});
  ReadScenario(config.root());
  config.Finish();
  const std::string resolved = config.ResolvedYaml();
  const Config again = Config::FromText(resolved, "resolved.yaml");
  const Scenario scenario = ReadScenario(again.root());
  again.Finish();
  EXPECT_EQ(again.ResolvedYaml(), resolved);
  EXPECT_EQ(scenario.machines[0].sensors.size(), 11u);
}

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

TEST(ReadScenario, TakesEffectsOfEverySensorAndOfOneAxis) {
  EXPECT_EQ(EffectFaults("imu: {bias: {gyro_x_degps: 1}, clock_drift: {drift_ppm: 20}}, "
                         "left: {antenna_swap: {}, antenna_yaw: {yaw_deg: 3}, multipath: {}}, "
                         "camera: {extrinsic: {x_m: 0.1}}, lidar: {range_bias: {range_m: 0.1}}, "
                         "encoders: {latency: {delay_s: 0.1}}, encoders/boom: {axis_flip: {}}, "
                         "encoders/arm: {scale: {rate_factor: 1.1}}"),
            "");
}

TEST(ReadScenario, RefusesAMechanismThatASensorCannotHaveAndListsThoseThatItCan) {
  EXPECT_THAT(EffectFaults("imu: {height_datum: {offset_m: 3}}"),
              AllOf(HasSubstr("effects.imu.height_datum: 'height_datum' does not act on this "
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

TEST(ReadScenario, RefusesNumbersOfSensorEffectsOutOfTheirRanges) {
  EXPECT_THAT(
      EffectFaults("imu: {clock_offset: {offset_s: 180}}"),
      HasSubstr("effects.imu.clock_offset.offset_s: 180 is out of range, need -40 to 40 s"));
  EXPECT_THAT(EffectFaults("imu: {clock_drift: {}}"), HasSubstr("clock_drift.drift_ppm: missing"));
  EXPECT_THAT(EffectFaults("imu: {axis_flip: {x: 0.5}}"), HasSubstr("not a whole number"));
  EXPECT_THAT(EffectFaults("left: {outliers: {probability: 1.5}}"), HasSubstr("need 0 to 1"));
  EXPECT_THAT(EffectFaults("imu: {bias: {gyro_x_radps: 1}}"),
              HasSubstr("imu.bias.gyro_x_radps: unknown key"));
}

TEST(ReadScenario, RefusesEffectsOfAPairOfAntennasThatIsNone) {
  EXPECT_THAT(
      EffectFaults("left: {antenna_swap: {}}",
                   "{name: third, preset: tera:config/sensors/rtk_f9p.yaml, link: boom}"),
      HasSubstr("effects.left.antenna_swap: 'antenna_swap' acts on a pair; need exactly two"));
  EXPECT_THAT(EffectFaults("left: {antenna_yaw: {yaw_deg: 1}}, right: {antenna_yaw: {yaw_deg: 1}}"),
              HasSubstr("acts on both antennas and stands at 'right' too; keep one"));
  EXPECT_THAT(FaultsOf(WithRig("{name: a, preset: tera:config/sensors/rtk_f9p.yaml, link: upper}, "
                               "{name: b, preset: tera:config/sensors/rtk_f9p.yaml, link: boom}") +
                       "effects: {excavator1: {a: {antenna_yaw: {yaw_deg: 1}}}}\n"),
              HasSubstr("'a' is on 'upper' and 'b' on 'boom'; need both on one link"));
}

TEST(ReadScenario, RefusesAnEffectOfAnAxisThatTheEncodersDoNotRead) {
  EXPECT_THAT(EffectFaults("encoders/bom: {axis_flip: {}}"),
              HasSubstr("effects.encoders/bom: unknown key (did you mean 'encoders/boom'?)"));
}

TEST(ReadScenario, RefusesMultipathOnAMachineWithoutABoom) {
  const std::string mast = R"(
machines:
  - name: mast1
    machine: tera:config/machines/mast.yaml
    operator: {type: idle}
    rig: {sensors: [{name: a, preset: tera:config/sensors/rtk_f9p.yaml, link: mast}]}
effects: {mast1: {a: {multipath: {}}}}
)";
  EXPECT_THAT(FaultsOf(kSite + mast),
              AllOf(HasSubstr("effects.a.multipath: "),
                    HasSubstr("none is beyond link 'mast' or those below it; need such a joint")));
}

TEST(ReadScenario, RefusesALeverArmOfAnImuThatNeverTurns) {
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

TEST(ReadScenario, TakesMultipathOnAMachineWithOtherJointNames) {
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

TEST(ReadScenario, RefusesTwoSwapsOfOnePair) {
  EXPECT_THAT(EffectFaults("left: {antenna_swap: {}}, right: {antenna_swap: {}}"),
              HasSubstr("left.antenna_swap: acts on both antennas and stands at 'right' too"));
}

TEST(ReadScenario, RefusesErrorsOfWhatASensorDoesNotMeasure) {
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
              HasSubstr("effects.imu.axis_flip: flips no axis; need 1 for x, y or z"));
}

TEST(ReadScenario, RefusesErrorsOfPositionsThatAReceiverDoesNotHave) {
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

TEST(ReadScenario, RefusesErrorsOfEncodersInUnitsOfAnotherKindOfAxis) {
  // All axes of the excavator turn.
  EXPECT_THAT(EffectFaults("encoders: {bias: {travel_m: 0.1}}"),
              HasSubstr("encoders.bias.travel_m: is in m, but no axis here slides; need the "
                        "parameter in degrees"));
  EXPECT_THAT(EffectFaults("encoders/boom: {quantisation: {angle_step_deg: 1, speed_step_mps: 1}}"),
              AllOf(HasSubstr("quantisation.speed_step_mps: is in m/s"),
                    ::testing::Not(HasSubstr("angle_step_deg"))));
  EXPECT_EQ(EffectFaults("encoders/boom: {outliers: {probability: 0.1}}"), "");

  const std::string gantry = R"(
machines:
  - name: gantry
    machine:
      kind: gantry
      fixed_base: true
      links:
        base: {mass_kg: 100, inertia_kgm2: [1, 1, 1]}
        trolley: {mass_kg: 10, inertia_kgm2: [1, 1, 1]}
        arm: {mass_kg: 5, com_m: [0.5, 0, 0], inertia_kgm2: [1, 1, 1]}
      joints:
        slide: {type: prismatic, parent: base, child: trolley, xyz_m: [0, 0, 2], axis: [1, 0, 0],
                limits_m: [0, 3], max_rate_mps: 1, max_effort_n: 500}
        turn: {type: revolute, parent: trolley, child: arm, axis: [0, -1, 0],
               limits_deg: [-90, 90], max_rate_degps: 30, max_effort_nm: 500}
      levers: [slide, turn]
    operator: {type: idle}
    rig: {sensors: [{name: e, preset: tera:config/sensors/encoder.yaml}]}
)";
  const auto faults = [&](const std::string& effects) {
    return FaultsOf(kSite + gantry + "effects: {gantry: {" + effects + "}}\n");
  };
  EXPECT_EQ(faults("e: {bias: {travel_m: 0.1, angle_deg: 1}}"), "");
  EXPECT_EQ(faults("e/slide: {bias: {travel_m: 0.1}}, e/turn: {bias: {angle_deg: 1}}"), "");
  EXPECT_THAT(faults("e/slide: {bias: {angle_deg: 1}}, e/turn: {bias: {speed_mps: 1}}"),
              AllOf(HasSubstr("e/slide.bias.angle_deg: is in deg, but no axis here turns"),
                    HasSubstr("e/turn.bias.speed_mps: is in m/s, but no axis here slides")));
}

TEST(ReadScenario, RefusesAllEffectsThatCannotActEachAtItsPlace) {
  const std::string faults = EffectFaults(
      "swing: {end_cushion: {zone_rad: 0.1}}, slew: {end_cushion: {zone_rad: 0.1}, "
      "cylinder_lever: {reference_rad: 0}}, arm: {cylinder_lever: {reference_rad: 0, rod_m: 1}}");
  EXPECT_THAT(faults,
              AllOf(HasSubstr("effects.slew.end_cushion: 'end_cushion' slows a joint"),
                    HasSubstr("effects.slew.cylinder_lever: 'cylinder_lever' needs"),
                    HasSubstr("effects.arm.cylinder_lever: "), ::testing::Not(HasSubstr("swing"))));
  EXPECT_THAT(FaultsOf(std::string(kSite) + kExcavator +
                           "effects: {excavator1: {boom: {dead_band: {width: 0.1}}}}\n",
                       {"machines[0].machine.levers=[left_track, right_track, slew]"}),
              AllOf(HasSubstr("boom.dead_band: 'dead_band' shapes a commanded rate, but no lever"),
                    HasSubstr("boom.actuator_ring: "), HasSubstr("bucket.actuator_ring: ")));
}

TEST(ReadScenario, RefusesRaisedGroundBeyondTheSite) {
  const auto faults = [](const std::string& place) {
    return FaultsOf(std::string(kSite) + kExcavator +
                    "effects: {excavator1: {base: "
                    "{terrain_height: {" +
                    place + ", height_m: 0.2, edge_m: 1}}}}\n");
  };
  // The site reaches from -6 to 6 m.
  EXPECT_EQ(faults("x_m: 8, y_m: 0, radius_m: 1.5"), "");
  EXPECT_THAT(
      faults("x_m: 8.5, y_m: 0, radius_m: 1"),
      HasSubstr("'terrain_height' of base raises ground beyond the site alone; need a place "
                "within 2 m of x -6 to 6 m, y -6 to 6 m"));
}

TEST(Scenarios, AllThatAreShippedAreValid) {
  for (const char* name : {"quickstart", "drive_three_soils", "two_machines", "warthog_asphalt"}) {
    const Config config = Config::FromFile(std::string("config/scenarios/") + name + ".yaml",
                                           {"terrain.cell_m=0.25"});
    ReadScenario(config.root());
    EXPECT_NO_THROW(config.Finish()) << name;
  }
}

TEST(ObstacleAt, FollowsItsPathOverTheGround) {
  // A plane that rises 0.1 m per metre along x.
  const TerrainSurface ground(
      TerrainGrid{.origin_W_m = Vec2(-10, -10), .cell_m = 20, .nx = 2, .ny = 2}, 1, {-1, 1, -1, 1},
      {{}});
  ScenarioObstacle walker;
  walker.height_above_ground_m = 0.5;
  walker.path = {{2, Vec2(0, 0)}, {4, Vec2(0, 3)}, {5, Vec2(4, 3)}};
  const BodyState middle = ObstacleAt(walker, FromSeconds(3), ground);
  EXPECT_TRUE(middle.X_WB.translation().isApprox(Vec3(0, 1.5, 0.5), 1e-6));
  EXPECT_NEAR(middle.v_WB_mps.y(), 1.5, 1e-9);
  EXPECT_NEAR(RpyFromRotation(middle.X_WB.linear()).z(), 90 * kDeg, 1e-9);
  const BodyState after = ObstacleAt(walker, FromSeconds(60), ground);
  EXPECT_TRUE(after.X_WB.translation().isApprox(Vec3(4, 3, 0.9), 1e-6));
  EXPECT_EQ(after.v_WB_mps.norm(), 0.0);
}

}  // namespace
}  // namespace tera
