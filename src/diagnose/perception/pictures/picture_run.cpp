#include "diagnose/perception/pictures/picture_run.h"

#include <fmt/format.h>

#include "diagnose/perception/pictures/picture_diagnosis.h"
#include "sensors/camera/camera.h"

namespace tera {
namespace {

constexpr int kWidest_px = 400;

/// Loads the pictures; returns why they cannot be compared, empty where they can.
std::string Load(const RecordedCamera& camera, const Recording& recording, int reduced,
                 PictureSource* source) {
  const CameraIntrinsics& lens = std::get<CameraModel>(camera.description->model).intrinsics;
  for (const ScanCaster::Scan& picture : *camera.pictures) {
    const Image<std::uint8_t> rgb = recording.LoadFrame(camera.channel, picture.t_ns).rgb;
    if (rgb.empty()) return "it recorded no colours";
    if (rgb.width_px != lens.width_px || rgb.height_px != lens.height_px) {
      return fmt::format(
          "its picture {} is of {} x {} pixels, but the scenario's camera has {} x {}; need the "
          "camera that was recorded",
          picture.t_ns, rgb.width_px, rgb.height_px, lens.width_px, lens.height_px);
    }
    source->t_ns.push_back(picture.t_ns);
    source->grey.push_back(ReducedGrey(rgb, reduced));
  }
  return "";
}

}  // namespace

bool TakesPictures(const SensorDescription& sensor) {
  const auto* camera = std::get_if<CameraModel>(&sensor.model);
  return camera && camera->rgb && !camera->depth;
}

PerceptionDiagnosis DiagnoseCamera(const RecordedCamera& camera, const Recording& recording,
                                   std::uint64_t seed, PictureCaster* caster) {
  const SensorDescription& sensor = *camera.description;
  const CameraIntrinsics& lens = std::get<CameraModel>(sensor.model).intrinsics;
  const int reduced = (lens.width_px + kWidest_px - 1) / kWidest_px;
  const CameraIntrinsics small = Reduced(lens, reduced);
  PictureSource source;
  source.channel = camera.channel;
  source.target = sensor.name;
  source.X_BS = sensor.X_BS;
  source.X_SC = OpticalInSensor();
  source.present = sensor.effects;
  source.render = [&](std::size_t frame, const SensorCalibration& calibration) {
    return caster->Render(camera.machine, sensor, (*camera.pictures)[frame], calibration, reduced);
  };
  source.link_at = [&](std::size_t frame, const SensorCalibration& calibration) {
    return caster->LinkAt(camera.machine, sensor, (*camera.pictures)[frame], calibration);
  };
  source.project = [small](const Vec3& p_C_m) { return small.Project(p_C_m); };
  source.ray = [small](const Vec2& px) { return small.RayOf(px); };
  const std::string obstacle = Load(camera, recording, reduced, &source);
  if (obstacle.empty()) return DiagnosePictures(source, seed);
  return NotJudged(source.channel, source.target, obstacle);
}

}  // namespace tera
