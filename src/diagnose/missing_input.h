#pragma once

#include <string>
#include <vector>

#include "diagnose/replay/axis_log.h"

namespace tera {

/// A joint or running gear that moves while its lever rests, or against a lever that only moves to
/// one side.
struct MissingInput {
  std::string channel;        ///< "excavator1/encoders/boom_radps"
  std::string axis;           ///< "boom"
  double share = 0;           ///< share of the moving time
  bool is_one_sided = false;  ///< true if the recorded lever moves to one side only
};

/// Finds axes whose input is missing: the lever is not recorded, is recorded to one side only, or
/// another lever moves the axis. No mechanism between lever and rate explains this, but several
/// would fit it.
///
/// Model   An axis moves if its rate exceeds the noise and a fifth of its larger rates, overall or
///         under its lever. A lever rests if it has been neutral for longer than any delay and lag.
///         While it rests, the mean rate over the second before or after must exceed the same
///         limit, because shaking has no mean.
///         Input is missing if motion at rest takes at least two seconds and a fifth of the moving
///         time. Creep and coasting are slower or shorter. For a lever that only moves to one side,
///         all motion to the other side counts too. Motion at rest does not count if the simulation
///         moves in the same direction at that time. An example is a slew that turning tracks drag
///         along.
///
/// `simulated` is a simulation under the recorded levers, at the times of `log`'s measurements, or
/// null.
std::vector<MissingInput> FindMissingInput(const MachineModel& model, const AxisLog& log,
                                           const AxisLog* simulated = nullptr);

}  // namespace tera
