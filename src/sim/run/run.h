#pragma once

#include <string>

#include "dataset/format/writer.h"
#include "sim/physics_motion.h"
#include "sim/rig.h"
#include "sim/run/pose_log.h"
#include "sim/run/truth_log.h"
#include "sim/scene_assembly.h"
#include "sim/simulation.h"

namespace tera {

/// What dataset.yaml says of a run of `scenario`. `resolved_yaml` is as Config::ResolvedYaml gives
/// it. Reads every input for its digest; throws InputError where one cannot be read.
DatasetInfo InfoOf(const Scenario& scenario, const std::string& resolved_yaml,
                   const SceneModel& scene);

/// A scenario under way: bodies and soil, what really happens to them, and what the sensors
/// measure of it, step by step into a sink.
class Run {
 public:
  /// Settles the machines and samples what is due at the start. Keeps references to all but `egl`.
  Run(const Scenario& scenario, Operators operators, const SceneAssembly& assembly,
      const EglOptions& egl, int threads, MeasurementSink* sink);

  void Step();
  /// Takes one step more, and of it writes only what belongs to its start: the state at the end,
  /// whose rates are the mean of those before and after it, the levers in force from there on,
  /// inertial samples, and pictures that are still being taken. So all that a run writes is the
  /// beginning of what a longer one does. No step may follow.
  void Finish();

  const Simulation& simulation() const { return simulation_; }
  const Rig& rig() const { return rig_; }

 private:
  Simulation simulation_;
  TruthLog truth_;
  PoseLog poses_;
  Rig rig_;
};

}  // namespace tera
