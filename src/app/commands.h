#pragma once

#include <CLI/CLI.hpp>

/// The commands of `tera`, one file each. A function adds its command to the command line; the
/// command runs in a callback. Bad input throws InputError.

namespace tera {

void AddCampaignCommand(CLI::App* app);
void AddDiagnoseCommand(CLI::App* app);
void AddGenerateCommand(CLI::App* app);
void AddCheckCommand(CLI::App* app);
void AddInfoCommand(CLI::App* app);
void AddCompareCommand(CLI::App* app);
void AddExportCommand(CLI::App* app);
void AddImportCommand(CLI::App* app);
void AddImportRigCommand(CLI::App* app);
void AddOverviewCommand(CLI::App* app);
void AddRealismCommand(CLI::App* app);
void AddLayoutCommand(CLI::App* app);
void AddLintCommand(CLI::App* app);
void AddRegisterCommand(CLI::App* app);
void AddReplayCommand(CLI::App* app);
void AddResenseCommand(CLI::App* app);
void AddRos2Command(CLI::App* app);
void AddServeCommand(CLI::App* app);
/// These two commands describe the whole program, `app`.
void AddCompletionCommand(CLI::App* app);
void AddManualCommand(CLI::App* app);
void AddSiteCommand(CLI::App* app);
void AddSweepCommand(CLI::App* app);
void AddViewCommand(CLI::App* app);

}  // namespace tera
