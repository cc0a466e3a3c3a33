#include <fmt/format.h>

#include <utility>

#include "sensors/camera/camera_view.h"
#include "sensors/sensor.h"
#include "sensors/slots/frame_slots.h"
#include "sensors/slots/mechanism_rows.h"

// A camera on the shelf.

namespace tera {
namespace {

/// A picture is taken when its last row is complete, over the ground of then.
class CameraSampler : public SensorSampler {
 public:
  explicit CameraSampler(const SensorPlace& place)
      : camera_(std::get<CameraModel>(place.sensor.model), place.sensor.clock,
                place.sensor.latency_ns, place.seed, place.folder),
        slots_(place.sensor.effects, place.seed, place.folder),
        clock_(place.sensor.clock),
        output_(place.output) {
    const Mounting mount = TrueMounting(place.sensor, place.rig);
    link_ = place.machine.LinkIndex(mount.link);
    X_BT_ = mount.X_BT;
  }

  void Sample(const SensedStep& step) override {
    if (LooksBack()) X_WS_.Append(step.t1_ns, step.after.links[link_].X_WB * X_BT_);
    for (; clock_.Due(next_) + camera_.Reach() <= step.t1_ns; ++next_) Take(step);
    if (LooksBack()) X_WS_.DropBefore(Opens_ns());
  }

  bool LooksBack() const override { return camera_.Reach() > 0; }
  TimeNs SceneNeededSince(TimeNs now_ns) const override {
    return LooksBack() ? std::min(Opens_ns(), now_ns) : now_ns;
  }

 private:
  /// When the shutter opens for the next picture.
  TimeNs Opens_ns() const { return clock_.Due(next_) - camera_.Reach(); }

  SeenScene SceneAtTime(const SensedStep& step, TimeNs t_ns) const {
    SeenScene seen;
    seen.state.t_ns = t_ns;
    seen.state.terrain = &step.scene.ground();
    seen.state.shapes = step.scene.ShapesNow();
    seen.state.dust = step.scene.air().dust;
    if (LooksBack()) {
      seen.X_WC = X_WS_.At(t_ns) * OpticalInSensor();
      seen.state.X_WB = step.scene.BodiesAt(t_ns);
    } else {
      const double s = step.FractionAt(t_ns);
      seen.X_WC = step.LinkAt(link_, s) * X_BT_ * OpticalInSensor();
      seen.state.X_WB = step.scene.BodiesBetween(s);
    }
    return seen;
  }

  void Take(const SensedStep& step) {
    const ReportClock::Times times = slots_.Stamp(next_, clock_.Due(next_));
    const bool is_needed =
        output_.sink->NeedsFrame(output_.channel, times.t_ns, clock_.Due(next_ + 1));
    if (!is_needed) output_.sink->MarkPresent(output_.channel, times.t_ns);
    if (!is_needed && !camera_.HasMemory()) return;
    CameraFrame frame = camera_.Measure(
        next_, [&](TimeNs t_ns) { return SceneAtTime(step, t_ns); }, step.scene.rasterizer());
    if (!is_needed) return;
    slots_.Apply(next_, times, &frame);
    output_.sink->Write(output_.channel, std::move(frame));
  }

  Camera camera_;
  FrameSlots slots_;
  SampleClock clock_;
  int link_ = 0;
  Pose X_BT_;  ///< where it truly sits
  SensorOutput output_;
  PoseTrack X_WS_;  ///< of a camera that looks back
  std::int64_t next_ = 0;
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

/// A shutter is shut again before the next picture, and all rows are read.
void CheckExposure(const ConfigMap& config, const CameraModel& model, double rate_hz) {
  if (!model.image_sensor || !(rate_hz > 0)) return;
  const ConfigMap sensor = config.Map("image_sensor");
  const auto check = [&](const ConfigMap& map, const char* key, double duration_s) {
    if (duration_s <= 1 / rate_hz) return;
    map.Fault(key, fmt::format("{} s at {} Hz: longer than from picture to picture; need at "
                               "most {} s",
                               duration_s, rate_hz, 1 / rate_hz));
  };
  check(sensor, "exposure_s", model.image_sensor->exposure_s);
  if (const auto& loop = model.image_sensor->auto_exposure) {
    check(sensor.Map("auto_exposure"), "longest_s", loop->longest_s);
  }
  if (const auto& shutter = model.image_sensor->shutter) {
    check(sensor.Map("shutter"), "readout_s", shutter->readout_s);
  }
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
                 .is_planar = !camera.intrinsics.IsAngular(),
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
