#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/config/config.h"
#include "core/time.h"

namespace tera {

/// The time scale of a clock.
enum class ClockScale {
  kUtc,     ///< Unix time: UTC without leap seconds
  kGps,     ///< GPS time, as a date: ahead of UTC by the leap seconds since 1980
  kUnknown  ///< unknown clock that counts from 1970
};

/// The epoch of a recording's time 0, exact to the nanosecond.
struct RecordingEpoch {
  TimeNs since_1970_ns = 0;  ///< by `clock`
  ClockScale clock = ClockScale::kUnknown;

  bool operator==(const RecordingEpoch&) const = default;
};

/// "UTC", "GPS time" or "a clock that is not known".
std::string_view TextOf(ClockScale clock);

/// The epoch as the line `epoch: {...}` of dataset.yaml.
std::string EpochYaml(const RecordingEpoch& epoch);

/// Reads the optional key `epoch` of dataset.yaml or of a mapping. A mapping's files may count from
/// 1970 themselves; there `since_1970_ns` defaults to 0. Faults go to `config`.
std::optional<RecordingEpoch> ReadEpoch(const ConfigMap& config, bool may_count_from_1970 = false);

/// GPS time minus UTC at a GPS time from 1999 on.
///
/// Source  IERS Bulletin C; the last leap second was at the end of 2016.
TimeNs GpsAheadOfUtc(TimeNs gps_ns);

/// The epoch in UTC. An unknown clock is taken for UTC.
TimeNs UtcOf(const RecordingEpoch& epoch);

/// Zero of `b` minus zero of `a`: in UTC if both clocks are known, else on one assumed clock.
TimeNs ZeroOfAfter(const RecordingEpoch& a, const RecordingEpoch& b);

}  // namespace tera
