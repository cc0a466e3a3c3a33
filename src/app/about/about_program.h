#pragma once

#include <string>

namespace tera {

/// Output of `tera --version`: the version alone on the first line, followed by source commit,
/// build type and libraries. `tera info` reports the computer's renderer.
std::string AboutProgram();

}  // namespace tera
