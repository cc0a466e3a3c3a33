#pragma once

#include <string>

namespace tera {

/// What `tera --version` prints: the version alone on the first line, then what the program was
/// built from, how, and with which libraries. The renderer of this machine is told by `tera info`.
std::string AboutProgram();

}  // namespace tera
