#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dataset/format/recording.h"
#include "physics/actuation/actuation.h"
#include "physics/description/machine.h"

namespace tera {

/// Rates of one joint or running gear, measured by an encoder.
struct MeasuredRate {
  std::string channel;  ///< "excavator1/encoders/boom_radps"
  std::size_t axis = 0;
  std::vector<TimeNs> t_ns;
  std::vector<double> at_step;  ///< times in steps of the log
  std::vector<double> rate_radps;
  /// False for samples at an end stop, unless the lever drives the joint away from it.
  std::vector<bool> is_free;
};

/// Step of the replay of axes, if encoders sample often enough.
inline constexpr double kReplayStep_s = 0.01;

/// Levers of one machine and the measured motion of its axes at even steps: input to the replay of
/// the actuation chain. Axes are joints, then gears, in the model's order.
///
/// Model   A command holds until the next one; before the first, levers are neutral. Levers are
///         means over each step. Positions and rates are linear between samples. Loads and inertias
///         are those of the links at the measured positions, on a level machine. An axis without an
///         encoder stays at its initial position and has no rate.
/// Omits   The ground's load on tools and tracks; a base that is not level.
struct AxisLog {
  TimeNs start_ns = 0;
  double step_s = 0;
  std::size_t steps = 0, axes = 0;
  std::vector<double> lever;       ///< steps x axes
  std::vector<AxisMotion> motion;  ///< steps x axes, at the start of each step
  /// Mass or inertia of the links beyond a joint, steps x axes. 0 for running gears and fixed
  /// joints.
  std::vector<double> inertia_kgm2;
  std::vector<MeasuredRate> measured;

  std::span<const double> levers_at(std::size_t step) const {
    return {lever.data() + step * axes, axes};
  }
  std::span<const double> inertias_at(std::size_t step) const {
    return {inertia_kgm2.data() + step * axes, axes};
  }
  std::span<const AxisMotion> motions_at(std::size_t step) const {
    return {motion.data() + step * axes, axes};
  }
};

struct NamedEncoders {
  std::string channel;
  EncoderRecording recording;
};

/// Position and rate of one joint or gear over time, as an encoder measured them.
struct AxisSamples {
  std::vector<TimeNs> t_ns;
  std::vector<double> position_rad, rate_radps;
};

AxisSamples SamplesOf(const EncoderRecording& recording, std::size_t axis);
/// Samples of the first encoder that measured the joint or gear of that name; may be empty.
std::optional<AxisSamples> SamplesOf(const std::string& axis,
                                     const std::vector<NamedEncoders>& encoders);

/// Linear interpolation at a time: the two neighbouring samples and the share of the way between
/// them. Outside the samples, the nearest one holds (a is b there).
struct BetweenSamples {
  std::size_t a = 0, b = 0;
  double s = 0;

  /// The times must ascend, with at least one.
  BetweenSamples(const std::vector<TimeNs>& t_ns, TimeNs at_ns);
  double Of(const std::vector<double>& values) const;
};

/// The axis that a lever moves.
std::size_t AxisOf(const MachineModel& model, const Lever& lever);

/// Log of a machine from its commands (columns named by levers) and encoders (axes named by joints
/// and gears; others are ignored). Throws InputError where commands and encoders have no time in
/// common or no column belongs to the machine.
AxisLog MakeAxisLog(const MachineModel& model, const TableRecording& commands,
                    const std::vector<NamedEncoders>& encoders, double step_s);

}  // namespace tera
