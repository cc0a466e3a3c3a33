#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/manual/command_help.h"

/// Common parts of the completion scripts of all shells.

namespace tera {

/// "'tera layout'", in quotes, for each command below the program.
std::vector<std::string> PathsBelow(const CommandHelp& program);
/// Last words of the commands below `command`.
std::vector<std::string> NamesOfCommands(const CommandHelp& command);

/// Text in single quotes; `quote_within` replaces each inner quote.
std::string Quoted(std::string_view text, std::string_view quote_within);

}  // namespace tera
