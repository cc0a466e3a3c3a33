#pragma once

#include "diagnose/diagnosis_input.h"

namespace tera {

/// A shorter recording leaves too few manoeuvres to which nothing is fitted.
inline constexpr double kShortestRecording_s = 20;

struct MeasurementOptions {
  double from_s = 0, to_s = 1e9;  ///< part of the recording to look at, from its first sample on
  bool needs_any = true;          ///< it is an error if nothing, or too little, was measured
};

/// The checked measurements of the machine. Throws InputError.
Measurements MeasurementsOf(const DiagnosisInput& input, const Recording& recording,
                            const MeasurementOptions& options = {});

/// The poses against which the base is replayed: the measured ones, else those by all sensors.
const std::vector<TruthPose>& BasePoses(const Measurements& measured);

}  // namespace tera
