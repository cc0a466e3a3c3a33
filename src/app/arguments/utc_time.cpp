#include "app/arguments/utc_time.h"

#include <optional>

#include "core/check.h"
#include "core/utc_time.h"

namespace tera {

CLI::Validator IsUtcTime() {
  return CLI::Validator(
      [](const std::string& text) -> std::string {
        if (ParseUtc(text)) return "";
        return "'" + text +
               "'; need a date and time of UTC from 1970 to 2037, "
               "2026-05-01T12:00:00Z";
      },
      "UTC");
}

TimeNs UtcTime(const std::string& text) {
  const std::optional<TimeNs> time_ns = ParseUtc(text);
  TERA_CHECK(time_ns, text);
  return *time_ns;
}

}  // namespace tera
