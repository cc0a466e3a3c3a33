#include <fmt/format.h>

#include <cmath>

#include "dataset/export/kitti/kitti_layout.h"
#include "dataset/export/kitti/kitti_text.h"
#include "dataset/export/stamp_text.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/png.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

fs::path Made(const fs::path& folder) {
  MakeFolder(folder);
  return folder;
}

/// All frames form sequence 00. The first image defines time 0 and the world frame, which is the
/// camera frame.
class OdometryLayout : public KittiLayoutWriter {
 public:
  OdometryLayout(const ExportJob& job, const KittiRig& rig)
      : rig_(rig),
        sequence_(Made(job.folder / "odometry/sequences/00")),
        poses_(Made(job.folder / "odometry/poses") / "00.txt"),
        times_(sequence_ / "times.txt") {
    MakeFolder(sequence_ / "image_2");
    MakeFolder(sequence_ / "velodyne");
  }

  std::optional<fs::path> Picture(int frame) const override {
    return sequence_ / "image_2" / fmt::format("{:06}.png", frame);
  }
  std::optional<fs::path> Points(int frame) const override {
    return sequence_ / "velodyne" / fmt::format("{:06}.bin", frame);
  }

  void Add(const KittiFrame& frame) override {
    if (frame.number == 0) {
      first_ns_ = frame.times.picture_ns;
      X_CW_first_ = frame.X_WC.inverse();
      WriteWholeFile(sequence_ / "calib.txt",
                     ProjectionLines(rig_.lens) + "Tr: " + PoseText(frame.X_CS()) + "\n");
    }
    poses_.Append(PoseText(X_CW_first_ * frame.X_WC) + "\n");
    times_.Append(SecondsText(frame.times.picture_ns - first_ns_) + "\n");
  }

  void Commit() override {
    poses_.Commit();
    times_.Commit();
  }

 private:
  const KittiRig& rig_;
  fs::path sequence_;
  CheckedFile poses_, times_;
  TimeNs first_ns_ = 0;
  Pose X_CW_first_ = Pose::Identity();
};

/// Writes depth along the optical axis in units of 1/256 m; 0 means no measurement.
class DepthLayout : public KittiLayoutWriter {
 public:
  DepthLayout(const ExportJob& job, const KittiRig& rig)
      : folder_(Made(job.folder / "depth" / DriveOf(job) / "proj_depth/groundtruth/image_02")) {
    WriteWholeFile(job.folder / "depth/calib_cam_to_cam.txt", CameraCalibrationText(job, rig.lens));
  }

  std::vector<fs::path> FilesOf(int frame) const override {
    return {folder_ / fmt::format("{:010}.png", frame)};
  }

  void WriteFiles(const KittiFrame& frame) const override {
    constexpr double kUnitsPerMillimetre = 256.0 / 1000.0;
    Image<std::uint16_t> depth = frame.depth_mm;
    for (std::uint16_t& value : depth.data) {
      value = static_cast<std::uint16_t>(std::lround(value * kUnitsPerMillimetre));
    }
    WriteWholeFile(FilesOf(frame.number).front(), EncodeGrey16Png(depth));
  }

 private:
  fs::path folder_;
};

}  // namespace

std::unique_ptr<KittiLayoutWriter> MakeOdometryLayout(const ExportJob& job, const KittiRig& rig) {
  return std::make_unique<OdometryLayout>(job, rig);
}

std::unique_ptr<KittiLayoutWriter> MakeDepthLayout(const ExportJob& job, const KittiRig& rig) {
  return std::make_unique<DepthLayout>(job, rig);
}

}  // namespace tera
