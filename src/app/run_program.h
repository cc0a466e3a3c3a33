#pragma once

#include <CLI/CLI.hpp>

namespace tera {

/// Parses the command line, which runs the command, and returns the exit status. 0: success; 1:
/// negative result or internal error; 2: bad input. An exception is printed as one message on
/// standard error. `app` must have the name of the program.
int RunProgram(CLI::App* app, int argc, char** argv);

}  // namespace tera
