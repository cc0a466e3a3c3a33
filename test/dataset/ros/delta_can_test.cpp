#include "dataset/ros/delta_can.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dataset/ros/serializer.h"

namespace tera::ros {
namespace {

// A machine's levers are in fields by their names, those of its gears by their sides, and the rest
// in the machine's order.
TEST(DeltaCan, HasEachLeverInItsPlace) {
  const std::vector<NamedLever> levers = {{"left_track", true},  {"tilt"},  {"boom"},
                                          {"right_track", true}, {"thumb"}, {"arm"}};
  const DeltaCan message = DeltaCanOf(levers, {0.5, 0.25, -1, -0.5, -0.25, 1}, 3'000'000'007);
  EXPECT_EQ(message.left_travel, 0.5f);
  EXPECT_EQ(message.right_travel, -0.5f);
  EXPECT_EQ(message.boom, -1);
  EXPECT_EQ(message.arm, 1);
  EXPECT_EQ(message.bucket, 0);
  EXPECT_THAT(message.others, testing::ElementsAre(0.25f, -0.25f));
  EXPECT_EQ(message.stamp_sec, 3);
  EXPECT_EQ(message.stamp_nanosec, 7u);
  EXPECT_TRUE(message.enable);
  EXPECT_FALSE(message.hydraulic_lock);
}

// Counted by hand from the definition: header 4 + 4 + (4 + 1), 3 to align, 8 floats, 3 bools, 1 to
// align, a length and two floats. ROS 1 has no padding; its header has its number, and its texts no
// final 0.
TEST(DeltaCan, IsAsLongAsItsDefinitionSays) {
  const DeltaCan message = DeltaCanOf({{"tilt"}, {"thumb"}}, {0.25, -0.25}, 0);
  Serializer cdr(WireForm::kCdr), ros1(WireForm::kRos1);
  cdr.Put(message);
  ros1.Put(message);
  EXPECT_EQ(cdr.bytes().size(), 4u + 13 + 3 + 32 + 3 + 1 + 4 + 8);
  EXPECT_EQ(ros1.bytes().size(), 4u + 8 + 4 + 32 + 3 + 4 + 8);
}

}  // namespace
}  // namespace tera::ros
