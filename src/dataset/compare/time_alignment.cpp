#include "dataset/compare/time_alignment.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>

#include "dataset/format/events_table.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

/// The number in front of the first comma.
std::optional<TimeNs> StampOf(const std::string& line) {
  TimeNs t_ns = 0;
  const char* const end = line.data() + std::min(line.find(','), line.size());
  const auto [stop, status] = std::from_chars(line.data(), end, t_ns);
  return status == std::errc() && stop == end ? std::optional(t_ns) : std::nullopt;
}

/// Times of the first and the last complete row of a table.
std::optional<RecordedSpan> SpanOfTable(const fs::path& csv) {
  constexpr std::streamoff kLongestRow = 65'536;
  std::ifstream stream(csv, std::ios::binary);
  std::string line;
  if (!std::getline(stream, line) || !std::getline(stream, line)) return std::nullopt;
  const auto first_ns = StampOf(line);
  stream.seekg(0, std::ios::end);
  stream.seekg(std::max<std::streamoff>(0, stream.tellg() - kLongestRow));
  auto last_ns = first_ns;
  for (std::getline(stream, line); std::getline(stream, line);) {
    if (const auto t_ns = StampOf(line)) last_ns = t_ns;
  }
  if (!first_ns) return std::nullopt;
  return RecordedSpan{*first_ns, *last_ns};
}

/// Formats a duration: "3.25 s", "2.5 h", "4 days".
std::string LengthText(TimeNs length_ns) {
  constexpr double kHour_s = 3600, kDay_s = 24 * kHour_s;
  const double s = std::abs(ToSeconds(length_ns));
  if (s > 2 * kDay_s) return fmt::format("{:.0f} days", s / kDay_s);
  return s > kHour_s ? fmt::format("{:.1f} h", s / kHour_s) : fmt::format("{:.13g} s", s);
}

/// Text such as "by the epochs of both, of UTC; that of b is 3 s after that of a".
std::string EpochsText(const RecordingEpoch& a, const RecordingEpoch& b, TimeNs shift_ns) {
  const bool is_one_clock = a.clock == b.clock;
  const std::string clocks = is_one_clock && a.clock != ClockScale::kUnknown
                                 ? fmt::format(", of {}", TextOf(a.clock))
                             : a.clock == ClockScale::kUnknown || b.clock == ClockScale::kUnknown
                                 ? ", taken as one clock, because a time scale is unknown"
                                 : ", with the leap seconds between GPS time and UTC";
  return fmt::format("by the epochs of both{}; {}", clocks,
                     shift_ns == 0
                         ? "they are the same"
                         : fmt::format("that of the second is {} {} the first's",
                                       LengthText(shift_ns), shift_ns > 0 ? "after" : "before"));
}

std::string NameIn(const Recording& recording) { return recording.directory().string(); }

/// Common time span, in the time of `one`.
std::optional<RecordedSpan> Overlap(const Recording& one, const Recording& other, TimeNs shift_ns) {
  const auto a = SpanOf(one), b = SpanOf(other);
  if (!a || !b) return std::nullopt;
  const RecordedSpan both{std::max(a->first_ns, b->first_ns + shift_ns),
                          std::min(a->last_ns, b->last_ns + shift_ns)};
  return both.first_ns <= both.last_ns ? std::optional(both) : std::nullopt;
}

}  // namespace

std::optional<RecordedSpan> SpanOf(const Recording& recording) {
  std::optional<RecordedSpan> all;
  for (const ChannelDescription& channel : recording.channels()) {
    if (channel.type == kEventsChannel) continue;
    const bool is_file = channel.type == kTableChannel || channel.type == kPoseChannel;
    const fs::path path = recording.directory() / channel.path;
    const auto span = SpanOfTable(is_file ? path : path / "data.csv");
    if (!span) continue;
    if (!all) all = span;
    all->first_ns = std::min(all->first_ns, span->first_ns);
    all->last_ns = std::max(all->last_ns, span->last_ns);
  }
  return all;
}

TimeAlignment AlignTimes(const Recording& one, const Recording& other) {
  const auto &a = one.info().epoch, &b = other.info().epoch;
  if (!a && !b && one.info().simulated && other.info().simulated) return {};
  if (!a && !b) {
    return {
        .told =
            "each from its own zero; neither has an epoch, so the zeros may be different events"};
  }
  if (!a || !b) {
    return {.told = fmt::format("each from its own zero; {} has an epoch and {} has none, so the "
                                "zeros may be different events",
                                NameIn(a ? one : other), NameIn(a ? other : one))};
  }
  const TimeNs shift_ns = ZeroOfAfter(*a, *b);
  if (Overlap(one, other, shift_ns)) return {shift_ns, true, EpochsText(*a, *b, shift_ns)};
  return {
      .told = fmt::format(
          "each from its own zero; the epochs are {} apart, so the recordings have no common time",
          LengthText(shift_ns))};
}

std::optional<RecordedSpan> TimeInCommon(const Recording& one, const Recording& other) {
  const auto &a = one.info().epoch, &b = other.info().epoch;
  if (!a || !b) return std::nullopt;
  return Overlap(one, other, ZeroOfAfter(*a, *b));
}

}  // namespace tera
