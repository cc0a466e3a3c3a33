#include "sim/scenario/read_effects.h"

#include <fmt/format.h>

#include <set>
#include <string>

#include "core/types/effects.h"
#include "physics/actuation/actuation_faults.h"
#include "physics/actuation/actuation_mechanisms.h"
#include "physics/actuation/learned_rate.h"
#include "physics/traction/ground_faults.h"
#include "physics/traction/ground_mechanisms.h"
#include "sensors/sensor_mechanisms.h"
#include "sim/scenario/effect_targets.h"

namespace tera {
namespace {

/// Reads the effects of a machine, target by target. Each name may denote only one target.
class TargetReader {
 public:
  explicit TargetReader(const ConfigMap& config) : config_(config) {}

  Effects Read(const std::string& name, EffectTarget target, std::span<const Mechanism> library) {
    if (!IsMappingOf("mechanisms, {MECHANISM: {PARAMETER: VALUE}}, or none to remove a mechanism",
                     config_, name)) {
      return {};
    }
    const auto map = config_.OptionalMap(name);
    if (!map) return {};
    if (!read_.insert(name).second) {
      config_.Fault(name, {FaultKind::kRepeated,
                           "'" + name +
                               "' names two things of this machine (joint, track, pump or sensor); "
                               "rename one of them"});
    }
    if (target != EffectTarget::kJoint && target != EffectTarget::kGear && map->Has("learned")) {
      map->Fault("learned", fmt::format("'learned' does not act on this target, {}; it acts on a "
                                        "joint, a track or a wheel set",
                                        target.name));
    }
    return ReadEffects(*map, target, library);
  }

  /// The learned effect of an axis.
  std::optional<LearnedEffect> ReadLearned(const std::string& name, const MachineModel& model,
                                           std::size_t axis) const {
    if (config_.IsText(name)) return std::nullopt;
    const auto map = config_.OptionalMap(name);
    return map ? ReadLearnedEffect(*map, LearnedVariablesOf(model, axis)) : std::nullopt;
  }

 private:
  ConfigMap config_;
  std::set<std::string> read_;
};

void ReadSensorEffects(const MachineModel& model, TargetReader* reader, SensorDescription* sensor) {
  const SensorKind& kind = KindOf(*sensor);
  sensor->effects = reader->Read(sensor->name, kind.target, SensorMechanisms());
  if (!kind.axes) return;
  for (const EncoderAxis& axis : kind.axes(*sensor, model)) {
    Effects effects =
        reader->Read(sensor->name + "/" + axis.name, kind.axis_target, SensorMechanisms());
    if (!effects.empty()) sensor->axis_effects.emplace(axis.name, std::move(effects));
  }
}

/// Reports effects that cannot apply to the target `name`.
void Report(const ConfigMap& effects, const std::string& name,
            const std::vector<EffectFault>& faults) {
  for (const EffectFault& fault : faults) {
    effects.Map(name).Fault(fault.mechanism,
                            fmt::format("'{}' {}", fault.mechanism, fault.finding));
  }
}

/// Reports all effects that would change nothing on their target.
void CheckEffects(const ConfigMap& effects, const MachineModel& model,
                  const std::vector<SensorDescription>& sensors) {
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    Report(effects, model.joints[j].name, FaultsOfJoint(model, j));
  }
  for (std::size_t g = 0; g < model.ground_tools.gears.size(); ++g) {
    Report(effects, model.ground_tools.gears[g].name, FaultsOfGear(model, g));
  }
  for (std::size_t p = 0; p < model.pumps.size(); ++p) {
    Report(effects, model.pumps[p].name, FaultsOfPump(model, p));
  }
  Report(effects, std::string(kBaseTarget), FaultsOfBase(model));
  for (const SensorDescription& sensor : sensors) {
    const SensorKind& kind = KindOf(sensor);
    if (kind.check_effects) kind.check_effects(effects, model, sensor, sensors);
  }
}

}  // namespace

std::optional<ConfigMap> ReadScenarioEffects(const ConfigMap& scenario) {
  constexpr std::string_view kNeed =
      "machines by their names, {MACHINE: {TARGET: {MECHANISM: {PARAMETER: VALUE}}}}";
  if (!IsMappingOf(kNeed, scenario, "effects")) return std::nullopt;
  return scenario.OptionalMap("effects");
}

void ReadMachineEffects(const ConfigMap& machine, const std::optional<ConfigMap>& scenario_effects,
                        const std::string& name, bool sound, MachineModel* model,
                        std::vector<SensorDescription>* sensors) {
  MachineEffects& effects = model->effects;
  effects.joints.resize(model->joints.size());
  effects.gears.resize(model->ground_tools.gears.size());
  effects.pumps.resize(model->pumps.size());
  effects.learned.resize(model->joints.size() + model->ground_tools.gears.size());
  constexpr std::string_view kNeed =
      "the targets of its effects, {TARGET: {MECHANISM: {PARAMETER: VALUE}}}; a target is a joint, "
      "a track or wheel set, a pump, a sensor or base";
  const bool overlaid = scenario_effects && IsMappingOf(kNeed, *scenario_effects, name);
  const auto map = overlaid ? machine.OptionalMapUnder("effects", *scenario_effects, name)
                            : machine.OptionalMap("effects");
  if (!map) return;
  TargetReader reader(*map);
  for (std::size_t j = 0; j < model->joints.size(); ++j) {
    if (model->joints[j].type == JointType::kFixed) continue;
    effects.joints[j] =
        reader.Read(model->joints[j].name, EffectTarget::kJoint, ActuationMechanisms());
    effects.learned[j] = reader.ReadLearned(model->joints[j].name, *model, j);
  }
  for (std::size_t g = 0; g < model->ground_tools.gears.size(); ++g) {
    effects.gears[g] =
        reader.Read(model->ground_tools.gears[g].name, EffectTarget::kGear, ActuationMechanisms());
    effects.learned[model->joints.size() + g] =
        reader.ReadLearned(model->ground_tools.gears[g].name, *model, model->joints.size() + g);
  }
  for (std::size_t p = 0; p < model->pumps.size(); ++p) {
    effects.pumps[p] =
        reader.Read(model->pumps[p].name, EffectTarget::kPump, ActuationMechanisms());
  }
  if (!model->ground_tools.gears.empty()) {
    effects.base = reader.Read(std::string(kBaseTarget), EffectTarget::kBase, GroundMechanisms());
  }
  for (SensorDescription& sensor : *sensors) ReadSensorEffects(*model, &reader, &sensor);
  if (sound) CheckEffects(*map, *model, *sensors);
}

}  // namespace tera
