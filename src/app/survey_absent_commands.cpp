#include "app/commands.h"
#include "core/error.h"

// Replaces `tera site` and `tera register` in a build without PCL.

namespace tera {
namespace {

void AddAbsent(CLI::App* app, const std::string& name, const std::string& what) {
  CLI::App* command = app->add_subcommand(name, what + " (not in this build: needs PCL)");
  command->allow_extras();
  command->callback([name] {
    throw InputError("tera " + name,
                     {FaultKind::kUnsupported,
                      "built without PCL; install libpcl-dev, then configure and build again"});
  });
}

}  // namespace

void AddSiteCommand(CLI::App* app) { AddAbsent(app, "site", "Make a site from a survey"); }

void AddRegisterCommand(CLI::App* app) { AddAbsent(app, "register", "Align two clouds"); }

}  // namespace tera
