#pragma once

#include <string>

#include "app/manual/command_help.h"

/// Scripts that complete commands, options, words that options take, and names of files. They ask
/// nobody: what they know is in them.

namespace tera {

std::string BashScript(const CommandHelp& program);
std::string ZshScript(const CommandHelp& program);
std::string FishScript(const CommandHelp& program);

}  // namespace tera
