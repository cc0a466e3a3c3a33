#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace tera {

/// Message about the first argument unknown to `app` and its command, with a similar option or
/// command. Empty if all are known. Call this function after a parse error, because CLI11 reports
/// missing arguments first.
std::string UnknownArgument(const CLI::App& app);

}  // namespace tera
