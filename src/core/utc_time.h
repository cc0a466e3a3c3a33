#pragma once

#include <optional>
#include <string_view>

#include "core/time.h"

namespace tera {

/// ns since 1970-01-01 00:00:00 of "2026-05-01T12:00:00Z", a date and a time of the years 1970 to
/// 2037; nothing where the text is no such time.
std::optional<TimeNs> ParseUtc(std::string_view text);

}  // namespace tera
