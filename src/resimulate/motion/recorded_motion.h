#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dataset/format/recording.h"
#include "physics/description/machine.h"
#include "physics/description/machine_placement.h"

namespace tera {

/// Recorded motion of a scenario's machine.
///
/// Frames  W of the recording's poses; links as in MachineModel.
/// Model   base poses are linear between rows. Encoders supply joint and gear positions, as a local
///         linear fit to the samples within 25 ms, so that sample noise does not become speed. A
///         joint without encoder keeps the scenario's position. A machine on a fixed base without
///         poses keeps its placement.
/// Omits   errors of encoders and poses themselves.
class RecordedMotion {
 public:
  /// `name` is the machine's name in the recording. The constructor reads the recording's channels.
  RecordedMotion(const MachinePlacement& placement, const std::string& name,
                 const Recording& recording);

  /// Reason for an unknown machine pose; empty if it is known.
  const std::string& obstacle() const { return obstacle_; }
  /// Time of the first measurement.
  std::optional<TimeNs> first_ns() const;
  /// True if poses and encoders cover the time. Cover means within 0.3 s of a sample, or between
  /// two samples at most three mean periods apart.
  bool IsKnownAt(TimeNs t_ns) const;
  /// True if every lever-driven joint has an encoder, so that the whole machine's pose is known.
  bool shows_whole() const { return shows_whole_; }
  /// True if every such joint between base and link has an encoder.
  bool Carries(int link) const;

  /// State with only links, joints and gears filled.
  MachineState At(TimeNs t_ns) const;

 private:
  struct Axis {
    std::vector<TimeNs> t_ns;
    std::vector<double> position;
    double At(TimeNs t) const;
  };
  /// True if a joint's motion is known, or if no lever moves it.
  bool IsShown(std::size_t joint) const;
  static std::optional<Axis> AxisNamed(const std::string& axis, const std::string& machine,
                                       const Recording& recording);

  const MachinePlacement& placement_;
  std::vector<TruthPose> poses_;
  std::vector<std::optional<Axis>> joints_, gears_;
  std::string obstacle_;
  bool shows_whole_ = true;
};

}  // namespace tera
