#include "physics/description/machine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/faults.h"
#include "physics/machine_fixture.h"

namespace tera {
namespace {

using enum FaultKind;

TEST(Machine, CompactExcavatorWeighsItsOperatingWeight) {
  EXPECT_NEAR(ShippedMachine("tb235").TotalMass_kg(), 3500, 1);
}

std::vector<std::string> ShippedMachines() {
  std::vector<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(DataRoot() / "config/machines")) {
    names.push_back(file.path().stem().string());
  }
  return names;
}

TEST(Machine, EveryShippedMachineStandsStillWithItsLeversAtRest) {
  ASSERT_GE(ShippedMachines().size(), 3u);
  for (const std::string& name : ShippedMachines()) {
    const MachineModel model = ShippedMachine(name);
    MachineRun run(model, MakePose(Vec3(1, 2, 3), 0, 0, 1), 0.0);
    run.StepFor(0.1);
    for (const BodyState& link : run.state().links) EXPECT_LT(link.v_WB_mps.norm(), 1e-9) << name;
  }
}

TEST(Machine, BucketTipStandsWhereTheHandDrawnPolygonPutsIt) {
  const MachineModel model = ShippedMachine("tb235");
  std::vector<double> q(model.joints.size(), 0.0);
  q[model.JointIndex("boom")] = 50 * kDeg;
  q[model.JointIndex("arm")] = -90 * kDeg;
  q[model.JointIndex("bucket")] = -35 * kDeg;
  // In the boom's plane, seen from the right: boom foot at (0.62 + 0.18, 0.56 + 0.10 + 0.20), then
  // 2.5 m at 50 deg, 1.545 m at -40 deg, 0.78 m at 50 - 90 - 35 - 45 = -120 deg.
  const double x = 0.80 + 2.5 * std::cos(50 * kDeg) + 1.545 * std::cos(-40 * kDeg) +
                   0.78 * std::cos(-120 * kDeg);
  const double z = 0.86 + 2.5 * std::sin(50 * kDeg) + 1.545 * std::sin(-40 * kDeg) +
                   0.78 * std::sin(-120 * kDeg);
  const NamedFrame& tip = model.frames.at(0);
  ASSERT_EQ(tip.name, "bucket_tip");
  const Pose X_WB = MakePose(Vec3(5, -2, 0.4), 0, 0, 90 * kDeg);  // looks along +y of W
  const auto poses = ForwardKinematics(model, X_WB, q);
  const Vec3 p = (poses[tip.link] * tip.X_BF).translation();
  EXPECT_NEAR(p.x(), 5, 1e-12);
  EXPECT_NEAR(p.y(), -2 + x, 1e-12);
  EXPECT_NEAR(p.z(), 0.4 + z, 1e-12);
}

TEST(Machine, SlewToTheLeftBringsTheBoomToTheLeft) {
  const MachineModel model = ShippedMachine("tb235");
  std::vector<double> q(model.joints.size(), 0.0);
  q[model.JointIndex("slew")] = 90 * kDeg;
  const auto poses = ForwardKinematics(model, Pose::Identity(), q);
  EXPECT_TRUE(poses[model.LinkIndex("boom")].translation().isApprox(Vec3(0, 0.80, 0.86), 1e-12));
}

TEST(Machine, LinksFollowTheirJointsWhateverTheWrittenOrder) {
  const MachineModel model = MachineFromText(R"(
kind: chain
links:
  tip: {mass_kg: 1, inertia_kgm2: [1, 1, 1]}
  middle: {mass_kg: 2, inertia_kgm2: [1, 1, 1]}
  root: {mass_kg: 3, inertia_kgm2: [1, 1, 1]}
joints:
  second: {type: fixed, parent: middle, child: tip}
  first: {type: fixed, parent: root, child: middle}
)");
  EXPECT_EQ(model.links[0].name, "root");
  EXPECT_EQ(model.joints[0].name, "first");
  for (std::size_t k = 0; k < model.joints.size(); ++k) {
    EXPECT_EQ(model.joints[k].child, static_cast<int>(k) + 1);
    EXPECT_LT(model.joints[k].parent, model.joints[k].child);
  }
}

TEST(Machine, EveryKeyOfAJointIsRead) {
  const MachineModel base = MachineFromText(kLiftArm);
  const auto with = [&](const std::string& text) {
    return MachineFromText(kLiftArm, {text}).joints[0];
  };
  const Joint joint = base.joints[0];
  EXPECT_DOUBLE_EQ(joint.max_rate_positive_radps, 30 * kDeg);
  EXPECT_DOUBLE_EQ(joint.max_rate_negative_radps, 20 * kDeg);
  EXPECT_DOUBLE_EQ(with("joints.lift.max_rate_degps=12").max_rate_negative_radps, 12 * kDeg);
  EXPECT_DOUBLE_EQ(with("joints.lift.max_effort_nm=7").max_effort_nm, 7);
  EXPECT_DOUBLE_EQ(with("joints.lift.initial_deg=-9").initial_rad, -9 * kDeg);
  EXPECT_DOUBLE_EQ(with("joints.lift.limits_deg=[10, 20]").lower_rad, 10 * kDeg);
  EXPECT_DOUBLE_EQ(with("joints.lift.limits_deg=[10, 20]").initial_rad, 10 * kDeg);
  EXPECT_TRUE(with("joints.lift.axis=[0, 0, 2]").axis_J.isApprox(Vec3::UnitZ()));
  EXPECT_TRUE(with("joints.lift.rpy_deg=[0, 0, 90]").X_PJ.linear().col(0).isApprox(Vec3::UnitY()));
}

TEST(Machine, EveryKeyOfALinkIsRead) {
  const auto with = [](const std::string& text) {
    return MachineFromText(kLiftArm, {text}).links[1];
  };
  EXPECT_EQ(with("links.arm.mass_kg=33").mass_kg, 33);
  EXPECT_TRUE(with("links.arm.com_m=[1, 2, 3]").com_B_m.isApprox(Vec3(1, 2, 3)));
  const Mat3 inertia = with("links.arm.inertia_kgm2=[5, 6, 7, 0.1, 0.2, 0.3]").inertia_B_kgm2;
  EXPECT_EQ(inertia(1, 1), 6);
  EXPECT_EQ(inertia(0, 1), 0.1);
  EXPECT_EQ(inertia(2, 0), 0.2);
  EXPECT_EQ(inertia(1, 2), 0.3);
  EXPECT_EQ(with("links.arm.label=arm").label, SemanticClass::kArm);
  const Link boxed = with("links.arm.collision=[{xyz_m: [1, 0, 0], size_m: [2, 3, 4]}]");
  EXPECT_EQ(boxed.collision.at(0).X_BG.translation().x(), 1);
  EXPECT_EQ(boxed.collision.at(0).size_m.z(), 4);
  const Link seen = with(
      "links.arm.visuals=[{mesh: 'tera:assets/tb235.glb', node: boom, scale: 2, xyz_m: [0, 1, 0], "
      "rpy_deg: [0, 0, 90], label: track}]");
  const Visual& visual = seen.visuals.at(0);
  EXPECT_EQ(visual.mesh, DataRoot() / "assets/tb235.glb");
  EXPECT_EQ(visual.node, "boom");
  EXPECT_EQ(visual.scale, 2);
  EXPECT_EQ(visual.label, SemanticClass::kTrack);
  EXPECT_TRUE(visual.X_BG.isApprox(MakePose(Vec3(0, 1, 0), 0, 0, 90 * kDeg), 1e-12));
}

TEST(Machine, EveryKeyOfRunningGearIsRead) {
  const std::string tracked = kLiftArm + R"(
gauge_m: 1.3
tracks:
  left: {link: arm, center_m: [0, 1, 0.2], wheelbase_m: 1, radius_m: 0.2, width_m: 0.3,
         max_speed_mps: 2, max_torque_nm: 500, inertia_kgm2: 3}
wheels:
  right: {link: arm, axles_m: [[0, -1, 0.4]], radius_m: 0.4, width_m: 0.2,
          max_speed_mps: 2, max_torque_nm: 700, inertia_kgm2: 4}
)";
  const auto with = [&](const std::string& text) {
    return MachineFromText(
        tracked, text.empty() ? std::vector<std::string>{} : std::vector<std::string>{text});
  };
  const MachineModel model = with("");
  const auto gear = [&](const std::string& text, int g) {
    return with(text).ground_tools.gears.at(g);
  };
  EXPECT_EQ(model.gauge_m, 1.3);
  EXPECT_EQ(model.ground_tools.gears[0].link, 1);
  EXPECT_EQ(gear("tracks.left.link=post", 0).link, 0);
  EXPECT_EQ(gear("tracks.left.center_m=[0, 2, 0]", 0).patches[0].p_B_m.y(), 2);
  EXPECT_EQ(gear("tracks.left.radius_m=0.25", 0).drive_radius_m, 0.25);
  EXPECT_EQ(gear("tracks.left.width_m=0.5", 0).patches[0].width_m, 0.5);
  EXPECT_GT(gear("tracks.left.wheelbase_m=2", 0).patches.size(),
            model.ground_tools.gears[0].patches.size());
  EXPECT_EQ(gear("tracks.left.grouser_m=0.03", 0).grouser_m, 0.03);
  const auto wheels = [&](const std::string& text) {
    return gear("tracks.left.road_wheels={" + text + "}", 0).patches[5];
  };
  EXPECT_EQ(gear("", 0).patches[5].wheel_pitch_m, 0);
  EXPECT_EQ(wheels("count: 4, pitch_m: 0.25").wheel_pitch_m, 0.25);
  EXPECT_EQ(wheels("count: 3, pitch_m: 0.3").wheel_pitch_m, 0.3);
  EXPECT_EQ(wheels("count: 1, pitch_m: 0.3").wheel_pitch_m, 0);  // the wheel is farther forward
  EXPECT_EQ(gear("wheels.right.link=post", 1).link, 0);
  EXPECT_EQ(gear("wheels.right.radius_m=0.5", 1).drive_radius_m, 0.5);
  EXPECT_EQ(gear("wheels.right.width_m=0.5", 1).patches[0].width_m, 0.5);
  EXPECT_EQ(gear("wheels.right.axles_m=[[0, -3, 0.4]]", 1).patches[0].p_B_m.y(), -3);
  const auto drive = [&](const std::string& text, int g) { return with(text).gear_drives.at(g); };
  EXPECT_EQ(drive("tracks.left.max_speed_mps=4", 0).max_rate_radps, 20);
  EXPECT_EQ(drive("tracks.left.max_torque_nm=9", 0).max_torque_nm, 9);
  EXPECT_EQ(drive("wheels.right.inertia_kgm2=9", 1).inertia_kgm2, 9);
  EXPECT_EQ(with("levers=[right]").levers.at(0).gear, 1);
  EXPECT_EQ(with("tracks.left.shoe={mesh: 'tera:assets/tb235.glb', node: shoe, count: 7}")
                .track_visuals.at(0)
                .shoe_count,
            7);
  // 2 x 1 m and a circle of 0.2 m around: 3.2566 m in 7 shoes.
  EXPECT_NEAR(gear("tracks.left.shoe={mesh: 'tera:assets/tb235.glb', node: shoe, count: 7}", 0)
                  .grouser_pitch_m,
              0.46523, 1e-5);
  EXPECT_EQ(model.ground_tools.gears[0].grouser_pitch_m, 0);
  EXPECT_THAT(FaultsOf(tracked, {"tracks.left.shoe={mesh: 'tera:assets/tb235.glb', node: shoe, "
                                 "count: 5000000000}"}),
              HasFault(kOutOfRange, "count"));
  EXPECT_EQ(with("wheels.right.wheel={mesh: 'tera:assets/warthog.glb', node: wheel}")
                .wheel_visuals.at(0)
                .axle_B_m.y(),
            -1);
  EXPECT_THAT(
      FaultsOf(tracked, {"wheels.left={link: arm, axles_m: [[0, 1, 0]], radius_m: 1, "
                         "width_m: 1, max_speed_mps: 1, max_torque_nm: 1, inertia_kgm2: 1}"}),
      HasFault(kRepeated));
}

TEST(Machine, FramesHullPointsAndShovelsAreRead) {
  const MachineModel model = MachineFromText(
      kLiftArm, {"frames={grip: {link: arm, xyz_m: [1, 2, 3], rpy_deg: [0, 90, 0]}}",
                 "hull_points=[{link: arm, points_m: [[1, 2, 3], [4, 5, 6]]}]"});
  EXPECT_EQ(model.frames.at(0).link, 1);
  EXPECT_TRUE(model.frames[0].X_BF.isApprox(MakePose(Vec3(1, 2, 3), 0, 90 * kDeg, 0), 1e-12));
  EXPECT_EQ(model.ground_tools.hull_points.at(1).p_B_m.z(), 6);
  const Shovel& scoop = model.ground_tools.shovels.at(0);
  EXPECT_EQ(scoop.link, 1);
  EXPECT_EQ(scoop.width_m, 0.5);
  EXPECT_EQ(scoop.profile_B_m.at(1).y(), -0.2);
  EXPECT_EQ(scoop.capacity_m3, 0.05);
}

TEST(Machine, ExcavatorHasItsEquipment) {
  const MachineModel model = ShippedMachine("tb235");
  EXPECT_EQ(model.kind, "tb235");
  EXPECT_FALSE(model.fixed_base);
  EXPECT_DOUBLE_EQ(model.gauge_m, 1.148);
  EXPECT_EQ(model.levers.size(), 8u);
  EXPECT_EQ(model.levers[0].gear, 0);
  EXPECT_EQ(model.levers[2].joint, model.JointIndex("slew"));
  ASSERT_EQ(model.cylinders.size(), 5u);
  EXPECT_EQ(model.cylinders[0].rod_link, model.LinkIndex("boom"));
  EXPECT_TRUE(model.cylinders[0].rod_pin_m.isApprox(Vec3(1.22, 0, 0.20)));
  EXPECT_EQ(model.cylinders[0].barrel->node, "boom_barrel");
  ASSERT_EQ(model.track_visuals.size(), 2u);
  EXPECT_EQ(model.track_visuals[1].shoe_count, 44);
  EXPECT_EQ(model.track_visuals[1].shoe.label, SemanticClass::kTrack);
  ASSERT_EQ(model.ground_tools.shovels.size(), 2u);
  EXPECT_EQ(model.ground_tools.shovels[0].teeth, 6);
  EXPECT_DOUBLE_EQ(model.ground_tools.shovels[0].tooth_length_m, 0.15);
  EXPECT_DOUBLE_EQ(model.ground_tools.shovels[0].capacity_m3, 0.11);
  EXPECT_EQ(model.ground_tools.hull_points.size(), 32u);
  EXPECT_DOUBLE_EQ(model.gear_drives[0].max_rate_radps, 1.25 / 0.25);
  EXPECT_EQ(model.links[model.LinkIndex("boom")].label, SemanticClass::kBoom);
  EXPECT_EQ(model.links[model.LinkIndex("boom")].collision.size(), 2u);
}

/// Capacities of a shovel by SAE J296. Struck: level with the plane from the edge behind the teeth
/// to the top edge. Heaped: with a hip roof of 1:1 on it.
struct Rated {
  double struck_m3, heaped_m3;
};

Rated RatedBySaeJ296(const Shovel& shovel) {
  std::vector<Vec2> held = shovel.profile_B_m;
  double teeth_m = shovel.tooth_length_m;
  while ((held[1] - held[0]).norm() <= teeth_m) {
    teeth_m -= (held[1] - held[0]).norm();
    held.erase(held.begin());
  }
  held[0] += teeth_m * (held[1] - held[0]).normalized();
  double area_m2 = 0;
  for (std::size_t k = 0; k < held.size(); ++k) {
    const Vec2 &a = held[k], &b = held[(k + 1) % held.size()];
    area_m2 += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  const double struck_m3 = std::abs(area_m2) * shovel.width_m;
  const double opening_m = (held.front() - held.back()).norm();
  const auto [narrow_m, wide_m] = std::minmax(opening_m, shovel.width_m);
  return {struck_m3, struck_m3 + wide_m * narrow_m * narrow_m / 4 - std::pow(narrow_m, 3) / 12};
}

TEST(Machine, EveryShippedBucketHoldsWhatItsFileSays) {
  int buckets = 0;
  for (const std::string& name : ShippedMachines()) {
    for (const Shovel& shovel : ShippedMachine(name).ground_tools.shovels) {
      if (shovel.capacity_m3 <= 0) continue;
      ++buckets;
      EXPECT_NEAR(RatedBySaeJ296(shovel).struck_m3 / shovel.capacity_m3, 1, 0.03) << name;
    }
  }
  EXPECT_GE(buckets, 2);
  // The maker's rating of the 20 t excavator's bucket.
  const MachineModel large = ShippedMachine("excavator20t");
  EXPECT_NEAR(RatedBySaeJ296(large.ground_tools.shovels[0]).heaped_m3 / 0.8, 1, 0.03);
}

TEST(Machine, SkidSteerTurnsTwoWheelsWithEachLever) {
  const MachineModel model = ShippedMachine("warthog");
  EXPECT_NEAR(model.TotalMass_kg(), 470, 1e-9);
  EXPECT_NEAR(model.ground_tools.mass_kg, 470, 1e-9);
  EXPECT_TRUE(model.joints.empty());
  ASSERT_EQ(model.ground_tools.gears.size(), 2u);
  EXPECT_EQ(model.wheel_visuals.size(), 4u);
  EXPECT_EQ(model.levers[1].gear, 1);
  EXPECT_DOUBLE_EQ(model.gear_drives[1].max_rate_radps, 5.0 / 0.30);
}

TEST(MachineFaults, EachNamesItsPlaceAndItsRemedy) {
  const auto with = [](const std::string& text) { return FaultsOf(kLiftArm, {text}); };
  EXPECT_THAT(FaultsOf(kLiftArm), testing::IsEmpty());
  EXPECT_THAT(with("links.arm.mass_kg=-20"), HasFault(kOutOfRange, "links.arm.mass_kg"));
  EXPECT_THAT(with("links.arm.mas_kg=20"), HasFault(kUnknown, "links.arm.mas_kg"));
  EXPECT_THAT(with("links.arm.inertia_kgm2=[1, 1, 3]"), HasFault(kInconsistent, "inertia_kgm2"));
  EXPECT_THAT(with("links.arm.inertia_kgm2=[1, 1, 0]"), HasFault(kOutOfRange, "inertia_kgm2"));
  EXPECT_THAT(with("links.arm.inertia_kgm2=[1, 1, 1, 0]"),
              HasFault(kMistyped, "links.arm.inertia_kgm2"));
  EXPECT_THAT(with("links.arm.label=boomm"), HasFault(kNoSuchName, "links.arm.label"));
  EXPECT_THAT(with("joints.lift.parent=pots"), HasFault(kNoSuchName, "joints.lift.parent"));
  EXPECT_THAT(with("joints.lift.child=hand"), HasFault(kNoSuchName, "joints.lift.child"));
  EXPECT_THAT(with("joints.lift.child=post"), HasFault(kOutOfRange, "child"));
  EXPECT_THAT(with("joints.lift.limits_deg=[30, -30]"),
              HasFault(kInconsistent, "joints.lift.limits_deg"));
  EXPECT_THAT(with("joints.lift.initial_deg=175"),
              HasFault(kOutOfRange, "joints.lift.initial_deg"));
  EXPECT_THAT(with("joints.lift.axis=[0, 0, 0]"), HasFault(kOutOfRange, "axis"));
  EXPECT_THAT(with("joints.lift.type=hinge"), HasFault(kNoSuchName, "joints.lift.type"));
  EXPECT_THAT(with("joints.lift.max_rate_degps=[1, 2, 3]"),
              HasFault(kMistyped, "joints.lift.max_rate_degps"));
  EXPECT_THAT(with("links.spare={mass_kg: 1, inertia_kgm2: [1, 1, 1]}"),
              HasFault(kMissing, "joints"));
  EXPECT_THAT(with("levers=[lift, lift]"), HasFault(kRepeated, "levers"));
  EXPECT_THAT(with("levers=[left]"), HasFault(kNoSuchName, "levers"));
  EXPECT_THAT(with("tracks={a/b: {}}"), HasFault(kMalformed, "tracks.a/b"));
  EXPECT_THAT(with("wheels={'a,b': {}}"), HasFault(kMalformed, "wheels.a,b"));
  EXPECT_THAT(with("tracks={lift: {}}"), HasFault(kRepeated, "tracks.lift"));
  EXPECT_THAT(with("shovels={a b: {}}"), HasFault(kMalformed, "shovels.a b"));
  EXPECT_THAT(with("shovels.scoop.link=armm"), HasFault(kNoSuchName, "shovels.scoop.link"));
  EXPECT_THAT(with("shovels.scoop.profile_m=[[0, 0], [1, 1]]"),
              HasFault(kMistyped, "shovels.scoop.profile_m"));
  EXPECT_THAT(with("shovels.scoop.profile_m=[[0, 0], [1, 1], [2, 2]]"),
              HasFault(kInconsistent, "shovels.scoop.profile_m"));
  EXPECT_THAT(with("shovels.scoop.profile_m=[[0, 0], [1, 1], [1, 0], [0, 1]]"),
              HasFault(kInconsistent, "profile_m"));
  EXPECT_THAT(with("shovels.scoop.width_m=0"), HasFault(kOutOfRange, "width_m"));
  EXPECT_THAT(with("shovels.scoop.profile_m=[[1, 0], [1, 0], [0, 1], [0, 0]]"),
              HasFault(kRepeated, "profile_m"));
  EXPECT_THAT(with("shovels.scoop.profile_m=[[0, 0], [1, 1], [1, 0], [0, 0.5]]"),
              HasFault(kInconsistent, "profile_m"));
  EXPECT_THAT(with("shovels.scoop.teeth=5000000000"), HasFault(kOutOfRange, "teeth"));
  EXPECT_THAT(with("shovels.scoop.tooth_length_m=3"), HasFault(kOutOfRange, "tooth_length_m"));
  EXPECT_THAT(with("shovels.scoop.edge_thickness_m=0"), HasFault(kOutOfRange, "edge_thickness_m"));
  EXPECT_THAT(with("shovels.scoop.teeth=90"), HasFault(kInconsistent, "teeth"));
  EXPECT_THAT(with("links.arm.visuals=[{mesh: nowhere.glb}]"), HasFault(kUnreadable, "mesh"));
  EXPECT_THAT(with("frames.tip={link: arm, xyz_m: [0, 0]}"),
              HasFault(kMistyped, "frames.tip.xyz_m"));
  EXPECT_THAT(with("urdf=nowhere.urdf"), HasFault(kUnreadable, "urdf"));
}

TEST(MachineFaults, RoadWheelsFitUnderTheirTrack) {
  const auto with = [](const std::string& keys) {
    return FaultsOf(kLiftArm, {"tracks={left: {link: arm, center_m: [0, 1, 0.2], wheelbase_m: 1, "
                               "radius_m: 0.2, width_m: 0.3, max_speed_mps: 2, max_torque_nm: 500, "
                               "inertia_kgm2: 3, " +
                               keys + "}}"});
  };
  EXPECT_THAT(with("road_wheels: {count: 5, pitch_m: 0.2}"), testing::IsEmpty());
  EXPECT_THAT(with("road_wheels: {count: 5, pitch_m: 0.21}"),
              HasFault(kOutOfRange, "tracks.left.road_wheels.pitch_m"));
  EXPECT_THAT(with("road_wheels: {count: 0, pitch_m: 0.2}"), HasFault(kOutOfRange, "count"));
  EXPECT_THAT(with("road_wheels: {count: 2, pitch_m: -0.2}"), HasFault(kOutOfRange, "pitch_m"));
  EXPECT_THAT(with("road_wheels: {count: 2}"), HasFaultAt("pitch_m"));
  EXPECT_THAT(with("grouser_m: -0.01"), HasFault(kOutOfRange, "grouser_m"));
}

TEST(MachineFaults, ALinkHangsOnOneJoint) {
  EXPECT_THAT(FaultsOf(kLiftArm, {"joints.again={type: fixed, parent: post, child: arm}"}),
              HasFault(kRepeated, "child"));
}

TEST(MachineFaults, JointsInALoopAreReported) {
  EXPECT_THAT(FaultsOf(kLiftArm, {"joints.back={type: fixed, parent: arm, child: post}"}),
              HasFault(kMissing, "joints"));
}

TEST(MachineFaults, AMachineHasLinks) {
  EXPECT_THAT(FaultsOf("kind: ghost\n"), HasFault(kMissing, "links"));
}

TEST(MachineFaults, WhatStandsOnLinksIsJudgedOnceTheyAreATree) {
  const std::string cylinder =
      "cylinders={ram: {barrel: {link: post, pin_m: [0, 0, 0]}, rod: {link: arm, pin_m: [1, 0, "
      "0]}}}";
  for (const auto& [change, place] : std::vector<std::pair<std::string, std::string>>{
           {"joints.lift.child=hand", "lift.child"},
           {"joints.lift.parent=arm", "lift.child"},
           {"joints.back={type: fixed, parent: arm, child: post}", "joints"},
           {"links.spare={mass_kg: 1, inertia_kgm2: [1, 1, 1]}", "joints"},
           {"joints=null", "joints"}}) {
    EXPECT_THAT(FaultsOf(kLiftArm, {change, cylinder}),
                testing::Each(testing::Field(
                    "place", &InputFault::place,
                    testing::ResultOf([&place](const std::string& at) { return EndsIn(at, place); },
                                      true))))
        << change;
  }
  EXPECT_THAT(FaultsOf("kind: ghost\ncylinders: {ram: {}}\n"), HasOnlyFault(kMissing, "links"));
}

TEST(MachineFaults, AreReportedAllAtOnce) {
  const auto faults =
      FaultsOf(kLiftArm, {"links.arm.mass_kg=-1", "joints.lift.limits_deg=[3, 1]", "levers=[x]"});
  EXPECT_THAT(faults, testing::SizeIs(3));
}

}  // namespace
}  // namespace tera
