#pragma once

#include "core/time.h"
#include "dataset/format/recording.h"
#include "resimulate/motion/simulated_course.h"
#include "sim/scenario/scenario.h"

namespace tera {

/// Time span of a simulation over a recording.
struct CourseSpan {
  TimeNs zero_ns = 0;  ///< start of the simulation, in the recording
  double until_s = 0;  ///< duration after the start
};

/// Motion of one machine that obeys recorded levers, from a simulation of its scenario without
/// sensors.
///
/// Model   Simulation. `levers` has a column per lever, by name. Columns without a lever are
///         ignored, and values are clipped to full lever. Each row holds until the next. Other
///         machines obey the scenario's operators.
SimulatedCourse SimulateUnderLevers(const Scenario& scenario, std::size_t machine,
                                    const TableRecording& levers, const CourseSpan& span);

}  // namespace tera
