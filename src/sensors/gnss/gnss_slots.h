#pragma once

#include <cstdint>
#include <string>

#include "core/types/effects.h"
#include "core/types/measurement.h"
#include "dataset/format/site_frame.h"
#include "sensors/gnss/gnss_errors.h"
#include "sensors/slots/low_pass.h"
#include "sensors/slots/report_clock.h"

namespace tera {

/// Errors between a receiver's model and its reported measurement (src/sensors/README.md).
class GnssSlots {
 public:
  GnssSlots(const Effects& effects, std::uint64_t seed, const std::string& stream_name);
  void Apply(const RaisedBoom& boom, const SiteFrame& site, GnssSample* sample);

 private:
  bool ideal_;
  GnssErrors errors_;
  LowPass filter_;
  ReportClock clock_;
  std::int64_t next_ = 0;
};

}  // namespace tera
