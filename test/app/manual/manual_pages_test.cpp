#include "app/manual/manual_pages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/manual/sample_program.h"
#include "app/other_program.h"
#include "dataset/format/sample_recording.h"

namespace tera {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::map<std::string, std::string> Pages() {
  return ManualPages(HelpOf(SampleProgram().app()), "1.2.3");
}

TEST(ManualPages, AreOneEachForTheProgramAndItsCommands) {
  std::vector<std::string> names;
  for (const auto& [name, page] : Pages()) names.push_back(name);
  EXPECT_THAT(names, testing::ElementsAre("tera-dig.1", "tera-plan-dig.1", "tera-plan-rest.1",
                                          "tera-plan.1", "tera.1"));
}

/// A page as displayed, without bold and underlined letters.
std::string Shown(const std::string& page) {
  const ScratchDirectory scratch;
  WriteWholeFile(scratch.path() / "page.1", page);
  const auto text = OutputOf("man --warnings=w -E UTF-8 -P cat " +
                             (scratch.path() / "page.1").string() + " 2>&1 | col -bx");
  return text.value_or("man failed");
}

TEST(ManualPages, ReadAsTheCommandLineIs) {
  if (!HasProgram("man")) GTEST_SKIP() << "needs man, of the package man-db";
  const std::string page = Shown(Pages().at("tera-dig.1"));
  EXPECT_THAT(page,
              AllOf(HasSubstr("TERA-DIG(1)"), HasSubstr("tera 1.2.3"),
                    HasSubstr("tera-dig - Dig a hole that's \\deep [m]: -1 or so\n"),
                    HasSubstr("tera dig PLACE --soil clay|sand [OPTION]...\n"),
                    HasSubstr("-n, --times INT\n"), HasSubstr("How often (a whole number >= 0).\n"),
                    HasSubstr("--with TEXT ...\n"), HasSubstr("What the ground is; required.\n")));
  EXPECT_THAT(page, AllOf(HasSubstr("SEE ALSO"), HasSubstr("tera(1)"), Not(HasSubstr("warning"))));
  EXPECT_THAT(Shown(Pages().at("tera-plan.1")),
              AllOf(HasSubstr("tera plan COMMAND\n"), HasSubstr("What next?\n"),
                    HasSubstr("tera(1), tera-plan-dig(1)"), Not(HasSubstr("warning"))));
}

}  // namespace
}  // namespace tera
