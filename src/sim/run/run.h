#pragma once

#include <string>

#include "dataset/format/writer.h"
#include "sim/events/event_log.h"
#include "sim/physics_motion.h"
#include "sim/rig.h"
#include "sim/run/pose_log.h"
#include "sim/run/task_log.h"
#include "sim/run/truth_log.h"
#include "sim/scene_assembly.h"
#include "sim/simulation.h"

namespace tera {

/// Contents of dataset.yaml for a run of `scenario`. `resolved_yaml` comes from
/// Config::ResolvedYaml. Reads all input files for their digests; throws InputError if one is
/// unreadable.
DatasetInfo InfoOf(const Scenario& scenario, const std::string& resolved_yaml,
                   const SceneModel& scene);

/// A running scenario: bodies, soil, truth and sensors. Each step writes its data to a sink.
class Run {
 public:
  /// Settles the machines and takes the samples at the start. Keeps references to all arguments
  /// except `egl`.
  Run(const Scenario& scenario, Operators operators, const SceneAssembly& assembly,
      const EglOptions& egl, int threads, MeasurementSink* sink);

  void Step();
  /// Writes the events until now as a channel of the recording. Call before Finish.
  void WriteEvents(DatasetWriter* writer) const;
  /// Takes one more step but writes only the data at its start: the final state, the levers in
  /// force, inertial samples, and unfinished pictures. The final state's rates average those before
  /// and after it. A run's output is thus a prefix of a longer run's. No step may follow.
  void Finish();

  const Simulation& simulation() const { return simulation_; }
  const Rig& rig() const { return rig_; }
  const TaskLog& task() const { return task_; }
  const EventLog& events() const { return events_; }

 private:
  Simulation simulation_;
  TruthLog truth_;
  PoseLog poses_;
  TaskLog task_;
  EventLog events_;
  Rig rig_;
};

}  // namespace tera
