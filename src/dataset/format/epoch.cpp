#include "dataset/format/epoch.h"

#include <fmt/format.h>

#include <charconv>
#include <chrono>

namespace tera {
namespace {

constexpr const char* kSince1970 = "since_1970_ns";
constexpr TimeNs kYear2100_ns = 4'102'444'800 * kNsPerSecond;

TimeNs ReadSince1970(const ConfigMap& epoch, bool may_lack) {
  const std::string text = may_lack ? epoch.Text(kSince1970, "0") : epoch.Text(kSince1970);
  TimeNs since_1970_ns = 0;
  const auto [stop, status] =
      std::from_chars(text.data(), text.data() + text.size(), since_1970_ns);
  if (status != std::errc() || stop != text.data() + text.size() || since_1970_ns < 0 ||
      since_1970_ns >= kYear2100_ns) {
    epoch.Fault(kSince1970, fmt::format("'{}' is not a time in whole nanoseconds from 1970 to "
                                        "2100; need one, for instance \"1700000000000000000\"",
                                        text));
    return 0;
  }
  return since_1970_ns;
}

}  // namespace

std::string_view TextOf(ClockScale clock) {
  if (clock == ClockScale::kUtc) return "UTC";
  return clock == ClockScale::kGps ? "GPS time" : "an unknown clock";
}

std::string EpochYaml(const RecordingEpoch& epoch) {
  const char* clock = epoch.clock == ClockScale::kUtc   ? "utc"
                      : epoch.clock == ClockScale::kGps ? "gps"
                                                        : "unknown";
  return fmt::format("epoch: {{{}: \"{}\", clock: {}}}\n", kSince1970, epoch.since_1970_ns, clock);
}

std::optional<RecordingEpoch> ReadEpoch(const ConfigMap& config, bool may_count_from_1970) {
  const auto map = config.OptionalMap("epoch");
  if (!map) return std::nullopt;
  const std::string clock = map->Choice("clock", {"utc", "gps", "unknown"}, "unknown");
  return RecordingEpoch{ReadSince1970(*map, may_count_from_1970), clock == "utc" ? ClockScale::kUtc
                                                                  : clock == "gps"
                                                                      ? ClockScale::kGps
                                                                      : ClockScale::kUnknown};
}

TimeNs GpsAheadOfUtc(TimeNs gps_ns) {
  struct Step {
    int year, month;
    TimeNs ahead_s;
  };
  TimeNs ahead_s = 13;
  for (const Step& step : {Step{2006, 1, 14}, Step{2009, 1, 15}, Step{2012, 7, 16},
                           Step{2015, 7, 17}, Step{2017, 1, 18}}) {
    const std::chrono::sys_days day = std::chrono::year(step.year) / step.month / 1;
    const TimeNs utc_s = std::chrono::seconds(day.time_since_epoch()).count();
    if (gps_ns >= (utc_s + step.ahead_s) * kNsPerSecond) ahead_s = step.ahead_s;
  }
  return ahead_s * kNsPerSecond;
}

TimeNs UtcOf(const RecordingEpoch& epoch) {
  const bool is_gps = epoch.clock == ClockScale::kGps;
  return epoch.since_1970_ns - (is_gps ? GpsAheadOfUtc(epoch.since_1970_ns) : 0);
}

TimeNs ZeroOfAfter(const RecordingEpoch& a, const RecordingEpoch& b) {
  const bool converts = a.clock != ClockScale::kUnknown && b.clock != ClockScale::kUnknown;
  return converts ? UtcOf(b) - UtcOf(a) : b.since_1970_ns - a.since_1970_ns;
}

}  // namespace tera
