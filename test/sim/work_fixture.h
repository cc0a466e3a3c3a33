#pragma once

#include <string>
#include <vector>

#include "core/config/config.h"
#include "sim/simulation.h"

/// Machines that dig, load a truck and drive over a plank: every kind of change of a ground.

namespace tera {

/// An excavator digs and dumps into the bed of a truck that moves away. Another drives over a plank
/// on loose soil, with partly random levers.
inline Scenario WorkScenario(const std::vector<std::string>& overrides = {}) {
  const Config config = Config::FromText(R"(
name: work
seed: 11
duration_s: 60
settle_s: 0.4
terrain:
  size_m: [24, 16]
  cell_m: 0.1
  soil: loose
  relief: {amplitude_m: 0.1, wavelength_m: 5}
machines:
  - name: digger
    machine: tera:config/machines/tb235.yaml
    start: {xy_m: [-3, 1], yaw_deg: 25, joints_deg: {boom: 30, arm: -80, bucket: -60}}
    operator: {type: dig_cycle, dump_azimuth_deg: 60}
  - name: driver
    machine: tera:config/machines/tb235.yaml
    start: {xy_m: [1.5, -4], yaw_deg: 10, joints_deg: {boom: 50, arm: -120, blade: 25}}
    operator: {type: random_levers, amplitude: 0.8, longest_s: 1}
obstacles:
  - {name: truck, label: truck, mesh: tera:assets/rock.glb, xy_m: [-3.5, 5], yaw_deg: 20,
     bed: {xyz_m: [0, 0, 0.6], size_m: [2.5, 2], wall_m: 0.4},
     path: [{t_s: 2, xy_m: [-3.5, 5]}, {t_s: 9, xy_m: [-2, 5.5]}]}
  - {name: plank, label: structure, mesh: tera:assets/rock.glb, xy_m: [2, -4], yaw_deg: 12,
     collision: [{xyz_m: [0, 0, 0.04], size_m: [1.2, 4, 0.08]}]}
  - {name: cone, label: cone, mesh: tera:assets/cone.glb, xy_m: [3.2, -3.5], yaw_deg: 5,
     collision: [{xyz_m: [0, 0, 0.35], size_m: [0.3, 0.3, 0.7]}],
     dynamic: {mass_kg: 4, com_m: [0, 0, 0.15]}}
effects:
  digger: {base: {terrain_height: {x_m: 2, y_m: -2, radius_m: 1, edge_m: 1, height_m: 0.1}}}
)",
                                         "work.yaml", overrides);
  Scenario scenario = ReadScenario(config.root());
  config.Finish();
  return scenario;
}

/// Heights of all vertices.
inline std::vector<float> HeightsOf(const TerrainSurface& ground) {
  std::vector<float> heights_m;
  for (int j = 0; j < ground.ny; ++j) {
    for (int i = 0; i < ground.nx; ++i) heights_m.push_back(ground.height_m(i, j));
  }
  return heights_m;
}

}  // namespace tera
