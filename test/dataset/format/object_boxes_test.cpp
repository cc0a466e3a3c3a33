#include "dataset/format/object_boxes.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "dataset/files/checked_file.h"
#include "own_folder.h"

namespace tera {
namespace {

CameraFrame LabelledFrame() {
  CameraFrame frame;
  frame.t_ns = 300;
  frame.exposure = {.exposure_s = 0.004,
                    .f_number = 4,
                    .gain_db = 6.5,
                    .saturation_cdpm2 = 5920.25,
                    .balance = Vec3(1.25, 1, 1.5)};
  frame.loads = {{.instance = 7,
                  .name = "a/bucket_soil",
                  .visible_px = 812,
                  .volume_m3 = 0.0625,
                  .mass_kg = 119.5,
                  .fill = 0.75,
                  .released_kgps = -41.5},
                 {.instance = 9, .name = "b/bucket_soil"}};
  ObjectBox box;
  box.instance = 3;
  box.name = "person";
  box.label = SemanticClass::kPerson;
  box.light = {.blur_px = 3.125,
               .most_blur_px = 4.5,
               .luminance_cdpm2 = 2210,
               .illuminance_lx = 54200.5,
               .shadow = 0.25};
  frame.boxes = {box};
  return frame;
}

TEST(ObjectBoxes, LightExposureAndLoadsReadBackAsTheyWere) {
  const std::filesystem::path file = OwnFolder() / "300.json";
  WriteWholeFile(file, EncodeBoxes(LabelledFrame()));
  CameraFrame read;
  ReadBoxes(file, &read);
  ASSERT_TRUE(read.exposure);
  EXPECT_EQ(read.exposure->exposure_s, 0.004);
  EXPECT_EQ(read.exposure->gain_db, 6.5);
  EXPECT_EQ(read.exposure->saturation_cdpm2, 5920.25);
  EXPECT_EQ(read.exposure->balance, Vec3(1.25, 1, 1.5));
  ASSERT_EQ(read.loads.size(), 2u);
  EXPECT_EQ(read.loads[0].name, "a/bucket_soil");
  EXPECT_EQ(read.loads[0].volume_m3, 0.0625);
  EXPECT_EQ(read.loads[0].released_kgps, -41.5);
  EXPECT_FALSE(read.loads[1].released_kgps);
  ASSERT_TRUE(read.boxes.at(0).light);
  EXPECT_EQ(read.boxes[0].light->blur_px, 3.125);
  EXPECT_EQ(read.boxes[0].light->illuminance_lx, 54200.5);
  EXPECT_EQ(read.boxes[0].light->shadow, 0.25);
}

// EV = log2(16 / 0.004) = log2(4000).
TEST(ObjectBoxes, TheExposureValueStandsBeside) {
  EXPECT_NE(EncodeBoxes(LabelledFrame()).find("\"ev\": 11.9657"), std::string::npos)
      << EncodeBoxes(LabelledFrame());
}

TEST(ObjectBoxes, WithoutThemAFileIsAsItAlwaysWas) {
  CameraFrame frame = LabelledFrame();
  frame.exposure.reset();
  frame.loads.clear();
  frame.boxes.clear();
  EXPECT_EQ(EncodeBoxes(frame), "{\n \"t_ns\": 300,\n \"boxes\": []\n}\n");
}

TEST(ObjectBoxes, ALoadWithoutItsMassIsRefusedWithItsFile) {
  const std::filesystem::path file = OwnFolder() / "300.json";
  std::string text = EncodeBoxes(LabelledFrame());
  text.replace(text.find("mass_kg"), 7, "mass_lb");
  WriteWholeFile(file, text);
  CameraFrame read;
  try {
    ReadBoxes(file, &read);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("300.json: not a file of boxes"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("mass_kg"), std::string::npos);
  }
}

}  // namespace
}  // namespace tera
