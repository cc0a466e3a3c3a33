#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dataset/format/recording.h"
#include "physics/description/machine.h"
#include "physics/description/machine_placement.h"

namespace tera {

/// How a machine of a scenario moved, as a recording has it.
///
/// Frames  W of the recording's poses; links as in MachineModel.
/// Model   poses of the base straight between rows; positions of joints and gears by their
///         encoders, each the mean of a straight line over the samples within 25 ms, so that noise
///         of single samples does not become speed. A joint without encoder stays as the scenario
///         has it. A machine on a fixed base, without poses, stays where it was placed.
/// Omits   errors of encoders and poses themselves.
class RecordedMotion {
 public:
  /// `name`: the machine's in the recording. Channels of the recording are read.
  RecordedMotion(const MachinePlacement& placement, const std::string& name,
                 const Recording& recording);

  /// Why it is not known where the machine was; empty where it is.
  const std::string& obstacle() const { return obstacle_; }
  /// Time of the first measurement.
  std::optional<TimeNs> first_ns() const;
  /// Whether poses and encoders cover the time: within 0.3 s of one of their samples, or between
  /// two that are at most three mean periods apart.
  bool IsKnownAt(TimeNs t_ns) const;
  /// Whether every joint that moves by a lever has an encoder: the machine looks as it did.
  bool shows_whole() const { return shows_whole_; }
  /// Whether every such joint between base and link has one.
  bool Carries(int link) const;

  /// Links, joints and gears; nothing else is filled.
  MachineState At(TimeNs t_ns) const;

 private:
  struct Axis {
    std::vector<TimeNs> t_ns;
    std::vector<double> position;
    double At(TimeNs t) const;
  };
  /// Whether it is known how a joint moved, or that no lever moved it.
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
