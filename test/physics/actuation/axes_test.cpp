#include "physics/actuation/axes.h"

#include <gtest/gtest.h>

#include "physics/machine_fixture.h"

namespace tera {
namespace {

TEST(Axes, AreJointsAndThenGearsByTheirNames) {
  const MachineModel model = ShippedMachine("tb235");
  EXPECT_EQ(AxisNamed(model, "boom"), model.JointIndex("boom"));
  const int left = AxisNamed(model, "left_track");
  ASSERT_GE(left, static_cast<int>(model.joints.size()));
  EXPECT_EQ(NameOfAxis(model, static_cast<std::size_t>(left)), "left_track");
  EXPECT_EQ(NameOfAxis(model, static_cast<std::size_t>(model.JointIndex("boom"))), "boom");
  EXPECT_EQ(AxisNamed(model, "upper"), -1);  // a link
}

TEST(Axes, HaveALeverWhereTheMachineNamesOne) {
  MachineModel model = ShippedMachine("tb235");
  const auto boom = static_cast<std::size_t>(AxisNamed(model, "boom"));
  const auto left = static_cast<std::size_t>(AxisNamed(model, "left_track"));
  EXPECT_TRUE(HasLever(model, boom));
  EXPECT_TRUE(HasLever(model, left));
  model.levers.clear();
  EXPECT_FALSE(HasLever(model, boom));
  EXPECT_FALSE(HasLever(model, left));
}

}  // namespace
}  // namespace tera
