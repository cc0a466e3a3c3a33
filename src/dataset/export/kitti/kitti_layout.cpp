#include "dataset/export/kitti/kitti_layout.h"

#include <fmt/format.h>

#include "dataset/export/kitti/kitti_text.h"
#include "dataset/export/kitti/oxts.h"

namespace tera {
namespace {

constexpr int kCameras = 4;

}  // namespace

std::string DayOf(const ExportJob& job) { return DayText(job.Stamp(0, kDefaultStart_ns)); }

std::string DriveOf(const ExportJob& job) { return DayOf(job) + "_drive_0001_sync"; }

std::string TimestampLine(const ExportJob& job, TimeNs t_ns) {
  return DateAndTimeText(job.Stamp(t_ns, kDefaultStart_ns)) + "\n";
}

std::string CameraCalibrationText(const ExportJob& job, const CameraLens& lens) {
  const Eigen::Matrix<double, 3, 4> P = ProjectionOf(lens);
  const std::string size = NumbersText(Vec2(lens.width_px, lens.height_px).transpose());
  const std::string no_turn = NumbersText(Mat3::Identity());
  std::string text = fmt::format("calib_time: {}\ncorner_dist: {:.12e}\n",
                                 CalibrationTimeText(job.Stamp(0, kDefaultStart_ns)), 0.0);
  for (int camera = 0; camera < kCameras; ++camera) {
    text += fmt::format(
        "S_{0:02}: {1}\nK_{0:02}: {2}\nD_{0:02}: {3}\nR_{0:02}: {4}\nT_{0:02}: {5}\n", camera, size,
        NumbersText(P.leftCols<3>()), NumbersText(Eigen::RowVectorXd::Zero(5)), no_turn,
        NumbersText(Eigen::RowVector3d::Zero()));
    text += fmt::format("S_rect_{0:02}: {1}\nR_rect_{0:02}: {2}\nP_rect_{0:02}: {3}\n", camera,
                        size, no_turn, NumbersText(P));
  }
  return text;
}

std::string ProjectionLines(const CameraLens& lens) {
  std::string text;
  for (int camera = 0; camera < kCameras; ++camera) {
    text += fmt::format("P{}: {}\n", camera, NumbersText(ProjectionOf(lens)));
  }
  return text;
}

std::string OxtsOf(const ExportJob& job, const KittiRig& rig, const KittiFrame& frame) {
  return OxtsRow(MotionAt(rig.lidar.poses, rig.lidar.X_PS.inverse(), frame.times.picture_ns),
                 job.recording.info());
}

}  // namespace tera
