#include "layout/sight/mount_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "layout/study/cycle.h"
#include "layout/yard.h"

namespace tera {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A box on the mast.
TestBox OnMast() { return {Vec3(-0.2, -0.3, -0.5), Vec3(0.6, 0.3, 1.1)}; }

std::vector<BuriedMount> BuriedAt(const Yard& yard, const Pose& X_WB, const Vec3& p_B_m) {
  MountCheck check;
  const std::vector<Viewer> viewers = {
      ViewerOf(ViewField::Samples::kPixels, 1, X_WB * MakePose(p_B_m, 0.1, 0.2, 0.3))};
  check.Add(0, viewers, yard.sighting());
  return check.Buried();
}

TEST(MountCheck, FindsAMountInsideASolidPartAndHowDeep) {
  const Yard yard(OnMast());
  const auto buried = BuriedAt(yard, yard.X_WMast(), Vec3(0.5, 0.05, 0.4));
  ASSERT_EQ(buried.size(), 1u);
  EXPECT_EQ(buried[0].part, "digger/mast");
  // The nearest face is 0.10 m away. Among 100 directions evenly over the sphere, one lies within
  // 0.2 rad of any, the radius of a cap of 1/100 of it. The distance along it is at most 1 / cos
  // 0.2 as large.
  EXPECT_GE(buried[0].depth_m, 0.10 - 1e-6);
  EXPECT_LE(buried[0].depth_m, 0.10 * 1.03);
}

TEST(MountCheck, NamesThePartThatItIsIn) {
  const Yard yard(OnMast());
  const auto buried = BuriedAt(yard, yard.X_WBase(), Vec3(-1.0, 0.4, 0.25));
  ASSERT_EQ(buried.size(), 1u);
  EXPECT_EQ(buried[0].part, "digger/base");
}

TEST(MountCheck, FindsNothingOutsideOfAPartOrOnIt) {
  const Yard yard(OnMast());
  for (const Vec3& p_B_m : {Vec3(0.65, 0, 0.4), Vec3(0.6, 0, 0.4), Vec3(0.595, 0, 0.4),
                            Vec3(0.1, 0.1, 1.1), Vec3(0.1, 0.1, 2.5)}) {
    EXPECT_THAT(BuriedAt(yard, yard.X_WMast(), p_B_m), IsEmpty()) << p_B_m.transpose();
  }
}

TEST(MountCheck, InsideAnotherThingIsNotInsideTheMachine) {
  const Yard yard(OnMast(),
                  "obstacles:\n  - {name: barrier1, preset: tera:config/obstacles/barrier.yaml, "
                  "xy_m: [8, 3], yaw_deg: 20}\n");
  EXPECT_THAT(BuriedAt(yard, MakePose(Vec3(8, 3, 0.2)), Vec3::Zero()), IsEmpty());
}

/// The shipped excavator as it starts in the quickstart, with a rig.
class ShippedExcavator : public testing::Test {
 protected:
  std::vector<std::string> WarningsOf(const std::string& rig) {
    const auto scenario_file = scratch_.path() / "scenario.yaml";
    const auto rig_file = scratch_.path() / "rig.yaml";
    WriteWholeFile(rig_file, rig);
    WriteWholeFile(scenario_file, R"(
name: excavator
duration_s: 1
terrain: {size_m: [12, 12], cell_m: 0.2, soil: dirt}
machines:
  - name: excavator1
    machine: tera:config/machines/tb235.yaml
    start: {xy_m: [1, 2], yaw_deg: 25, joints_deg: {boom: 40, arm: -95, bucket: -20}}
    operator: {type: idle}
)");
    const Cycle cycle(scenario_file, {});
    Layout layout = LoadLayout(rig_file, cycle, 0);
    const SceneAssembly assembly(cycle.scenario());
    const Simulation simulation(cycle.scenario());
    Sighting sighting(cycle.scenario(), assembly, 1);
    sighting.Show(simulation.state(), simulation.ground());
    MoveViewers(simulation.state().machines[0], &layout);
    MountCheck check;
    check.Add(0, layout.viewers, sighting);
    return check.Warnings();
  }
  static std::string CameraOn(const std::string& link, const std::string& xyz_m) {
    return "sensors:\n  - {name: camera, preset: tera:config/sensors/rgb_640.yaml, link: " + link +
           ", xyz_m: " + xyz_m + "}\n";
  }
  const ScratchDirectory scratch_;
};

TEST_F(ShippedExcavator, HasItsSensorsInTheAir) {
  std::string rig = ReadWholeFile(DataRoot() / "config/rigs/excavator.yaml");
  for (std::size_t at; (at = rig.find("../sensors")) != std::string::npos;) {
    rig.replace(at, 10, "tera:config/sensors");
  }
  EXPECT_THAT(WarningsOf(rig), IsEmpty());
}

TEST_F(ShippedExcavator, IsToldOfACameraThatIsMovedIntoItsBoom) {
  EXPECT_THAT(WarningsOf(CameraOn("boom", "[0.65, 0.0, 0.25]")),
              ElementsAre(testing::AllOf(HasSubstr("camera: its mount lies"),
                                         HasSubstr("inside excavator1/boom"),
                                         HasSubstr("move its xyz_m"))));
}

TEST_F(ShippedExcavator, IsToldOfACameraThatIsMovedIntoItsCounterweight) {
  EXPECT_THAT(WarningsOf(CameraOn("upper", "[-0.9, 0.1, 0.3]")),
              ElementsAre(HasSubstr("inside excavator1/upper")));
}

}  // namespace
}  // namespace tera
