#include "dataset/export/nuscenes/nuscenes_rig.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>

#include "core/error.h"
#include "dataset/export/kitti/kitti_rig.h"
#include "dataset/export/picture/labelled_frame.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

std::string UpperCase(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

NuScenesSensor ReadLidar(ExportJob* job, const std::string& path) {
  NuScenesSensor lidar;
  lidar.path = path;
  const SensorSheet sheet = ReadSensorSheet(job->recording.directory() / path);
  if (sheet.rate_hz > 0) lidar.delay_ns = FromSeconds(0.5 / sheet.rate_hz);
  lidar.t_ns = job->recording.FrameTimes(path);
  for (TimeNs& t_ns : lidar.t_ns) t_ns += lidar.delay_ns;
  lidar.poses = SensorTrack(job, path);
  return lidar;
}

/// Returns nullopt if the lens is unknown or cannot be rectified.
std::optional<NuScenesSensor> ReadCamera(ExportJob* job, const std::string& path) {
  const SensorSheet sheet = ReadSensorSheet(job->recording.directory() / path);
  if (!sheet.lens || !Rectifier::Takes(*sheet.lens)) return std::nullopt;
  NuScenesSensor camera;
  camera.path = path;
  camera.channel = "CAM_" + UpperCase(fs::path(path).filename().string());
  camera.lens = sheet.lens;
  camera.t_ns = job->recording.FrameTimes(path);
  camera.poses = SensorTrack(job, path);
  camera.X_SF = OpticalAxesInSensor();
  return camera;
}

void RequireChannelsApart(const NuScenesRig& rig) {
  std::map<std::string, std::string> sensor_of;
  for (const NuScenesSensor& sensor : rig.sensors) {
    const auto [other, is_new] = sensor_of.try_emplace(sensor.channel, sensor.path);
    if (is_new) continue;
    throw InputError(
        sensor.path,
        {FaultKind::kRepeated,
         fmt::format("would be nuScenes' channel {}, like {}; rename one of the two folders",
                     sensor.channel, other->second)});
  }
}

}  // namespace

std::vector<NuScenesRig> ReadNuScenesRigs(ExportJob* job) {
  std::vector<NuScenesRig> rigs;
  const auto rig_of = [&](const std::string& path) -> NuScenesRig& {
    const std::string machine = MachineOf(path);
    const auto found = std::find_if(rigs.begin(), rigs.end(),
                                    [&](const NuScenesRig& r) { return r.machine == machine; });
    if (found != rigs.end()) return *found;
    rigs.push_back({.machine = machine, .X_WB = MachineTrack(*job, machine).X_WS, .sensors = {}});
    return rigs.back();
  };
  for (const std::string& path : job->recording.SensorsOf(ChannelForm::kScans)) {
    if (job->recording.FrameTimes(path).empty()) continue;
    NuScenesSensor lidar = ReadLidar(job, path);
    std::vector<NuScenesSensor>& sensors = rig_of(path).sensors;
    // The nuScenes tools require this name for the roof lidar.
    lidar.channel =
        sensors.empty() ? "LIDAR_TOP" : "LIDAR_" + UpperCase(fs::path(path).filename().string());
    sensors.push_back(std::move(lidar));
  }
  const std::vector<std::string> boxed = CamerasWith(job->recording, {"rgb", "boxes"});
  for (const std::string& path : CamerasWith(job->recording, {"rgb"})) {
    std::optional<NuScenesSensor> camera = ReadCamera(job, path);
    if (!camera) continue;
    camera->has_boxes = std::find(boxed.begin(), boxed.end(), path) != boxed.end();
    rig_of(path).sensors.push_back(std::move(*camera));
  }
  for (const NuScenesRig& rig : rigs) RequireChannelsApart(rig);
  return rigs;
}

}  // namespace tera
