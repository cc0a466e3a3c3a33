#include "app/manual/completion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "app/manual/sample_program.h"
#include "app/other_program.h"
#include "dataset/format/sample_recording.h"

// The scripts as the shells themselves run them, in a folder with one file.

namespace tera {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

class Completion : public testing::Test {
 protected:
  Completion() {
    const CommandHelp program = HelpOf(SampleProgram().app());
    WriteWholeFile(scratch_.path() / "script.bash", BashScript(program));
    WriteWholeFile(scratch_.path() / "script.zsh", ZshScript(program));
    WriteWholeFile(scratch_.path() / "script.fish", FishScript(program));
    std::filesystem::create_directory(scratch_.path() / "site");
    WriteWholeFile(scratch_.path() / "site/a hole.yaml", "");
  }
  /// Output of `shell`, which first reads `script` in the folder "site".
  std::vector<std::string> LinesOf(const std::string& shell, const std::string& commands) const {
    WriteWholeFile(scratch_.path() / "commands", commands);
    const auto text = OutputOf("cd " + (scratch_.path() / "site").string() + " && HOME=.. " +
                               shell + " ../commands 2>&1");
    std::istringstream stream(text.value_or("failed"));
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
  }
  /// bash's completions of these words, the last of which is incomplete.
  std::vector<std::string> InBash(const std::string& words) const {
    return LinesOf("bash --norc", "source ../script.bash\nCOMP_WORDS=(" + words +
                                      ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_tera\n"
                                      "((${#COMPREPLY[@]})) && printf '%s\\n' \"${COMPREPLY[@]}\"\n"
                                      "exit 0\n");
  }
  /// fish's completions, without descriptions.
  std::vector<std::string> InFish(const std::string& line) const {
    std::vector<std::string> offered =
        LinesOf("fish --no-config", "source ../script.fish\ncomplete -C '" + line + "'\n");
    for (std::string& word : offered) word = word.substr(0, word.find('\t'));
    return offered;
  }

  ScratchDirectory scratch_;
};

TEST_F(Completion, BashOffersCommandsOptionsWordsAndFiles) {
  EXPECT_THAT(InBash("tera ''"), ElementsAre("dig", "plan"));
  EXPECT_THAT(InBash("tera pl"), ElementsAre("plan"));
  EXPECT_THAT(InBash("tera plan ''"), ElementsAre("dig", "rest"));
  EXPECT_THAT(InBash("tera plan dig ''"), ElementsAre("clay", "sand"));
  EXPECT_THAT(InBash("tera dig --de"), ElementsAre("--deep"));
  EXPECT_THAT(InBash("tera dig -"),
              ElementsAre("-h", "--help", "--soil", "-n", "--times", "--with", "--deep"));
  EXPECT_THAT(InBash("tera dig --soil ''"), ElementsAre("clay", "sand"));
  EXPECT_THAT(InBash("tera dig --soil = s"), ElementsAre("sand")) << "as bash splits --soil=s";
  EXPECT_THAT(InBash("tera dig --soil ="), ElementsAre("clay", "sand"));
  EXPECT_THAT(InBash("tera dig -n ''"), IsEmpty()) << "a number";
  EXPECT_THAT(InBash("tera dig ''"), ElementsAre("a hole.yaml"));
  EXPECT_THAT(InBash("tera dig plan --de"), ElementsAre("--deep")) << "a place called plan";
}

TEST_F(Completion, FishOffersTheSame) {
  if (!HasProgram("fish")) GTEST_SKIP() << "needs fish";
  EXPECT_THAT(InFish("tera "), UnorderedElementsAre("dig", "plan"));
  EXPECT_THAT(InFish("tera plan "), UnorderedElementsAre("dig", "rest"));
  EXPECT_THAT(InFish("tera plan dig "), UnorderedElementsAre("clay", "sand"));
  EXPECT_THAT(InFish("tera dig --de"), ElementsAre("--deep"));
  EXPECT_THAT(InFish("tera dig --soil "), UnorderedElementsAre("clay", "sand"));
  EXPECT_THAT(InFish("tera dig --soil=s"), ElementsAre("--soil=sand"));
  EXPECT_THAT(InFish("tera dig -n "), IsEmpty());
  EXPECT_THAT(InFish("tera dig "), Contains("a hole.yaml"));
}

// A terminal of zsh itself, in which lines are typed and completed.
TEST_F(Completion, ZshOffersTheSame) {
  if (!HasProgram("zsh")) GTEST_SKIP() << "needs zsh";
  std::string commands = R"zsh(zmodload zsh/zpty
zpty z zsh -f -i
zpty -w z 'PS1=; autoload -Uz compinit; compinit -u -D; source ../script.zsh; tera() { : }; print ready-$((1 + 1))'
zpty -r -m z ignored '*ready-2*'
complete() {
  zpty -n -w z $1$'\t'
  zpty -r -m z text "*$2*" && print -r -- $2
  zpty -n -w z $'\x15'
}
)zsh";
  const std::vector<std::pair<std::string, std::string>> completed = {
      {"tera pla", "tera plan"},
      {"tera dig --soil s", "--soil sand"},
      {"tera dig --soil=s", "--soil=sand"},
      {"tera plan dig cl", "plan dig clay"},
      {"tera dig --de", "dig --deep"}};
  std::vector<std::string> whole;
  for (const auto& [typed, offered] : completed) {
    commands += "complete '" + typed + "' '" + offered + "'\n";
    whole.push_back(offered);
  }
  EXPECT_EQ(LinesOf("timeout 30 zsh -f", commands + "zpty -d z\n"), whole);
}

TEST_F(Completion, ScriptsAreReadWithoutAWord) {
  EXPECT_THAT(LinesOf("bash -n", BashScript(HelpOf(SampleProgram().app()))), IsEmpty());
  if (HasProgram("zsh")) {
    EXPECT_THAT(LinesOf("zsh -n", ZshScript(HelpOf(SampleProgram().app()))), IsEmpty());
  }
}

}  // namespace
}  // namespace tera
