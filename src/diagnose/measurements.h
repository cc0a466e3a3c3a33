#pragma once

#include "diagnose/diagnosis_input.h"

namespace tera {

/// Least length of a recording, s: a shorter one has too few manoeuvres for validation.
inline constexpr double kShortestRecording_s = 20;

struct MeasurementOptions {
  double from_s = 0, to_s = 1e9;  ///< part of the recording, from its first sample on
  bool needs_any = true;          ///< whether missing or insufficient measurements are an error
};

/// The machine's checked measurements. Throws InputError.
Measurements MeasurementsOf(const DiagnosisInput& input, const Recording& recording,
                            const MeasurementOptions& options = {});

/// Poses for the base's replay: the measured ones, else those estimated from all sensors.
const std::vector<TruthPose>& BasePoses(const Measurements& measured);

}  // namespace tera
