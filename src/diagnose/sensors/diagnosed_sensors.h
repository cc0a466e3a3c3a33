#pragma once

#include <deque>
#include <string>
#include <vector>

#include "diagnose/search/block/block_diagnosis.h"
#include "diagnose/sensors/sensor_diagnosis.h"

namespace tera {

/// A finding of a sensor, and the channel in which it shows most.
struct SensorFound {
  Finding finding;
  std::string channel, unit;
};

/// The diagnosis of a machine's units, receivers, encoders and poses, with its findings in the form
/// of all others. They point into its candidates: it is moved, not copied.
struct DiagnosedSensors {
  DiagnosedSensors() = default;
  DiagnosedSensors(DiagnosedSensors&&) = default;
  DiagnosedSensors& operator=(DiagnosedSensors&&) = default;

  SensorDiagnosis estimate;
  std::deque<Candidate> candidates;  ///< of the findings and of their rivals
  std::vector<SensorFound> findings, within_tolerance;
  /// Mechanisms that were chosen and remove too little of the error to be its cause. Unconfirmed
  /// ones also include those beyond tolerance without a steady gain.
  std::vector<SensorFound> unconfirmed;
};

/// The findings of a diagnosis of sensors of the machine `machine` of the recording.
DiagnosedSensors DiagnosedOf(SensorDiagnosis estimate, const std::string& machine);

/// Adds the axes that counted backwards, as findings, but those of which the scenario says so.
void AddReversed(const std::vector<ReversedAxis>& reversed, DiagnosedSensors* sensors);

/// Adds the receivers whose samples were stamped anew, as findings: the offsets of their clocks,
/// including the rest that the estimate finds.
void AddOffsetReceivers(const std::vector<OffsetReceiver>& offset, const std::string& machine,
                        DiagnosedSensors* sensors);

/// Whether a channel's residual is no louder than twice its differences from one sample to the
/// next: lasting error would be. Error that changes as fast as noise is not seen.
bool IsNoise(const ChannelError& channel);

/// Whether a channel's residual is noise, within the tolerance of a constant error, or below a
/// fifth of a unit's motion: no sensor is wrong for it.
bool IsExplained(const ChannelError& channel);

/// The measurements without those of units and receivers that the estimate explains, or whose fault
/// it names.
Measurements WithoutExplained(const DiagnosisInput& input, const SensorDiagnosis& estimate,
                              Measurements measured);

/// Leaves the blocks of inertial units only the mechanisms that the estimate does not have. The
/// others were judged beside all sensors at once. A unit over measured poses and encoders would
/// take their noise for a filter or a delay of its own.
void RemoveEstimated(const DiagnosisInput& input, const SensorDiagnosis& estimate,
                     std::vector<ReplayBlock>* blocks);

}  // namespace tera
