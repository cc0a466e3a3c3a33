#include <fmt/format.h>

#include <exception>
#include <filesystem>
#include <string>

#include "app/about/about_program.h"
#include "app/arguments/misspelt.h"
#include "app/commands.h"
#include "core/error.h"

namespace {

constexpr int kSuccess = 0;
constexpr int kBug = 1;
constexpr int kBadInput = 2;

int Run(int argc, char** argv) {
  CLI::App app{"TERA, a sensor-centric perception simulator for autonomous excavators"};
  app.require_subcommand(1);
  app.set_version_flag("--version", tera::AboutProgram(),
                       "Print the version, and what this program was built from and how");
  tera::AddGenerateCommand(&app);
  tera::AddCheckCommand(&app);
  tera::AddInfoCommand(&app);
  tera::AddCompareCommand(&app);
  tera::AddDiagnoseCommand(&app);
  tera::AddExportCommand(&app);
  tera::AddImportCommand(&app);
  tera::AddImportRigCommand(&app);
  tera::AddLayoutCommand(&app);
  tera::AddLintCommand(&app);
  tera::AddOverviewCommand(&app);
  tera::AddRealismCommand(&app);
  tera::AddProveCommand(&app);
  tera::AddRegisterCommand(&app);
  tera::AddReplayCommand(&app);
  tera::AddResenseCommand(&app);
  tera::AddRos2Command(&app);
  tera::AddServeCommand(&app);
  tera::AddCompletionCommand(&app);
  tera::AddManualCommand(&app);
  tera::AddSiteCommand(&app);
  tera::AddViewCommand(&app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::RuntimeError& e) {
    return e.get_exit_code();  // of a command whose answer is no
  } catch (const CLI::ParseError& e) {
    const std::string unknown = tera::UnknownArgument(app);
    if (e.get_exit_code() == kSuccess || unknown.empty()) {
      return app.exit(e) == 0 ? kSuccess : kBadInput;
    }
    fmt::print(stderr, "{}\nRun with --help for more information.\n", unknown);
    return kBadInput;
  }
  return kSuccess;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return Run(argc, argv);
  } catch (const tera::InputError& e) {
    fmt::print(stderr, "{}\n", e.what());
    return kBadInput;
  } catch (const std::filesystem::filesystem_error& e) {
    const std::string path = e.path1().string();
    fmt::print(stderr, "{}: {}; check the disk and the path\n", path, e.code().message());
    return kBadInput;
  } catch (const std::exception& e) {
    fmt::print(stderr, "tera: internal error, please report it: {}\n", e.what());
    return kBug;
  }
}
