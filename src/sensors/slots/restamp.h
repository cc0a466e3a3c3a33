#pragma once

#include "sensors/slots/report_clock.h"

namespace tera {

/// Gives a sample the times that its sensor writes.
template <typename Sample>
void Restamp(const ReportClock::Times& times, Sample* sample) {
  sample->t_ns = times.t_ns;
  sample->t_available_ns += times.late_ns;
}

}  // namespace tera
