#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/commands.h"
#include "core/error.h"

// The command of a program that was built without gRPC.

namespace tera {
namespace {

TEST(ServeAbsent, SaysInOneLineWhatToInstallWhateverItsArguments) {
  CLI::App app;
  AddServeCommand(&app);
  try {
    app.parse("serve scenario.yaml --port 0", /*program_name_included=*/false);
    FAIL() << "nothing was said";
  } catch (const InputError& error) {
    const std::string text = error.what();
    for (const char* package : {"libgrpc++-dev", "libprotobuf-dev", "protobuf-compiler-grpc"}) {
      EXPECT_THAT(text, testing::HasSubstr(package));
    }
    EXPECT_EQ(text.find('\n'), std::string::npos);
  }
}

}  // namespace
}  // namespace tera
