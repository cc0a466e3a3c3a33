#include <string>

#include "app/commands.h"
#include "core/error.h"

// Placeholders for commands whose libraries are missing in a quickstart build.

namespace tera {
namespace {

void AddLeftOut(const std::string& name, const std::string& description, CLI::App* app) {
  CLI::App* command = app->add_subcommand(name, description + " (not in this build)");
  command->allow_extras();
  command->callback([name] {
    throw InputError(
        "tera " + name,
        {FaultKind::kUnsupported,
         "not in this build of the quickstart; scripts/build.sh builds the whole program"});
  });
}

}  // namespace

void AddCampaignCommand(CLI::App* app) {
  AddLeftOut("campaign", "Run many varied episodes of one scenario", app);
}
void AddDiagnoseCommand(CLI::App* app) {
  AddLeftOut("diagnose", "Find why a recording differs from its simulation", app);
}
void AddLayoutCommand(CLI::App* app) {
  AddLeftOut("layout", "Evaluate, compare and search sensor layouts", app);
}
void AddRegisterCommand(CLI::App* app) { AddLeftOut("register", "Align two clouds", app); }
void AddResenseCommand(CLI::App* app) {
  AddLeftOut("resense", "Measure a recorded scene with another rig", app);
}
void AddRos2Command(CLI::App* app) { AddLeftOut("ros2", "Run a scenario live for ROS 2", app); }
void AddServeCommand(CLI::App* app) {
  AddLeftOut("serve", "Let a program step a scenario over a socket", app);
}
void AddSiteCommand(CLI::App* app) { AddLeftOut("site", "Make a site from a survey", app); }
void AddSweepCommand(CLI::App* app) {
  AddLeftOut("sweep", "Measure how factors of a scenario change a figure of a report", app);
}

}  // namespace tera
