#pragma once

#include <string>

namespace tera {

/// Text of `tera --version`: the version on the first line, then source commit, build type and
/// libraries. `tera info` describes the renderer of the computer.
std::string AboutProgram();

}  // namespace tera
