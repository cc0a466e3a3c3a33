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

/// The times at which poses were measured, where they are stamped as they arrive.
std::optional<PoseTimes> ArrivalsOf(const Measurements& measured);

/// The block of the base, where all tracks or wheels have encoders and its motion is known. Motion
/// is compared over `interval_s`. Of a machine that has running gear and half of what that takes,
/// `why_not` says what is missing.
std::optional<ReplayBlock> RecordedBase(const DiagnosisInput& input, const Measurements& measured,
                                        double interval_s, std::string* why_not);

/// What the base's replay lacks of its simulation, whose encoders are `simulated`; none where the
/// two have no time in common.
std::optional<ReplayDiscrepancy> RecordedBaseDiscrepancy(
    const DiagnosisInput& input, const Measurements& measured,
    const std::vector<NamedEncoders>& simulated, const SimulatedCourse& course, double interval_s);

}  // namespace tera
