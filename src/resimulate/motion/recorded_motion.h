#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dataset/format/recording.h"
#include "physics/description/machine.h"
#include "physics/description/machine_placement.h"

namespace tera {

/// Recorded motion of a machine.
///
/// Frames  W of the recorded poses; links as in MachineModel.
/// Model   base poses are interpolated linearly between rows. Joint and gear positions come from
///         encoders: a linear fit to the samples within 25 ms, so that sample noise does not become
///         speed. A joint without an encoder keeps the scenario's position. A machine on a fixed
///         base without recorded poses keeps its placement.
/// Omits   errors of the encoders and of the recorded poses.
class RecordedMotion {
 public:
  /// Reads the channels of the recording. `name` is the machine's name there.
  RecordedMotion(const MachinePlacement& placement, const std::string& name,
                 const Recording& recording);

  /// Explains why the machine's pose is unknown. Empty if it is known.
  const std::string& obstacle() const { return obstacle_; }
  /// Time of the first measurement.
  std::optional<TimeNs> first_ns() const;
  /// True if poses and encoders cover the time. A channel covers times within 0.3 s of a sample,
  /// and times between two samples that are at most three mean periods apart.
  bool IsKnownAt(TimeNs t_ns) const;
  /// True if each joint with a lever has an encoder. The pose of the whole machine is then known.
  bool shows_whole() const { return shows_whole_; }
  /// True if each joint with a lever between the base and this link has an encoder.
  bool Carries(int link) const;

  /// State in which only links, joints and gears are set.
  MachineState At(TimeNs t_ns) const;

 private:
  struct Axis {
    std::vector<TimeNs> t_ns;
    std::vector<double> position;
    double At(TimeNs t) const;
  };
  /// True if the joint has an encoder or no lever moves it.
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
