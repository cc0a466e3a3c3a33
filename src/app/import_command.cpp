#include <memory>
#include <string>
#include <vector>

#include "app/commands.h"
#include "dataset/import/import_csv.h"

namespace tera {

void AddImportCommand(CLI::App* app) {
  struct Arguments {
    std::string mapping, out;
    std::vector<std::string> set;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      app->add_subcommand("import", "Turn CSV files of a real recording into TERA's format");
  command->add_option("MAPPING", arguments->mapping, "Mapping file (YAML, see docs/dataset.md)")
      ->required();
  command->add_option("--out", arguments->out, "Directory of the recording; new or empty")
      ->required();
  command
      ->add_option("--set", arguments->set,
                   "key.path=value instead of the mapping's, above all file=recording.csv")
      ->take_all();
  command->callback([arguments] { ImportCsv(arguments->mapping, arguments->out, arguments->set); });
}

}  // namespace tera
