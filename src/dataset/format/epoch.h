#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/config/config.h"
#include "core/time.h"

namespace tera {

enum class ClockScale {
  kUtc,     ///< Unix time: UTC without leap seconds
  kGps,     ///< GPS time written as a date. It is ahead of UTC by the leap seconds since 1980.
  kUnknown  ///< counts from 1970 on an unknown time scale
};

/// Date and time at which a recording's t_ns is 0, exact to the nanosecond.
struct RecordingEpoch {
  TimeNs since_1970_ns = 0;  ///< nanoseconds since 1970-01-01 00:00:00 on `clock`
  ClockScale clock = ClockScale::kUnknown;

  bool operator==(const RecordingEpoch&) const = default;
};

/// "UTC", "GPS time" or "a clock that is not known".
std::string_view TextOf(ClockScale clock);

/// The epoch as the line `epoch: {...}` of dataset.yaml.
std::string EpochYaml(const RecordingEpoch& epoch);

/// Reads the optional key `epoch`. With `may_count_from_1970`, `since_1970_ns` may be absent and
/// then defaults to 0, because the times of the files may already count from 1970. Faults are
/// reported at `config`.
std::optional<RecordingEpoch> ReadEpoch(const ConfigMap& config, bool may_count_from_1970 = false);

/// GPS time minus UTC. Valid for GPS times from 1999 on.
///
/// Source  IERS Bulletin C; the last leap second was at the end of 2016.
TimeNs GpsAheadOfUtc(TimeNs gps_ns);

/// The epoch in UTC. A clock of unknown scale is assumed to be UTC.
TimeNs UtcOf(const RecordingEpoch& epoch);

/// Time 0 of `b` minus time 0 of `a`. The difference is in UTC if both time scales are known;
/// otherwise both clocks are assumed to have the same scale.
TimeNs ZeroOfAfter(const RecordingEpoch& a, const RecordingEpoch& b);

}  // namespace tera
