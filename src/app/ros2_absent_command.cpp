#include "app/commands.h"
#include "core/error.h"

// Replaces `tera ros2` in a build without Cyclone DDS.

namespace tera {

void AddRos2Command(CLI::App* app) {
  CLI::App* command = app->add_subcommand(
      "ros2", "Run a scenario live for ROS 2 (not in this build: needs Cyclone DDS)");
  command->allow_extras();
  command->callback([] {
    throw InputError(
        "tera ros2",
        {FaultKind::kUnsupported,
         "built without Cyclone DDS; install cyclonedds-dev, then configure and build again"});
  });
}

}  // namespace tera
