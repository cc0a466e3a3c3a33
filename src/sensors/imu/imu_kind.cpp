#include <fmt/format.h>

#include <algorithm>

#include "core/types/sample_rows.h"
#include "core/units.h"
#include "sensors/imu/imu_slots.h"
#include "sensors/sensor.h"
#include "sensors/slots/check_steps.h"
#include "sensors/slots/mechanism_rows.h"

// Inertial unit as a sensor kind.

namespace tera {
namespace {

class ImuSampler : public SensorSampler {
 public:
  explicit ImuSampler(const SensorPlace& place)
      : ImuSampler(place, TrueMounting(place.sensor, place.rig)) {}

  /// The first sample comes at the end of the first interval.
  void SampleStart(const SensedStep&) override {}

  void Sample(const SensedStep& step) override {
    const Vec3 gravity_W_mps2(0, 0, -kStandardGravity_mps2);
    samples_.clear();
    imu_.Advance(step.t0_ns, step.before.links[link_], step.t1_ns, step.after.links[link_],
                 gravity_W_mps2, &samples_);
    for (ImuSample& sample : samples_) {
      slots_.Apply(&sample);
      output_.sink->Write(output_.channel, RowOf(sample));
    }
  }

  /// Writes the samples of the last step, which wait for its successor.
  void Finish(const SensedStep& step) override { Sample(step); }

 private:
  ImuSampler(const SensorPlace& place, const Mounting& mount)
      : imu_(std::get<ImuModel>(place.sensor.model), mount.X_BT, place.sensor.clock,
             place.sensor.latency_ns, place.seed, place.folder),
        slots_(place.sensor.effects, place.seed, place.folder),
        link_(place.machine.LinkIndex(mount.link)),
        output_(place.output) {}

  Imu imu_;
  ImuSlots slots_;
  int link_;
  SensorOutput output_;
  std::vector<ImuSample> samples_;
};

std::vector<Mechanism> ImuMechanisms() {
  using enum Slot;
  const std::vector<EffectTarget> imu = {EffectTarget::kImu};
  std::vector<EffectParameter> flips = Alike(
      {"x", "y", "z", "gyro_x", "gyro_y", "gyro_z", "accel_x", "accel_y", "accel_z"}, "1", 0, 1, 0);
  for (EffectParameter& axis : flips) axis.whole = true;
  return {
      {"mount_rotation", kSensorGeometry, imu, TurnParameters()},
      {"axis_flip", kSensorGeometry, imu, flips},
      {"imu_lever_arm", kSensorGeometry, imu, ShiftParameters()},
      {"bias", kSensorStatic, imu,
       Joined({Alike({"gyro_x_degps", "gyro_y_degps", "gyro_z_degps"}, "deg/s", -100, 100, 0),
               Alike({"accel_x_mps2", "accel_y_mps2", "accel_z_mps2"}, "m/s^2", -20, 20, 0)})},
      {"scale", kSensorStatic, imu,
       Alike({"gyro_x_factor", "gyro_y_factor", "gyro_z_factor", "accel_x_factor", "accel_y_factor",
              "accel_z_factor"},
             "1", 0.5, 2, 1)},
      // Defaults: 2000 deg/s and 16 g in 16 bit, as in common chips.
      {"saturation",
       kSensorStatic,
       imu,
       {{"gyro_limit_degps", "deg/s", 1, 1e4, 2000},
        {"accel_limit_mps2", "m/s^2", 1, 1e4, 156.9064}}},
      {"quantisation",
       kSensorStatic,
       imu,
       {{"gyro_step_degps", "deg/s", 0, 10, 0.06103515625},
        {"accel_step_mps2", "m/s^2", 0, 10, 0.004788403}}},
      {"outliers", kSensorStatic, imu,
       Joined({ProbabilityParameter(),
               {{"gyro_degps", "deg/s", 0, 1e4, 50}, {"accel_mps2", "m/s^2", 0, 1e3, 20}}})},
      {"temperature_drift", kSensorStatic, imu,
       Joined({WarmUpParameters(),
               Alike({"gyro_x_degpspk", "gyro_y_degpspk", "gyro_z_degpspk"}, "deg/s/K", -1, 1, 0),
               Alike({"accel_x_mps2pk", "accel_y_mps2pk", "accel_z_mps2pk"}, "m/s^2/K", -0.1, 0.1,
                     0)})},
      {"vibration_rectification", kSensorStatic, imu,
       Joined({Alike({"x_s2pm", "y_s2pm", "z_s2pm"}, "s^2/m", -0.1, 0.1, 0),
               {{"engine_rms_mps2", "m/s^2", 0, 100, 3}, {"window_s", "s", 0.01, 60, 0.5}}})},
  };
}

/// True if a link can rotate: any link of a mobile machine, or a link beyond a rotary joint.
bool CanTurn(const MachineModel& model, int link) {
  if (!model.fixed_base) return true;
  for (; link > 0; link = model.joints[link - 1].parent) {
    const JointType type = model.joints[link - 1].type;
    if (type == JointType::kRevolute || type == JointType::kContinuous) return true;
  }
  return false;
}

constexpr StepAndLimit kSteps[] = {{"gyro_step_degps", "gyro_limit_degps"},
                                   {"accel_step_mps2", "accel_limit_mps2"}};

void CheckImuEffects(const ConfigMap& effects, const MachineModel& model,
                     const SensorDescription& imu, const SensorList&) {
  if (imu.effects.empty()) return;
  const ConfigMap config = effects.Map(imu.name);
  CheckSteps(config, imu.effects, kSteps);
  const Effect* flip = FindEffect(imu.effects, "axis_flip");
  const auto is_kept = [](double axis) { return axis == 0; };
  if (flip && std::all_of(flip->values.begin(), flip->values.end(), is_kept)) {
    config.Fault("axis_flip",
                 "flips no axis; need 1 for x, y or z, or for one of gyro_x to accel_z");
  }
  if (FindEffect(imu.effects, "imu_lever_arm") && !CanTurn(model, model.LinkIndex(imu.link))) {
    config.Fault(
        "imu_lever_arm",
        fmt::format("shows where a link turns, which '{}' cannot on its fixed base; need a "
                    "link that turns",
                    imu.link));
  }
}

}  // namespace

constinit const SensorKind kImuKind = {
    .name = kImuChannel,
    .target = EffectTarget::kImu,
    .read = ReadModelOf<ImuModel>,
    .model_yaml = YamlOfModel<ImuModel>,
    .columns = [](const SensorDescription&, const MachineModel&) { return ImuColumns(); },
    .sampler = [](const SensorPlace& place) -> std::unique_ptr<SensorSampler> {
      return std::make_unique<ImuSampler>(place);
    },
    .mechanisms = ImuMechanisms,
    .check_effects = CheckImuEffects,
};

}  // namespace tera
