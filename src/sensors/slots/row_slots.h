#pragma once

#include <cstdint>
#include <string>

#include "core/types/effects.h"
#include "core/types/measurement.h"
#include "sensors/slots/low_pass.h"
#include "sensors/slots/report_clock.h"

namespace tera {

/// Errors between a sensor's model and its reported row, for a kind with only the common effects:
/// filter and clock.
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
