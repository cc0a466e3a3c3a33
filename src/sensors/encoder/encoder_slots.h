#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/types/effects.h"
#include "core/types/measurement.h"
#include "sensors/encoder/encoder_errors.h"
#include "sensors/slots/low_pass.h"
#include "sensors/slots/report_clock.h"

namespace tera {

/// Errors between an encoder set's model and its reported measurement (src/sensors/README.md).
class EncoderSlots {
 public:
  /// `axis_effects` holds the effects of each axis; it may be empty. `linear` marks the axes in
  /// metres.
  EncoderSlots(const Effects& effects, const std::vector<Effects>& axis_effects,
               const std::vector<bool>& linear, const std::vector<std::string>& axes,
               std::uint64_t seed, const std::string& stream_name);
  void Apply(EncoderSample* sample);

 private:
  bool ideal_;
  std::vector<AxisErrors> axes_;
  LowPass filter_;
  ReportClock clock_;
  std::int64_t next_ = 0;
};

}  // namespace tera
