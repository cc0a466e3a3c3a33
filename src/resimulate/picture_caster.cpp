#include "resimulate/picture_caster.h"

#include "sensors/camera/camera.h"

namespace tera {

PictureCaster::PictureCaster(const Scenario& scenario, const SceneAssembly& assembly,
                             const RecordedStage& stage,
                             const std::vector<RecordedMotion>& machines)
    : scenario_(scenario),
      assembly_(assembly),
      stage_(stage),
      machines_(machines),
      surface_(SurfacesOf(scenario, assembly, machines)),
      rasterizer_(assembly.model(), {}) {}

std::optional<BodyState> PictureCaster::LinkAt(std::size_t machine, const SensorDescription& sensor,
                                               const ScanCaster::Scan& picture,
                                               const SensorCalibration& calibration) const {
  const TimeNs t_ns = picture.t_ns - FromSeconds(calibration.clock_offset_s);
  if (!machines_[machine].IsKnownAt(t_ns)) return std::nullopt;
  const int link = scenario_.machines[machine].placement.model.LinkIndex(sensor.link);
  return machines_[machine].At(t_ns).links[static_cast<std::size_t>(link)];
}

std::optional<SimulatedPicture> PictureCaster::Render(std::size_t machine,
                                                      const SensorDescription& sensor,
                                                      const ScanCaster::Scan& picture,
                                                      const SensorCalibration& calibration,
                                                      int reduced) {
  const auto link = LinkAt(machine, sensor, picture, calibration);
  if (!link) return std::nullopt;
  const TimeNs t_ns = picture.t_ns - FromSeconds(calibration.clock_offset_s);
  const Instant state = stage_.StateAt(t_ns, picture.moment);
  SceneState scene;
  scene.t_ns = t_ns;
  scene.X_WB = assembly_.BodyPoses(state);
  scene.shapes = assembly_.ShapesOf(state);
  scene.terrain = picture.moment.ground.get();
  const CameraIntrinsics lens = Reduced(PicturesOf(sensor)->intrinsics, reduced);
  CameraFrame frame =
      rasterizer_.Render(lens, link->X_WB * calibration.X_BT * OpticalInSensor(), scene);
  SimulatedPicture simulated;
  simulated.grey = ReducedGrey(frame.rgb, 1);
  simulated.depth_m = std::move(frame.depth_m);
  simulated.surface = Image<std::uint8_t>(lens.width_px, lens.height_px);
  for (std::size_t i = 0; i < simulated.surface.data.size(); ++i) {
    const Surface surface =
        simulated.depth_m.data[i] > 0 ? surface_[frame.instance.data[i]] : Surface::kNothing;
    simulated.surface.data[i] = static_cast<std::uint8_t>(surface);
  }
  return simulated;
}

CameraIntrinsics Reduced(const CameraIntrinsics& lens, int times) {
  CameraIntrinsics reduced = lens;
  reduced.width_px = lens.width_px / times;
  reduced.height_px = lens.height_px / times;
  reduced.fx_px = lens.fx_px / times;
  reduced.fy_px = lens.fy_px / times;
  // The centre of the upper left pixel is (0, 0) at either size.
  reduced.cx_px = (lens.cx_px + 0.5) / times - 0.5;
  reduced.cy_px = (lens.cy_px + 0.5) / times - 0.5;
  return reduced;
}

Image<float> ReducedGrey(const Image<std::uint8_t>& rgb, int times) {
  Image<float> grey(rgb.width_px / times, rgb.height_px / times);
  const float over = 1.0f / (255.0f * static_cast<float>(times * times));
  for (int y = 0; y < grey.height_px * times; ++y) {
    for (int x = 0; x < grey.width_px * times; ++x) {
      const float value =
          0.299f * rgb.at(x, y, 0) + 0.587f * rgb.at(x, y, 1) + 0.114f * rgb.at(x, y, 2);
      grey.at(x / times, y / times) += over * value;
    }
  }
  return grey;
}

}  // namespace tera
