#pragma once

#include <string>

#include "app/manual/command_help.h"

/// Scripts that complete commands, options, option values and file names. They are self-contained
/// and run no program.

namespace tera {

std::string BashScript(const CommandHelp& program);
std::string ZshScript(const CommandHelp& program);
std::string FishScript(const CommandHelp& program);

}  // namespace tera
