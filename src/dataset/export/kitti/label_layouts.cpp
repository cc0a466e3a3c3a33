#include <fmt/format.h>

#include "dataset/export/kitti/kitti_layout.h"
#include "dataset/export/kitti/kitti_text.h"
#include "dataset/files/checked_file.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

/// Frames are independent; each has its own calibration.
class ObjectLayout : public KittiLayoutWriter {
 public:
  ObjectLayout(const ExportJob& job, const KittiRig& rig)
      : rig_(rig), folder_(job.folder / "object/training") {
    for (const char* kind : {"image_2", "velodyne", "calib", "label_2"}) MakeFolder(folder_ / kind);
  }

  std::optional<fs::path> Picture(int frame) const override {
    return File("image_2", frame, "png");
  }
  std::optional<fs::path> Points(int frame) const override {
    return File("velodyne", frame, "bin");
  }
  std::vector<fs::path> FilesOf(int frame) const override {
    return {File("calib", frame, "txt"), File("label_2", frame, "txt")};
  }

  void WriteFiles(const KittiFrame& frame) const override {
    WriteWholeFile(File("calib", frame.number, "txt"),
                   fmt::format("{}R0_rect: {}\nTr_velo_to_cam: {}\nTr_imu_to_velo: {}\n",
                               ProjectionLines(rig_.lens), NumbersText(Mat3::Identity()),
                               PoseText(frame.X_CS()), PoseText(rig_.lidar.X_PS.inverse())));
    std::string lines;
    for (const KittiLabel& label : frame.labels) lines += ObjectLine(label);
    WriteWholeFile(File("label_2", frame.number, "txt"), lines);
  }

 private:
  fs::path File(const char* kind, int frame, const char* ending) const {
    return folder_ / kind / fmt::format("{:06}.{}", frame, ending);
  }

  const KittiRig& rig_;
  fs::path folder_;
};

/// All frames form the sequence 0000.
class TrackingLayout : public KittiLayoutWriter {
 public:
  TrackingLayout(const ExportJob& job, const KittiRig& rig)
      : job_(job),
        rig_(rig),
        folder_(job.folder / "tracking/training"),
        labels_(FileIn("label_02")),
        oxts_(FileIn("oxts")) {
    MakeFolder(folder_ / "image_02/0000");
    MakeFolder(folder_ / "velodyne/0000");
  }

  std::optional<fs::path> Picture(int frame) const override {
    return folder_ / "image_02/0000" / fmt::format("{:06}.png", frame);
  }
  std::optional<fs::path> Points(int frame) const override {
    return folder_ / "velodyne/0000" / fmt::format("{:06}.bin", frame);
  }

  void Add(const KittiFrame& frame) override {
    if (frame.number == 0) {
      WriteWholeFile(FileIn("calib"),
                     fmt::format("{}R_rect {}\nTr_velo_cam {}\nTr_imu_velo {}\n",
                                 ProjectionLines(rig_.lens), NumbersText(Mat3::Identity()),
                                 PoseText(frame.X_CS()), PoseText(rig_.lidar.X_PS.inverse())));
    }
    for (const KittiLabel& label : frame.labels) labels_.Append(TrackLine(frame.number, label));
    oxts_.Append(OxtsOf(job_, rig_, frame));
  }

  void Commit() override {
    labels_.Commit();
    oxts_.Commit();
  }

 private:
  fs::path FileIn(const char* kind) const {
    MakeFolder(folder_ / kind);
    return folder_ / kind / "0000.txt";
  }

  const ExportJob& job_;
  const KittiRig& rig_;
  fs::path folder_;
  CheckedFile labels_, oxts_;
};

}  // namespace

std::unique_ptr<KittiLayoutWriter> MakeObjectLayout(const ExportJob& job, const KittiRig& rig) {
  return std::make_unique<ObjectLayout>(job, rig);
}

std::unique_ptr<KittiLayoutWriter> MakeTrackingLayout(const ExportJob& job, const KittiRig& rig) {
  return std::make_unique<TrackingLayout>(job, rig);
}

}  // namespace tera
