#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "app/commands.h"
#include "core/error.h"
#include "sensors/import_rig.h"

namespace tera {
namespace {

void WriteText(const std::string& text, const std::filesystem::path& file) {
  const std::filesystem::path partial = file.string() + ".partial";
  std::ofstream stream(partial);
  stream << text;
  stream.close();
  if (!stream) {
    std::filesystem::remove(partial);
    throw InputError(fmt::format("{}: cannot be written; need a writable folder", file.string()));
  }
  std::filesystem::rename(partial, file);
}

}  // namespace

void AddImportRigCommand(CLI::App* app) {
  struct Arguments {
    std::string rig, out;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app->add_subcommand(
      "import-rig", "Turn a rig in the TERA paper's YAML form into one of this schema");
  command->add_option("FILE", arguments->rig, "Rig in the paper's form (YAML)")->required();
  command->add_option("--out", arguments->out, "File to write; standard output without it");
  command->callback([arguments] {
    const std::string yaml = ImportRig(arguments->rig);
    if (arguments->out.empty()) {
      fmt::print("{}", yaml);
    } else {
      WriteText(yaml, arguments->out);
    }
  });
}

}  // namespace tera
