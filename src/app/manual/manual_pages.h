#pragma once

#include <map>
#include <string>

#include "app/manual/command_help.h"

namespace tera {

/// Manual pages (section 1, roff with man macros): one for the program and one per command. Keys
/// are file names such as "tera-generate.1".
std::map<std::string, std::string> ManualPages(const CommandHelp& program,
                                               const std::string& version);

}  // namespace tera
