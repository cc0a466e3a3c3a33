#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "app/about/version.h"
#include "app/diagnosed_report.h"
#include "app/manual/manual_pages.h"
#include "app/run_program.h"
#include "blind/cases/recording_files.h"
#include "blind/marking/table.h"
#include "blind/prove.h"
#include "core/config/portable_name.h"
#include "dataset/files/checked_file.h"
#include "diagnose/report/files/write_report.h"

// The program `tera-prove` generates recordings with other simulators and scores their diagnoses.

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

void AddOptions(CLI::App* app, ProveArguments* arguments) {
  blind::ProveOptions& prove = arguments->prove;
  app->add_option("--cases", prove.cases, "How many")->check(CLI::Range(1, 100000));
  app->add_option("--first", prove.first, "Number of the first case")->check(CLI::Range(1, 100000));
  app->add_option("--seed", prove.seed, "Seed of the concealed effects");
  app->add_option("--out", prove.out, "Folder to write, which must not exist")->required();
  const std::map<std::string, blind::MakerKind> makers = {{"own", blind::MakerKind::kOwn},
                                                          {"mujoco", blind::MakerKind::kMujoco}};
  app->add_option("--maker", prove.maker,
                  "own: joints or tracks alone; mujoco: a whole machine with all its sensors")
      ->transform(CLI::CheckedTransformer(makers, CLI::ignore_case));
  app->add_flag("--reserve", prove.reserve,
                "mujoco: forms, manoeuvres and a machine that no other run uses");
  app->add_option("--duration", prove.duration_s, "Seconds of each recording")
      ->check(CLI::Range(26.0, 3600.0));
  app->add_option("--threads", arguments->threads, "Fits at a time")->check(CLI::PositiveNumber);
}

}  // namespace
}  // namespace tera

int main(int argc, char** argv) {
  const std::string name = "tera-prove";
  CLI::App app{"Conceal effects in recordings of other simulators and score what diagnose says",
               name};
  tera::ProveArguments arguments;
  tera::AddOptions(&app, &arguments);
  app.set_version_flag("--version", name + " " + tera::kVersion, "Print the version");
  app.add_flag_callback(
      "--manual",
      [&] {
        fmt::print("{}", tera::ManualPages(tera::HelpOf(app), tera::kVersion).at(name + ".1"));
        throw CLI::Success();
      },
      "Print the manual page");
  app.callback([&] { tera::RunProve(&arguments); });
  return tera::RunProgram(&app, argc, argv);
}
