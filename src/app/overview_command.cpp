#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>

#include "app/commands.h"
#include "dataset/overview/overview.h"

namespace tera {

void AddOverviewCommand(CLI::App* app) {
  struct Arguments {
    std::string dataset, image, video;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app->add_subcommand(
      "overview", "Draw a contact sheet of a dataset and a film of its cameras");
  command->add_option("DATASET", arguments->dataset, "Dataset directory")->required();
  command->add_option("--image", arguments->image, "PNG to write (DATASET/overview.png)");
  command->add_option("--video", arguments->video, "MP4 to write (DATASET/overview.mp4)");
  command->callback([arguments] {
    const std::filesystem::path dataset = arguments->dataset;
    const auto or_inside = [&](const std::string& file, const char* name) {
      return file.empty() ? dataset / name : std::filesystem::path(file);
    };
    const std::filesystem::path image = or_inside(arguments->image, "overview.png");
    const std::filesystem::path video = or_inside(arguments->video, "overview.mp4");
    WriteOverview(dataset, image, video);
    for (const std::filesystem::path& file : {image, video}) {
      if (std::filesystem::exists(file)) fmt::print("{}\n", file.string());
    }
  });
}

}  // namespace tera
