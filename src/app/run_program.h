#pragma once

#include <CLI/CLI.hpp>

namespace tera {

/// Parses a program's command line, which runs the callbacks of what is given, and returns the
/// exit status: 0; 1 where the answer is no or the program has a fault of its own; 2 where what
/// was given cannot be used. Whatever is thrown becomes one message on standard error. `app` has
/// the program's name.
int RunProgram(CLI::App* app, int argc, char** argv);

}  // namespace tera
