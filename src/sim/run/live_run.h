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
  int threads = 2;  ///< for rays and for encoding
  EglOptions egl;
  std::optional<std::filesystem::path> record;  ///< the dataset to write, new or empty
};

/// A run that its caller steps, with machines driven externally and measurements sent to sinks.
/// Optionally it records a dataset, which `tera replay` reproduces byte for byte from its commands.
/// A stopped recording replays as far as its commands are on disk; at most the last second is
/// missing.
///
/// Model   every machine obeys its scenario's operator until its first message (RemoteOperator). A
///         message acts from the next step on. The run has no fixed end.
class LiveRun {
 public:
  /// Settles the machines and samples at t = 0. The sinks must outlive the run. Throws InputError
  /// as Generate does.
  LiveRun(std::shared_ptr<const Scenario> scenario, const std::string& resolved_yaml,
          const LiveOptions& options, std::vector<MeasurementSink*> sinks);
  /// Leaves an incomplete recording if Finish was not called.
  ~LiveRun();

  /// `message` must have no fault for the machine (FaultOf).
  void Command(std::size_t machine, const ControlMessage& message);
  /// Throws InputError if the recording cannot be written, and names the part that is kept; so does
  /// Finish.
  void Step();
  /// Ends the recording. No step may follow.
  void Finish();

  const Scenario& scenario() const;
  const Simulation& simulation() const;
  const EventLog& events() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tera
