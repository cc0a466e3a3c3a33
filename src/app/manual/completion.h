#pragma once

#include <string>

#include "app/manual/command_help.h"

/// Shell scripts that complete commands, options, values and file names. They do not call any
/// program.

namespace tera {

std::string BashScript(const CommandHelp& program);
std::string ZshScript(const CommandHelp& program);
std::string FishScript(const CommandHelp& program);

}  // namespace tera
