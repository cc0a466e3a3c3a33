#include "view/page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/faults.h"
#include "view/small_recording.h"

namespace tera {
namespace {

using enum FaultKind;
std::vector<InputFault> Refusal(const std::vector<std::filesystem::path>& places) {
  return FaultsIn([&] { ReadPage(places); });
}

TEST(ViewPage, IsTheFirstThatIsThere) {
  WriteFileAt(OwnFolder() / "page" / "b.html", "<b><!--pack--></b>");
  EXPECT_EQ(ReadPage({OwnFolder() / "page" / "a.html", OwnFolder() / "page" / "b.html"}),
            "<b><!--pack--></b>");
}

TEST(ViewPage, SaysWhatTheBuildLacked) {
  WriteFileAt(OwnFolder() / "bare" / "missing.txt", "esbuild is not installed\n");
  const auto bare = Refusal({OwnFolder() / "none" / "a.html", OwnFolder() / "bare" / "a.html"});
  ASSERT_THAT(bare, HasOnlyFault(kUnsupported, "tera view"));
  EXPECT_THAT(bare[0].finding, testing::HasSubstr("esbuild is not installed"));
  EXPECT_THAT(Refusal({OwnFolder() / "none" / "a.html"}), HasFault(kUnsupported, "tera view"));
}

TEST(ViewPage, MustBeItsOwn) {
  WriteFileAt(OwnFolder() / "other" / "a.html", "<p>something else</p>");
  EXPECT_THAT(Refusal({OwnFolder() / "other" / "a.html"}), HasFault(kMalformed));
}

}  // namespace
}  // namespace tera
