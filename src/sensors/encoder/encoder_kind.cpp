#include <fmt/format.h>

#include "core/types/sample_rows.h"
#include "sensors/encoder/encoded_axes.h"
#include "sensors/encoder/encoder_slots.h"
#include "sensors/sensor.h"
#include "sensors/slots/check_steps.h"
#include "sensors/slots/mechanism_rows.h"

// Encoder set as a sensor kind.

namespace tera {
namespace {

std::vector<EncoderAxis> AxesOfSensor(const SensorDescription& sensor,
                                      const MachineModel& machine) {
  return NamesOf(AxesOf(std::get<EncoderModel>(sensor.model), machine), machine);
}

double Mix(double a, double b, double s) { return a + (b - a) * s; }

EncoderSlots SlotsOf(const SensorPlace& place) {
  std::vector<bool> linear;
  std::vector<std::string> names;
  std::vector<Effects> axis_effects;
  for (const EncoderAxis& axis : AxesOfSensor(place.sensor, place.machine)) {
    linear.push_back(axis.linear);
    names.push_back(axis.name);
    const auto own = place.sensor.axis_effects.find(axis.name);
    axis_effects.push_back(own == place.sensor.axis_effects.end() ? Effects{} : own->second);
  }
  return {place.sensor.effects, axis_effects, linear, names, place.seed, place.folder};
}

Encoder EncoderOf(const SensorPlace& place) {
  std::vector<bool> linear;
  for (const EncoderAxis& axis : AxesOfSensor(place.sensor, place.machine)) {
    linear.push_back(axis.linear);
  }
  return {std::get<EncoderModel>(place.sensor.model),
          place.sensor.clock,
          place.sensor.latency_ns,
          place.seed,
          place.folder,
          linear};
}

class EncoderSampler : public InstantSampler {
 public:
  explicit EncoderSampler(const SensorPlace& place)
      : InstantSampler(place.sensor.clock),
        encoder_(EncoderOf(place)),
        slots_(SlotsOf(place)),
        axes_(AxesOf(std::get<EncoderModel>(place.sensor.model), place.machine)),
        output_(place.output) {}

 private:
  void MeasureAt(std::int64_t k, TimeNs t_ns, const SensedStep& step) override {
    const MachineState &a = step.before, &b = step.after;
    const double s = step.FractionAt(t_ns);
    std::vector<double> q_rad, qd_radps;
    for (const int j : axes_.joints) {
      q_rad.push_back(Mix(a.q_rad[j], b.q_rad[j], s));
      qd_radps.push_back(Mix(a.qd_radps[j], b.qd_radps[j], s));
    }
    for (const int g : axes_.gears) {
      q_rad.push_back(Mix(a.gear_angle_rad[g], b.gear_angle_rad[g], s));
      qd_radps.push_back(Mix(a.gear_rate_radps[g], b.gear_rate_radps[g], s));
    }
    EncoderSample sample = encoder_.Measure(k, q_rad, qd_radps);
    slots_.Apply(&sample);
    output_.sink->Write(output_.channel, RowOf(sample));
  }

  Encoder encoder_;
  EncoderSlots slots_;
  EncodedAxes axes_;
  SensorOutput output_;
};

std::vector<Mechanism> EncoderMechanisms() {
  using enum Slot;
  const std::vector<EffectTarget> encoders = {EffectTarget::kEncoder, EffectTarget::kEncoderAxis};
  return {
      {"axis_flip", kSensorGeometry, encoders, {}},
      {"bias",
       kSensorStatic,
       encoders,
       {{"angle_deg", "deg", -360, 360, 0},
        {"rate_degps", "deg/s", -1e3, 1e3, 0},
        {"travel_m", "m", -10, 10, 0},
        {"speed_mps", "m/s", -10, 10, 0}}},
      {"scale", kSensorStatic, encoders, Alike({"position_factor", "rate_factor"}, "1", 0.5, 2, 1)},
      {"saturation",
       kSensorStatic,
       encoders,
       {{"angle_limit_deg", "deg", 0, 1e6, 1e6},
        {"rate_limit_degps", "deg/s", 0, 1e5, 1e5},
        {"travel_limit_m", "m", 0, 1e3, 1e3},
        {"speed_limit_mps", "m/s", 0, 1e3, 1e3}}},
      {"quantisation",
       kSensorStatic,
       encoders,
       {{"angle_step_deg", "deg", 0, 90, 0},
        {"rate_step_degps", "deg/s", 0, 90, 0},
        {"travel_step_m", "m", 0, 1, 0},
        {"speed_step_mps", "m/s", 0, 1, 0}}},
      {"outliers", kSensorStatic, encoders,
       Joined({ProbabilityParameter(),
               {{"angle_deg", "deg", 0, 360, 10}, {"travel_m", "m", 0, 10, 0.1}}})},
      {"temperature_drift", kSensorStatic, encoders,
       Joined({WarmUpParameters(),
               {{"angle_degpk", "deg/K", -1, 1, 0}, {"travel_mpk", "m/K", -0.01, 0.01, 0}}})},
  };
}

constexpr StepAndLimit kSteps[] = {{"angle_step_deg", "angle_limit_deg"},
                                   {"rate_step_degps", "rate_limit_degps"},
                                   {"travel_step_m", "travel_limit_m"},
                                   {"speed_step_mps", "speed_limit_mps"}};

struct Kinds {
  bool turning = false, sliding = false;
};

/// Reports parameters whose unit fits no axis. Default values pass, because a resolved document
/// contains them.
void CheckUnits(const ConfigMap& config, const Effects& effects, const Kinds& kinds) {
  for (const Effect& effect : effects) {
    const ConfigMap map = config.Map(effect.mechanism->id);
    for (const EffectParameter& parameter : effect.mechanism->parameters) {
      if (effect[parameter.name] == parameter.otherwise) continue;
      const std::string_view unit = parameter.unit;
      const bool of_angles = unit == "deg" || unit == "deg/s" || unit == "deg/K";
      const bool of_travel = unit == "m" || unit == "m/s" || unit == "m/K";
      if (of_angles && !kinds.turning) {
        map.Fault(parameter.name, fmt::format("is in {}, but no axis here turns; need the "
                                              "parameter in metres",
                                              unit));
      } else if (of_travel && !kinds.sliding) {
        map.Fault(parameter.name, fmt::format("is in {}, but no axis here slides; need the "
                                              "parameter in degrees",
                                              unit));
      }
    }
  }
}

void CheckEncoderEffects(const ConfigMap& effects, const MachineModel& model,
                         const SensorDescription& sensor, const SensorList&) {
  Kinds all;
  for (const EncoderAxis& axis : AxesOfSensor(sensor, model)) {
    (axis.linear ? all.sliding : all.turning) = true;
    const auto own = sensor.axis_effects.find(axis.name);
    if (own == sensor.axis_effects.end()) continue;
    CheckUnits(effects.Map(sensor.name + "/" + axis.name), own->second,
               {.turning = !axis.linear, .sliding = axis.linear});
    CheckSteps(effects.Map(sensor.name + "/" + axis.name),
               EffectsOfAxis(sensor.effects, own->second), kSteps);
  }
  if (sensor.effects.empty()) return;
  CheckUnits(effects.Map(sensor.name), sensor.effects, all);
  CheckSteps(effects.Map(sensor.name), sensor.effects, kSteps);
}

void CheckJointNames(const ConfigMap& config, const SensorDescription& sensor,
                     const MachineModel& model) {
  for (const std::string& name : AxesOf(std::get<EncoderModel>(sensor.model), model).unknown) {
    config.Fault("joints",
                 {FaultKind::kNoSuchName,
                  "machine '" + model.kind + "' has no joint, track or wheel '" + name + "'"});
  }
}

}  // namespace

constinit const SensorKind kEncoderKind = {
    .name = kEncoderChannel,
    .target = EffectTarget::kEncoder,
    .on_link = false,
    .read = ReadModelOf<EncoderModel>,
    .model_yaml = YamlOfModel<EncoderModel>,
    .columns = [](const SensorDescription& s,
                  const MachineModel& machine) { return EncoderColumns(AxesOfSensor(s, machine)); },
    .sampler = [](const SensorPlace& place) -> std::unique_ptr<SensorSampler> {
      return std::make_unique<EncoderSampler>(place);
    },
    .mechanisms = EncoderMechanisms,
    .check_effects = CheckEncoderEffects,
    .axes = AxesOfSensor,
    .axis_target = EffectTarget::kEncoderAxis,
    .check_names = CheckJointNames,
};

}  // namespace tera
