#pragma once

#include <cstdint>
#include <string>

#include "core/types/effects.h"
#include "core/types/measurement.h"
#include "sensors/slots/low_pass.h"
#include "sensors/slots/report_clock.h"

namespace tera {

/// What lies between the measurement of a sensor's own model and the row it reports, for a kind
/// that has no effects but those of every kind of rows: the filter and the clock.
class RowSlots {
 public:
  RowSlots(const Effects& effects, std::uint64_t seed, const std::string& stream_name);
  void Apply(RowSample* row);

 private:
  bool ideal_;
  LowPass filter_;
  ReportClock clock_;
  std::int64_t next_ = 0;
};

}  // namespace tera
