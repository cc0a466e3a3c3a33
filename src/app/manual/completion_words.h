#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/manual/command_help.h"

/// What the scripts of all shells are made of.

namespace tera {

/// "'tera layout'", in quotes, of all that lies below the program.
std::vector<std::string> PathsBelow(const CommandHelp& program);
/// Of the commands below one, their last words.
std::vector<std::string> NamesOfCommands(const CommandHelp& command);

/// A text in single quotes, in which a quote is written as `quote_within`.
std::string Quoted(std::string_view text, std::string_view quote_within);

}  // namespace tera
