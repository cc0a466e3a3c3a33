#include "sensors/camera/load_labels.h"

#include <gtest/gtest.h>

namespace tera {
namespace {

/// Two shovels, the second initially empty, and a picture with six pixels of the first's soil.
class TwoShovels : public ::testing::Test {
 protected:
  TwoShovels() {
    model_.instances = {{.name = "none"},
                        {.name = "truck"},
                        {.name = "a/bucket_soil", .shape = 0, .capacity_m3 = 0.5},
                        {.name = "b/bucket_soil", .shape = 1, .capacity_m3 = 2}};
    state_.shapes = {Soil(0.2, 300), nullptr};
    frame_.instance = Image<std::uint16_t>(5, 4);
    std::fill_n(frame_.instance.data.begin(), 6, std::uint16_t{2});
  }

  static std::shared_ptr<const ShapedMesh> Soil(double volume_m3, double mass_kg) {
    auto soil = std::make_shared<ShapedMesh>();
    soil->volume_m3 = volume_m3;
    soil->mass_kg = mass_kg;
    return soil;
  }

  SceneModel model_;
  SceneState state_;
  CameraFrame frame_;
};

TEST_F(TwoShovels, HaveARowEachSeenOrNot) {
  LoadLabels labels;
  labels.Fill(model_, state_, &frame_);
  ASSERT_EQ(frame_.loads.size(), 2u);
  EXPECT_EQ(frame_.loads[0].instance, 2);
  EXPECT_EQ(frame_.loads[0].name, "a/bucket_soil");
  EXPECT_EQ(frame_.loads[0].visible_px, 6);
  EXPECT_EQ(frame_.loads[0].mass_kg, 300);
  EXPECT_DOUBLE_EQ(frame_.loads[0].fill, 0.4);
  EXPECT_EQ(frame_.loads[1].visible_px, 0);
  EXPECT_EQ(frame_.loads[1].volume_m3, 0);
  EXPECT_FALSE(frame_.loads[0].released_kgps) << "before the first there is no picture";
}

// 120 kg less after half a second are 240 kg/s; 60 kg more -120.
TEST_F(TwoShovels, WhatOneLosesIsToldByTheSecond) {
  LoadLabels labels;
  labels.Fill(model_, state_, &frame_);
  state_.t_ns = 500'000'000;
  state_.shapes = {Soil(0.12, 180), Soil(0.04, 60)};
  labels.Fill(model_, state_, &frame_);
  EXPECT_DOUBLE_EQ(frame_.loads[0].released_kgps.value(), 240);
  EXPECT_DOUBLE_EQ(frame_.loads[1].released_kgps.value(), -120);
}

}  // namespace
}  // namespace tera
