#pragma once

#include <optional>

#include "app/diagnose_recording.h"
#include "dataset/format/recording.h"
#include "diagnose/diagnosis.h"

namespace tera {

/// Simulates the scenario as it is, under the recorded levers and without sensors, as long as the
/// recording lasts and ten minutes at most. None where the recording has no levers, or nothing of a
/// joint, a track or the base. Times count from the recording's own zero, or from its first sample
/// where that is later than a second.
std::optional<SimulatedCourse> SimulateAsItIs(const ScenarioOptions& scenario, std::size_t machine,
                                              const DiagnosisInput& input,
                                              const Measurements& measured);

/// Simulates it with what was found of joints, tracks and the base, and holds both against the
/// recording on the manoeuvres that the diagnosis kept back. `before`: as it is.
///
/// Model   no sensors: rates and poses are those of the simulation at the times of the
///         measurements, base motion over the same intervals as the block's. The first 120 s at
///         most. Path: along poses half a second apart.
/// Omits   inertial units, whose findings nothing here shows.
WholeSimulation SimulateWhole(const ScenarioOptions& scenario, std::size_t machine,
                              const DiagnosisInput& input, const Recording& recording,
                              const DiagnosisOptions& options, const Diagnosis& diagnosis,
                              const std::optional<SimulatedCourse>& before);

}  // namespace tera
