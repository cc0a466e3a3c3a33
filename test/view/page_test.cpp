#include "view/page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "view/small_recording.h"

namespace tera {
namespace {

std::string Refusal(const std::vector<std::filesystem::path>& places) {
  try {
    ReadPage(places);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(ViewPage, IsTheFirstThatIsThere) {
  WriteFileAt(OwnFolder() / "page" / "b.html", "<b><!--pack--></b>");
  EXPECT_EQ(ReadPage({OwnFolder() / "page" / "a.html", OwnFolder() / "page" / "b.html"}),
            "<b><!--pack--></b>");
}

TEST(ViewPage, SaysWhatTheBuildLacked) {
  WriteFileAt(OwnFolder() / "bare" / "missing.txt", "esbuild is not installed\n");
  EXPECT_EQ(Refusal({OwnFolder() / "none" / "a.html", OwnFolder() / "bare" / "a.html"}),
            "tera view: its page was not built: esbuild is not installed");
  EXPECT_THAT(Refusal({OwnFolder() / "none" / "a.html"}), testing::HasSubstr("tera_view_page"));
}

TEST(ViewPage, MustBeItsOwn) {
  WriteFileAt(OwnFolder() / "other" / "a.html", "<p>something else</p>");
  EXPECT_THAT(Refusal({OwnFolder() / "other" / "a.html"}),
              testing::HasSubstr("is not the page of tera view"));
}

}  // namespace
}  // namespace tera
