#include "dataset/export/nuscenes/sensor_frames.h"

#include <fmt/format.h>

#include <bit>

#include "core/error.h"
#include "dataset/export/bag/little_endian.h"
#include "dataset/export/kitti/steady_scan.h"
#include "dataset/export/nuscenes/nuscenes_categories.h"
#include "dataset/export/picture/labelled_frame.h"
#include "dataset/format/png.h"

namespace tera {

SensorFrames::SensorFrames(const Recording& recording, const NuScenesSensor& sensor)
    : recording_(recording), sensor_(sensor) {
  if (sensor.is_camera()) rectifier_.emplace(*sensor.lens);
}

std::string SensorFrames::PictureBytes(TimeNs t_ns) const {
  const CameraLens& lens = *sensor_.lens;
  const std::filesystem::path rgb = FrameFile(recording_, sensor_.path, "rgb", t_ns);
  const PictureSize size = SizeOfPng(rgb);
  if (size.width_px != lens.width_px || size.height_px != lens.height_px) {
    throw InputError(rgb.string(),
                     fmt::format("has {} x {} pixels; need {} x {} of sensor.yaml", size.width_px,
                                 size.height_px, lens.width_px, lens.height_px));
  }
  return rectifier_->changes_pictures() ? EncodeRgbPng(rectifier_->Blended(ReadRgbPng(rgb)))
                                        : ReadWholePng(rgb);
}

std::vector<LidarPoint> SensorFrames::Points(TimeNs t_ns) const {
  return SteadyScan(recording_.LoadScan(sensor_.path, t_ns - sensor_.delay_ns), sensor_.poses.X_WS,
                    t_ns);
}

std::vector<Vec3> SensorFrames::InWorld(const std::vector<LidarPoint>& points, TimeNs t_ns) const {
  const Pose X_WS = sensor_.X_WF(t_ns);
  std::vector<Vec3> points_W_m;
  points_W_m.reserve(points.size());
  for (const LidarPoint& p : points) points_W_m.push_back(X_WS * Vec3(p.x_m, p.y_m, p.z_m));
  return points_W_m;
}

std::string SensorFrames::Categories(const std::vector<LidarPoint>& points, TimeNs t_ns,
                                     const std::set<std::uint16_t>& own) const {
  std::string categories;
  for (const LidarPoint& point : points) {
    if (point.label >= kSemanticClasses.size()) {
      throw InputError(
          (recording_.directory() / sensor_.path / "scans" /
           fmt::format("{}.pcd", t_ns - sensor_.delay_ns))
              .string(),
          {FaultKind::kNoSuchName,
           fmt::format(
               "has a point of the class {}; need classes of docs/reference/dataset.md, 0 to {}",
               point.label, kSemanticClasses.size() - 1)});
    }
    const bool is_own = own.contains(point.instance);
    categories.push_back(static_cast<char>(
        is_own ? kNuScenesEgo : NuScenesCategoryOf(static_cast<SemanticClass>(point.label))));
  }
  return categories;
}

std::string NuScenesPointBytes(const std::vector<LidarPoint>& points) {
  constexpr float kFullIntensity = 255;
  std::string bytes;
  for (const LidarPoint& p : points) {
    for (const float value :
         {p.x_m, p.y_m, p.z_m, kFullIntensity * p.intensity, static_cast<float>(p.ring)}) {
      AppendNumber(std::bit_cast<std::uint32_t>(value), &bytes);
    }
  }
  return bytes;
}

}  // namespace tera
