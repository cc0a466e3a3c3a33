#pragma once

#include <string>
#include <vector>

#include "diagnose/replay/axis_log.h"

namespace tera {

/// A joint or gear that moves while its lever rests, or opposite to a lever that only ever moves to
/// one side.
struct MissingInput {
  std::string channel;        ///< "excavator1/encoders/boom_radps"
  std::string axis;           ///< "boom"
  double share = 0;           ///< of the time in which it moves
  bool is_one_sided = false;  ///< its recorded lever moves to one side only
};

/// Axes with missing input: the lever is lost, recorded to one side only, or another lever moves
/// the axis. No mechanism between lever and rate explains that, but several can be fitted to it.
///
/// Model   an axis moves if its rate exceeds the noise and a fifth of its larger rates, overall or
///         under its lever. While the lever rests, the mean over the second before or after must
///         exceed that too, since shaking has no mean. A lever rests once it has been neutral for
///         longer than any delay and lag. Input is missing if motion at rest takes at least two
///         seconds and a fifth of the moving time: creep and coasting are slower or shorter. If a
///         lever only ever moves to one side, all motion towards the other side counts too. Motion
///         that the simulation under the recorded levers has at the same time and in the same
///         direction does not count. An example is a slew dragged along by turning tracks.
///
/// `simulated` is that simulation at the times of `log`'s measurements, or null.
std::vector<MissingInput> FindMissingInput(const MachineModel& model, const AxisLog& log,
                                           const AxisLog* simulated = nullptr);

}  // namespace tera
