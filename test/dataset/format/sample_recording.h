#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <string>

#include "core/types/sample_rows.h"
#include "core/units.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/writer.h"

/// A small recording with one channel of each type, for tests.

namespace tera {

/// A new empty directory, removed with the test.
class ScratchDirectory {
 public:
  ScratchDirectory() {
    std::string name = (std::filesystem::temp_directory_path() / "tera_dataset_XXXXXX").string();
    EXPECT_NE(mkdtemp(name.data()), nullptr);
    path_ = name;
  }
  ~ScratchDirectory() { std::filesystem::remove_all(path_); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline ChannelInfo CameraChannel(const std::string& folder, const std::string& sensor_yaml) {
  return {folder, std::string(kCameraChannel), ChannelForm::kPictures, sensor_yaml, {}};
}

inline ChannelInfo LidarChannel(const std::string& folder, const std::string& sensor_yaml) {
  return {folder, std::string(kLidarChannel), ChannelForm::kScans, sensor_yaml, {}};
}

inline DatasetInfo SampleInfo() {
  DatasetInfo info;
  info.scenario_name = "two \"words\"";
  info.seed = 7;
  info.duration_s = 0.5;
  info.origin_lat_deg = 46.78;
  info.origin_lon_deg = -71.27;
  info.origin_height_m = 90.5;
  info.resolved_scenario_yaml = "seed: 7\n";
  info.instances = {{1, "truck", "truck"}, {2, "person", "person"}};
  return info;
}

inline constexpr int kSampleFrames = 6;
inline constexpr TimeNs kSamplePeriod_ns = 100'000'000;

inline CameraFrame SampleFrame(int k) {
  CameraFrame frame;
  frame.t_ns = k * kSamplePeriod_ns;
  const int width = 33, height = 17;
  frame.rgb = Image<std::uint8_t>(width, height, 3);
  frame.depth_m = Image<float>(width, height);
  frame.semantic = Image<std::uint8_t>(width, height);
  frame.instance = Image<std::uint16_t>(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c) {
        frame.rgb.at(x, y, c) = static_cast<std::uint8_t>(7 * x + 5 * y * (c + 1) + k);
      }
      frame.depth_m.at(x, y) = static_cast<float>(0.001 * (1 + x + 100 * y + k));
      frame.semantic.at(x, y) = static_cast<std::uint8_t>((x + y + k) % 18);
      frame.instance.at(x, y) = static_cast<std::uint16_t>(300 * x + k);
    }
  }
  ObjectBox box;
  box.instance = 2;
  box.parent = 1;
  box.label = SemanticClass::kPerson;
  box.name = "person";
  box.x_min_px = 3;
  box.y_min_px = 4;
  box.x_max_px = 12;
  box.y_max_px = 15;
  box.visible_px = 60;
  box.visibility = 0.625;
  box.X_CO = MakePose(Vec3(0.5, -0.25, 7.0 + k), 0.1, -0.4, 2.5);
  box.size_O_m = Vec3(0.5, 0.6, 1.75);
  frame.boxes = {box};
  return frame;
}

inline LidarScan SampleScan(int k, int points = 500) {
  LidarScan scan;
  scan.t_ns = k * kSamplePeriod_ns;
  for (int i = 0; i < points; ++i) {
    LidarPoint p;
    p.x_m = 0.01f * static_cast<float>(i) - 2.5f;
    p.y_m = std::sin(0.1f * static_cast<float>(i + k));
    p.z_m = -1.5f;
    p.intensity = 0.25f;
    p.time_offset_ns = static_cast<std::uint32_t>(i * 1000);
    p.ring = static_cast<std::uint16_t>(i % 64);
    p.instance = static_cast<std::uint16_t>(i % 3);
    p.label = static_cast<std::uint8_t>(i % 18);
    scan.points.push_back(p);
  }
  return scan;
}

inline ImuSample SampleImu(int k) {
  const TimeNs t_ns = k * kSamplePeriod_ns;
  return {t_ns, t_ns, Vec3(0.1 * k, -1.0 / 3.0, 2e-9), Vec3(0.02, -0.3, 9.80665)};
}

inline GnssSample SampleGnss(int k) {
  GnssSample s;
  s.t_ns = s.t_available_ns = k * kSamplePeriod_ns;
  s.lat_deg = 46.780000123456789;
  s.lon_deg = -71.27 + 1e-7 * k;
  s.alt_m = 91.25;
  s.enu_m = Vec3(1.5, -2.25 * k, 0.75);
  s.fix = GnssFix::kRtkFloat;
  s.variance_enu_m2 = Vec3(0.01, 0.02, 0.05);
  return s;
}

inline EncoderSample SampleEncoder(int k) {
  const TimeNs t_ns = k * kSamplePeriod_ns;
  return {t_ns, t_ns, {0.1 * k, -0.2}, {1.0, 0.5 * k}};
}

inline TruthPose SamplePose(int k) {
  return {k * kSamplePeriod_ns, MakePose(Vec3(1.0 + 0.1 * k, 2, -0.5), 0.1, -0.2, 2.8 + 0.1 * k),
          Vec3(1, 0, 0.25), Vec3(0, 0, 1)};
}

/// Writes the frames from 0 up to, not including, `end`; all channels, in order of time.
inline void WriteSample(DatasetWriter* writer, int end) {
  const ChannelId imu = writer->AddChannel(ImuChannel("digger/imu", "type: imu\n"));
  const ChannelId gnss = writer->AddChannel(GnssChannel("digger/gnss", "type: gnss\n"));
  const ChannelId joints = writer->AddChannel(
      EncoderChannel("digger/joints", "type: encoder\n", {{"boom"}, {"stick", true}}));
  const ChannelId camera = writer->AddChannel(CameraChannel("digger/front", "type: camera\n"));
  const ChannelId lidar = writer->AddChannel(LidarChannel("digger/lidar", "type: lidar\n"));
  const ChannelId commands =
      writer->AddChannel(TableChannel("digger/commands.csv", {"boom", "arm"}));
  const ChannelId pose = writer->AddChannel(PoseChannel("truth/digger/pose.csv"));
  WriteWholeFile(writer->PathFor("truth/terrain/start.tif"), "heights");
  for (int k = 0; k < end; ++k) {
    writer->Write(imu, RowOf(SampleImu(k)));
    writer->Write(gnss, RowOf(SampleGnss(k)));
    writer->Write(joints, RowOf(SampleEncoder(k)));
    const TimeNs t_ns = k * kSamplePeriod_ns;
    if (writer->NeedsFrame(camera, t_ns, t_ns)) {
      writer->Write(camera, SampleFrame(k));
    } else {
      writer->MarkPresent(camera, t_ns);
    }
    if (writer->NeedsFrame(lidar, t_ns, t_ns)) {
      writer->Write(lidar, SampleScan(k));
    } else {
      writer->MarkPresent(lidar, t_ns);
    }
    writer->Write(commands, RowSample{t_ns, t_ns, {0.5, -1.0}});
    writer->Write(pose, RowOf(SamplePose(k)));
  }
}

inline void WriteWholeSample(const std::filesystem::path& directory, const WriterOptions& options) {
  DatasetWriter writer(directory, SampleInfo(), options);
  WriteSample(&writer, kSampleFrames);
  writer.Finish();
}

/// Relative names and bytes of all files under a directory.
inline std::map<std::string, std::string> AllFiles(const std::filesystem::path& directory) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(directory)) {
    if (entry.is_regular_file()) {
      files[entry.path().lexically_relative(directory)] = ReadWholeFile(entry.path());
    }
  }
  return files;
}

}  // namespace tera
