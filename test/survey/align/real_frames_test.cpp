#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/units.h"
#include "dataset/files/checked_file.h"
#include "dataset/import/cloud/read_point_cloud.h"
#include "survey/align/registration.h"

// Frames of real lidars, in the folder of TERA_RECORDINGS: an Ouster OS1-128 on a moving vehicle,
// with poses by its maker's software, and a frame of a VLP-16.

namespace tera {
namespace {

namespace fs = std::filesystem;

const fs::path kRecordings = TERA_RECORDINGS;

template <typename T>
T NumberAt(const std::string& bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof(T));
  return value;
}

/// Frames of UDP packets RNG15_RFL8_NIR8 in a pcap file, in the sensor's frame: the equations of
/// the OS1's Firmware User Manual.
std::map<int, std::vector<Vec3>> OusterFrames(const fs::path& pcap, const fs::path& sheet) {
  const auto json = nlohmann::json::parse(ReadWholeFile(sheet));
  const auto altitudes_deg = json["beam_altitude_angles"].get<std::vector<double>>();
  const auto azimuths_deg = json["beam_azimuth_angles"].get<std::vector<double>>();
  const auto to_sensor = json["lidar_to_sensor_transform"].get<std::vector<double>>();
  const double arm_mm = json["lidar_origin_to_beam_origin_mm"];
  constexpr std::size_t kFileHeader = 24, kPacketHeader = 16, kNetwork = 42, kLidarPacket = 8490;
  constexpr std::size_t kFrameHeader = 32, kColumnHeader = 12, kColumns = 16;
  constexpr double kTurn = 2 * std::numbers::pi, kColumnsOfATurn = 1024;
  const std::size_t column_bytes = kColumnHeader + 4 * altitudes_deg.size();
  const std::string bytes = ReadWholeFile(pcap);
  std::map<int, std::vector<Vec3>> frames;
  for (std::size_t at = kFileHeader; at < bytes.size();) {
    const auto length = NumberAt<std::uint32_t>(bytes, at + 8);
    const std::size_t packet = at + kPacketHeader + kNetwork;
    at += kPacketHeader + length;
    if (length != kLidarPacket) continue;
    auto& points = frames[NumberAt<std::uint16_t>(bytes, packet + 2)];
    for (std::size_t c = 0; c < kColumns; ++c) {
      const std::size_t column = packet + kFrameHeader + c * column_bytes;
      const double encoder_rad =
          kTurn * (1 - NumberAt<std::uint16_t>(bytes, column + 8) / kColumnsOfATurn);
      for (std::size_t row = 0; row < altitudes_deg.size(); ++row) {
        const auto pixel = NumberAt<std::uint32_t>(bytes, column + kColumnHeader + 4 * row);
        const double range_mm = 8.0 * (pixel & 0x7fff);
        if (range_mm == 0) continue;
        const double azimuth = encoder_rad - azimuths_deg[row] * kDeg;
        const double altitude = altitudes_deg[row] * kDeg, beam_mm = range_mm - arm_mm;
        const Vec3 p_mm(
            beam_mm * std::cos(azimuth) * std::cos(altitude) + arm_mm * std::cos(encoder_rad),
            beam_mm * std::sin(azimuth) * std::cos(altitude) + arm_mm * std::sin(encoder_rad),
            beam_mm * std::sin(altitude));
        Vec3 in_sensor;
        for (int axis = 0; axis < 3; ++axis) {
          const double* r = &to_sensor[static_cast<std::size_t>(4 * axis)];
          in_sensor[axis] = 0.001 * (r[0] * p_mm.x() + r[1] * p_mm.y() + r[2] * p_mm.z() + r[3]);
        }
        points.push_back(in_sensor);
      }
    }
  }
  return frames;
}

std::vector<Pose> KittiPoses(const fs::path& file) {
  std::ifstream stream(file);
  std::vector<Pose> poses;
  for (double first = 0; stream >> first;) {
    Eigen::Matrix4d rows = Eigen::Matrix4d::Identity();
    rows(0, 0) = first;
    for (int k = 1; k < 12; ++k) stream >> rows(k / 4, k % 4);
    poses.emplace_back(rows);
  }
  return poses;
}

double TurnBetween_rad(const Pose& a, const Pose& b) {
  return Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle();
}

// The vehicle moves by 0.25 m during a frame. The maker's poses refer to points moved to one
// instant, ours to the original points. Over two frames of equal speed that cancels, except for the
// vehicle's acceleration.
TEST(RealFrames, AnOustersFramesLieToEachOtherAsItsMakersSoftwareSays) {
  const fs::path folder = kRecordings / "lidar_ouster";
  const std::string name = "OS-1-128_v2.3.0_1024x10";
  if (!fs::exists(folder / (name + ".json"))) GTEST_SKIP() << "no recordings in " << folder;
  const auto frames = OusterFrames(folder / (name + "_lb_n3.pcap"), folder / (name + ".json"));
  const auto poses = KittiPoses(folder / (name + "_lb_n3_poses_kitti.txt"));
  ASSERT_EQ(frames.size(), 3u);
  ASSERT_EQ(poses.size(), 3u);
  std::vector<std::vector<Vec3>> clouds;
  for (const auto& [number, points] : frames) clouds.push_back(points);
  const RegistrationRequest request = {.voxel_m = 0.2};
  std::vector<Pose> found;
  for (const auto& [a, b] : {std::pair{0, 1}, {1, 2}, {0, 2}}) {
    const Registration result = Register(clouds[a], clouds[b], request);
    EXPECT_EQ(result.status, RegistrationStatus::kRegistered);
    const Pose X_AB = poses[a].inverse() * poses[b];
    const double off_m = (result.X_AB.translation() - X_AB.translation()).norm();
    EXPECT_LT(off_m, 0.035) << a << b;
    EXPECT_LT(TurnBetween_rad(result.X_AB, X_AB), 0.15 * kDeg) << a << b;
    found.push_back(result.X_AB);
  }
  // The inverse registration gives the inverse pose.
  const Pose both = found[0] * found[1];
  EXPECT_LT((both.translation() - found[2].translation()).norm(), 0.01);
  EXPECT_LT(TurnBetween_rad(both, found[2]), 0.1 * kDeg);
}

TEST(RealFrames, HalfOfAVelodynesPointsAreFoundWhereTheOtherHalfWasMovedTo) {
  const fs::path file = kRecordings / "lidar_velodyne/1673400472138016708.pcd";
  if (!fs::exists(file)) GTEST_SKIP() << "no recording " << file;
  const std::vector<Vec3> points = ReadPointCloud(file).p_m;
  ASSERT_EQ(points.size(), 14831u);  // of its header
  const Pose X_AB = MakePose({0.3, -0.2, 0.1}, 0, 0, 3 * kDeg);
  std::vector<Vec3> a, b;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (k % 2 == 0) {
      a.push_back(points[k]);
    } else {
      b.push_back(X_AB.inverse() * points[k]);
    }
  }
  const Registration found = Register(a, b, {.voxel_m = 0.02});
  EXPECT_EQ(found.status, RegistrationStatus::kRegistered);
  EXPECT_LT((found.X_AB.translation() - X_AB.translation()).norm(), 0.003);
  EXPECT_LT(TurnBetween_rad(found.X_AB, X_AB), 0.1 * kDeg);
}

}  // namespace
}  // namespace tera
