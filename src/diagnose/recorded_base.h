#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnose/discrepancy/discrepancy_correction.h"
#include "diagnose/measurements.h"
#include "diagnose/replay/pose_times.h"
#include "diagnose/search/fit/replay_block.h"
#include "resimulate/motion/simulated_course.h"

namespace tera {

/// Times at which poses were measured, if their stamps may be times of arrival. Empty for simulated
/// poses.
std::optional<PoseTimes> ArrivalsOf(const Measurements& measured);

/// The block of the base, if all tracks or wheels have encoders and its motion is known. For a
/// machine with running gear and part of these measurements, `why_not` names the missing part.
std::optional<ReplayBlock> RecordedBase(const DiagnosisInput& input, const Measurements& measured,
                                        std::string* why_not);

/// Discrepancy of the base's replay from its simulation. `simulated` are the simulation's encoders.
/// Empty if recording and simulation have no common time.
std::optional<ReplayDiscrepancy> RecordedBaseDiscrepancy(
    const DiagnosisInput& input, const Measurements& measured,
    const std::vector<NamedEncoders>& simulated, const SimulatedCourse& course);

}  // namespace tera
