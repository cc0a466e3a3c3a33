#include "sim/run/run.h"

#include <algorithm>
#include <set>
#include <utility>

#include "core/config/portable_name.h"
#include "dataset/format/recorded_inputs.h"

namespace tera {
namespace {

/// Input files of the scenario and files that its meshes refer to, sorted by name.
std::vector<InputFile> InputsOf(const Scenario& scenario, const SceneModel& scene) {
  std::vector<InputFile> inputs = scenario.inputs;
  std::set<std::string> places;
  for (const InputFile& input : inputs) places.insert(PortableName(input.path));
  for (const Mesh& mesh : scene.meshes) {
    for (const std::filesystem::path& file : mesh.files) {
      const std::string name = PortableName(file);
      if (places.insert(name).second) inputs.push_back({name, file});
    }
  }
  std::sort(inputs.begin(), inputs.end(),
            [](const InputFile& a, const InputFile& b) { return a.name < b.name; });
  return inputs;
}

}  // namespace

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
  info.inputs = DigestsOf(InputsOf(scenario, scene));
  for (std::size_t i = 1; i < scene.instances.size(); ++i) {
    info.instances.push_back({static_cast<std::uint16_t>(i), scene.instances[i].name,
                              std::string(NameOf(scene.instances[i].label)),
                              scene.instances[i].parent});
  }
  return info;
}

Run::Run(const Scenario& scenario, Operators operators, const SceneAssembly& assembly,
         const EglOptions& egl, int threads, MeasurementSink* sink)
    : simulation_(scenario, std::move(operators)),
      truth_(scenario, sink),
      poses_(scenario, sink),
      task_(scenario, simulation_.ground(), sink),
      events_(scenario, simulation_.state()),
      rig_(scenario, assembly, egl, threads, sink) {
  poses_.WriteStart(simulation_.state());
  rig_.SampleStart(simulation_.state(), simulation_.ground());
}

void Run::Step() {
  simulation_.Step();
  truth_.Write(simulation_.previous(), simulation_.state());
  poses_.Write(simulation_.previous(), simulation_.state());
  task_.Write(simulation_.state().t_ns);
  events_.Observe(simulation_.last_step());
  rig_.Sample(simulation_.last_step());
}

void Run::WriteEvents(DatasetWriter* writer) const {
  writer->AddWholeText(EventsChannel(), EventsText(events_.All()));
}

void Run::Finish() {
  simulation_.Step();
  truth_.Write(simulation_.previous(), simulation_.state());
  rig_.Finish(simulation_.last_step());
}

}  // namespace tera
