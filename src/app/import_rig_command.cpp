#include <fmt/format.h>

#include <memory>
#include <string>

#include "app/commands.h"
#include "dataset/files/checked_file.h"
#include "sensors/import_rig.h"

namespace tera {
void AddImportRigCommand(CLI::App* app) {
  struct Arguments {
    std::string rig, machine, out;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app->add_subcommand(
      "import-rig",
      "Turn rigs of the TERA paper's project into a rig, or machines, of this schema");
  command->add_option("FILE", arguments->rig, "Its configuration (YAML)")->required();
  command->add_option("--machine", arguments->machine,
                      "id of one machine to convert (all, as machines of a scenario)");
  command->add_option("--out", arguments->out, "File to write; standard output without it");
  command->callback([arguments] {
    const std::string yaml = ImportRig(arguments->rig, arguments->machine);
    if (arguments->out.empty()) {
      fmt::print("{}", yaml);
    } else {
      WriteWholeFile(arguments->out, yaml);
    }
  });
}

}  // namespace tera
