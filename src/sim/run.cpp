#include "sim/run.h"

namespace tera {

DatasetInfo InfoOf(const Scenario& scenario, const std::string& resolved_yaml,
                   const SceneModel& scene) {
  DatasetInfo info;
  info.scenario_name = scenario.name;
  info.simulated = true;
  info.seed = scenario.seed;
  info.duration_s = scenario.duration_s;
  info.origin_lat_deg = scenario.origin.lat_deg;
  info.origin_lon_deg = scenario.origin.lon_deg;
  info.origin_height_m = scenario.origin.height_m;
  info.resolved_scenario_yaml = resolved_yaml;
  for (std::size_t i = 1; i < scene.instances.size(); ++i) {
    info.instances.push_back({static_cast<std::uint16_t>(i), scene.instances[i].name,
                              std::string(NameOf(scene.instances[i].label))});
  }
  return info;
}

Run::Run(Scenario* scenario, const SceneAssembly& assembly, const EglOptions& egl, int threads,
         MeasurementSink* sink)
    : simulation_(scenario),
      truth_(*scenario, sink),
      rig_(*scenario, assembly, egl, threads, sink) {
  rig_.SampleStart(simulation_);
}

void Run::Step() {
  simulation_.Step();
  truth_.Write(simulation_.previous(), simulation_.state());
  rig_.Sample(simulation_);
}

void Run::Finish() {
  truth_.Finish(simulation_.state());
  rig_.Finish();
}

}  // namespace tera
