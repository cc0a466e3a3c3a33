#include "app/run_program.h"

#include <fmt/format.h>

#include <exception>
#include <filesystem>
#include <string>

#include "app/arguments/misspelt.h"
#include "core/error.h"

namespace tera {
namespace {

constexpr int kSuccess = 0;
constexpr int kBug = 1;
constexpr int kBadInput = 2;

int Parse(CLI::App* app, int argc, char** argv) {
  try {
    app->parse(argc, argv);
  } catch (const CLI::RuntimeError& e) {
    return e.get_exit_code();  // a command with a negative result
  } catch (const CLI::ParseError& e) {
    const std::string unknown = UnknownArgument(*app);
    if (e.get_exit_code() == kSuccess || unknown.empty()) {
      return app->exit(e) == 0 ? kSuccess : kBadInput;
    }
    fmt::print(stderr, "{}\nRun with --help for more information.\n", unknown);
    return kBadInput;
  }
  return kSuccess;
}

}  // namespace

int RunProgram(CLI::App* app, int argc, char** argv) {
  try {
    return Parse(app, argc, argv);
  } catch (const InputError& e) {
    fmt::print(stderr, "{}\n", e.what());
    return kBadInput;
  } catch (const std::filesystem::filesystem_error& e) {
    const std::string path = e.path1().string();
    fmt::print(stderr, "{}: {}; check the disk and the path\n", path, e.code().message());
    return kBadInput;
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}: internal error, please report it: {}\n", app->get_name(), e.what());
    return kBug;
  }
}

}  // namespace tera
