#include <fmt/format.h>

#include <chrono>
#include <deque>
#include <future>
#include <optional>
#include <utility>
#include <vector>

#include "render/gl/rasterizer_pool.h"
#include "sensors/camera/camera_view.h"
#include "sensors/sensor.h"
#include "sensors/slots/frame_slots.h"
#include "sensors/slots/mechanism_rows.h"

namespace tera {
namespace {

/// Takes each image at the end of the exposure of its last row, over the ground at that time.
///
/// Model   A rasterizer renders the image, and the sampler writes it. With concurrent rasterizers,
///         the write may happen in a later step. Images that need several instants are rendered
///         within their step.
class CameraSampler : public SensorSampler {
 public:
  explicit CameraSampler(const SensorPlace& place)
      : cameras_(1, Camera(std::get<CameraModel>(place.sensor.model), place.sensor.clock,
                           place.sensor.latency_ns, place.seed, place.folder)),
        slots_(place.sensor.effects, place.seed, place.folder),
        clock_(place.sensor.clock),
        output_(place.output) {
    const Mounting mount = TrueMounting(place.sensor, place.rig);
    link_ = place.machine.LinkIndex(mount.link);
    X_BT_ = mount.X_BT;
  }

  void Sample(const SensedStep& step) override {
    while (!ordered_.empty() && IsThere(ordered_.front())) WriteFirst();
    if (LooksBack()) X_WS_.Append(step.t1_ns, step.after.links[link_].X_WB * X_BT_);
    for (; clock_.Due(next_) + camera().Reach() <= step.t1_ns; ++next_) Take(step);
    if (LooksBack()) X_WS_.DropBefore(Opens_ns());
  }
  void Finish(const SensedStep&) override { WriteAllBut(0); }

  bool LooksBack() const override { return camera().Reach() > 0; }
  TimeNs SceneNeededSince(TimeNs now_ns) const override {
    return LooksBack() ? std::min(Opens_ns(), now_ns) : now_ns;
  }

 private:
  /// An image that is not yet written.
  struct Ordered {
    ReportClock::Times times;
    bool is_needed;
    KeptScene scene = {};                 ///< input of `frame`
    std::future<CameraFrame> frame = {};  ///< none if unused
  };

  const Camera& camera() const { return cameras_.front(); }
  /// Opening time of the shutter for the next image.
  TimeNs Opens_ns() const { return clock_.Due(next_) - camera().Reach(); }

  void Take(const SensedStep& step) {
    const ReportClock::Times times = slots_.Stamp(next_, clock_.Due(next_));
    Ordered picture{times,
                    output_.sink->NeedsFrame(output_.channel, times.t_ns, clock_.Due(next_ + 1))};
    if (picture.is_needed || camera().HasMemory()) Order(step, &picture);
    ordered_.push_back(std::move(picture));
    const bool is_late =
        first_rasterizer_ && step.scene.rasterizers()->work_beside() && !LooksBack();
    // leaves one image for each rasterizer in progress
    WriteAllBut(is_late ? cameras_.size() + 1 : 0);
  }

  /// A camera with memory uses a single rasterizer. Other cameras use the rasterizers in turn, with
  /// one Camera object for each.
  void Order(const SensedStep& step, Ordered* picture) {
    RasterizerPool& rasterizers = *step.scene.rasterizers();
    if (!first_rasterizer_) first_rasterizer_ = rasterizers.NextForACamera();
    if (!camera().HasMemory()) cameras_.resize(rasterizers.count(), camera());
    const std::size_t turn = static_cast<std::size_t>(next_) % cameras_.size();
    picture->scene = step.scene.Keep();
    picture->frame =
        rasterizers.Take((*first_rasterizer_ + turn) % rasterizers.count(),
                         [this, k = next_, &camera = cameras_[turn], times = picture->times,
                          scene_at = ScenesOf(step, picture->scene)](Rasterizer* rasterizer) {
                           CameraFrame frame = camera.Measure(k, scene_at, rasterizer);
                           slots_.Apply(k, times, &frame);
                           return frame;
                         });
  }

  /// Scenes for images of several instants are valid during the step, other scenes as long as
  /// `kept`.
  SceneAt ScenesOf(const SensedStep& step, const KeptScene& kept) const {
    SeenScene seen;
    seen.state.terrain = kept.ground.get();
    seen.state.shapes = kept.shapes;
    seen.state.dust = kept.dust.get();
    if (LooksBack()) {
      return [this, &step, seen](TimeNs t_ns) mutable {
        seen.state.t_ns = t_ns;
        seen.X_WC = X_WS_.At(t_ns) * OpticalInSensor();
        seen.state.X_WB = step.scene.BodiesAt(t_ns);
        return seen;
      };
    }
    seen.state.t_ns = clock_.Due(next_);
    const double s = step.FractionAt(seen.state.t_ns);
    seen.X_WC = step.LinkAt(link_, s) * X_BT_ * OpticalInSensor();
    seen.state.X_WB = step.scene.BodiesBetween(s);
    return [seen](TimeNs) { return seen; };
  }

  static bool IsThere(const Ordered& picture) {
    return !picture.frame.valid() ||
           picture.frame.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  }

  void WriteAllBut(std::size_t last) {
    while (ordered_.size() > last) WriteFirst();
  }

  /// Waits for the oldest image and writes it.
  void WriteFirst() {
    Ordered picture = std::move(ordered_.front());
    ordered_.pop_front();
    CameraFrame frame;
    if (picture.frame.valid()) frame = picture.frame.get();
    if (picture.is_needed) {
      output_.sink->Write(output_.channel, std::move(frame));
    } else {
      output_.sink->MarkPresent(output_.channel, picture.times.t_ns);
    }
  }

  std::vector<Camera> cameras_;  ///< identical; one for each rasterizer if the camera has no memory
  std::optional<std::size_t> first_rasterizer_;
  FrameSlots slots_;
  SampleClock clock_;
  int link_ = 0;
  Pose X_BT_;  ///< true mounting
  SensorOutput output_;
  PoseTrack X_WS_;  ///< used only for images of several instants
  std::int64_t next_ = 0;
  std::deque<Ordered> ordered_;
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

/// Reports exposure and read-out times longer than the image interval.
void CheckExposure(const ConfigMap& config, const CameraModel& model, double rate_hz) {
  if (!model.image_sensor || !(rate_hz > 0)) return;
  const ConfigMap sensor = config.Map("image_sensor");
  const auto check = [&](const ConfigMap& map, const char* key, double duration_s) {
    if (duration_s <= 1 / rate_hz) return;
    map.Fault(key, {FaultKind::kOutOfRange,
                    fmt::format("{} s at {} Hz: longer than from picture to picture; need at "
                                "most {} s",
                                duration_s, rate_hz, 1 / rate_hz)});
  };
  check(sensor, "exposure_s", model.image_sensor->exposure_s);
  if (const auto& loop = model.image_sensor->auto_exposure) {
    check(sensor.Map("auto_exposure"), "longest_s", loop->longest_s);
  }
  if (const auto& shutter = model.image_sensor->shutter) {
    check(sensor.Map("shutter"), "readout_s", shutter->readout_s);
  }
}

/// Points of the pixels of the recorded depth image. The odd stride samples all columns.
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
