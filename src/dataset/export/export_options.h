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

/// What a recording can be written as, and how; docs/reference/export.md says what each format
/// holds.

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
  kNuscenes
};

struct ExportFormatName {
  ExportFormat format;
  std::string_view name;  ///< as the command line has it
};

/// All formats in order of value.
inline constexpr std::array<ExportFormatName, 14> kExportFormats = {
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
     {ExportFormat::kNuscenes, "nuscenes"}}};

/// Whether a format is a bag of ROS messages, which alone takes `images`; that of ROS 2 also
/// `storage` and `compression`.
constexpr bool IsBag(ExportFormat format) {
  return format == ExportFormat::kRosbag2 || format == ExportFormat::kBag;
}
/// Whether a format is of so many files that an export of it which was stopped goes on with those
/// that are whole; of others it begins again.
constexpr bool GoesOnByFrames(ExportFormat format) {
  return format == ExportFormat::kKitti || format == ExportFormat::kSemanticKitti ||
         format == ExportFormat::kCoco || format == ExportFormat::kNuscenes ||
         format == ExportFormat::kWebdataset;
}
/// Whether a format is of one lidar, and of one camera besides.
constexpr bool IsOfOneCamera(ExportFormat format) { return format == ExportFormat::kKitti; }
constexpr bool IsOfOneLidar(ExportFormat format) {
  return IsOfOneCamera(format) || format == ExportFormat::kSemanticKitti;
}
/// Whether a format may need to know how machines hang together.
constexpr bool UsesJointTrees(ExportFormat format) {
  return IsBag(format) || IsOfOneLidar(format) || format == ExportFormat::kNuscenes ||
         format == ExportFormat::kPcd || format == ExportFormat::kPly ||
         format == ExportFormat::kLas;
}

/// The benchmarks of KITTI, each a folder of its own.
enum class KittiLayout { kRaw, kObject, kTracking, kOdometry, kDepth };

struct KittiLayoutName {
  KittiLayout layout;
  std::string_view name;  ///< as the command line has it
};
inline constexpr std::array<KittiLayoutName, 5> kKittiLayouts = {
    {{KittiLayout::kRaw, "raw"},
     {KittiLayout::kObject, "object"},
     {KittiLayout::kTracking, "tracking"},
     {KittiLayout::kOdometry, "odometry"},
     {KittiLayout::kDepth, "depth"}}};

/// nuScenes' own rate of key frames.
inline constexpr double kDefaultKeyFrames_hz = 2;

/// Of a size that is read at once from any storage, and of which a machine holds several.
inline constexpr std::int64_t kDefaultShardBytes = 256'000'000;

enum class BagStorage { kMcap, kSqlite3 };
/// Pictures as pixels, or as the recording's PNG files.
enum class BagImages { kRaw, kCompressed };

/// Pictures that a recording names and does not have.
struct AbsentPictures {
  std::int64_t count = 0;
  std::filesystem::path first;

  void Add(const std::filesystem::path& file) {
    if (count++ == 0) first = file;
  }
};

/// What an export has come to.
struct ExportProgress {
  double recorded_s = 0, duration_s = 0;
  std::int64_t records = 0;
};

struct ExportOptions {
  ExportFormat format = ExportFormat::kTum;
  /// Go on with what a stopped export with these options has left; and where this one is stopped by
  /// a fault, leave what can be gone on with.
  bool resume = false;
  int threads = 2;  ///< that read, decode and encode frames; they change no byte
  /// UTC of the recording's time 0, in ns since 1970. Without it, times stay what they are, but in
  /// formats that must have a date, where it is the recording's epoch, and without one
  /// kDefaultStart_ns.
  std::optional<TimeNs> start_utc_ns;
  BagStorage storage = BagStorage::kMcap;
  BagCompression compression = BagCompression::kZstd;  ///< of MCAP's chunks
  BagImages images = BagImages::kRaw;
  std::vector<KittiLayout> kitti_layouts;         ///< empty: all
  std::string camera, lidar;                      ///< of formats of one: paths; empty: the first
  double key_frames_hz = kDefaultKeyFrames_hz;    ///< of nuScenes: how often all is annotated
  std::int64_t shard_bytes = kDefaultShardBytes;  ///< of WebDataset: about how large archives are
  std::filesystem::path
      card;  ///< of WebDataset: what its card says of its publisher; empty: no card
  /// Gives the joint trees of the recording's machines where a format needs them; of a machine
  /// without one, nothing but its root has a place.
  std::function<std::vector<JointTree>()> joint_trees;
  /// Reads the ground's rasters where a format has them; without it they are left out.
  ReadGround read_ground;
  std::function<void(const ExportProgress&)> progress;
};

/// 2024-01-01 00:00:00 UTC: the date of recordings that have none.
inline constexpr TimeNs kDefaultStart_ns = 1'704'067'200 * kNsPerSecond;

}  // namespace tera
