#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dataset/export/ros/joint_tree.h"
#include "dataset/format/sample_recording.h"

namespace tera {

inline constexpr TimeNs kFrame_ns = 100'000'000;
inline constexpr int kFrames = 5;
inline constexpr const char* kLens =
    "model:\n  width_px: 4\n  height_px: 3\n  fx_px: 2\n  fy_px: 2\n  cx_px: 1.5\n  cy_px: 1\n";

inline std::string Sheet(const std::string& type, const std::string& more) {
  return "type: " + type +
         "\nname: x\nparent_link: chassis\nX_parent_sensor:\n  xyz_m: [1, 0, 2]\n"
         "  quaternion_wxyz: [1, 0, 0, 0]\nrate_hz: 10\nlatency_s: 0\n" +
         more;
}

inline CameraFrame FrameAt(int k) {
  CameraFrame frame;
  frame.t_ns = k * kFrame_ns + kFrame_ns / 2;
  frame.rgb = Image<std::uint8_t>(4, 3, 3);
  frame.rgb.data[0] = static_cast<std::uint8_t>(k);
  frame.depth_m = Image<float>(4, 3);
  frame.semantic = Image<std::uint8_t>(4, 3);
  frame.instance = Image<std::uint16_t>(4, 3);
  return frame;
}

inline LidarScan ScanAt(int k) {
  LidarPoint point;
  point.x_m = 5.0f + static_cast<float>(k);
  point.label = static_cast<std::uint8_t>(k + 1);
  return {k * kFrame_ns, k * kFrame_ns, {point}};
}

inline std::vector<JointTree> Tree() { return {JointTree{"digger", "chassis"}}; }

/// A machine that moves forward, with a lidar and a camera of small frames with every label.
inline void WriteFramesRecording(const std::filesystem::path& directory) {
  DatasetWriter writer(directory, SampleInfo(), {});
  const ChannelId front = writer.AddChannel(CameraChannel("digger/front", Sheet("camera", kLens)));
  const ChannelId lidar = writer.AddChannel(LidarChannel("digger/lidar", Sheet("lidar", "")));
  const ChannelId pose = writer.AddChannel(PoseChannel("truth/digger/pose.csv"));
  const ChannelId joints =
      writer.AddChannel(TableChannel("truth/digger/joints.csv", {"boom_rad", "boom_radps"}));
  for (int k = 0; k <= kFrames; ++k) {
    const TimeNs t_ns = k * kFrame_ns;
    writer.Write(pose, RowOf(TruthPose{t_ns, MakePose(Vec3(k, 0, 0))}));
    writer.Write(joints, RowSample{t_ns, t_ns, {0, 0}});
    if (k == kFrames) break;
    writer.Write(lidar, ScanAt(k));
    writer.Write(front, FrameAt(k));
  }
  writer.Finish();
}

}  // namespace tera
