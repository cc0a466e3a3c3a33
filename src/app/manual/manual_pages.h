#pragma once

#include <map>
#include <string>

#include "app/manual/command_help.h"

namespace tera {

/// Manual pages of section 1, a page each for the program and its commands, as man's macros for
/// roff: by their files' names, "tera-generate.1".
std::map<std::string, std::string> ManualPages(const CommandHelp& program,
                                               const std::string& version);

}  // namespace tera
