#pragma once

#include "core/time.h"
#include "dataset/format/recording.h"
#include "resimulate/motion/simulated_course.h"
#include "sim/scenario/scenario.h"

namespace tera {

/// Time span of a simulation, relative to a recording.
struct CourseSpan {
  TimeNs zero_ns = 0;  ///< time in the recording at which the simulation starts
  double until_s = 0;  ///< duration after the start
};

/// Motion of one machine under recorded levers. It comes from a simulation of the scenario without
/// sensors.
///
/// Model   `levers` has a column for each lever, by name. Columns that name no lever are ignored.
///         Values are clipped to [-1, 1]. Each row holds until the next one. Other machines obey
///         the scenario's operators.
SimulatedCourse SimulateUnderLevers(const Scenario& scenario, std::size_t machine,
                                    const TableRecording& levers, const CourseSpan& span);

}  // namespace tera
