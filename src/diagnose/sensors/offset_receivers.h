#pragma once

#include <vector>

#include "diagnose/diagnosis_input.h"
#include "diagnose/sensors/path_lag.h"

namespace tera {

/// The lag of a receiver's fixes behind running gear and joints.
struct ReceiverLag {
  std::size_t sensor = 0;   ///< index among the scenario's sensors
  PathLag lag;              ///< beyond the documented delay of its stamps
  double documented_s = 0;  ///< clock offset
  double near_s = 0;  ///< lags up to this are within tolerance, or found by the motion estimate
};

std::vector<ReceiverLag> ReceiverLags(const DiagnosisInput& input, const Measurements& measured);

/// Receivers whose stamps are off by more than the motion estimate can find.
///
/// Model   the fixes of the receiver match the path of its antenna from running gear and joints
///         (AntennaPath) at another time (LagBehind). Recorded poses replace running gear without
///         encoders. Three conditions hold. The lag exceeds 0.5 s and its tolerance with 95 %
///         confidence. It is better than any other lag, with p at most 0.01 over all receivers. The
///         fixes move 0.5 to 1.5 times as far as the path.
/// Omits   early encoders or poses while the receivers are right; receivers without their
///         documented fix.
std::vector<OffsetReceiver> OffsetReceiversOf(const DiagnosisInput& input,
                                              const Measurements& measured);

/// Shifts the samples' stamps by the found lag.
void StampAnew(const std::vector<OffsetReceiver>& offset, Measurements* measured);

}  // namespace tera
