#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "core/time.h"

namespace tera {

/// "2026-05-01T12:00:00Z", a date and a time of the years 1970 to 2037.
CLI::Validator IsUtcTime();
/// ns since 1970-01-01 00:00:00 of a text that IsUtcTime takes.
TimeNs UtcTime(const std::string& text);

}  // namespace tera
