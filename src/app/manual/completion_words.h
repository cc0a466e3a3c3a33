#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/manual/command_help.h"

/// Parts shared by the completion scripts of all shells.

namespace tera {

/// Paths of all commands below the program, quoted, such as "'tera layout'".
std::vector<std::string> PathsBelow(const CommandHelp& program);
/// Names of the commands directly below `command`.
std::vector<std::string> NamesOfCommands(const CommandHelp& command);

/// Puts text in single quotes; `quote_within` replaces each quote inside.
std::string Quoted(std::string_view text, std::string_view quote_within);

}  // namespace tera
