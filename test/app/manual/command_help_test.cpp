#include "app/manual/command_help.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/manual/sample_program.h"

namespace tera {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(CommandHelp, KnowsCommandsAndThoseBelowThem) {
  const CommandHelp program = HelpOf(SampleProgram().app());
  std::vector<std::string> paths;
  for (const CommandHelp* command : AllOf(program)) paths.push_back(command->Joined(" "));
  EXPECT_THAT(paths,
              ElementsAre("tera", "tera dig", "tera plan", "tera plan dig", "tera plan rest"));
  EXPECT_EQ(program.description, "Works on the ground");
  EXPECT_EQ(program.commands.at(1).commands.at(0).Joined("-"), "tera-plan-dig");
}

TEST(CommandHelp, KnowsWhatOptionsTake) {
  const CommandHelp program = HelpOf(SampleProgram().app());
  const std::vector<OptionHelp>& options = program.commands.at(0).options;
  ASSERT_EQ(options.size(), 6u);
  EXPECT_THAT(options[0].names, ElementsAre("-h", "--help"));
  EXPECT_EQ(options[0].type, "");
  EXPECT_TRUE(options[1].is_argument);
  EXPECT_THAT(options[1].names, ElementsAre("PLACE"));
  EXPECT_TRUE(options[1].TakesPath());
  EXPECT_TRUE(options[2].is_required);
  EXPECT_THAT(options[2].words, ElementsAre("clay", "sand"));
  EXPECT_FALSE(options[2].TakesPath());
  EXPECT_THAT(options[3].names, ElementsAre("-n", "--times"));
  EXPECT_EQ(options[3].need, "whole number >= 0");
  EXPECT_THAT(options[3].words, IsEmpty());
  EXPECT_FALSE(options[3].is_repeated);
  EXPECT_TRUE(options[4].is_repeated);
  EXPECT_EQ(options[5].type, "") << "a flag";
}

}  // namespace
}  // namespace tera
