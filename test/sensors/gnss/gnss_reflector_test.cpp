#include "sensors/gnss/gnss_reflector.h"

#include <gtest/gtest.h>

#include <string>

#include "core/config/config.h"

// Reflectors near an antenna are found by geometry, not by names.

namespace tera {
namespace {

MachineModel Machine(const std::string& name) {
  const Config config = Config::FromFile("config/machines/" + name + ".yaml");
  MachineModel model = ReadMachine(config.root());
  config.Finish();
  return model;
}

std::string LinkOf(const MachineModel& model, const std::string& antenna_link) {
  const auto reflector = GnssReflectorOf(model, model.LinkIndex(antenna_link));
  return reflector ? model.links[reflector->link].name : "none";
}

TEST(GnssReflector, OfAnExcavatorIsItsBoomPastTheJointsThatTurnAboutTheVertical) {
  for (const char* machine : {"tb235", "excavator20t"}) {
    const MachineModel model = Machine(machine);
    EXPECT_EQ(LinkOf(model, "upper"), "boom") << machine;
    EXPECT_EQ(LinkOf(model, "undercarriage"), "boom") << machine;
    EXPECT_EQ(LinkOf(model, "boom"), "arm") << machine;
  }
}

TEST(GnssReflector, PointsFromItsPinToTheNext) {
  const MachineModel model = Machine("tb235");
  const auto boom = GnssReflectorOf(model, model.LinkIndex("upper"));
  ASSERT_TRUE(boom);
  EXPECT_TRUE(boom->direction_B.isApprox(Vec3::UnitX(), 1e-12));  // x of the boom, from its file
  // The bucket has no further joint: towards its centre of mass.
  const auto bucket = GnssReflectorOf(model, model.LinkIndex("arm"));
  ASSERT_TRUE(bucket);
  const Vec3& com_B_m = model.links[model.LinkIndex("bucket")].com_B_m;
  EXPECT_TRUE(bucket->direction_B.isApprox(com_B_m.normalized(), 1e-12));
}

TEST(GnssReflector, IsTheSameWhateverTheJointsAndLinksAreCalled) {
  MachineModel model = Machine("tb235");
  const auto before = GnssReflectorOf(model, model.LinkIndex("upper"));
  const int upper = model.LinkIndex("upper");
  for (Joint& joint : model.joints) joint.name = "joint_" + std::to_string(joint.child);
  for (Link& link : model.links) link.name = "body_" + link.name.substr(1);
  const auto after = GnssReflectorOf(model, upper);
  ASSERT_TRUE(before && after);
  EXPECT_EQ(after->link, before->link);
  EXPECT_EQ(after->direction_B, before->direction_B);
}

TEST(GnssReflector, IsFoundOnOtherMachinesAndNotWhereNothingRises) {
  EXPECT_EQ(LinkOf(Machine("fixed_arm"), "base"), "link1");
  EXPECT_EQ(LinkOf(Machine("mast"), "mast"), "none");
  EXPECT_EQ(LinkOf(Machine("excavator20t"), "bucket"), "none");
  EXPECT_EQ(LinkOf(Machine("warthog"), "chassis"), "none");
}

}  // namespace
}  // namespace tera
