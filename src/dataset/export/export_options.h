#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/time.h"
#include "dataset/export/bag/compression.h"
#include "dataset/export/ros/ground_squares.h"
#include "dataset/export/ros/joint_tree.h"

/// Export formats and their options; docs/reference/export.md describes each format.

namespace tera {

enum class ExportFormat {
  kTum,
  kEuroc,
  kNmea,
  kPos,
  kRosbag2,
  kBag,
  kPcd,
  kPly,
  kLas,
  kCoco,
  kKitti,
  kSemanticKitti,
  kWebdataset,
  kNuscenes,
  kPcap
};

struct ExportFormatName {
  ExportFormat format;
  std::string_view name;  ///< on the command line
};

/// All formats in order of value.
inline constexpr std::array<ExportFormatName, 15> kExportFormats = {
    {{ExportFormat::kTum, "tum"},
     {ExportFormat::kEuroc, "euroc"},
     {ExportFormat::kNmea, "nmea"},
     {ExportFormat::kPos, "pos"},
     {ExportFormat::kRosbag2, "rosbag2"},
     {ExportFormat::kBag, "bag"},
     {ExportFormat::kPcd, "pcd"},
     {ExportFormat::kPly, "ply"},
     {ExportFormat::kLas, "las"},
     {ExportFormat::kCoco, "coco"},
     {ExportFormat::kKitti, "kitti"},
     {ExportFormat::kSemanticKitti, "semantickitti"},
     {ExportFormat::kWebdataset, "webdataset"},
     {ExportFormat::kNuscenes, "nuscenes"},
     {ExportFormat::kPcap, "pcap"}}};

/// Whether a format is a bag of ROS messages. Only bags use `images`; ROS 2 bags also use `storage`
/// and `compression`.
constexpr bool IsBag(ExportFormat format) {
  return format == ExportFormat::kRosbag2 || format == ExportFormat::kBag;
}
/// Whether a stopped export of a format resumes from its complete frames. Other formats start
/// again.
constexpr bool GoesOnByFrames(ExportFormat format) {
  return format == ExportFormat::kKitti || format == ExportFormat::kSemanticKitti ||
         format == ExportFormat::kCoco || format == ExportFormat::kNuscenes ||
         format == ExportFormat::kWebdataset;
}
/// Whether a format has one lidar, and also one camera.
constexpr bool IsOfOneCamera(ExportFormat format) { return format == ExportFormat::kKitti; }
constexpr bool IsOfOneLidar(ExportFormat format) {
  return IsOfOneCamera(format) || format == ExportFormat::kSemanticKitti;
}
/// Whether a format takes the choice of a lidar.
constexpr bool ChoosesLidar(ExportFormat format) {
  return IsOfOneLidar(format) || format == ExportFormat::kPcap;
}
/// Whether a format may need joint trees.
constexpr bool UsesJointTrees(ExportFormat format) {
  return IsBag(format) || IsOfOneLidar(format) || format == ExportFormat::kNuscenes ||
         format == ExportFormat::kPcd || format == ExportFormat::kPly ||
         format == ExportFormat::kLas;
}

/// The benchmarks of KITTI, each in its own folder.
enum class KittiLayout { kRaw, kObject, kTracking, kOdometry, kDepth };

struct KittiLayoutName {
  KittiLayout layout;
  std::string_view name;  ///< on the command line
};
inline constexpr std::array<KittiLayoutName, 5> kKittiLayouts = {
    {{KittiLayout::kRaw, "raw"},
     {KittiLayout::kObject, "object"},
     {KittiLayout::kTracking, "tracking"},
     {KittiLayout::kOdometry, "odometry"},
     {KittiLayout::kDepth, "depth"}}};

/// nuScenes' key frame rate.
inline constexpr double kDefaultKeyFrames_hz = 2;

/// Small enough for fast reads from any storage, and for several in a computer's memory.
inline constexpr std::int64_t kDefaultShardBytes = 256'000'000;

enum class BagStorage { kMcap, kSqlite3 };
/// Pictures as pixels, or as the recording's PNG files.
enum class BagImages { kRaw, kCompressed };

/// Pictures that a recording names but lacks.
struct AbsentPictures {
  std::int64_t count = 0;
  std::filesystem::path first;

  void Add(const std::filesystem::path& file) {
    if (count++ == 0) first = file;
  }
};

struct ExportProgress {
  double recorded_s = 0, duration_s = 0;
  std::int64_t records = 0;
};

struct ExportOptions {
  ExportFormat format = ExportFormat::kTum;
  /// Resume a stopped export with these options. After a fault, keep the files that can be resumed.
  bool resume = false;
  int threads = 2;  ///< for reading, decoding and encoding; they change no byte
  /// UTC of the recording's time 0, in ns since 1970. Without it, times stay unchanged, except in
  /// formats that need a date: these use the recording's epoch, or kDefaultStart_ns without one.
  std::optional<TimeNs> start_utc_ns;
  BagStorage storage = BagStorage::kMcap;
  BagCompression compression = BagCompression::kZstd;  ///< compression of MCAP's chunks
  BagImages images = BagImages::kRaw;
  std::vector<KittiLayout> kitti_layouts;         ///< empty: all
  std::string camera, lidar;                      ///< paths; empty: the first, or all of `pcap`
  double key_frames_hz = kDefaultKeyFrames_hz;    ///< rate of fully annotated frames in nuScenes
  std::int64_t shard_bytes = kDefaultShardBytes;  ///< approximate archive size in WebDataset
  std::filesystem::path card;  ///< publisher's facts for the WebDataset card; empty: no card
  /// Returns the joint trees of the recording's machines. A machine without one has only the pose
  /// of its root.
  std::function<std::vector<JointTree>()> joint_trees;
  /// Reads the ground's rasters. Without it they are left out.
  ReadGround read_ground;
  std::function<void(const ExportProgress&)> progress;
};

/// 2024-01-01 00:00:00 UTC: the default date of recordings.
inline constexpr TimeNs kDefaultStart_ns = 1'704'067'200 * kNsPerSecond;

}  // namespace tera
