#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "core/faults.h"
#include "core/units.h"
#include "dataset/export/export.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/png.h"
#include "dataset/format/sample_recording.h"

// A machine that drives east by 1 m/s, with a camera and a lidar on its chassis and a camera on its
// boom, which turns.

namespace tera {
namespace {

using enum FaultKind;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;
namespace fs = std::filesystem;

constexpr TimeNs kMs = 1'000'000;

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

CameraFrame FrameAt(TimeNs t_ns) {
  CameraFrame frame;
  frame.t_ns = t_ns;
  frame.rgb = Image<std::uint8_t>(4, 3, 3);
  frame.rgb.data[0] = static_cast<std::uint8_t>(t_ns / kMs);
  frame.depth_m = Image<float>(4, 3);
  frame.depth_m.at(2, 1) = 10.5f;
  frame.semantic = Image<std::uint8_t>(4, 3);
  frame.instance = Image<std::uint16_t>(4, 3);
  return frame;
}

class KittiTest : public testing::Test {
 protected:
  KittiTest() {
    DatasetWriter writer(recording(), SampleInfo(), {});
    const ChannelId front = writer.AddChannel(
        CameraChannel("digger/front", Sheet("camera", "chassis", "[1, 0, 2]", kLens)));
    const ChannelId boom = writer.AddChannel(
        CameraChannel("digger/boom", Sheet("camera", "boom", "[1, 0, 0]", kLens)));
    const ChannelId lidar =
        writer.AddChannel(LidarChannel("digger/lidar", Sheet("lidar", "chassis", "[0, 0, 3]", "")));
    const ChannelId pose = writer.AddChannel(PoseChannel("truth/digger/pose.csv"));
    const ChannelId joints =
        writer.AddChannel(TableChannel("truth/digger/joints.csv", {"boom_rad", "boom_radps"}));
    for (const double t_s : {0.0, 1.0}) {
      const TimeNs t_ns = FromSeconds(t_s);
      writer.Write(pose, RowOf(TruthPose{t_ns, MakePose(Vec3(t_s, 0, 0))}));
      writer.Write(joints, RowSample{t_ns, t_ns, {t_s, 1}});
    }
    for (const TimeNs t_ms : {0, 40, 120}) {
      writer.Write(front, FrameAt(t_ms * kMs));
      writer.Write(boom, FrameAt(t_ms * kMs));
    }
    for (const TimeNs t_ms : {0, 100, 200}) {
      LidarPoint ahead, late;
      ahead.x_m = 5;
      ahead.intensity = 0.25f;
      ahead.label = static_cast<std::uint8_t>(SemanticClass::kPerson);
      ahead.instance = 258;
      late.x_m = 5;
      late.time_offset_ns = static_cast<std::uint32_t>(90 * kMs);
      writer.Write(lidar, LidarScan{t_ms * kMs, t_ms * kMs, {ahead, late}});
    }
    writer.Finish();
  }

  fs::path recording() const { return scratch_.path() / "run"; }
  fs::path out() const { return scratch_.path() / "out"; }
  void To(std::vector<KittiLayout> layouts, const std::string& camera = "") {
    Export(recording(), out(),
           {.format = ExportFormat::kKitti,
            .kitti_layouts = std::move(layouts),
            .camera = camera,
            .joint_trees = Tree});
  }
  std::vector<InputFault> FaultOf(std::vector<KittiLayout> layouts,
                                  const std::string& camera = "") {
    try {
      To(std::move(layouts), camera);
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
  std::string Written(const std::string& file) const { return ReadWholeFile(out() / file); }

  ScratchDirectory scratch_;
};

float FloatAt(const std::string& bytes, std::size_t index) {
  float value;
  std::memcpy(&value, bytes.data() + sizeof value * index, sizeof value);
  return value;
}

// Scans begin at 0, 100 and 200 ms. During the first there are pictures at 0 and 40, the latter
// nearer to its middle; during the second one at 120; during the third none.
TEST_F(KittiTest, AFrameIsAScanWithThePictureNearestToItsMiddle) {
  To({KittiLayout::kRaw});
  const std::string drive = "raw/2024_01_01/2024_01_01_drive_0001_sync/";
  EXPECT_EQ(Written(drive + "image_02/timestamps.txt"),
            "2024-01-01 00:00:00.040000000\n2024-01-01 00:00:00.120000000\n");
  EXPECT_EQ(Written(drive + "velodyne_points/timestamps_end.txt"),
            "2024-01-01 00:00:00.100000000\n2024-01-01 00:00:00.200000000\n");
  EXPECT_EQ(ReadRgbPng(out() / (drive + "image_02/data/0000000001.png")).data[0], 120);
  EXPECT_FALSE(fs::exists(out() / (drive + "image_02/data/0000000002.png")));
  EXPECT_FALSE(fs::exists(out() / "object"));
}

// 40 ms after a ray of time 0, the lidar is 4 cm further; for one of 90 ms it is 5 cm less far.
TEST_F(KittiTest, PointsAreWhereTheLidarSeesThemAtTheTimeOfThePicture) {
  To({KittiLayout::kOdometry});
  const std::string points = Written("odometry/sequences/00/velodyne/000000.bin");
  ASSERT_EQ(points.size(), 2u * 4 * sizeof(float));
  EXPECT_FLOAT_EQ(FloatAt(points, 0), 4.96f);
  EXPECT_FLOAT_EQ(FloatAt(points, 3), 0.25f);
  EXPECT_FLOAT_EQ(FloatAt(points, 4), 5.05f);
}

// The lidar is 1 m behind the camera and 1 m above it. 80 ms make 8 cm along the camera's z.
TEST_F(KittiTest, OdometryHasTheMountAndTheWayOfTheCamera) {
  To({KittiLayout::kOdometry});
  const std::string calib = Written("odometry/sequences/00/calib.txt");
  EXPECT_THAT(calib, StartsWith("P0: 2.000000000000e+00 0.000000000000e+00 1.500000000000e+00 0"));
  double m[12];
  ASSERT_EQ(std::sscanf(calib.c_str() + calib.find("Tr:"),
                        "Tr: %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf", m, m + 1, m + 2,
                        m + 3, m + 4, m + 5, m + 6, m + 7, m + 8, m + 9, m + 10, m + 11),
            12);
  const double expected[12] = {0, -1, 0, 0, 0, 0, -1, -1, 1, 0, 0, -1};
  for (int k = 0; k < 12; ++k) EXPECT_NEAR(m[k], expected[k], 1e-12) << k;
  const std::string poses = Written("odometry/poses/00.txt");
  EXPECT_THAT(poses.substr(poses.find('\n')), HasSubstr("1.000000000000e+00 8.000000000000e-02\n"));
  EXPECT_EQ(Written("odometry/sequences/00/times.txt"), "0.000000000\n0.080000000\n");
}

TEST_F(KittiTest, DepthIsIn256thsOfAMetre) {
  To({KittiLayout::kDepth});
  const Image<std::uint16_t> depth = ReadGrey16Png(
      out() / "depth/2024_01_01_drive_0001_sync/proj_depth/groundtruth/image_02/0000000000.png");
  EXPECT_EQ(depth.at(2, 1), 2688);  // 10.5 m
  EXPECT_EQ(depth.at(0, 0), 0);
}

TEST_F(KittiTest, SensorsThatMoveAgainstEachOtherHaveNoOneCalibration) {
  EXPECT_THAT(FaultOf({KittiLayout::kTracking}, "digger/boom"), HasFault(kUnsupported, "run"));
  To({KittiLayout::kObject}, "digger/boom");
  EXPECT_NE(Written("object/training/calib/000000.txt"),
            Written("object/training/calib/000001.txt"));
}

TEST_F(KittiTest, WhatALayoutNeedsAndTheCameraLacksIsNamed) {
  fs::remove_all(recording() / "digger/front/depth");
  EXPECT_THAT(FaultOf({}), HasFault(kUnreadable, "front/depth/40000000.png"));
  fs::remove_all(recording() / "digger/front/boxes");
  EXPECT_THAT(FaultOf({KittiLayout::kObject}), HasFault(kUnreadable, "front/boxes/40000000.json"));
}

TEST_F(KittiTest, AFisheyeIsRefused) {
  Edit("digger/front/sensor.yaml", "model:\n", "model:\n  lens: kannala_brandt\n");
  EXPECT_THAT(FaultOf({}), HasFault(kUnsupported, "digger/front/sensor.yaml"));
}

TEST_F(KittiTest, ASensorOfWhichTooLittleIsKnownIsRefused) {
  EXPECT_THAT(FaultOf({}, "digger/rear"), HasFault(kNoSuchName));
  Edit("digger/lidar/sensor.yaml", "rate_hz: 10\n", "");
  EXPECT_THAT(FaultOf({}), HasFault(kMissing, "digger/lidar/sensor.yaml"));
  Edit("digger/front/sensor.yaml", kLens, "");
  EXPECT_THAT(FaultOf({}), HasFault(kMissing, "digger/front/sensor.yaml"));
}

TEST_F(KittiTest, SensorsThatNeverRanTogetherHaveNoFrames) {
  WriteWholeFile(recording() / "digger/lidar/data.csv", "t_ns,filename\n200000000,200000000.pcd\n");
  EXPECT_THAT(FaultOf({}), HasFault(kMissing, "run"));
}

TEST_F(KittiTest, APictureOfAnotherSizeThanTheLensIsNamed) {
  Edit("digger/front/sensor.yaml", "width_px: 4", "width_px: 5");
  EXPECT_THAT(FaultOf({KittiLayout::kRaw}), HasFault(kInconsistent, "rgb/40000000.png"));
}

TEST_F(KittiTest, SemanticKittisLabelsAreInstanceAndClassInOneNumber) {
  Export(recording(), out(), {.format = ExportFormat::kSemanticKitti, .joint_trees = Tree});
  const std::string labels = Written("sequences/00/labels/000001.label");
  EXPECT_EQ(labels, std::string("\x0b\0\x02\x01\0\0\0\0", 8));  // 11, then 258 = 0x0102
  // At the first ray the points are its own; for one 90 ms later the lidar had moved by 9 cm.
  const std::string points = Written("sequences/00/velodyne/000001.bin");
  EXPECT_FLOAT_EQ(FloatAt(points, 0), 5);
  EXPECT_FLOAT_EQ(FloatAt(points, 4), 5.09f);
  EXPECT_EQ(Written("sequences/00/times.txt"), "0.000000000\n0.100000000\n0.200000000\n");
  EXPECT_THAT(Written("semantic-kitti.yaml"),
              AllOf(HasSubstr("content:\n  0: 0.5\n"), HasSubstr("  11: person\n"),
                    HasSubstr("  11: [160, 40, 255]\n")));
}

}  // namespace
}  // namespace tera
