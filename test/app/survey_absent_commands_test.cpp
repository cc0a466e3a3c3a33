#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/commands.h"
#include "core/error.h"

// The commands of a program that was built without PCL.

namespace tera {
namespace {

TEST(SurveyAbsent, SaysInOneLineWhatToInstallWhateverItsArguments) {
  for (const char* arguments : {"site survey.las --out site", "register a.pcd b.pcd --gate 2"}) {
    CLI::App app;
    AddSiteCommand(&app);
    AddRegisterCommand(&app);
    try {
      app.parse(arguments, /*program_name_included=*/false);
      FAIL() << "nothing was said";
    } catch (const InputError& error) {
      const std::string text = error.what();
      EXPECT_THAT(text, testing::HasSubstr("libpcl-dev"));
      EXPECT_EQ(text.find('\n'), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace tera
