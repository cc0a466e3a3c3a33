#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/time.h"
#include "dataset/format/channel.h"

namespace tera {

/// Channel type and file of the events of a simulated recording.
inline constexpr std::string_view kEventsChannel = "events";
inline constexpr char kEventsFile[] = "truth/events.csv";

enum class EventKind { kContact, kStrike, kSpill, kTip, kDrop, kPersonNear };

/// Name and unit of each EventKind, in its order.
struct EventKindInfo {
  std::string_view name, unit;
};
inline constexpr std::array<EventKindInfo, 6> kEventKinds = {{{"contact", "N"},
                                                              {"strike", "N s"},
                                                              {"spill", "kg"},
                                                              {"tip", "rad"},
                                                              {"drop", "m"},
                                                              {"person_near", "m"}}};

/// Something that happened. docs/reference/dataset.md defines the kinds.
struct RecordedEvent {
  TimeNs begin_ns = 0, end_ns = 0;
  EventKind kind = EventKind::kContact;
  std::string machine;  ///< empty for a thing without machine
  std::string part;     ///< of the machine; may be empty
  std::string other;    ///< what it meets; may be empty
  double value = 0;     ///< in the kind's unit

  auto operator<=>(const RecordedEvent&) const = default;
};

ChannelInfo EventsChannel();

/// The whole file, rows in order of their beginning.
std::string EventsText(std::vector<RecordedEvent> events);

/// Reports each faulty row and skips it. Throws InputError if the file cannot be read or has
/// another header.
std::vector<RecordedEvent> ReadEvents(
    const std::filesystem::path& file,
    const std::function<void(int line, const std::string& what)>& on_fault);
/// Refuses faulty rows with InputError.
std::vector<RecordedEvent> ReadEvents(const std::filesystem::path& file);

}  // namespace tera
