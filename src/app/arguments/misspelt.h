#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace tera {

/// What to say of the first argument that neither `app` nor its command knows, with the option or
/// command that it resembles. Empty where all are known. To ask after parsing failed, as CLI11
/// speaks of what is then missing first.
std::string UnknownArgument(const CLI::App& app);

}  // namespace tera
