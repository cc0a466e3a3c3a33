#pragma once

#include <cstddef>
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

/// Levers and measured motion of a machine's axes at even steps: the input to a replay of the
/// actuation chain. A lever is the input of a joint, track or wheel set, -1 to 1. Axes are the
/// joints, then the running gears, in the model's order.
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

/// Makes the log of a machine. Columns of `commands` are named by levers, encoder axes by joints
/// and running gears; other names are ignored. Throws InputError if commands and encoders have no
/// common time, or if no column belongs to the machine.
AxisLog MakeAxisLog(const MachineModel& model, const TableRecording& commands,
                    const std::vector<NamedEncoders>& encoders, double step_s);

}  // namespace tera
