#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dataset/export/kitti/frame_pairs.h"
#include "dataset/export/kitti/kitti_label.h"
#include "dataset/export/kitti/kitti_rig.h"

/// Folder layouts of KITTI's benchmarks.

namespace tera {

/// A frame at the time of its picture.
struct KittiFrame {
  int number = 0;  ///< from 0
  FramePair times;
  bool is_written = false;  ///< a stopped export has completed its files
  Pose X_WC, X_WS;
  std::vector<KittiLabel> labels;  ///< if a layout has labels
  Image<std::uint16_t> depth_mm;   ///< rectified; if a layout has depth

  Pose X_CS() const { return X_WC.inverse() * X_WS; }
};

/// Writes the files of one benchmark. The caller writes pictures and scans, which several
/// benchmarks share.
class KittiLayoutWriter {
 public:
  virtual ~KittiLayoutWriter() = default;

  /// Paths of a frame's picture and points; nothing if the layout has none.
  virtual std::optional<std::filesystem::path> Picture(int /*frame*/) const { return std::nullopt; }
  virtual std::optional<std::filesystem::path> Points(int /*frame*/) const { return std::nullopt; }
  /// Files of a single frame that the layout writes itself.
  virtual std::vector<std::filesystem::path> FilesOf(int /*frame*/) const { return {}; }
  /// Writes these for a new frame. Runs on any thread.
  virtual void WriteFiles(const KittiFrame& /*frame*/) const {}
  /// Adds to files of all frames. Frames come in order, each once.
  virtual void Add(const KittiFrame& /*frame*/) {}
  virtual void Commit() {}
};

// `job` and `rig` must outlive the writers.
// raw/DAY/: calib_*.txt and DAY_drive_0001_sync/ with image_02, velodyne_points and oxts.
std::unique_ptr<KittiLayoutWriter> MakeRawLayout(const ExportJob& job, const KittiRig& rig);
/// object/training/: image_2, velodyne, calib and label_2.
std::unique_ptr<KittiLayoutWriter> MakeObjectLayout(const ExportJob& job, const KittiRig& rig);
/// tracking/training/: image_02/0000, velodyne/0000, calib, oxts and label_02.
std::unique_ptr<KittiLayoutWriter> MakeTrackingLayout(const ExportJob& job, const KittiRig& rig);
/// odometry/: sequences/00 with image_2, velodyne, calib.txt and times.txt, and poses/00.txt.
std::unique_ptr<KittiLayoutWriter> MakeOdometryLayout(const ExportJob& job, const KittiRig& rig);
/// depth/DAY_drive_0001_sync/: proj_depth/groundtruth/image_02, and depth/calib_cam_to_cam.txt.
std::unique_ptr<KittiLayoutWriter> MakeDepthLayout(const ExportJob& job, const KittiRig& rig);

/// "2011_09_26" for the recording's start, and "2011_09_26_drive_0001_sync".
std::string DayOf(const ExportJob& job);
std::string DriveOf(const ExportJob& job);
/// A measurement's date and time, with the line's end.
std::string TimestampLine(const ExportJob& job, TimeNs t_ns);

/// calib_cam_to_cam.txt. KITTI's four cameras are all the exported camera, which is also their
/// reference. The lens has no distortion, since the pictures are rectified.
std::string CameraCalibrationText(const ExportJob& job, const CameraLens& lens);
/// "P0: ..." to "P3: ...", of the same camera.
std::string ProjectionLines(const CameraLens& lens);
/// The oxts row of a frame, for the link that carries the lidar.
std::string OxtsOf(const ExportJob& job, const KittiRig& rig, const KittiFrame& frame);

}  // namespace tera
