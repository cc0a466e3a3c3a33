#pragma once

#include <CLI/CLI.hpp>

namespace tera {

/// Parses a program's command line, which runs the callbacks, and returns the exit status. 0:
/// success; 1: negative answer or internal fault; 2: unusable input. An exception becomes a single
/// message on standard error. `app` has the program's name.
int RunProgram(CLI::App* app, int argc, char** argv);

}  // namespace tera
