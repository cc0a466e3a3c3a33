#include "diagnose/perception/pictures/picture_run.h"

#include <utility>

#include "diagnose/perception/pictures/picture_diagnosis.h"
#include "resimulate/recorded_scans.h"
#include "sensors/camera/camera.h"

namespace tera {
namespace {

constexpr int kWidest_px = 400;

}  // namespace

PerceptionDiagnosis DiagnoseCamera(const RecordedSensor& camera, const Recording& recording,
                                   std::uint64_t seed, PictureCaster* caster) {
  const SensorDescription& sensor = *camera.description;
  const CameraIntrinsics& lens = PicturesOf(sensor)->intrinsics;
  const int reduced = (lens.width_px + kWidest_px - 1) / kWidest_px;
  const CameraIntrinsics small = Reduced(lens, reduced);
  PictureSource source;
  source.channel = camera.channel;
  source.target = sensor.name;
  source.kind = KindOf(sensor).target;
  source.X_BS = sensor.X_BS;
  source.X_SC = OpticalInSensor();
  source.present = sensor.effects;
  source.render = [&](std::size_t frame, const SensorCalibration& calibration) {
    return caster->Render(camera.machine, sensor, camera.scans[frame], calibration, reduced);
  };
  source.link_at = [&](std::size_t frame, const SensorCalibration& calibration) {
    return caster->LinkAt(camera.machine, sensor, camera.scans[frame], calibration);
  };
  source.project = [small](const Vec3& p_C_m) { return small.Project(p_C_m); };
  source.ray = [small](const Vec2& px) { return small.RayOf(px); };
  for (const ScanCaster::Scan& picture : camera.scans) {
    LoadedPicture loaded =
        LoadGreyPicture(recording, camera.channel, sensor, picture.t_ns, reduced);
    if (!loaded.obstacle.empty()) {
      return NotJudged(source.channel, source.target, loaded.obstacle);
    }
    source.t_ns.push_back(picture.t_ns);
    source.grey.push_back(std::move(loaded.grey));
  }
  return DiagnosePictures(source, seed);
}

}  // namespace tera
