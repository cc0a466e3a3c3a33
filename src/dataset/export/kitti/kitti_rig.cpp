#include "dataset/export/kitti/kitti_rig.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/error.h"

namespace tera {
namespace {

/// The channel that the option names, or else the first.
std::string Chosen(const ExportJob& job, ChannelForm form, const std::string& named,
                   std::string_view option, std::string_view kind) {
  const std::vector<std::string> all = job.recording.SensorsOf(form);
  RequireAny(all, job, kind);
  if (named.empty()) return all.front();
  if (std::find(all.begin(), all.end(), named) == all.end()) {
    throw InputError(std::string(option),
                     {FaultKind::kNoSuchName, fmt::format("{} has no {} '{}'; need one of {}",
                                                          job.recording.directory().string(), kind,
                                                          named, fmt::join(all, ", "))});
  }
  return named;
}

std::string SheetOf(const ExportJob& job, const std::string& sensor) {
  return (job.recording.directory() / sensor / "sensor.yaml").string();
}

CameraLens LensOf(const ExportJob& job, const std::string& camera) {
  const SensorSheet sheet = ReadSensorSheet(job.recording.directory() / camera);
  if (!sheet.lens) {
    throw InputError(SheetOf(job, camera),
                     {FaultKind::kMissing, "has no lens; need `model` with width_px to cy_px"});
  }
  if (!Rectifier::Takes(*sheet.lens)) {
    throw InputError(
        SheetOf(job, camera),
        {FaultKind::kUnsupported,
         fmt::format(
             "its lens has the law {}, which no pinhole can replace, but KITTI's pictures have a "
             "pinhole lens; choose a camera with a brown_conrady or rational lens with --camera",
             sheet.lens->law)});
  }
  return *sheet.lens;
}

}  // namespace

std::string ChosenLidar(const ExportJob& job) {
  return Chosen(job, ChannelForm::kScans, job.options.lidar, "--lidar", "lidar");
}

Pose OpticalAxesInSensor() {
  Mat3 R_SC;
  R_SC << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return MakePose(Vec3::Zero(), R_SC);
}

Pose KittiRig::X_WC(TimeNs t_ns) const {
  return camera_poses.X_WS.At(t_ns) * OpticalAxesInSensor();
}

KittiLidar ReadKittiLidar(ExportJob* job) {
  KittiLidar lidar;
  lidar.path = ChosenLidar(*job);
  const SensorSheet sheet = ReadSensorSheet(job->recording.directory() / lidar.path);
  if (!(sheet.rate_hz > 0)) {
    throw InputError(SheetOf(*job, lidar.path),
                     {FaultKind::kMissing, "has no rate; need `rate_hz` of its scans"});
  }
  if (!sheet.X_PS) {
    throw InputError(SheetOf(*job, lidar.path),
                     {FaultKind::kMissing, "has no X_parent_sensor; need its pose on its link"});
  }
  lidar.period_ns = FromSeconds(1 / sheet.rate_hz);
  lidar.X_PS = *sheet.X_PS;
  lidar.poses = SensorTrack(job, lidar.path);
  return lidar;
}

KittiRig ReadKittiRig(ExportJob* job) {
  KittiRig rig;
  rig.camera = Chosen(*job, ChannelForm::kPictures, job->options.camera, "--camera", "camera");
  rig.lens = LensOf(*job, rig.camera);
  rig.lidar = ReadKittiLidar(job);
  rig.camera_poses = SensorTrack(job, rig.camera);
  return rig;
}

}  // namespace tera
