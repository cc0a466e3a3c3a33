#pragma once

#include <vector>

#include "diagnose/diagnosis_input.h"
#include "diagnose/sensors/path_lag.h"

namespace tera {

/// Lag of a receiver's fixes beside running gear and joints.
struct ReceiverLag {
  std::size_t sensor = 0;   ///< its place among the scenario's sensors
  PathLag lag;              ///< beyond the documented lag of its stamps
  double documented_s = 0;  ///< offset of its clock
  double near_s = 0;        ///< lags that are as expected, or that the estimate finds itself
};

/// The lag of each receiver with data to compare.
std::vector<ReceiverLag> ReceiverLags(const DiagnosisInput& input, const Measurements& measured);

/// The receivers whose stamps are late or early by more than the estimate of the motion finds.
///
/// Model   a receiver's stamps are wrong if its antenna follows running gear and joints
///         (AntennaPath) at another time (LagBehind). Recorded poses replace them where no gear was
///         read. The lag exceeds half a second and its tolerance with 95 %. It is better than any
///         other lag with p of 0.01 over all receivers. The fixes move by about as much as gear and
///         joints say.
/// Omits   early encoders or poses beside receivers that are all right; receivers without their
///         documented fix.
std::vector<OffsetReceiver> OffsetReceiversOf(const DiagnosisInput& input,
                                              const Measurements& measured);

/// Stamps the samples of these receivers as documented clocks would.
void StampAnew(const std::vector<OffsetReceiver>& offset, Measurements* measured);

}  // namespace tera
