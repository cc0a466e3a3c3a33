#include "app/commands.h"
#include "core/error.h"

// Replaces `tera serve` in a build without gRPC.

namespace tera {

void AddServeCommand(CLI::App* app) {
  CLI::App* command = app->add_subcommand(
      "serve", "Let a program step a scenario over a socket (not in this build: needs gRPC)");
  command->allow_extras();
  command->callback([] {
    throw InputError(
        "tera serve",
        {FaultKind::kUnsupported,
         "built without gRPC; install libgrpc++-dev, libprotobuf-dev, protobuf-compiler and "
         "protobuf-compiler-grpc, then configure and build again"});
  });
}

}  // namespace tera
