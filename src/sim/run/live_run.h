#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dataset/format/measurement_sink.h"
#include "render/gl/rasterizer.h"
#include "sim/events/event_log.h"
#include "sim/operators/remote_operator.h"
#include "sim/scenario/scenario.h"
#include "sim/simulation.h"

namespace tera {

struct LiveOptions {
  int threads = 2;  ///< for rays and encoding
  EglOptions egl;
  /// Folder of the dataset to write, which must be new or empty.
  std::optional<std::filesystem::path> record;
};

/// A run that its caller advances step by step, with externally controlled machines. Measurements
/// go to sinks. Optionally the run is recorded as a dataset; `tera replay` reproduces it byte for
/// byte from its commands. A recording that was interrupted replays as far as its commands are on
/// disk, which excludes at most the last second.
///
/// Model   a machine obeys the scenario's operator until its first message (RemoteOperator). A
///         message takes effect at the next step. The run has no fixed end.
class LiveRun {
 public:
  /// Settles the machines and takes the samples at t = 0. The sinks must outlive the run. Throws
  /// InputError as Generate does.
  LiveRun(std::shared_ptr<const Scenario> scenario, const std::string& resolved_yaml,
          const LiveOptions& options, std::vector<MeasurementSink*> sinks);
  /// If Finish was not called, the recording stays incomplete.
  ~LiveRun();

  /// Sends a message, which must have no fault for this machine (FaultOf).
  void Command(std::size_t machine, const ControlMessage& message);
  /// Throws InputError if the recording cannot be written; the message names the part that is kept.
  /// Finish does the same.
  void Step();
  /// Completes the recording. No step may follow.
  void Finish();

  const Scenario& scenario() const;
  const Simulation& simulation() const;
  const EventLog& events() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tera
