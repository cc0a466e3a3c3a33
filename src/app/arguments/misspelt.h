#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace tera {

/// Message about the first argument that `app` and its command do not know, with a similar option
/// or command. Empty if all arguments are known. Called after a parse error, because CLI11 reports
/// missing arguments before unknown ones.
std::string UnknownArgument(const CLI::App& app);

}  // namespace tera
