#include "dataset/format/events_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/error.h"
#include "core/parse_number.h"
#include "core/split_text.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/csv_rows.h"

namespace tera {
namespace {

/// The event of a row; otherwise the fault.
std::string ReadRow(std::string_view row, RecordedEvent* event) {
  const std::vector<std::string_view> fields = PartsOf(row, ',');
  if (fields.size() != EventsChannel().columns.size() + 1) {
    return fmt::format("{} fields, need {}", fields.size(), EventsChannel().columns.size() + 1);
  }
  const auto begin_ns = ParseNumber<TimeNs>(fields[0]), end_ns = ParseNumber<TimeNs>(fields[1]);
  if (!begin_ns || !end_ns) return "t_ns and end_ns must be whole numbers";
  if (*end_ns < *begin_ns) return fmt::format("ends at {}, before it begins", *end_ns);
  const auto kind = std::ranges::find(kEventKinds, fields[2], &EventKindInfo::name);
  if (kind == kEventKinds.end()) {
    std::vector<std::string_view> names;
    for (const EventKindInfo& info : kEventKinds) names.push_back(info.name);
    return fmt::format("unknown kind '{}', need one of {}", fields[2], fmt::join(names, ", "));
  }
  const auto value = ParseFinite(fields[6]);
  if (!value || *value < 0) return fmt::format("value '{}', need a number from 0", fields[6]);
  if (fields[7] != kind->unit) {
    return fmt::format("unit '{}', need '{}' for {}", fields[7], kind->unit, kind->name);
  }
  *event = {*begin_ns,
            *end_ns,
            static_cast<EventKind>(kind - kEventKinds.begin()),
            std::string(fields[3]),
            std::string(fields[4]),
            std::string(fields[5]),
            *value};
  return "";
}

}  // namespace

ChannelInfo EventsChannel() {
  return {.path = kEventsFile,
          .type = std::string(kEventsChannel),
          .form = ChannelForm::kRows,
          .sensor_yaml = std::nullopt,
          .columns = {"end_ns", "kind", "machine", "part", "other", "value", "unit"}};
}

std::string EventsText(std::vector<RecordedEvent> events) {
  std::ranges::sort(events);
  std::string text = TableHeader(EventsChannel().columns) + '\n';
  for (const RecordedEvent& event : events) {
    const EventKindInfo& kind = kEventKinds[static_cast<std::size_t>(event.kind)];
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{}\n", event.begin_ns,
                   event.end_ns, kind.name, event.machine, event.part, event.other, event.value,
                   kind.unit);
  }
  return text;
}

std::vector<RecordedEvent> ReadEvents(
    const std::filesystem::path& file,
    const std::function<void(int line, const std::string& what)>& on_fault) {
  const std::string text = ReadWholeFile(file);
  const std::string header = TableHeader(EventsChannel().columns);
  std::vector<std::string_view> lines = PartsOf(text, '\n');
  if (lines.front() != header) {
    throw InputError(
        fmt::format("{}:1", file.string()),
        {FaultKind::kMalformed, fmt::format("found '{}', need '{}'", lines.front(), header)});
  }
  std::vector<RecordedEvent> events;
  const bool is_whole = lines.back().empty();
  if (is_whole) lines.pop_back();
  for (std::size_t k = 1; k < lines.size(); ++k) {
    const int line = static_cast<int>(k) + 1;
    RecordedEvent event;
    std::string fault = ReadRow(lines[k], &event);
    if (!is_whole && k + 1 == lines.size()) fault = "the last line has no end";
    if (fault.empty() && !events.empty() && event.begin_ns < events.back().begin_ns) {
      fault = fmt::format("begins at {}, before the row above it", event.begin_ns);
    }
    if (fault.empty()) {
      events.push_back(std::move(event));
    } else {
      on_fault(line, fault);
    }
  }
  return events;
}

std::vector<RecordedEvent> ReadEvents(const std::filesystem::path& file) {
  return ReadEvents(file, [&](int line, const std::string& what) {
    throw InputError(fmt::format("{}:{}", file.string(), line), {FaultKind::kMalformed, what});
  });
}

}  // namespace tera
