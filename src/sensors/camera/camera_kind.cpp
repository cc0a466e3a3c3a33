#include <fmt/format.h>

#include <utility>

#include "sensors/camera/camera_view.h"
#include "sensors/sensor.h"
#include "sensors/slots/frame_slots.h"
#include "sensors/slots/mechanism_rows.h"

// A camera on the shelf.

namespace tera {
namespace {

class CameraSampler : public InstantSampler {
 public:
  explicit CameraSampler(const SensorPlace& place)
      : InstantSampler(place.sensor.clock),
        camera_(std::get<CameraModel>(place.sensor.model), place.sensor.clock,
                place.sensor.latency_ns, place.seed, place.folder),
        slots_(place.sensor.effects, place.seed, place.folder),
        output_(place.output) {
    const Mounting mount = TrueMounting(place.sensor, place.rig);
    link_ = place.machine.LinkIndex(mount.link);
    X_BT_ = mount.X_BT;
  }

 private:
  void MeasureAt(std::int64_t k, TimeNs t_ns, const SensedStep& step) override {
    const ReportClock::Times times = slots_.Stamp(k, t_ns);
    if (!output_.sink->NeedsFrame(output_.channel, times.t_ns, clock().Due(k + 1))) {
      output_.sink->MarkPresent(output_.channel, times.t_ns);
      return;
    }
    const double s = step.FractionAt(t_ns);
    SceneState scene;
    scene.t_ns = t_ns;
    scene.terrain = &step.scene.ground();
    scene.shapes = step.scene.ShapesNow();
    scene.X_WB = step.scene.BodiesBetween(s);
    CameraFrame frame =
        camera_.Measure(k, step.LinkAt(link_, s) * X_BT_, scene, step.scene.rasterizer());
    slots_.Apply(k, times, &frame);
    output_.sink->Write(output_.channel, std::move(frame));
  }

  Camera camera_;
  FrameSlots slots_;
  int link_ = 0;
  Pose X_BT_;  ///< where it truly sits
  SensorOutput output_;
};

std::vector<Mechanism> CameraMechanisms() {
  using enum Slot;
  const std::vector<EffectTarget> camera = {EffectTarget::kCamera};
  return {
      {"range_bias", kSensorStatic, camera, {{"depth_m", "m", -5, 5, {}}}},
      {"scale", kSensorStatic, camera, {{"depth_factor", "1", 0.5, 2, {}}}},
      {"quantisation", kSensorStatic, camera, {{"depth_step_m", "m", 0, 1, 0.01}}},
      {"outliers", kSensorStatic, camera,
       Joined({ProbabilityParameter(), {{"depth_m", "m", 0, 100, 1}}})},
  };
}

void CheckCameraEffects(const ConfigMap& effects, const MachineModel&,
                        const SensorDescription& camera, const SensorList&) {
  if (std::get<CameraModel>(camera.model).depth) return;
  for (const Effect& effect : camera.effects) {
    if (effect.mechanism->slot != Slot::kSensorStatic) continue;
    effects.Map(camera.name)
        .Fault(effect.mechanism->id,
               "changes depth, which this camera does not give; need depth: true");
  }
}

/// A shutter is shut again before the next picture.
void CheckExposure(const ConfigMap& config, const CameraModel& model, double rate_hz) {
  if (!model.image_sensor || !(rate_hz > 0)) return;
  if (model.image_sensor->exposure_s <= 1 / rate_hz) return;
  config.Map("image_sensor")
      .Fault("exposure_s",
             fmt::format("{} s at {} Hz: longer than from picture to picture; need at "
                         "most {} s",
                         model.image_sensor->exposure_s, rate_hz, 1 / rate_hz));
}

/// Points where the pixels of the recorded depth picture look. An odd number of pixels from one
/// that is taken to the next, so that all columns come.
LoadedScan DepthPoints(const SensorDescription& sensor, const Measurement& recorded,
                       std::size_t most) {
  const auto& model = std::get<CameraModel>(sensor.model);
  const auto& frame = std::get<CameraFrame>(recorded);
  const Image<float>& depth_m = frame.depth_m;
  const CameraIntrinsics& lens = model.intrinsics;
  LoadedScan loaded{{frame.t_ns, {}}, ""};
  if (depth_m.width_px != lens.width_px || depth_m.height_px != lens.height_px) {
    loaded.obstacle = fmt::format(
        "its depth picture {} is of {} x {} pixels, but the scenario's camera "
        "has {} x {}; need the camera that was recorded",
        frame.t_ns, depth_m.width_px, depth_m.height_px, lens.width_px, lens.height_px);
    return loaded;
  }
  const std::size_t pixels = depth_m.data.size();
  const Mat3 R_SC = OpticalInSensor().linear();
  const double noise_1pm = model.disparity_noise_px / (lens.fx_px * model.baseline_m);
  for (std::size_t i = 0; i < pixels; i += (pixels / most + 1) | 1) {
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

std::optional<Ranging> DepthRanging(const SensorDescription& sensor) {
  const auto& camera = std::get<CameraModel>(sensor.model);
  if (!camera.depth) return std::nullopt;
  return Ranging{.min_range_m = camera.depth_min_m,
                 .max_range_m = camera.depth_max_m,
                 .is_planar = true,
                 .points = DepthPoints};
}

}  // namespace

constinit const SensorKind kCameraKind = {
    .name = kCameraChannel,
    .target = EffectTarget::kCamera,
    .form = ChannelForm::kPictures,
    .read =
        [](const ConfigMap& config, SensorDescription* s) {
          s->model = ReadCameraModel(config);
          CheckExposure(config, std::get<CameraModel>(s->model), s->clock.rate_hz);
        },
    .model_yaml =
        [](const SensorDescription& s) { return CameraModelYaml(std::get<CameraModel>(s.model)); },
    .pictures = [](const SensorDescription& s) -> const PictureContent* {
      return &std::get<CameraModel>(s.model);
    },
    .ranging = DepthRanging,
    .view =
        [](const SensorDescription& s) {
          return ViewOf(std::get<CameraModel>(s.model), s.clock.rate_hz);
        },
    .sampler = [](const SensorPlace& place) -> std::unique_ptr<SensorSampler> {
      return std::make_unique<CameraSampler>(place);
    },
    .mechanisms = CameraMechanisms,
    .check_effects = CheckCameraEffects,
};

}  // namespace tera
