#pragma once

#include <optional>
#include <string_view>

#include "core/time.h"

namespace tera {

/// Parses a text like "2026-05-01T12:00:00Z" to nanoseconds since 1970-01-01 00:00:00 UTC. Accepts
/// the years 1970 to 2037; returns nullopt for any other text.
std::optional<TimeNs> ParseUtc(std::string_view text);

}  // namespace tera
