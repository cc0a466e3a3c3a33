#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "diagnose/replay/axis_log.h"

namespace tera {

/// A recording in which nothing is wrong.
struct NullRecording {
  TableRecording commands;
  NamedEncoders encoders{"excavator1/encoders", {}};
};

/// config/machines/tb235.yaml, its arm stretched out in the air.
MachineModel RaisedTb235();

/// Boom, arm, bucket and slew of a machine under levers that `seed` makes up.
///
/// Model   the chain of actuation of `model` at 2 ms, where the replay steps 10 ms, positions
///         integrated. Nominal numbers are off, each by its own draw: rates of each joint by a
///         factor of 1 +- 3 % at most, masses of all links by one of 1 +- 3 % (normal, at most 6
///         %). Encoders at 100 Hz, stamps jittered by 0.3 ms; noise of the rates of 0.1 to 0.4
///         deg/s, autoregressive with a coefficient of 0, 0.5, 0.8 or 0.95, innovations of
///         Student's t with 3 to 12 degrees of freedom; positions to 0.02 deg; 2 % of samples lost
///         in bursts. Levers are steps, ramps and sines of 0.08 to 1, one to three joints at a
///         time, turned back before the end stops.
NullRecording SimulateNull(const MachineModel& model, double duration_s, std::uint64_t seed);

/// How a diagnosis of it came out.
struct NullOutcome {
  std::size_t judged = 0, blocks = 0;  ///< of the blocks, those with manoeuvres enough
  std::vector<std::string> alarms;     ///< what was found or left unexplained
  std::vector<std::string> unconfirmed;
};

NullOutcome DiagnoseNull(const MachineModel& model, double duration_s, std::uint64_t seed);

}  // namespace tera
