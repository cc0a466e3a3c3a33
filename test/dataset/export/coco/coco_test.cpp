#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/faults.h"
#include "dataset/export/export.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/object_boxes.h"
#include "dataset/format/png.h"
#include "dataset/format/sample_recording.h"

// A picture of 4 x 3 pixels: sky above, ground below, a machine of two parts and a person.

namespace tera {
namespace {

using enum FaultKind;
using nlohmann::json;
namespace fs = std::filesystem;

constexpr std::uint16_t kBoom = 1, kArm = 2, kPerson = 300, kMachine = 9;

class CocoTest : public testing::Test {
 protected:
  CocoTest() {
    DatasetInfo info = SampleInfo();
    info.instances = {{kBoom, "digger/boom", "boom", kMachine},
                      {kArm, "digger/arm", "arm", kMachine},
                      {kMachine, "digger", "vehicle"},
                      {kPerson, "walker", "person"}};
    DatasetWriter writer(recording(), info, {});
    const ChannelId front = writer.AddChannel(CameraChannel("digger/front", "type: camera\n"));
    const ChannelId depth = writer.AddChannel(CameraChannel("digger/depth", "type: camera\n"));
    writer.Write(front, Frame());
    CameraFrame other;
    other.depth_m = Image<float>(4, 3);
    writer.Write(depth, std::move(other));
    writer.Finish();
  }

  static CameraFrame Frame() {
    CameraFrame frame;
    frame.rgb = Image<std::uint8_t>(4, 3, 3);
    frame.semantic = Image<std::uint8_t>(4, 3);
    frame.instance = Image<std::uint16_t>(4, 3);
    frame.semantic.data = {0, 0, 0, 0,   //
                           4, 4, 5, 11,  //
                           1, 4, 1, 11};
    frame.instance.data = {0, 0,     0,    0,        //
                           1, kBoom, kArm, kPerson,  //
                           0, kBoom, 0,    kPerson};
    return frame;
  }

  fs::path recording() const { return scratch_.path() / "run"; }
  fs::path out() const { return scratch_.path() / "out"; }
  json Exported(const std::string& file) {
    if (!fs::exists(out())) Export(recording(), out(), {.format = ExportFormat::kCoco});
    return json::parse(ReadWholeFile(out() / file));
  }
  std::vector<InputFault> Fault() {
    try {
      Export(recording(), out(), {.format = ExportFormat::kCoco});
    } catch (const InputError& e) {
      EXPECT_FALSE(fs::exists(out()) || fs::exists(out().string() + ".incomplete"));
      return e.faults();
    }
    return {};
  }
  void Edit(const std::string& file, const std::string& from, const std::string& to) {
    std::string text = ReadWholeFile(recording() / file);
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << text;
    WriteWholeFile(recording() / file, text.replace(at, from.size(), to));
  }

  ScratchDirectory scratch_;
};

TEST_F(CocoTest, EachObjectHasItsMaskAndAWholeThoseOfItsParts) {
  const json document = Exported("annotations/instances.json");
  ASSERT_EQ(document["images"].size(), 1u);
  EXPECT_EQ(document["images"][0]["file_name"], "digger_front_0.png");
  EXPECT_EQ(document["images"][0]["width"], 4);
  EXPECT_EQ(document["images"][0]["height"], 3);
  ASSERT_EQ(document["annotations"].size(), 4u);
  // Columns from the left: the boom is the middle of the first, and the lower two of the second.
  const json& boom = document["annotations"][0];
  EXPECT_EQ(boom["name"], "digger/boom");
  EXPECT_EQ(boom["segmentation"]["size"], json({3, 4}));
  EXPECT_EQ(boom["segmentation"]["counts"], "11214");  // 1, 1, 2, 2 - 1, 6 - 2
  EXPECT_EQ(boom["bbox"], json({0, 1, 2, 2}));
  EXPECT_EQ(boom["area"], 3);
  EXPECT_EQ(boom["parent_instance_id"], kMachine);
  const json& machine = document["annotations"][2];
  EXPECT_EQ(machine["instance_id"], kMachine);
  EXPECT_EQ(machine["bbox"], json({0, 1, 3, 2}));
  EXPECT_EQ(machine["area"], 4);
  EXPECT_EQ(machine["category_id"], 10);  // class 9, vehicle
}

TEST_F(CocoTest, APanopticPictureHasNumbersOfSegmentsAsColours) {
  const json document = Exported("annotations/panoptic.json");
  const Image<std::uint8_t> picture = ReadRgbPng(out() / "annotations/panoptic/digger_front_0.png");
  const auto colour = [&](int x, int y) {
    return std::array<int, 3>{picture.at(x, y, 0), picture.at(x, y, 1), picture.at(x, y, 2)};
  };
  EXPECT_EQ(colour(3, 1), (std::array<int, 3>{44, 1, 0}));  // 300 = 256 + 44
  EXPECT_EQ(colour(0, 0), (std::array<int, 3>{0, 0, 1}));   // sky, class 0
  EXPECT_EQ(colour(0, 2), (std::array<int, 3>{0, 0, 2}));   // terrain, class 1
  const json& segments = document["annotations"][0]["segments_info"];
  ASSERT_EQ(segments.size(), 5u);
  EXPECT_EQ(segments[4]["id"], 131072);
  EXPECT_EQ(segments[4]["category_id"], 2);
  EXPECT_EQ(segments[4]["area"], 2);
  EXPECT_EQ(segments[4]["bbox"], json({0, 2, 3, 1}));
}

constexpr std::array<const char*, 17> kBackwards = {
    "right_ankle",    "left_ankle",    "right_knee", "left_knee",   "right_hip",
    "left_hip",       "right_wrist",   "left_wrist", "right_elbow", "left_elbow",
    "right_shoulder", "left_shoulder", "right_ear",  "left_ear",    "right_eye",
    "left_eye",       "nose"};

ObjectBox BoxWith(std::uint16_t instance, SemanticClass label, std::vector<Keypoint> points) {
  ObjectBox box;
  box.instance = instance;
  box.label = label;
  box.keypoints = std::move(points);
  return box;
}

/// The file of a picture's boxes.
std::string FileOf(std::vector<ObjectBox> boxes) {
  CameraFrame frame;
  frame.boxes = std::move(boxes);
  return EncodeBoxes(frame);
}

// A person's points are in COCO's order, independent of their own; the nose is first. A point
// outside the picture has no place and counts as not labelled.
TEST_F(CocoTest, KeyPointsAreInTheOrderOfTheirCategory) {
  std::vector<Keypoint> person;
  for (const char* name : kBackwards) {
    person.push_back({name, Vec3(0, 0, 5), Vec2(3.25, 1.5), KeypointSight::kHidden});
  }
  person.back().sight = KeypointSight::kSeen;
  person.front() = {"right_ankle", Vec3(0, 2, 5), Vec2(3.5, 80), KeypointSight::kOutside};
  const std::vector<Keypoint> machine = {
      {"boom_pin", Vec3(0, 0, 4), Vec2(1, 1), KeypointSight::kSeen},
      {"arm_pin", Vec3(0, 0, -1), std::nullopt, KeypointSight::kOutside}};
  WriteWholeFile(recording() / "digger/front/boxes/0.json",
                 FileOf({BoxWith(kMachine, SemanticClass::kVehicle, machine),
                         BoxWith(kPerson, SemanticClass::kPerson, person),
                         BoxWith(kBoom, SemanticClass::kBoom, {})}));
  const json document = Exported("annotations/keypoints.json");
  ASSERT_EQ(document["images"].size(), 1u);
  ASSERT_EQ(document["annotations"].size(), 2u);
  const json& of_machine = document["annotations"][0];
  EXPECT_EQ(of_machine["keypoints"], json({1.0, 1.0, 2, 0.0, 0.0, 0}));
  EXPECT_EQ(of_machine["num_keypoints"], 1);
  EXPECT_EQ(of_machine["area"], 4);
  EXPECT_EQ(of_machine["category_id"], 1001);
  const json& of_person = document["annotations"][1];
  ASSERT_EQ(of_person["keypoints"].size(), 3u * 17);
  EXPECT_EQ(of_person["keypoints"][2], 2);   // the nose is seen
  EXPECT_EQ(of_person["keypoints"][5], 1);   // the left eye hidden
  EXPECT_EQ(of_person["keypoints"][50], 0);  // the right ankle outside
  EXPECT_EQ(of_person["keypoints"][49], 0.0);
  EXPECT_EQ(of_person["num_keypoints"], 16);
  EXPECT_EQ(of_person["id"], Exported("annotations/instances.json")["annotations"][3]["id"]);
  const json& categories = document["categories"];
  ASSERT_EQ(categories.size(), 2u);
  EXPECT_EQ(categories[0]["name"], "vehicle_1");
  EXPECT_EQ(categories[0]["keypoints"], json({"boom_pin", "arm_pin"}));
  EXPECT_EQ(categories[1]["id"], 12);  // class 11, person
  EXPECT_EQ(categories[1]["keypoints"][16], "right_ankle");
  EXPECT_EQ(categories[1]["skeleton"].size(), 19u);
}

TEST_F(CocoTest, ObjectsWithOtherPointsAreOfAnotherCategory) {
  const auto point = [](const char* name) {
    return Keypoint{name, Vec3(0, 0, 4), Vec2(1, 1), KeypointSight::kSeen};
  };
  WriteWholeFile(recording() / "digger/front/boxes/0.json",
                 FileOf({BoxWith(kMachine, SemanticClass::kVehicle, {point("a"), point("b")}),
                         BoxWith(kBoom, SemanticClass::kVehicle, {point("b"), point("a")}),
                         BoxWith(kPerson, SemanticClass::kPerson, {point("nose")})}));
  const json categories = Exported("annotations/keypoints.json")["categories"];
  ASSERT_EQ(categories.size(), 3u);
  EXPECT_EQ(categories[1]["name"], "vehicle_2");
  EXPECT_EQ(categories[1]["id"], 1002);
  EXPECT_EQ(categories[2]["name"], "person_1");
  EXPECT_EQ(categories[2]["skeleton"], json::array());
}

TEST_F(CocoTest, WithoutKeyPointsThereIsNoFileOfThem) {
  Exported("annotations/instances.json");
  EXPECT_FALSE(fs::exists(out() / "annotations/keypoints.json"));
}

TEST_F(CocoTest, PicturesAreTheRecordingsOwn) {
  Exported("annotations/instances.json");
  EXPECT_EQ(ReadWholeFile(out() / "images/digger_front_0.png"),
            ReadWholeFile(recording() / "digger/front/rgb/0.png"));
  EXPECT_FALSE(fs::exists(out() / "images/digger_depth_0.png"));
}

TEST_F(CocoTest, ADateIsWrittenWhereOneIsGiven) {
  Export(recording(), out(),
         {.format = ExportFormat::kCoco, .start_utc_ns = 1'714'564'800 * kNsPerSecond});
  EXPECT_EQ(Exported("annotations/instances.json")["images"][0]["date_captured"],
            "2024-05-01 12:00:00");
}

TEST_F(CocoTest, WithoutLabelsThereIsNothing) {
  fs::remove_all(recording() / "digger/front/instance");
  EXPECT_THAT(Fault(), HasFault(kMissing));
}

TEST_F(CocoTest, AnObjectThatIsNotListedIsNamed) {
  Edit("dataset.yaml", "id: 300", "id: 301");
  EXPECT_THAT(Fault(), HasFault(kNoSuchName, "instance/0.png"));
}

TEST_F(CocoTest, AMachineThatIsAPartOfItselfIsRefused) {
  Edit("dataset.yaml", "class: vehicle}", "class: vehicle, parent: 1}");
  EXPECT_THAT(Fault(), HasFault(kInconsistent, "dataset.yaml"));
}

TEST_F(CocoTest, APictureThatIsCutOffIsNamed) {
  const fs::path file = recording() / "digger/front/rgb/0.png";
  const std::string whole = ReadWholeFile(file);
  WriteWholeFile(file, whole.substr(0, whole.size() - 3));
  EXPECT_THAT(Fault(), HasFault(kMalformed, "rgb/0.png"));
  WriteWholeFile(file, "");
  EXPECT_THAT(Fault(), HasFault(kMalformed, "rgb/0.png"));
}

TEST_F(CocoTest, CamerasWhosePicturesWouldShareNamesAreRefused) {
  fs::copy(recording() / "digger/front", recording() / "digger_front", fs::copy_options::recursive);
  Edit("dataset.yaml", "channels:\n", "channels:\n  - {path: \"digger_front\", type: camera}\n");
  EXPECT_THAT(Fault(), HasFault(kRepeated, "digger/front"));
}

TEST_F(CocoTest, AClassThatIsNoneIsNamed) {
  Image<std::uint8_t> semantic = Frame().semantic;
  semantic.data[3] = 99;
  WriteWholeFile(recording() / "digger/front/semantic/0.png", EncodeGreyPng(semantic));
  EXPECT_THAT(Fault(), HasFault(kNoSuchName, "semantic/0.png"));
}

}  // namespace
}  // namespace tera
