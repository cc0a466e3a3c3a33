#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/commands.h"
#include "core/error.h"

// The command of a program that was built without Cyclone DDS.

namespace tera {
namespace {

TEST(Ros2Absent, SaysInOneLineWhatToInstallWhateverItsArguments) {
  CLI::App app;
  AddRos2Command(&app);
  try {
    app.parse("ros2 scenario.yaml --pace lockstep", /*program_name_included=*/false);
    FAIL() << "nothing was said";
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_THAT(text, testing::HasSubstr("install cyclonedds-dev"));
    EXPECT_EQ(text.find('\n'), std::string::npos);
  }
}

}  // namespace
}  // namespace tera
