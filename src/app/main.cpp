#include "app/about/about_program.h"
#include "app/commands.h"
#include "app/run_program.h"
#include "core/error.h"

namespace {

/// Refers the user to the program tera-prove. Its simulators serve only to evaluate TERA, so they
/// are in a separate program.
void AddProveCommand(CLI::App* app) {
  CLI::App* command = app->add_subcommand("prove", "Is the program tera-prove");
  command->group("")->allow_extras();  // hides the command in help and manual pages
  command->set_help_flag("");          // `tera prove --help` prints the same text
  command->callback([] {
    throw tera::InputError("tera prove",
                           {tera::FaultKind::kUnsupported,
                            "is a separate program; run tera-prove with the same options, from the "
                            "package tera-prove or the build target of this name"});
  });
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"TERA, a sensor-centric perception simulator for autonomous excavators", "tera"};
  app.require_subcommand(1);
  app.set_version_flag("--version", tera::AboutProgram(),
                       "Print the version and the build of this program");
  tera::AddGenerateCommand(&app);
  tera::AddCampaignCommand(&app);
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
  AddProveCommand(&app);
  tera::AddRegisterCommand(&app);
  tera::AddReplayCommand(&app);
  tera::AddResenseCommand(&app);
  tera::AddRos2Command(&app);
  tera::AddServeCommand(&app);
  tera::AddCompletionCommand(&app);
  tera::AddManualCommand(&app);
  tera::AddSiteCommand(&app);
  tera::AddSweepCommand(&app);
  tera::AddViewCommand(&app);
  return tera::RunProgram(&app, argc, argv);
}
