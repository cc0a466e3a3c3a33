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

/// Times at which poses were measured, if their stamps are times of arrival.
std::optional<PoseTimes> ArrivalsOf(const Measurements& measured);

/// The block of the base, if all tracks or wheels have encoders and its motion is known. Motion is
/// compared over `interval_s`. For a machine with running gear and part of these measurements,
/// `why_not` names the missing part.
std::optional<ReplayBlock> RecordedBase(const DiagnosisInput& input, const Measurements& measured,
                                        double interval_s, std::string* why_not);

/// Discrepancy of the base's replay from its simulation, whose encoders are `simulated`; empty if
/// the two have no time in common.
std::optional<ReplayDiscrepancy> RecordedBaseDiscrepancy(
    const DiagnosisInput& input, const Measurements& measured,
    const std::vector<NamedEncoders>& simulated, const SimulatedCourse& course, double interval_s);

}  // namespace tera
