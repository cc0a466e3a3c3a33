#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "app/about/version.h"
#include "app/arguments/argument_checks.h"
#include "app/commands.h"
#include "app/manual/completion.h"
#include "app/manual/manual_pages.h"
#include "core/error.h"
#include "dataset/files/checked_file.h"
#include "dataset/files/whole_folder.h"

// The commands for manual pages and shell completion.

namespace tera {
namespace {

enum class Shell { kBash, kFish, kZsh };
const std::map<std::string, Shell> kShells = {
    {"bash", Shell::kBash}, {"fish", Shell::kFish}, {"zsh", Shell::kZsh}};

void WriteManual(const CommandHelp& program, const std::filesystem::path& out) {
  RequireNothingAt(out);
  WholeFolder folder(out);
  for (const auto& [name, page] : ManualPages(program, kVersion)) {
    WriteWholeFile(folder.temporary() / name, page);
  }
  folder.Commit();
}

std::string ScriptFor(Shell shell, const CommandHelp& program) {
  if (shell == Shell::kBash) return BashScript(program);
  return shell == Shell::kFish ? FishScript(program) : ZshScript(program);
}

}  // namespace

void AddManualCommand(CLI::App* app) {
  auto out = std::make_shared<std::filesystem::path>();
  CLI::App* command = app->add_subcommand(
      "manual", "Write manual pages, one each for the program and its commands");
  command->add_option("--out", *out, "Folder of the pages; new or empty")->required();
  command->callback([app, out] { WriteManual(HelpOf(*app), *out); });
}

void AddCompletionCommand(CLI::App* app) {
  auto shell = std::make_shared<Shell>();
  CLI::App* command = app->add_subcommand(
      "completion", "Print a script for completion of this program's command line in a shell");
  command->add_option("SHELL", *shell, "bash, fish or zsh")->required()->transform(OneOf(kShells));
  command->callback([app, shell] { fmt::print("{}", ScriptFor(*shell, HelpOf(*app))); });
}

}  // namespace tera
