#pragma once

#include <string>
#include <vector>

#include "diagnose/replay/axis_log.h"

namespace tera {

/// A joint or gear that moves while its lever rests, or against a lever that has but one side.
struct MissingInput {
  std::string channel;        ///< "excavator1/encoders/boom_radps"
  std::string axis;           ///< "boom"
  double share = 0;           ///< of the time in which it moves
  bool is_one_sided = false;  ///< the recording has its lever to one side alone
};

/// The axes of which the recording lacks input: the lever was lost, recorded to one side alone, or
/// another one moves the axis. No mechanism between lever and rate explains that, though several
/// can be fitted to it.
///
/// Model   an axis moves where its rate exceeds a fifth of its larger rates, of all or of those
///         under its lever, and what its noise makes of it; where its lever rests, the mean over
///         the second before or after must do so as well, for what shakes goes nowhere. A lever
///         rests where it has been neutral longer than any delay and lag lasts. Input is missing
///         where that is more than a fifth of the time in which the axis moves, and two seconds at
///         least: creep and coasting are slower or shorter. Of a lever that was only ever pushed to
///         one side, all motion to the other counts. Motion at rest that the simulation under the
///         recorded levers has too, at the same time and to the same side, needs no other input: a
///         slew that is dragged along as the tracks turn below it.
///
/// `simulated` is that simulation at the times of `log`'s measurements, if there is one.
std::vector<MissingInput> FindMissingInput(const MachineModel& model, const AxisLog& log,
                                           const AxisLog* simulated = nullptr);

}  // namespace tera
