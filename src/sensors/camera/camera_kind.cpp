#include <utility>

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
    scene.body_scale = step.scene.BodyScales();
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

}  // namespace

constinit const SensorKind kCameraKind = {
    .name = kCameraChannel,
    .target = EffectTarget::kCamera,
    .form = ChannelForm::kPictures,
    .read = [](const ConfigMap& config,
               SensorDescription* s) { s->model = ReadCameraModel(config); },
    .model_yaml =
        [](const SensorDescription& s) { return CameraModelYaml(std::get<CameraModel>(s.model)); },
    .sampler = [](const SensorPlace& place) -> std::unique_ptr<SensorSampler> {
      return std::make_unique<CameraSampler>(place);
    },
    .mechanisms = CameraMechanisms,
    .check_effects = CheckCameraEffects,
};

}  // namespace tera
