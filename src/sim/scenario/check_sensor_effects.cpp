#include "sim/scenario/check_sensor_effects.h"

#include <fmt/format.h>

#include <span>
#include <string_view>

#include "sensors/slots/encoder_errors.h"
#include "sim/gnss_reflector.h"
#include "sim/rig.h"

namespace tera {
namespace {

/// Faults of effects that need another antenna.
void CheckPair(const ConfigMap& config, const SensorDescription& antenna,
               const std::vector<SensorDescription>& sensors) {
  const SensorDescription* other = OtherAntenna(antenna, sensors);
  for (const std::string_view id : {"antenna_swap", "antenna_yaw"}) {
    if (!FindEffect(antenna.effects, id)) continue;
    if (!other) {
      config.Fault(id,
                   fmt::format("'{}' acts on a pair; need exactly two gnss on this machine", id));
    } else if (FindEffect(other->effects, id)) {
      config.Fault(
          id, fmt::format("acts on both antennas and stands at '{}' too; keep one", other->name));
    }
  }
  if (other && FindEffect(antenna.effects, "antenna_yaw") && other->link != antenna.link) {
    config.Fault("antenna_yaw", fmt::format("turns two antennas on one link, but '{}' is on '{}' "
                                            "and '{}' on '{}'; need both on one link",
                                            antenna.name, antenna.link, other->name, other->link));
  }
}

void CheckGnss(const ConfigMap& config, const MachineModel& model, const SensorDescription& gnss,
               const std::vector<SensorDescription>& sensors) {
  CheckPair(config, gnss, sensors);
  const int link = model.LinkIndex(gnss.link);
  if (FindEffect(gnss.effects, "multipath") && link >= 0 && !GnssReflectorOf(model, link)) {
    config.Fault(
        "multipath",
        fmt::format("comes from a part that a joint raises, a boom or a lift arm, but none "
                    "is beyond link '{}' or those below it; need such a joint",
                    gnss.link));
  }
  const GnssFix fix = std::get<GnssModel>(gnss.model).fix;
  for (const Effect& effect : gnss.effects) {
    const Mechanism& mechanism = *effect.mechanism;
    const bool of_time = mechanism.slot == Slot::kSensorTiming && mechanism.id != "filter_delay";
    if (fix == GnssFix::kNone && !of_time) {
      config.Fault(mechanism.id,
                   "changes positions, of which a receiver with fix: none gives "
                   "none; need another fix");
    } else if (fix != GnssFix::kRtkFixed && mechanism.id == "float_jump") {
      config.Fault("float_jump", fmt::format("loses a fixed solution, but this receiver has {}; "
                                             "need fix: rtk_fixed",
                                             NameOf(fix)));
    }
  }
}

void CheckCamera(const ConfigMap& config, const SensorDescription& camera) {
  if (std::get<CameraModel>(camera.model).depth) return;
  for (const Effect& effect : camera.effects) {
    if (effect.mechanism->slot != Slot::kSensorStatic) continue;
    config.Fault(effect.mechanism->id,
                 "changes depth, which this camera does not give; need depth: true");
  }
}

/// Whether a link can turn: on a machine that stands on the ground, or beyond a joint that turns.
bool CanTurn(const MachineModel& model, int link) {
  if (!model.fixed_base) return true;
  for (; link > 0; link = model.joints[link - 1].parent) {
    const JointType type = model.joints[link - 1].type;
    if (type == JointType::kRevolute || type == JointType::kContinuous) return true;
  }
  return false;
}

/// Of one quantity, the parameters of its quantisation and its saturation.
struct StepAndLimit {
  std::string_view step, limit;
};
constexpr StepAndLimit kOfImu[] = {{"gyro_step_degps", "gyro_limit_degps"},
                                   {"accel_step_mps2", "accel_limit_mps2"}};
constexpr StepAndLimit kOfEncoder[] = {{"angle_step_deg", "angle_limit_deg"},
                                       {"rate_step_degps", "rate_limit_degps"},
                                       {"travel_step_m", "travel_limit_m"},
                                       {"speed_step_mps", "speed_limit_mps"}};

/// Steps of quantisation beyond the limit of saturation: what is clipped would round to zero, or to
/// more than the limit. Reported at the one of both that `config` has.
void CheckSteps(const ConfigMap& config, const Effects& effects,
                std::span<const StepAndLimit> quantities) {
  const Effect* rounding = FindEffect(effects, "quantisation");
  const Effect* clipping = FindEffect(effects, "saturation");
  if (!rounding || !clipping) return;
  for (const auto& [step, limit] : quantities) {
    if ((*rounding)[step] <= (*clipping)[limit]) continue;
    config.Fault(
        config.Has("quantisation") ? "quantisation" : "saturation",
        fmt::format("{} {:g} of quantisation is beyond {} {:g} of saturation, which leaves "
                    "no value between; need a step of at most the limit",
                    step, (*rounding)[step], limit, (*clipping)[limit]));
  }
}

void CheckImu(const ConfigMap& config, const MachineModel& model, const SensorDescription& imu) {
  CheckSteps(config, imu.effects, kOfImu);
  const Effect* flip = FindEffect(imu.effects, "axis_flip");
  if (flip && (*flip)["x"] == 0 && (*flip)["y"] == 0 && (*flip)["z"] == 0) {
    config.Fault("axis_flip", "flips no axis; need 1 for x, y or z");
  }
  if (FindEffect(imu.effects, "imu_lever_arm") && !CanTurn(model, model.LinkIndex(imu.link))) {
    config.Fault(
        "imu_lever_arm",
        fmt::format("shows where a link turns, which '{}' cannot on its fixed base; need a "
                    "link that turns",
                    imu.link));
  }
}

/// What kinds of axes a set of encoders has.
struct Kinds {
  bool turning = false, sliding = false;
};

/// Numbers in units of an axis that is not there, but for defaults: a resolved document has them.
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

void CheckEncoder(const ConfigMap& effects, const MachineModel& model,
                  const SensorDescription& sensor) {
  Kinds all;
  for (const EncoderAxis& axis :
       NamesOf(AxesOf(std::get<EncoderModel>(sensor.model), model), model)) {
    (axis.linear ? all.sliding : all.turning) = true;
    const auto own = sensor.axis_effects.find(axis.name);
    if (own == sensor.axis_effects.end()) continue;
    CheckUnits(effects.Map(sensor.name + "/" + axis.name), own->second,
               {.turning = !axis.linear, .sliding = axis.linear});
    CheckSteps(effects.Map(sensor.name + "/" + axis.name),
               EffectsOfAxis(sensor.effects, own->second), kOfEncoder);
  }
  if (sensor.effects.empty()) return;
  CheckUnits(effects.Map(sensor.name), sensor.effects, all);
  CheckSteps(effects.Map(sensor.name), sensor.effects, kOfEncoder);
}

}  // namespace

void CheckSensorEffects(const ConfigMap& effects, const MachineModel& model,
                        const std::vector<SensorDescription>& sensors) {
  for (const SensorDescription& sensor : sensors) {
    if (std::holds_alternative<EncoderModel>(sensor.model)) {
      CheckEncoder(effects, model, sensor);
    } else if (sensor.effects.empty()) {
      continue;
    } else if (std::holds_alternative<GnssModel>(sensor.model)) {
      CheckGnss(effects.Map(sensor.name), model, sensor, sensors);
    } else if (std::holds_alternative<CameraModel>(sensor.model)) {
      CheckCamera(effects.Map(sensor.name), sensor);
    } else if (std::holds_alternative<ImuModel>(sensor.model)) {
      CheckImu(effects.Map(sensor.name), model, sensor);
    }
  }
}

}  // namespace tera
