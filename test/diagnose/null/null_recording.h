#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "diagnose/replay/axis_log.h"

namespace tera {

/// A recording without any discrepancy: the null hypothesis holds.
struct NullRecording {
  TableRecording commands;
  NamedEncoders encoders{"excavator1/encoders", {}};
};

/// config/machines/tb235.yaml with its arm stretched out in the air.
MachineModel RaisedTb235();

/// Boom, arm, bucket and slew of a machine under random levers with seed `seed`.
///
/// Model   the actuation chain of `model` at 2 ms, where the replay steps 10 ms, with integrated
///         positions. Nominal numbers are off, each by its own draw: rates of each joint by at most
///         3 %; masses of all links by a common factor, normal with 3 % and at most 6 %. Encoders
///         at 100 Hz, stamps jittered by 0.3 ms. Noise of the rates is 0.1 to 0.4 deg/s,
///         autoregressive with a coefficient of 0, 0.5, 0.8 or 0.95, and innovations of Student's t
///         with 3 to 12 degrees of freedom. Positions have noise of 0.02 deg. 2 % of samples are
///         lost in bursts. Levers are steps, ramps and sines of 0.08 to 1, on one to three joints
///         at a time, reversed before the end stops.
NullRecording SimulateNull(const MachineModel& model, double duration_s, std::uint64_t seed);

/// Result of diagnosing it.
struct NullOutcome {
  std::size_t judged = 0, blocks = 0;  ///< blocks with enough manoeuvres
  std::vector<std::string> alarms;     ///< findings and unexplained errors
  std::vector<std::string> unconfirmed;
};

NullOutcome DiagnoseNull(const MachineModel& model, double duration_s, std::uint64_t seed);

}  // namespace tera
