#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/diagnosed_report.h"
#include "blind/cases/recording_files.h"
#include "blind/marking/table.h"
#include "blind/prove.h"
#include "core/config/portable_name.h"
#include "dataset/files/checked_file.h"
#include "diagnose/report/files/write_report.h"

namespace tera {
namespace {

struct ProveArguments {
  blind::ProveOptions prove;
  int threads = HostOptions().threads;
};

void RunProve(ProveArguments* arguments) {
  RequireNewFolder(arguments->prove.out);
  blind::ProveOptions& prove = arguments->prove;
  if (prove.maker == blind::MakerKind::kOwn) {
    prove.machine_yaml = PlaceOfInput(blind::kMachine, {});
    prove.real_csv = PlaceOfInput(blind::kRealDrive, {});
  } else {
    const std::vector<const char*> working = {"4t", "7t"}, kept = {"2t"};
    for (const char* size : prove.reserve ? kept : working) {
      const auto place = [size](const char* what) {
        return PlaceOfInput(fmt::format("tera:examples/prove/{}{}.yaml", what, size), {});
      };
      prove.machines.push_back({place("excavator"), place("rig")});
    }
  }
  const auto diagnose = [&](const std::filesystem::path& scenario,
                            const std::filesystem::path& recording,
                            const std::filesystem::path& out) {
    ReportDiagnosis({.scenario = {.scenario = scenario.string()},
                     .recordings = {recording},
                     .out = out,
                     .task = {.simulate = false, .threads = arguments->threads}});
  };
  const auto baselines = [&](const std::filesystem::path& scenario,
                             const std::filesystem::path& recording,
                             const std::filesystem::path& out) {
    const Scenario read = Load({.scenario = scenario.string()}).scenario;
    WriteWholeFile(out / "baselines.json",
                   BaselinesOfRecording(read, Recording(recording), arguments->threads));
  };
  const auto marks =
      blind::Prove(arguments->prove, {diagnose, baselines}, [](const blind::Mark& mark) {
        fmt::print("{}", blind::CaseLine(mark));
        std::fflush(stdout);
      });
  fmt::print("\n{}", blind::TableMarkdown(blind::TableOf(marks)));
  fmt::print("\n{}", blind::MethodsMarkdown(blind::MethodsOf(marks)));
}

}  // namespace

void AddProveCommand(CLI::App* app) {
  auto arguments = std::make_shared<ProveArguments>();
  CLI::App* command = app->add_subcommand(
      "prove", "Conceal effects in recordings of another simulator and score what diagnose says");
  command->add_option("--cases", arguments->prove.cases, "How many")->check(CLI::Range(1, 100000));
  command->add_option("--first", arguments->prove.first, "Number of the first of them")
      ->check(CLI::Range(1, 100000));
  command->add_option("--seed", arguments->prove.seed, "Of what is concealed");
  command->add_option("--out", arguments->prove.out, "Folder to write, which must not exist")
      ->required();
  const std::map<std::string, blind::MakerKind> makers = {{"own", blind::MakerKind::kOwn},
                                                          {"mujoco", blind::MakerKind::kMujoco}};
  command
      ->add_option("--maker", arguments->prove.maker,
                   "own: joints or tracks alone; mujoco: a whole machine with all its sensors")
      ->transform(CLI::CheckedTransformer(makers, CLI::ignore_case));
  command->add_flag("--reserve", arguments->prove.reserve,
                    "Of mujoco: forms, manoeuvres and a machine that no other run uses");
  command->add_option("--duration", arguments->prove.duration_s, "Seconds of each recording")
      ->check(CLI::Range(26.0, 3600.0));
  command->add_option("--threads", arguments->threads, "Fits at a time")
      ->check(CLI::PositiveNumber);
  command->callback([arguments] { RunProve(arguments.get()); });
}

}  // namespace tera
