#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dataset/export/kitti/frame_pairs.h"
#include "dataset/export/kitti/kitti_label.h"
#include "dataset/export/kitti/kitti_rig.h"

/// Folder layouts of the KITTI benchmarks.

namespace tera {

/// A frame, at the time of its image.
struct KittiFrame {
  int number = 0;  ///< counted from 0
  FramePair times;
  bool is_written = false;  ///< a stopped export has already completed the frame's files
  Pose X_WC, X_WS;
  std::vector<KittiLabel> labels;  ///< only if a layout needs labels
  Image<std::uint16_t> depth_mm;   ///< rectified depth; only if a layout needs depth

  Pose X_CS() const { return X_WC.inverse() * X_WS; }
};

/// Writes the files of one benchmark. Images and scans are written by the caller, because several
/// benchmarks share them.
class KittiLayoutWriter {
 public:
  virtual ~KittiLayoutWriter() = default;

  /// Paths of a frame's image and points; nullopt if the layout has none.
  virtual std::optional<std::filesystem::path> Picture(int /*frame*/) const { return std::nullopt; }
  virtual std::optional<std::filesystem::path> Points(int /*frame*/) const { return std::nullopt; }
  /// Other files that belong to a single frame.
  virtual std::vector<std::filesystem::path> FilesOf(int /*frame*/) const { return {}; }
  /// Writes the files of FilesOf for a frame. Thread-safe.
  virtual void WriteFiles(const KittiFrame& /*frame*/) const {}
  /// Adds a frame to files that cover all frames. Called once per frame, in order.
  virtual void Add(const KittiFrame& /*frame*/) {}
  virtual void Commit() {}
};

// `job` and `rig` must outlive the writers.
//
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

/// Formats "2011_09_26" and "2011_09_26_drive_0001_sync", from the start of the recording.
std::string DayOf(const ExportJob& job);
std::string DriveOf(const ExportJob& job);
/// Date and time of a measurement, with line end.
std::string TimestampLine(const ExportJob& job, TimeNs t_ns);

/// Text of calib_cam_to_cam.txt. All four KITTI cameras are the exported camera, which is also the
/// reference camera. Distortion is zero, because images are rectified.
std::string CameraCalibrationText(const ExportJob& job, const CameraLens& lens);
/// Lines "P0: ..." to "P3: ...", all for the exported camera.
std::string ProjectionLines(const CameraLens& lens);
/// The oxts row of a frame, for the link that carries the lidar.
std::string OxtsOf(const ExportJob& job, const KittiRig& rig, const KittiFrame& frame);

}  // namespace tera
