#include <fmt/format.h>

#include <memory>
#include <thread>

#include "app/about/version.h"
#include "app/arguments/argument_checks.h"
#include "app/commands.h"
#include "core/config/config.h"
#include "render/gl/rasterizer.h"
#include "render/rays/ray_scene.h"

namespace tera {

void AddInfoCommand(CLI::App* app) {
  struct Arguments {
    int egl_device = -1;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      app->add_subcommand("info", "Print the versions, renderer and threads of this computer");
  command->add_option("--egl-device", arguments->egl_device, "GPU to ask")
      ->check(WholeNumberFrom0());
  command->callback([arguments] {
    const Rasterizer rasterizer(SceneModel{}, {.device = arguments->egl_device});
    const GlInfo& gl = rasterizer.info();
    fmt::print("tera          {}\n", kVersion);
    fmt::print("data          {}\n", DataRoot().string());
    fmt::print("EGL platform  {}\n", gl.egl_platform);
    fmt::print("GL renderer   {} ({})\n", gl.renderer, gl.vendor);
    fmt::print("GL version    {}\n", gl.version);
    fmt::print("Embree        {}\n", EmbreeVersion());
    fmt::print("threads       {}\n", std::thread::hardware_concurrency());
  });
}

}  // namespace tera
