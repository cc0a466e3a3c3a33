#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dataset/export/kitti/frame_pairs.h"
#include "dataset/export/kitti/kitti_label.h"
#include "dataset/export/kitti/kitti_rig.h"

/// The folders in which KITTI's benchmarks have their data.

namespace tera {

/// A frame, at the time of its picture.
struct KittiFrame {
  int number = 0;  ///< from 0
  FramePair times;
  bool is_written = false;  ///< its files are whole already, from an export that was stopped
  Pose X_WC, X_WS;
  std::vector<KittiLabel> labels;  ///< where a layout has some
  Image<std::uint16_t> depth_mm;   ///< rectified; where a layout has it

  Pose X_CS() const { return X_WC.inverse() * X_WS; }
};

/// What one benchmark has of the frames. Pictures and scans, which several have, are written by
/// whoever calls.
class KittiLayoutWriter {
 public:
  virtual ~KittiLayoutWriter() = default;

  /// Where the picture and the points of a frame belong; nothing where the layout has none.
  virtual std::optional<std::filesystem::path> Picture(int /*frame*/) const { return std::nullopt; }
  virtual std::optional<std::filesystem::path> Points(int /*frame*/) const { return std::nullopt; }
  /// Files of a frame alone that the layout writes itself.
  virtual std::vector<std::filesystem::path> FilesOf(int /*frame*/) const { return {}; }
  /// Writes these, of a frame that is not written; on any thread.
  virtual void WriteFiles(const KittiFrame& /*frame*/) const {}
  /// Adds to files of all frames. Frames come in order, each once.
  virtual void Add(const KittiFrame& /*frame*/) {}
  virtual void Commit() {}
};

// `job` and `rig` outlive what is made.
/// raw/DAY/: calib_*.txt and DAY_drive_0001_sync/ with image_02, velodyne_points and oxts.
std::unique_ptr<KittiLayoutWriter> MakeRawLayout(const ExportJob& job, const KittiRig& rig);
/// object/training/: image_2, velodyne, calib and label_2.
std::unique_ptr<KittiLayoutWriter> MakeObjectLayout(const ExportJob& job, const KittiRig& rig);
/// tracking/training/: image_02/0000, velodyne/0000, calib, oxts and label_02.
std::unique_ptr<KittiLayoutWriter> MakeTrackingLayout(const ExportJob& job, const KittiRig& rig);
/// odometry/: sequences/00 with image_2, velodyne, calib.txt and times.txt, and poses/00.txt.
std::unique_ptr<KittiLayoutWriter> MakeOdometryLayout(const ExportJob& job, const KittiRig& rig);
/// depth/DAY_drive_0001_sync/: proj_depth/groundtruth/image_02, and depth/calib_cam_to_cam.txt.
std::unique_ptr<KittiLayoutWriter> MakeDepthLayout(const ExportJob& job, const KittiRig& rig);

/// "2011_09_26", of the recording's beginning, and "2011_09_26_drive_0001_sync".
std::string DayOf(const ExportJob& job);
std::string DriveOf(const ExportJob& job);
/// A measurement's date and time, with the line's end.
std::string TimestampLine(const ExportJob& job, TimeNs t_ns);

/// calib_cam_to_cam.txt. All four of KITTI's cameras are the one that there is, which is their
/// reference too; as its pictures are rectified, no lens distorts.
std::string CameraCalibrationText(const ExportJob& job, const CameraLens& lens);
/// "P0: ..." to "P3: ...", of the same camera.
std::string ProjectionLines(const CameraLens& lens);
/// The oxts row of a frame: of the link that carries the lidar.
std::string OxtsOf(const ExportJob& job, const KittiRig& rig, const KittiFrame& frame);

}  // namespace tera
