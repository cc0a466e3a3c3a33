#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <string>

#include "core/error.h"
#include "core/types/labels.h"
#include "dataset/export/bag/little_endian.h"
#include "dataset/export/export_job.h"
#include "dataset/export/kitti/kitti_rig.h"
#include "dataset/export/kitti/kitti_text.h"
#include "dataset/export/kitti/steady_scan.h"
#include "dataset/export/stamp_text.h"
#include "dataset/files/checked_file.h"
#include "dataset/files/in_order.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

/// Number of points per class.
using ClassCounts = std::array<std::int64_t, kSemanticClasses.size()>;

/// SemanticKITTI's class 0 is "unlabeled". The dataset's class 0 is sky, which no ray hits, so both
/// can share the number.
std::string_view NameOfClass(const SemanticClassInfo& info) {
  return info.label == SemanticClass::kSky ? "unlabeled" : info.name;
}

/// YAML mapping from each class number to `value` of the class.
template <typename Value>
std::string ClassMap(std::string_view key, const Value& value) {
  std::string text = fmt::format("{}:\n", key);
  for (const SemanticClassInfo& info : kSemanticClasses) {
    text += fmt::format("  {}: {}\n", static_cast<int>(info.label), value(info));
  }
  return text;
}

/// Class definitions for the development kit: names, colours (blue, green, red), fractions of all
/// points, identical training numbers, and the ignored class.
std::string ClassesYaml(const ClassCounts& counts) {
  std::int64_t all = 0;
  for (const std::int64_t count : counts) all += count;
  const auto same = [](const SemanticClassInfo& info) { return static_cast<int>(info.label); };
  return ClassMap("labels", [](const auto& info) { return NameOfClass(info); }) +
         ClassMap("color_map",
                  [](const auto& info) {
                    return fmt::format("[{}, {}, {}]", info.rgb[2], info.rgb[1], info.rgb[0]);
                  }) +
         ClassMap("content",
                  [&](const auto& info) {
                    const auto count = counts[static_cast<std::size_t>(info.label)];
                    return all > 0 ? static_cast<double>(count) / static_cast<double>(all) : 0;
                  }) +
         ClassMap("learning_map", same) + ClassMap("learning_map_inv", same) +
         ClassMap("learning_ignore",
                  [](const auto& info) { return info.label == SemanticClass::kSky; }) +
         "split:\n  train: [0]\n  valid: []\n  test: []\n";
}

/// One 32-bit label per point: class in the lower 16 bits, instance in the upper.
std::string LabelBytes(const LidarScan& scan, const fs::path& file, ClassCounts* counts) {
  constexpr int kInstanceShift = 16;
  std::string bytes;
  for (const LidarPoint& point : scan.points) {
    if (point.label >= counts->size()) {
      throw InputError(
          file.string(),
          {FaultKind::kNoSuchName,
           fmt::format(
               "has a point of the class {}; need classes of docs/reference/dataset.md, 0 to {}",
               point.label, counts->size() - 1)});
    }
    ++(*counts)[point.label];
    AppendNumber(std::uint32_t{point.instance} << kInstanceShift | point.label, &bytes);
  }
  return bytes;
}

/// Counts the classes in a label file that already exists.
void CountLabels(const fs::path& labels, ClassCounts* counts) {
  const std::string bytes = ReadWholeFile(labels);
  for (std::size_t at = 0; at + sizeof(std::uint32_t) <= bytes.size();
       at += sizeof(std::uint32_t)) {
    ++counts->at(static_cast<unsigned char>(bytes[at]));
  }
}

/// A scan whose files are written.
struct WrittenScan {
  TimeNs t_ns = 0;
  bool was_written = false;  ///< files written by a stopped export
  fs::path points, labels;
  ClassCounts counts{};
};

/// Writes the files of a scan unless they exist. Thread-safe.
void WriteScan(const Recording& recording, const std::string& lidar, const PoseTrack& X_WS,
               WrittenScan* written) {
  if (written->was_written) return CountLabels(written->labels, &written->counts);
  const LidarScan scan = recording.LoadScan(lidar, written->t_ns);
  const fs::path file =
      recording.directory() / lidar / "scans" / fmt::format("{}.pcd", written->t_ns);
  WriteWholeFile(written->points, VelodyneBytes(SteadyScan(scan, X_WS, written->t_ns)));
  WriteWholeFile(written->labels, LabelBytes(scan, file, &written->counts));
}

/// Calibration of a virtual camera 0 at the origin of the lidar.
std::string CalibrationText(const Pose& X_SC) {
  Eigen::Matrix<double, 3, 4> P = Eigen::Matrix<double, 3, 4>::Identity();
  std::string text;
  for (int camera = 0; camera < 4; ++camera) {
    text += fmt::format("P{}: {}\n", camera, NumbersText(P));
  }
  return text + "Tr: " + PoseText(X_SC.inverse()) + "\n";
}

fs::path MadeFolder(const fs::path& folder) {
  MakeFolder(folder);
  return folder;
}

}  // namespace

/// Writes sequences/00 (velodyne, labels, calib.txt, poses.txt and times.txt) and
/// semantic-kitti.yaml with the classes of the dataset. Exports one lidar. Each scan is
/// motion-corrected to its first ray.
///
/// Frames  Camera 0 is a virtual camera at the lidar's origin (x right, y down, z forward). Poses
///         are those of camera 0, relative to its pose at the first scan. `Tr` maps the lidar frame
///         to camera 0.
/// Source  Behley et al. 2019, "SemanticKITTI", and its development kit.
void ExportSemanticKitti(ExportJob* job) {
  const std::string lidar = ChosenLidar(*job);
  const PoseTrack X_WS = SensorTrack(job, lidar).X_WS;
  const Pose X_SC = OpticalAxesInSensor();
  const fs::path sequence = job->folder / "sequences/00";
  const fs::path velodyne = MadeFolder(sequence / "velodyne"),
                 labels = MadeFolder(sequence / "labels");
  CheckedFile poses(sequence / "poses.txt"), times(sequence / "times.txt");
  ClassCounts counts{};
  InOrder<WrittenScan> scans(job->options.threads, [&](const WrittenScan& scan) {
    for (std::size_t c = 0; c < counts.size(); ++c) counts[c] += scan.counts[c];
    if (!scan.was_written) job->Written(lidar, scan.t_ns, {scan.points, scan.labels});
  });
  Pose X_CW_first;
  TimeNs first_ns = 0;
  int frame = 0;
  RecordStream stream(job->recording, std::vector<std::string>{lidar});
  for (Record record; job->Next(&stream, &record); ++frame) {
    const Pose X_WC = X_WS.At(record.t_ns) * X_SC;
    if (frame == 0) {
      X_CW_first = X_WC.inverse();
      first_ns = record.t_ns;
    }
    poses.Append(PoseText(X_CW_first * X_WC) + "\n");
    times.Append(SecondsText(record.t_ns - first_ns) + "\n");
    const std::string name = fmt::format("{:06}", frame);
    WrittenScan scan = {record.t_ns, job->IsWritten(lidar, record.t_ns), velodyne / (name + ".bin"),
                        labels / (name + ".label")};
    scans.Give([&, scan]() mutable {
      WriteScan(job->recording, lidar, X_WS, &scan);
      return scan;
    });
  }
  scans.Finish();
  poses.Commit();
  times.Commit();
  WriteWholeFile(sequence / "calib.txt", CalibrationText(X_SC));
  WriteWholeFile(job->folder / "semantic-kitti.yaml", ClassesYaml(counts));
}

}  // namespace tera
