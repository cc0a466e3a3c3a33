#pragma once

#include <deque>
#include <string>
#include <vector>

#include "diagnose/search/block/block_diagnosis.h"
#include "diagnose/sensors/sensor_diagnosis.h"

namespace tera {

/// A sensor finding, and the channel whose error shows it best.
struct SensorFound {
  Finding finding;
  std::string channel, unit;
};

/// The diagnosis of a machine's inertial units, receivers, encoders and poses, as Findings.
/// Findings point into `candidates`; therefore the struct can be moved but not copied.
struct DiagnosedSensors {
  DiagnosedSensors() = default;
  DiagnosedSensors(DiagnosedSensors&&) = default;
  DiagnosedSensors& operator=(DiagnosedSensors&&) = default;

  SensorDiagnosis estimate;
  std::deque<Candidate> candidates;  ///< candidates of the findings and their rivals
  std::vector<SensorFound> findings, within_tolerance;
  /// Chosen mechanisms that gain too little to be the cause, and mechanisms beyond tolerance whose
  /// gain is not steady.
  std::vector<SensorFound> unconfirmed;
};

/// Converts the estimate of the sensors of machine `machine` to findings.
DiagnosedSensors DiagnosedOf(SensorDiagnosis estimate, const std::string& machine);

/// Adds a finding for each reversed axis that the scenario does not document.
void TellReversed(const std::vector<ReversedAxis>& reversed, DiagnosedSensors* sensors);

/// Adds a finding for each receiver with corrected stamps. Its clock offset is the correction plus
/// the remaining offset that the estimate found.
void TellOffset(const std::vector<OffsetReceiver>& offset, const std::string& machine,
                DiagnosedSensors* sensors);

/// True if the residual is at most twice the noise that its successive differences show. A larger
/// residual contains slow errors. Errors that change as fast as noise are not detected.
bool IsNoise(const ChannelError& channel);

/// True if the residual is noise, within the tolerance of a constant error, or below a fifth of an
/// inertial unit's motion. Such a residual points to no sensor fault.
bool IsExplained(const ChannelError& channel);

/// Removes the samples of units and receivers that the estimate explains or names as faulty.
Measurements WithoutExplained(const DiagnosisInput& input, const SensorDiagnosis& estimate,
                              Measurements measured);

/// Removes from the blocks of inertial units those mechanisms that the estimate covers. The
/// estimate judged them together with all sensors. A block alone compares its unit with measured
/// poses and encoders, and would take their noise for a filter or delay of the unit.
void RemoveEstimated(const DiagnosisInput& input, const SensorDiagnosis& estimate,
                     std::vector<ReplayBlock>* blocks);

}  // namespace tera
