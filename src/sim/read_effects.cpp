#include "sim/read_effects.h"

#include <fmt/format.h>

#include <set>
#include <string>

#include "core/effects.h"
#include "physics/actuation_mechanisms.h"
#include "physics/ground_mechanisms.h"
#include "physics/slots/actuation.h"
#include "sensors/sensor_mechanisms.h"
#include "sim/rig.h"

namespace tera {
namespace {

constexpr std::string_view kBaseTarget = "base";

/// Reads target after target of one machine's effects; a name stands for one of them alone.
class TargetReader {
 public:
  explicit TargetReader(const ConfigMap& config) : config_(config) {}

  Effects Read(const std::string& name, EffectTarget target, std::span<const Mechanism> library) {
    const auto map = config_.OptionalMap(name);
    if (!map) return {};
    if (!read_.insert(name).second) {
      config_.Fault(name, "'" + name +
                              "' names two things of this machine (joint, track, pump or sensor); "
                              "rename one of them");
    }
    return ReadEffects(*map, target, library);
  }

 private:
  ConfigMap config_;
  std::set<std::string> read_;
};

EffectTarget TargetOf(const SensorDescription& sensor) {
  if (std::holds_alternative<ImuModel>(sensor.model)) return EffectTarget::kImu;
  if (std::holds_alternative<GnssModel>(sensor.model)) return EffectTarget::kGnss;
  if (std::holds_alternative<CameraModel>(sensor.model)) return EffectTarget::kCamera;
  if (std::holds_alternative<LidarModel>(sensor.model)) return EffectTarget::kLidar;
  return EffectTarget::kEncoder;
}

void ReadSensorEffects(const MachineModel& model, TargetReader* reader, SensorDescription* sensor) {
  sensor->effects = reader->Read(sensor->name, TargetOf(*sensor), SensorMechanisms());
  const auto* encoder = std::get_if<EncoderModel>(&sensor->model);
  if (!encoder) return;
  for (const EncoderAxis& axis : NamesOf(AxesOf(*encoder, model), model)) {
    Effects effects = reader->Read(sensor->name + "/" + axis.name, EffectTarget::kEncoderAxis,
                                   SensorMechanisms());
    if (!effects.empty()) sensor->axis_effects.emplace(axis.name, std::move(effects));
  }
}

/// Faults of effects that need another antenna or certain joints of the machine.
void CheckAntenna(const ConfigMap& config, const MachineModel& model,
                  const SensorDescription& antenna, const std::vector<SensorDescription>& sensors) {
  const SensorDescription* other = OtherAntenna(antenna, sensors);
  for (const std::string_view id : {"antenna_swap", "antenna_yaw"}) {
    if (FindEffect(antenna.effects, id) && !other) {
      config.Fault(id,
                   fmt::format("'{}' acts on a pair; need exactly two gnss on this machine", id));
    }
  }
  if (other && FindEffect(antenna.effects, "antenna_yaw")) {
    if (other->link != antenna.link) {
      config.Fault("antenna_yaw",
                   fmt::format("turns two antennas on one link, but '{}' is on '{}' "
                               "and '{}' on '{}'; need both on one link",
                               antenna.name, antenna.link, other->name, other->link));
    }
    if (FindEffect(other->effects, "antenna_yaw")) {
      config.Fault(
          "antenna_yaw",
          fmt::format("turns both antennas and stands at '{}' too; keep one", other->name));
    }
  }
  for (const char* joint : {kMultipathBoom, kMultipathSlew}) {
    if (FindEffect(antenna.effects, "multipath") && model.JointIndex(joint) < 0) {
      config.Fault("multipath", fmt::format("depends on the joints '{}' and '{}', but this machine "
                                            "has no '{}'; need both",
                                            kMultipathBoom, kMultipathSlew, joint));
    }
  }
}

}  // namespace

void ReadMachineEffects(const ConfigMap& machine, const std::optional<ConfigMap>& scenario_effects,
                        const std::string& name, MachineModel* model,
                        std::vector<SensorDescription>* sensors) {
  MachineEffects& effects = model->effects;
  effects.joints.resize(model->joints.size());
  effects.gears.resize(model->ground_tools.gears.size());
  effects.pumps.resize(model->pumps.size());
  const auto map = scenario_effects ? machine.OptionalMapUnder("effects", *scenario_effects, name)
                                    : machine.OptionalMap("effects");
  if (!map) return;
  TargetReader reader(*map);
  for (std::size_t j = 0; j < model->joints.size(); ++j) {
    if (model->joints[j].type == JointType::kFixed) continue;
    effects.joints[j] =
        reader.Read(model->joints[j].name, EffectTarget::kJoint, ActuationMechanisms());
    const std::string fault = FaultOfEffects(*model, j);
    if (!fault.empty()) map->Fault(model->joints[j].name, fault);
  }
  for (std::size_t g = 0; g < model->ground_tools.gears.size(); ++g) {
    effects.gears[g] =
        reader.Read(model->ground_tools.gears[g].name, EffectTarget::kGear, ActuationMechanisms());
  }
  for (std::size_t p = 0; p < model->pumps.size(); ++p) {
    effects.pumps[p] =
        reader.Read(model->pumps[p].name, EffectTarget::kPump, ActuationMechanisms());
  }
  if (!model->ground_tools.gears.empty()) {
    effects.base = reader.Read(std::string(kBaseTarget), EffectTarget::kBase, GroundMechanisms());
  }
  for (SensorDescription& sensor : *sensors) ReadSensorEffects(*model, &reader, &sensor);
  for (const SensorDescription& sensor : *sensors) {
    const bool gnss = std::holds_alternative<GnssModel>(sensor.model);
    if (gnss && !sensor.effects.empty()) {
      CheckAntenna(map->Map(sensor.name), *model, sensor, *sensors);
    }
  }
}

}  // namespace tera
