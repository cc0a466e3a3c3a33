#pragma once

#include "core/time.h"
#include "dataset/format/recording.h"
#include "resimulate/motion/simulated_course.h"
#include "sim/scenario/scenario.h"

namespace tera {

/// From when to when a scenario is simulated over a recording.
struct CourseSpan {
  TimeNs zero_ns = 0;  ///< when the simulation starts, in the recording
  double until_s = 0;  ///< after that
};

/// Simulates a scenario, without sensors, while one of its machines obeys recorded levers: how that
/// machine moves.
///
/// Model   Simulation. `levers` has a column for each lever, by its name; columns that the machine
///         has no lever for are left out, and values beyond full lever are full lever. Each row
///         holds until the next. Other machines obey the operators that the scenario gives them.
SimulatedCourse SimulateUnderLevers(const Scenario& scenario, std::size_t machine,
                                    const TableRecording& levers, const CourseSpan& span);

}  // namespace tera
