#pragma once

#include "diagnose/diagnosis_input.h"

namespace tera {

/// Least length of a recording in seconds. A shorter one has too few manoeuvres for validation.
inline constexpr double kShortestRecording_s = 20;

struct MeasurementOptions {
  double from_s = 0, to_s = 1e9;  ///< diagnosed part, in time since the recording's first sample
  bool needs_any = true;          ///< true: throw if measurements are missing or too short
};

/// Reads, checks and corrects the machine's measurements. Throws InputError.
Measurements MeasurementsOf(const DiagnosisInput& input, const Recording& recording,
                            const MeasurementOptions& options = {});

/// Poses for the base's replay: the recorded ones, or else those estimated from all sensors.
const std::vector<TruthPose>& BasePoses(const Measurements& measured);

}  // namespace tera
