#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "app/arguments/argument_checks.h"
#include "app/commands.h"
#include "app/progress/stop_signals.h"
#include "app/viewed_stage.h"
#include "core/error.h"
#include "dataset/files/checked_file.h"
#include "view/excerpt.h"
#include "view/page.h"
#include "view/stage_file.h"
#include "view/view_server.h"

namespace tera {
namespace {

constexpr std::uint64_t kMbBytes = 1'000'000;
constexpr int kHighestPort = 65535, kMostExcerptMb = 500;

struct ViewArguments {
  std::vector<std::string> paths, moved;
  std::string excerpt;
  int port = 0, size_mb = 25;
  bool stop_with_stdin = false;
};

std::vector<Viewed> Open(const ViewArguments& arguments) {
  std::vector<Viewed> viewed;
  for (const std::string& path : arguments.paths) {
    viewed.push_back(OpenViewed(path));
    if (viewed.back().kind != Viewed::Kind::kDataset) continue;
    viewed.back().stage = [path, moved = arguments.moved] {
      return StageFile(StageOfRecording(path, moved));
    };
  }
  RequireFewDatasets(viewed);
  return viewed;
}

void WriteExcerpt(const ViewArguments& arguments) {
  const Excerpt excerpt = MakeExcerpt(Open(arguments), ReadPage(PagePlaces()),
                                      kMbBytes * static_cast<std::uint64_t>(arguments.size_mb));
  WriteWholeFile(arguments.excerpt, excerpt.html);
  fmt::print("{}: {:.1f} MB. {}\n", arguments.excerpt,
             static_cast<double>(excerpt.html.size()) / kMbBytes, excerpt.words);
}

void Serve(const ViewArguments& arguments) {
  std::vector<Viewed> viewed = Open(arguments);
  const StopSignals stop;
  const ViewServer server(std::move(viewed), ReadPage(PagePlaces()), arguments.port);
  fmt::print("look at {} (Ctrl-C ends)\n", server.address());
  std::fflush(stdout);
  stop.Wait(arguments.stop_with_stdin);
}

}  // namespace

void AddViewCommand(CLI::App* app) {
  auto arguments = std::make_shared<ViewArguments>();
  CLI::App* command = app->add_subcommand(
      "view", "Look at datasets and diagnoses in a browser (docs/reference/view.md)");
  command
      ->add_option("PATH", arguments->paths,
                   "Folder of a dataset or of a diagnosis; two datasets are shown side by side")
      ->required();
  CLI::Option* const port =
      command->add_option("--port", arguments->port, "Port on 127.0.0.1; without it a free one")
          ->check(WholeNumberBetween(1, kHighestPort));
  CLI::Option* const excerpt = command->add_option(
      "--export", arguments->excerpt, "Write one HTML file with part of the data; serve nothing");
  excerpt->excludes(port);
  command->add_option("--size", arguments->size_mb, "Largest size of that file in MB; 25")
      ->check(WholeNumberBetween(1, kMostExcerptMb))
      ->needs(excerpt);
  AddMovedOption(command, &arguments->moved);
  command->add_flag("--stop-with-stdin", arguments->stop_with_stdin,
                    "End when standard input closes");
  command->callback([arguments] {
    if (arguments->excerpt.empty())
      Serve(*arguments);
    else
      WriteExcerpt(*arguments);
  });
}

}  // namespace tera
