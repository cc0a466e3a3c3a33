#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "core/faults.h"
#include "core/units.h"
#include "dataset/export/export.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/sample_recording.h"

// A machine that drives east by 1 m/s, with a camera and a lidar on its chassis and a camera on its
// boom, which turns. A person walks north by 2 m/s, 10 m before it.

namespace tera {
namespace {

using enum FaultKind;
using nlohmann::json;
namespace fs = std::filesystem;

constexpr TimeNs kNuscenesMs = 1'000'000;
constexpr std::uint16_t kPerson = 2, kDigger = 5, kBoom = 6;

std::string Sheet(const std::string& type, const std::string& link, const std::string& xyz_m,
                  const std::string& more) {
  return "type: " + type + "\nname: x\nparent_link: " + link +
         "\nX_parent_sensor:\n  xyz_m: " + xyz_m +
         "\n  quaternion_wxyz: [1, 0, 0, 0]\nrate_hz: 10\nlatency_s: 0\n" + more;
}

constexpr const char* kLens =
    "model:\n  width_px: 4\n  height_px: 3\n  fx_px: 2\n  fy_px: 2\n  cx_px: 1.5\n  cy_px: 1\n";

std::vector<JointTree> Tree() {
  JointTree tree{"digger", "chassis"};
  tree.joints.push_back({"boom", "chassis", "boom", JointTree::Motion::kTurns,
                         MakePose(Vec3(0, 0, 1)), Vec3::UnitY()});
  return {tree};
}

/// The person's box, 10 m ahead of the camera in W, seen from the camera at (1 + t, 0, 2).
CameraFrame FrameAt(TimeNs t_ns, double visibility) {
  const double t_s = ToSeconds(t_ns);
  CameraFrame frame;
  frame.t_ns = t_ns;
  frame.rgb = Image<std::uint8_t>(4, 3, 3);
  frame.semantic = Image<std::uint8_t>(4, 3);
  frame.instance = Image<std::uint16_t>(4, 3);
  ObjectBox person;
  person.instance = kPerson;
  person.label = SemanticClass::kPerson;
  person.name = "person";
  person.visible_px = 3;
  person.visibility = visibility;
  person.size_O_m = Vec3(0.5, 0.6, 1.8);
  const Vec3 p_CO_m(-2 * t_s, 1.1, 10 - 1 - t_s);  // right, down, forward of (10, 2 t, 0.9)
  Mat3 R_CO;                                       // the person looks along x of W
  R_CO << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  person.X_CO = MakePose(p_CO_m, R_CO);
  ObjectBox own = person, part = person, unseen = person;
  own.instance = kDigger;
  own.name = "digger";
  own.label = SemanticClass::kVehicle;
  part.instance = kBoom;
  part.parent = kDigger;
  unseen.instance = 1;
  unseen.name = "truck";
  unseen.visible_px = 0;
  frame.boxes = {unseen, person, own, part};
  return frame;
}

class NuscenesTest : public testing::Test {
 protected:
  NuscenesTest() {
    DatasetInfo info = SampleInfo();
    info.instances.push_back({kDigger, "digger", "vehicle"});
    info.instances.push_back({kBoom, "digger/boom", "boom", kDigger});
    DatasetWriter writer(recording(), info, {});
    const ChannelId front = writer.AddChannel(
        CameraChannel("digger/front", Sheet("camera", "chassis", "[1, 0, 2]", kLens)));
    const ChannelId boom = writer.AddChannel(
        CameraChannel("digger/boom_eye", Sheet("camera", "boom", "[1, 0, 0]", kLens)));
    const ChannelId lidar =
        writer.AddChannel(LidarChannel("digger/roof", Sheet("lidar", "chassis", "[0, 0, 3]", "")));
    const ChannelId pose = writer.AddChannel(PoseChannel("truth/digger/pose.csv"));
    const ChannelId joints =
        writer.AddChannel(TableChannel("truth/digger/joints.csv", {"boom_rad", "boom_radps"}));
    for (const double t_s : {0.0, 1.0}) {
      const TimeNs t_ns = FromSeconds(t_s);
      writer.Write(pose, RowOf(TruthPose{t_ns, MakePose(Vec3(t_s, 0, 0))}));
      writer.Write(joints, RowSample{t_ns, t_ns, {t_s, 1}});
    }
    for (const TimeNs t_ms : {0, 100, 600}) {
      writer.Write(front, FrameAt(t_ms * kNuscenesMs, t_ms == 600 ? 0.5 : 0.9));
      CameraFrame other = FrameAt(t_ms * kNuscenesMs, 1);
      other.boxes.clear();
      writer.Write(boom, std::move(other));
    }
    for (const TimeNs t_ms : {0, 100, 500}) {
      LidarPoint person, ground, own;
      person.x_m = 10 - 0.001f * static_cast<float>(t_ms);  // of the first ray
      person.y_m = 2 * 0.001f * static_cast<float>(t_ms + 50);
      person.z_m = -2.1f;
      person.intensity = 0.5f;
      person.ring = 7;
      person.label = static_cast<std::uint8_t>(SemanticClass::kPerson);
      person.instance = kPerson;
      ground.x_m = 5;
      ground.label = static_cast<std::uint8_t>(SemanticClass::kTerrain);
      own.label = static_cast<std::uint8_t>(SemanticClass::kBoom);
      own.instance = kBoom;
      writer.Write(lidar, LidarScan{t_ms * kNuscenesMs, t_ms * kNuscenesMs, {person, ground, own}});
    }
    writer.Finish();
  }

  fs::path recording() const { return scratch_.path() / "run"; }
  fs::path out() const { return scratch_.path() / "out"; }
  void To(double key_frames_hz = 2) {
    Export(
        recording(), out(),
        {.format = ExportFormat::kNuscenes, .key_frames_hz = key_frames_hz, .joint_trees = Tree});
  }
  json Table(const std::string& name) {
    if (!fs::exists(out())) To();
    return json::parse(ReadWholeFile(out() / "v1.0-tera" / (name + ".json")));
  }
  json DataOf(const std::string& channel) {
    json rows = json::array();
    for (const json& row : Table("sample_data")) {
      if (row["filename"].get<std::string>().find("/" + channel + "/") != std::string::npos) {
        rows.push_back(row);
      }
    }
    return rows;
  }
  std::vector<InputFault> Fault() {
    try {
      To();
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

// Scans take 100 ms: their middles are at 50, 150 and 550 ms. The second is too soon.
TEST_F(NuscenesTest, SamplesAreInTheMiddleOfScans) {
  const json samples = Table("sample");
  ASSERT_EQ(samples.size(), 2u);
  EXPECT_EQ(samples[0]["timestamp"], 1'704'067'200'050'000);
  EXPECT_EQ(samples[1]["timestamp"], 1'704'067'200'550'000);
  EXPECT_EQ(samples[0]["next"], samples[1]["token"]);
  const json lidar = DataOf("LIDAR_TOP");
  ASSERT_EQ(lidar.size(), 3u);
  EXPECT_EQ(lidar[1]["is_key_frame"], false);
  EXPECT_EQ(lidar[1]["sample_token"], samples[1]["token"]);
  EXPECT_EQ(lidar[1]["filename"],
            "sweeps/LIDAR_TOP/two__words_-digger__LIDAR_TOP__1704067200150000.pcd.bin");
}

TEST_F(NuscenesTest, MoreKeyFramesWhereTheyAreAskedFor) {
  To(10);
  EXPECT_EQ(Table("sample").size(), 3u);
}

// The camera's pictures at 0 and 100 ms are equally near to the first sample. The boom turns about
// its y by 1 rad between the two rows of its joints, linearly.
TEST_F(NuscenesTest, ASensorThatMovesHasANewMountForEachFrame) {
  const json front = DataOf("CAM_FRONT"), boom = DataOf("CAM_BOOM_EYE");
  ASSERT_EQ(front.size(), 3u);
  EXPECT_EQ(front[0]["is_key_frame"], true);
  EXPECT_EQ(front[1]["is_key_frame"], false);
  EXPECT_EQ(front[0]["calibrated_sensor_token"], front[2]["calibrated_sensor_token"]);
  EXPECT_NE(boom[0]["calibrated_sensor_token"], boom[1]["calibrated_sensor_token"]);
  for (const json& mount : Table("calibrated_sensor")) {
    if (mount["token"] == boom[2]["calibrated_sensor_token"]) {
      EXPECT_NEAR(mount["translation"][0], 0.4 + 0.6 * std::cos(1), 1e-9);
      EXPECT_NEAR(mount["translation"][2], 1 - 0.6 * std::sin(1), 1e-9);
    }
    if (mount["token"] == front[0]["calibrated_sensor_token"]) {
      EXPECT_EQ(mount["translation"], json({1.0, 0.0, 2.0}));
      EXPECT_EQ(mount["camera_intrinsic"],
                json({{2.0, 0.0, 1.5}, {0.0, 2.0, 1.0}, {0.0, 0.0, 1.0}}));
    }
  }
  for (const json& pose : Table("ego_pose")) {
    if (pose["token"] == front[2]["ego_pose_token"]) {
      EXPECT_NEAR(pose["translation"][0], 0.6, 1e-12);
    }
  }
}

// Between pictures the person moves linearly: at 50 ms it is 0.1 m to the north, at 550 ms 1.1 m.
// Neither the machine, nor its boom, nor invisible objects are annotated.
TEST_F(NuscenesTest, AnObjectIsAnnotatedWhereItIsAtTheTimeOfTheSample) {
  const json annotations = Table("sample_annotation");
  ASSERT_EQ(annotations.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    const json& a = annotations[k];
    EXPECT_NEAR(a["translation"][0], 10, 1e-9);
    EXPECT_NEAR(a["translation"][1], k == 0 ? 0.1 : 1.1, 1e-9);
    EXPECT_NEAR(a["translation"][2], 0.9, 1e-9);
    EXPECT_NEAR(a["rotation"][0], 1, 1e-9);
    EXPECT_EQ(a["size"], json({0.6, 0.5, 1.8}));  // width, length, height
    EXPECT_EQ(a["num_lidar_pts"], 1);
  }
  EXPECT_EQ(annotations[0]["next"], annotations[1]["token"]);
  EXPECT_EQ(annotations[1]["prev"], annotations[0]["token"]);
  EXPECT_EQ(annotations[0]["visibility_token"], "4");
  EXPECT_EQ(annotations[1]["visibility_token"], "2");  // half of it, in the picture at 600 ms
  const json instances = Table("instance"), categories = Table("category");
  ASSERT_EQ(instances.size(), 1u);
  EXPECT_EQ(instances[0]["nbr_annotations"], 2);
  EXPECT_EQ(categories[4]["token"], instances[0]["category_token"]);
  EXPECT_EQ(categories[4]["name"], "human.pedestrian.construction_worker");
}

// All three points have the time of the first ray, 50 ms before the middle, when the lidar was 5 cm
// further back.
TEST_F(NuscenesTest, PointsAreOfTheScansMiddleWithCategoriesOfKeyFrames) {
  const json lidar = DataOf("LIDAR_TOP");
  const std::string bytes = ReadWholeFile(out() / lidar[0]["filename"].get<std::string>());
  ASSERT_EQ(bytes.size(), 3u * 5 * sizeof(float));
  float values[5];
  std::memcpy(values, bytes.data(), sizeof values);
  EXPECT_FLOAT_EQ(values[0], 9.95f);
  EXPECT_FLOAT_EQ(values[1], 0.1f);
  EXPECT_FLOAT_EQ(values[3], 127.5f);
  EXPECT_FLOAT_EQ(values[4], 7);
  const json labels = Table("lidarseg");
  ASSERT_EQ(labels.size(), 2u);
  EXPECT_EQ(labels[0]["sample_data_token"], lidar[0]["token"]);
  EXPECT_EQ(ReadWholeFile(out() / labels[0]["filename"].get<std::string>()),
            std::string({4, 27, 31}));  // a worker, terrain, the machine itself
}

TEST_F(NuscenesTest, TokensOfAnotherRecordingAreOthers) {
  const json before = Table("sample");
  fs::remove_all(out());
  Edit("dataset.yaml", "seed: 7", "seed: 8");
  EXPECT_EQ(before[0]["token"].get<std::string>().size(), 32u);
  EXPECT_NE(before[0]["token"], Table("sample")[0]["token"]);
}

TEST_F(NuscenesTest, AFisheyeIsLeftOut) {
  Edit("digger/front/sensor.yaml", "model:\n", "model:\n  lens: kannala_brandt\n");
  EXPECT_TRUE(DataOf("CAM_FRONT").empty());
  EXPECT_FALSE(DataOf("CAM_BOOM_EYE").empty());
  EXPECT_TRUE(Table("sample_annotation").empty());
}

TEST_F(NuscenesTest, WhatCannotBeExportedIsNamed) {
  Edit("dataset.yaml", "path: \"digger/boom_eye\"", "path: \"digger/FRONT\"");
  fs::rename(recording() / "digger/boom_eye", recording() / "digger/FRONT");
  EXPECT_THAT(Fault(), HasFault(kRepeated, "digger/FRONT"));
  fs::remove_all(recording() / "digger/FRONT/rgb");
  Edit("digger/front/sensor.yaml", "width_px: 4", "width_px: 40");
  EXPECT_THAT(Fault(), HasFault(kInconsistent, "rgb/0.png"));
  Edit("digger/front/sensor.yaml", "width_px: 40", "width_px: 4");
  Edit("digger/front/boxes/0.json", "\"p_CO_m\"", "\"p_CO\"");
  EXPECT_THAT(Fault(), HasFault(kMalformed, "boxes/0.json"));
  fs::remove(recording() / "truth/digger/pose.csv");
  Edit("dataset.yaml", "  - {path: \"truth/digger/pose.csv\", type: pose}\n", "");
  EXPECT_THAT(Fault(), HasFault(kMissing));
}

TEST_F(NuscenesTest, WithoutPicturesAndScansThereIsNothing) {
  for (const char* sensor : {"front", "boom_eye"}) {
    fs::remove_all(recording() / "digger" / sensor / "rgb");
  }
  WriteWholeFile(recording() / "digger/roof/data.csv", "t_ns,filename\n");
  EXPECT_THAT(Fault(), HasFault(kMissing));
}

}  // namespace
}  // namespace tera
