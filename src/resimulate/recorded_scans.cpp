#include "resimulate/recorded_scans.h"

#include <fmt/format.h>

#include "resimulate/picture_caster.h"
#include "sensors/camera/camera.h"

namespace tera {
namespace {

constexpr std::size_t kMostPointsOfScan = 4000;  ///< that are kept of a scan or depth picture

LoadedScan LoadOf(const Recording& recording, const std::string& channel, const LidarModel& model,
                  TimeNs t_ns) {
  const LidarScan recorded = recording.LoadScan(channel, t_ns);
  const std::size_t stride = recorded.points.size() / kMostPointsOfScan + 1;
  LoadedScan loaded{{t_ns, {}}, ""};
  // An odd stride, so that with an even number of beams all of them come.
  for (std::size_t i = 0; i < recorded.points.size(); i += stride | 1) {
    const LidarPoint& point = recorded.points[i];
    if (point.ring >= model.elevation_rad.size()) {
      loaded.obstacle = fmt::format(
          "a point of its scan {} is of ring {}, but the scenario's lidar has "
          "{} beams; need the lidar that was recorded",
          t_ns, point.ring, model.elevation_rad.size());
    }
    const Vec3 p_S_m(point.x_m, point.y_m, point.z_m);
    if (p_S_m.norm() < model.min_range_m) continue;
    loaded.scan.points.push_back(
        {p_S_m, static_cast<TimeNs>(point.time_offset_ns), model.range_noise_m});
  }
  return loaded;
}

LoadedScan LoadOf(const Recording& recording, const std::string& channel, const CameraModel& model,
                  TimeNs t_ns) {
  const Image<float> depth_m = recording.LoadFrame(channel, t_ns).depth_m;
  const CameraIntrinsics& lens = model.intrinsics;
  LoadedScan loaded{{t_ns, {}}, ""};
  if (depth_m.width_px != lens.width_px || depth_m.height_px != lens.height_px) {
    loaded.obstacle = fmt::format(
        "its depth picture {} is of {} x {} pixels, but the scenario's camera "
        "has {} x {}; need the camera that was recorded",
        t_ns, depth_m.width_px, depth_m.height_px, lens.width_px, lens.height_px);
    return loaded;
  }
  const std::size_t pixels = depth_m.data.size();
  const Mat3 R_SC = OpticalInSensor().linear();
  const double noise_1pm = model.disparity_noise_px / (lens.fx_px * model.baseline_m);
  for (std::size_t i = 0; i < pixels; i += (pixels / kMostPointsOfScan + 1) | 1) {
    const double z_m = depth_m.data[i];
    if (!(z_m > 0)) continue;
    const auto width = static_cast<std::size_t>(lens.width_px);
    const auto ray = lens.RayOf({static_cast<double>(i % width), static_cast<double>(i / width)});
    if (!ray) continue;
    const Vec3 p_S_m = R_SC * (z_m * *ray);
    loaded.scan.points.push_back({p_S_m, 0, noise_1pm * z_m * p_S_m.norm()});
  }
  return loaded;
}

}  // namespace

LoadedScan LoadRangeScan(const Recording& recording, const std::string& channel,
                         const SensorDescription& sensor, TimeNs t_ns) {
  if (const auto* lidar = std::get_if<LidarModel>(&sensor.model)) {
    return LoadOf(recording, channel, *lidar, t_ns);
  }
  return LoadOf(recording, channel, std::get<CameraModel>(sensor.model), t_ns);
}

LoadedPicture LoadGreyPicture(const Recording& recording, const std::string& channel,
                              const SensorDescription& sensor, TimeNs t_ns, int reduced) {
  const CameraIntrinsics& lens = std::get<CameraModel>(sensor.model).intrinsics;
  const Image<std::uint8_t> rgb = recording.LoadFrame(channel, t_ns).rgb;
  if (rgb.empty()) return {{}, "it recorded no colours"};
  if (rgb.width_px != lens.width_px || rgb.height_px != lens.height_px) {
    return {
        {},
        fmt::format("its picture {} is of {} x {} pixels, but the scenario's camera has {} x {}; "
                    "need the camera that was recorded",
                    t_ns, rgb.width_px, rgb.height_px, lens.width_px, lens.height_px)};
  }
  return {ReducedGrey(rgb, reduced), ""};
}

}  // namespace tera
