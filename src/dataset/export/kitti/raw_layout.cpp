#include <fmt/format.h>

#include "dataset/export/kitti/kitti_layout.h"
#include "dataset/export/kitti/kitti_text.h"
#include "dataset/files/checked_file.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

class RawLayout : public KittiLayoutWriter {
 public:
  RawLayout(const ExportJob& job, const KittiRig& rig)
      : job_(job),
        rig_(rig),
        day_(job.folder / "raw" / DayOf(job)),
        drive_(day_ / DriveOf(job)),
        pictures_(Times("image_02", "timestamps.txt")),
        points_(Times("velodyne_points", "timestamps.txt")),
        starts_(Times("velodyne_points", "timestamps_start.txt")),
        ends_(Times("velodyne_points", "timestamps_end.txt")),
        oxts_(Times("oxts", "timestamps.txt")) {}

  std::optional<fs::path> Picture(int frame) const override {
    return drive_ / "image_02/data" / fmt::format("{:010}.png", frame);
  }
  std::optional<fs::path> Points(int frame) const override {
    return drive_ / "velodyne_points/data" / fmt::format("{:010}.bin", frame);
  }

  std::vector<fs::path> FilesOf(int frame) const override {
    return {drive_ / "oxts/data" / fmt::format("{:010}.txt", frame)};
  }

  void WriteFiles(const KittiFrame& frame) const override {
    WriteWholeFile(FilesOf(frame.number).front(), OxtsOf(job_, rig_, frame));
  }

  void Add(const KittiFrame& frame) override {
    if (frame.number == 0) WriteCalibration(frame.X_CS());
    const std::string now = TimestampLine(job_, frame.times.picture_ns);
    for (CheckedFile* file : {&pictures_, &points_, &oxts_}) file->Append(now);
    starts_.Append(TimestampLine(job_, frame.times.scan_ns));
    ends_.Append(TimestampLine(job_, frame.times.scan_ns + rig_.lidar.period_ns));
  }

  void Commit() override {
    for (CheckedFile* file : {&pictures_, &points_, &starts_, &ends_, &oxts_}) file->Commit();
  }

 private:
  fs::path Times(const char* kind, const char* name) const {
    MakeFolder(drive_ / kind / "data");
    return drive_ / kind / name;
  }

  void WriteCalibration(const Pose& X_CS) const {
    const std::string head =
        "calib_time: " + CalibrationTimeText(job_.Stamp(0, kDefaultStart_ns)) + "\n";
    const auto turn_and_shift = [](const Pose& pose) {
      return fmt::format("R: {}\nT: {}\n", NumbersText(pose.linear()),
                         NumbersText(pose.translation().transpose()));
    };
    WriteWholeFile(day_ / "calib_cam_to_cam.txt", CameraCalibrationText(job_, rig_.lens));
    WriteWholeFile(day_ / "calib_velo_to_cam.txt",
                   head + turn_and_shift(X_CS) + "delta_f: 0 0\ndelta_c: 0 0\n");
    WriteWholeFile(day_ / "calib_imu_to_velo.txt",
                   head + turn_and_shift(rig_.lidar.X_PS.inverse()));
  }

  const ExportJob& job_;
  const KittiRig& rig_;
  fs::path day_, drive_;
  CheckedFile pictures_, points_, starts_, ends_, oxts_;
};

}  // namespace

std::unique_ptr<KittiLayoutWriter> MakeRawLayout(const ExportJob& job, const KittiRig& rig) {
  return std::make_unique<RawLayout>(job, rig);
}

}  // namespace tera
