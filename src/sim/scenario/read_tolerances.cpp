#include "sim/scenario/read_tolerances.h"

#include <fmt/format.h>

#include "sim/scenario/effect_targets.h"

namespace tera {
namespace {

constexpr std::string_view kNeedOfScenario =
    "machines by their names, {MACHINE: {TARGET: {MECHANISM: {PARAMETER: HALF_WIDTH}}}}";
constexpr std::string_view kNeedOfMachine =
    "{TARGET: {MECHANISM: {PARAMETER: HALF_WIDTH}}}; a target is a joint, a track or wheel set, a "
    "pump, a sensor or base";

/// The mapping at `key`. Empty without that key.
std::optional<ConfigMap> MappingOf(std::string_view need, const ConfigMap& config,
                                   std::string_view key) {
  return IsMappingOf(need, config, key) ? config.OptionalMap(key) : std::nullopt;
}

void ReadMechanism(const ConfigMap& config, const std::string& target, const Mechanism& mechanism,
                   Tolerances* out) {
  for (std::size_t p = 0; p < mechanism.parameters.size(); ++p) {
    const EffectParameter& parameter = mechanism.parameters[p];
    const auto half_width =
        config.OptionalNumber(parameter.name, AtLeast(0, std::string(parameter.unit)));
    if (half_width) out->push_back({target, &mechanism, p, *half_width});
  }
}

}  // namespace

std::optional<ConfigMap> ReadScenarioTolerances(const ConfigMap& scenario) {
  return MappingOf(kNeedOfScenario, scenario, "tolerances");
}

Tolerances ReadMachineTolerances(const ConfigMap& machine,
                                 const std::optional<ConfigMap>& scenario_tolerances,
                                 const std::string& name, const MachineModel& model,
                                 const std::vector<SensorDescription>& sensors) {
  Tolerances tolerances;
  const bool overlaid =
      scenario_tolerances && IsMappingOf(kNeedOfMachine, *scenario_tolerances, name);
  const auto map = overlaid ? machine.OptionalMapUnder("tolerances", *scenario_tolerances, name)
                            : MappingOf(kNeedOfMachine, machine, "tolerances");
  if (!map) return tolerances;
  for (const NamedTarget& target : TargetsOf(model, sensors)) {
    const auto of_target = MappingOf(kNeedOfMachine, *map, target.name);
    if (!of_target) continue;
    for (const Mechanism& mechanism : target.library) {
      if (!mechanism.ActsOn(target.kind)) continue;
      const auto of_mechanism = MappingOf("{PARAMETER: HALF_WIDTH}", *of_target, mechanism.id);
      if (of_mechanism) ReadMechanism(*of_mechanism, target.name, mechanism, &tolerances);
    }
  }
  return tolerances;
}

}  // namespace tera
