#pragma once

#include <string>
#include <vector>

#include "core/config/config.h"
#include "core/faults.h"
#include "sim/scenario/scenario.h"

// Scenarios as text, composed of parts, and their faults.

namespace tera {

constexpr const char* kSite = R"(
name: test
duration_s: 1
terrain: {size_m: [12, 12], cell_m: 0.1, soil: dirt}
)";

constexpr const char* kExcavator = R"(
machines:
  - name: excavator1
    machine: tera:config/machines/tb235.yaml
    operator: {type: idle}
)";

/// The excavator with `sensors`, "{name: a, ...}, {name: b, ...}".
inline std::string WithRig(const std::string& sensors) {
  return std::string(kSite) + kExcavator + "    rig: {sensors: [" + sensors + "]}\n";
}

/// The only machine of a site: a sliding trolley with a turning arm.
inline std::string Gantry(const std::string& name, const std::string& sensors) {
  return R"(
machines:
  - name: )" +
         name + R"(
    machine:
      kind: gantry
      fixed_base: true
      links:
        base: {mass_kg: 100, inertia_kgm2: [1, 1, 1]}
        trolley: {mass_kg: 10, inertia_kgm2: [1, 1, 1]}
        arm: {mass_kg: 5, com_m: [0.5, 0, 0], inertia_kgm2: [1, 1, 1]}
      joints:
        slide: {type: prismatic, parent: base, child: trolley, xyz_m: [0, 0, 2], axis: [1, 0, 0],
                limits_m: [0, 3], max_rate_mps: 1, max_effort_n: 500}
        turn: {type: revolute, parent: trolley, child: arm, axis: [0, -1, 0],
               limits_deg: [-90, 90], max_rate_degps: 30, max_effort_nm: 500}
      levers: [slide, turn]
    operator: {type: idle}
    rig: {sensors: [)" +
         sensors + "]}\n";
}

/// Faults of a scenario, if any.
inline std::vector<InputFault> ScenarioFaults(const std::string& yaml,
                                              const std::vector<std::string>& overrides = {}) {
  return FaultsIn([&] {
    const Config config = Config::FromText(yaml, "s.yaml", overrides);
    ReadScenario(config.root());
    config.Finish();
  });
}

}  // namespace tera
