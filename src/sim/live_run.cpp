#include "sim/live_run.h"

#include <utility>

#include "core/check.h"
#include "core/error.h"
#include "dataset/sink_group.h"
#include "dataset/writer.h"
#include "sim/run.h"

namespace tera {
namespace {

/// Puts a remote operator before each machine's own.
std::vector<RemoteOperator*> TakeOver(Scenario* scenario) {
  std::vector<RemoteOperator*> operators;
  for (ScenarioMachine& machine : scenario->machines) {
    auto remote = std::make_unique<RemoteOperator>(std::move(machine.driver));
    operators.push_back(remote.get());
    machine.driver = std::move(remote);
  }
  return operators;
}

std::unique_ptr<DatasetWriter> RecorderOf(const Scenario& scenario,
                                          const std::string& resolved_yaml, const SceneModel& scene,
                                          const LiveOptions& options) {
  if (!options.record) return nullptr;
  return std::make_unique<DatasetWriter>(*options.record, InfoOf(scenario, resolved_yaml, scene),
                                         WriterOptions{.threads = options.threads});
}

}  // namespace

struct LiveRun::Impl {
  Impl(Scenario given, const std::string& resolved_yaml, const LiveOptions& options,
       std::vector<MeasurementSink*> sinks)
      : scenario(std::move(given)),
        operators(TakeOver(&scenario)),
        assembly(scenario),
        recorder(RecorderOf(scenario, resolved_yaml, assembly.model(), options)),
        group(AllSinks(std::move(sinks))) {
    try {
      run = std::make_unique<Run>(&scenario, assembly, options.egl, options.threads, &group);
      if (recorder) WriteTerrain("truth/terrain/height_start.tif");
    } catch (const InputError&) {
      if (recorder) recorder->Discard();
      throw;
    }
  }

  std::vector<MeasurementSink*> AllSinks(std::vector<MeasurementSink*> sinks) {
    if (recorder) sinks.push_back(recorder.get());
    return sinks;
  }

  void WriteTerrain(const std::string& file) {
    scenario.soil->WriteGeoTiff(recorder->PathFor(file), scenario.origin);
  }

  Scenario scenario;
  std::vector<RemoteOperator*> operators;
  SceneAssembly assembly;
  std::unique_ptr<DatasetWriter> recorder;
  SinkGroup group;
  std::unique_ptr<Run> run;
};

LiveRun::LiveRun(Scenario scenario, const std::string& resolved_yaml, const LiveOptions& options,
                 std::vector<MeasurementSink*> sinks)
    : impl_(std::make_unique<Impl>(std::move(scenario), resolved_yaml, options, std::move(sinks))) {
}

LiveRun::~LiveRun() = default;

void LiveRun::Command(std::size_t machine, const ControlMessage& message) {
  TERA_CHECK(machine < impl_->operators.size(), machine);
  const auto fault = FaultOf(message, impl_->scenario.machines[machine].placement.model);
  TERA_CHECK(!fault, fault.value_or(""));
  impl_->operators[machine]->Receive(simulation().state().t_ns, message);
}

void LiveRun::Step() { impl_->run->Step(); }

void LiveRun::Finish() {
  impl_->run->Finish();
  if (!impl_->recorder) return;
  impl_->WriteTerrain("truth/terrain/height_end.tif");
  impl_->recorder->SetDuration(ToSeconds(simulation().state().t_ns));
  impl_->recorder->Finish();
}

const Scenario& LiveRun::scenario() const { return impl_->scenario; }

const Simulation& LiveRun::simulation() const { return impl_->run->simulation(); }

}  // namespace tera
