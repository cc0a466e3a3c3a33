#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/faults.h"
#include "own_folder.h"
#include "physics/machine_fixture.h"

// Descriptions with massless moving links, as for mobile machines in ROS.

namespace tera {
namespace {

using enum FaultKind;

const std::string kRover = "kind: rover\nurdf: test/physics/data/rover.urdf\nlevers: [pan]\n";

/// rover.urdf with its bodies combined by hand. The chassis stands at (1, 0, 0.2) m turned left by
/// 90 deg, so that its x is the root's y. Its centre is at (1, 0, 0.3) and the battery's, 3 m along
/// its y, at (-2, 0, 0.3). 60 kg and 30 kg are 3 m apart: the centre is at a third of that, (0, 0,
/// 0.3), and 60 * 1^2 + 30 * 2^2 = 180 kg m2 are added about y and z.
const std::string kTwin = R"(
kind: rover
links:
  root: {mass_kg: 90, com_m: [0, 0, 0.3], inertia_kgm2: [5.5, 182.3, 186.7]}
  mast: {mass_kg: 4, com_m: [0.3, 0, 0.4], inertia_kgm2: [0.3, 0.3, 0.02]}
joints:
  pan:
    type: revolute
    parent: root
    child: mast
    xyz_m: [1, 0.2, 0.5]
    rpy_deg: [5.729577951308232, 0, 90]
    axis: [0, 0, 1]
    limits_rad: [-2, 2]
    max_rate_degps: 34.37746770784939
    max_effort_nm: 40
levers: [pan]
)";

const Link& LinkOf(const MachineModel& model, const std::string& name) {
  return model.links.at(model.LinkIndex(name));
}

TEST(FixedLinks, ARootWithoutMassHasThatOfWhatIsFixedToIt) {
  const MachineModel model = MachineFromText(kRover);
  const Link& root = model.links[0];
  EXPECT_EQ(root.name, "base_footprint");
  EXPECT_NEAR(root.mass_kg, 90, 1e-9);
  EXPECT_NEAR(model.TotalMass_kg(), 94, 1e-9);
  EXPECT_TRUE(root.com_B_m.isApprox(Vec3(0, 0, 0.3), 1e-9)) << root.com_B_m;
  // The chassis has 2, 5, 6 about axes whose x and y are exchanged; the battery likewise 0.3, 0.5,
  // 0.7.
  const Mat3 expected = Vec3(5 + 0.5, 2 + 0.3 + 180, 6 + 0.7 + 180).asDiagonal();
  EXPECT_TRUE(root.inertia_B_kgm2.isApprox(expected, 1e-9)) << root.inertia_B_kgm2;
  for (const char* name : {"base_link", "chassis_link", "battery_link", "camera_link"}) {
    EXPECT_EQ(LinkOf(model, name).mass_kg, 0) << name;
  }
}

TEST(FixedLinks, ALinkOnAJointHasTheMassOfWhatIsFixedToIt) {
  const MachineModel model = MachineFromText(kRover);
  const Link& mount = LinkOf(model, "mast_mount");
  EXPECT_NEAR(mount.mass_kg, 4, 1e-12);
  EXPECT_TRUE(mount.com_B_m.isApprox(Vec3(0.3, 0, 0.4), 1e-12));
  EXPECT_TRUE(mount.inertia_B_kgm2.isApprox(Mat3(Vec3(0.3, 0.3, 0.02).asDiagonal()), 1e-12));
}

TEST(FixedLinks, ALinkWithMassKeepsItsOwn) {
  std::string twin = kTwin;
  twin.insert(twin.find("joints:\n"), "  ballast: {mass_kg: 7, inertia_kgm2: [1, 1, 1]}\n");
  twin.insert(twin.find("levers:"),
              "  bolt: {type: fixed, parent: root, child: ballast, xyz_m: [0, 0, 1]}\n");
  const MachineModel model = MachineFromText(twin);
  EXPECT_EQ(model.links[0].mass_kg, 90);
  EXPECT_EQ(LinkOf(model, "ballast").mass_kg, 7);
}

TEST(FixedLinks, MovesLikeItsTwinOfTwoBodies) {
  const MachineModel rover = MachineFromText(kRover), twin = MachineFromText(kTwin);
  const Pose X_WB = MakePose(Vec3(1, 2, 3), 0.1, -0.2, 0.7);
  MachineRun a(rover, X_WB), b(twin, X_WB);
  for (MachineRun* run : {&a, &b}) {
    run->input.levers = {0.8};
    run->input.soil.link_wrench[0] = {.force_W_n = Vec3(40, -90, 700),
                                      .torque_W_nm = Vec3(30, 60, -50)};
    run->StepFor(1);
  }
  const Pose& X_WA = a.state().links[0].X_WB;
  EXPECT_FALSE(X_WA.isApprox(X_WB, 0.1));
  EXPECT_TRUE(X_WA.isApprox(b.state().links[0].X_WB, 1e-6));
  EXPECT_GT(std::abs(b.state().q_rad[0]), 0.3);
  EXPECT_NEAR(a.state().q_rad[rover.JointIndex("pan")], b.state().q_rad[0], 1e-6);
}

TEST(FixedLinks, FallsAsEverythingDoes) {
  const MachineModel model = MachineFromText(kRover);
  MachineRun run(model, MakePose(Vec3(0, 0, 5)));
  run.StepFor(0.5);
  EXPECT_NEAR(run.state().links[0].X_WB.translation().z(), 5 - 0.5 * kGravity_mps2 * 0.25, 0.01);
}

TEST(FixedLinks, FramesWithoutMassKeepTheirPoses) {
  const MachineModel model = MachineFromText(kRover);
  MachineRun run(model, MakePose(Vec3(1, 2, 3), 0.1, -0.2, 0.7));
  run.input.levers = {0.8};
  run.StepFor(0.4);
  const auto pose = [&](const std::string& name) {
    return run.state().links[model.LinkIndex(name)].X_WB;
  };
  const Pose X_root_chassis = MakePose(Vec3(1, 0, 0.2), 0, 0, 90 * kDeg);
  EXPECT_TRUE((pose("base_footprint") * X_root_chassis).isApprox(pose("chassis_link"), 1e-9));
  const Pose X_mount_camera = MakePose(Vec3(0.4, 0, 0.8), 0, 0.3, 0);
  EXPECT_TRUE((pose("mast_mount") * X_mount_camera).isApprox(pose("camera_link"), 1e-9));
  // REP 103: an optical frame looks along z, with x to the right and y down.
  Mat3 R_camera_optical;
  R_camera_optical << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  EXPECT_TRUE((pose("camera_link").linear() * R_camera_optical)
                  .isApprox(pose("camera_optical_frame").linear(), 1e-9));
}

std::vector<InputFault> FaultsWith(const std::string& links_and_joints,
                                   const std::string& keys = "") {
  const std::string file = OwnFolder() / "machine.urdf";
  std::ofstream(file) << "<robot name='r'>" + links_and_joints + "</robot>";
  return FaultsOf("kind: r\nurdf: " + file + "\n" + keys);
}

const std::string kBody = R"(<link name="body"><inertial><mass value="3"/>
    <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>)";

std::string JointBetween(const std::string& parent, const std::string& child,
                         const std::string& type) {
  return "<joint name='" + child + "_joint' type='" + type + "'><parent link='" + parent +
         "'/><child link='" + child + "'/></joint>";
}

TEST(FixedLinks, AMovingLinkWithoutAnyMassIsToldWithItsRemedy) {
  const std::string frames = "<link name='base_footprint'/><link name='base_link'/>" +
                             JointBetween("base_footprint", "base_link", "fixed");
  EXPECT_THAT(FaultsWith(frames), HasOnlyFault(kOutOfRange, "mass_kg"));
  EXPECT_THAT(FaultsWith(frames, "fixed_base: true\n"), testing::IsEmpty());
  const std::string wheel =
      kBody + "<link name='wheel'/>" + JointBetween("body", "wheel", "continuous");
  EXPECT_THAT(FaultsWith(wheel), HasOnlyFault(kOutOfRange, "mass_kg"));
}

TEST(FixedLinks, AWorldWithoutMassIsAskedWhetherItIsTheGround) {
  const std::string arm = "<link name='world'/>" + kBody + JointBetween("world", "body", "fixed");
  EXPECT_THAT(FaultsWith(arm), HasOnlyFault(kInconsistent, "name"));
  EXPECT_THAT(FaultsWith(arm, "fixed_base: true\n"), testing::IsEmpty());
  EXPECT_THAT(FaultsWith(arm, "fixed_base: false\n"), testing::IsEmpty());
}

}  // namespace
}  // namespace tera
