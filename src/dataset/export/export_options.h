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
  std::string_view name;  ///< name on the command line
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

/// True for bags of ROS messages. The option `images` applies to bags only; `storage` and
/// `compression` apply to ROS 2 bags only.
constexpr bool IsBag(ExportFormat format) {
  return format == ExportFormat::kRosbag2 || format == ExportFormat::kBag;
}
/// True for a format that resumes a stopped export after its last complete frames. Other formats
/// start again.
constexpr bool GoesOnByFrames(ExportFormat format) {
  return format == ExportFormat::kKitti || format == ExportFormat::kSemanticKitti ||
         format == ExportFormat::kCoco || format == ExportFormat::kNuscenes ||
         format == ExportFormat::kWebdataset;
}
/// True for a format that exports a single lidar, or a single lidar and camera.
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

/// Benchmarks of KITTI. Each has its own folder.
enum class KittiLayout { kRaw, kObject, kTracking, kOdometry, kDepth };

struct KittiLayoutName {
  KittiLayout layout;
  std::string_view name;  ///< name on the command line
};
inline constexpr std::array<KittiLayoutName, 5> kKittiLayouts = {
    {{KittiLayout::kRaw, "raw"},
     {KittiLayout::kObject, "object"},
     {KittiLayout::kTracking, "tracking"},
     {KittiLayout::kOdometry, "odometry"},
     {KittiLayout::kDepth, "depth"}}};

/// Key frame rate of the original nuScenes.
inline constexpr double kDefaultKeyFrames_hz = 2;

/// Small enough to read quickly from any storage and to keep several archives in memory.
inline constexpr std::int64_t kDefaultShardBytes = 256'000'000;

enum class BagStorage { kMcap, kSqlite3 };
/// Content of image messages: raw pixels, or the PNG files of the recording.
enum class BagImages { kRaw, kCompressed };

/// Images that a recording lists but lacks.
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
  /// Resume a stopped export with equal options. After a failure, keep files that can be resumed.
  bool resume = false;
  int threads = 2;  ///< threads to read, decode and encode; the result does not depend on them
  /// UTC of the recording's time 0, in ns since 1970. If absent, times are exported unchanged. A
  /// format that needs a date then uses the epoch of the recording, or else kDefaultStart_ns.
  std::optional<TimeNs> start_utc_ns;
  BagStorage storage = BagStorage::kMcap;
  BagCompression compression = BagCompression::kZstd;  ///< compression of MCAP chunks
  BagImages images = BagImages::kRaw;
  std::vector<KittiLayout> kitti_layouts;         ///< empty: all
  std::string camera, lidar;                      ///< paths; empty: the first, or all of `pcap`
  double key_frames_hz = kDefaultKeyFrames_hz;    ///< rate of fully annotated frames in nuScenes
  std::int64_t shard_bytes = kDefaultShardBytes;  ///< approximate size of a WebDataset archive
  std::filesystem::path card;  ///< file with the publisher's facts for the WebDataset card; empty:
                               ///< no card
  /// Returns the joint trees of the machines. For a machine without a tree, only its root pose is
  /// exported.
  std::function<std::vector<JointTree>()> joint_trees;
  /// Reads ground rasters. If not set, the export omits them.
  ReadGround read_ground;
  std::function<void(const ExportProgress&)> progress;
};

/// 2024-01-01 00:00:00 UTC, the date of a recording without an epoch.
inline constexpr TimeNs kDefaultStart_ns = 1'704'067'200 * kNsPerSecond;

}  // namespace tera
