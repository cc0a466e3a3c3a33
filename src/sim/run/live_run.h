#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dataset/format/measurement_sink.h"
#include "render/gl/rasterizer.h"
#include "sim/operators/remote_operator.h"
#include "sim/scenario/scenario.h"
#include "sim/simulation.h"

namespace tera {

struct LiveOptions {
  int threads = 2;  ///< for rays and for encoding
  EglOptions egl;
  std::optional<std::filesystem::path> record;  ///< the dataset to write, new or empty
};

/// A run that goes step by step as its caller says, its machines driven from outside, its
/// measurements sent to sinks and, if wanted, recorded as a dataset. `tera replay` gives the
/// recording again from its commands, byte by byte; one that was stopped, as far as its commands
/// came to the disk, which all but the last second have.
///
/// Model   every machine obeys its scenario's operator until its first message (RemoteOperator). A
///         message acts from the next step on. The run has no end of its own.
class LiveRun {
 public:
  /// Settles the machines and measures what is due at t = 0. The sinks must outlive the run. Throws
  /// InputError as Generate does.
  LiveRun(std::shared_ptr<const Scenario> scenario, const std::string& resolved_yaml,
          const LiveOptions& options, std::vector<MeasurementSink*> sinks);
  /// Without Finish, leaves an incomplete recording.
  ~LiveRun();

  /// `message` must be without fault for the machine (FaultOf).
  void Command(std::size_t machine, const ControlMessage& message);
  /// Throws InputError where the recording cannot be written, and says what is kept of it; so does
  /// Finish.
  void Step();
  /// Ends the recording. No step may follow.
  void Finish();

  const Scenario& scenario() const;
  const Simulation& simulation() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tera
