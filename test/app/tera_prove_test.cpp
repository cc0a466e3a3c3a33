#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "app/program.h"
#include "core/faults.h"

namespace tera {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::StartsWith;

Outcome Prove(const Arguments& arguments, const ScratchDirectory& scratch) {
  return TeraProcess(arguments, {scratch.path()}, TERA_PROVE_PROGRAM).Wait();
}

/// A frozen seed at a reduced size: cases are written, answered, sealed and marked.
/// docs/evidence/proof.md has the quality of answers over many more.
TEST(TeraProve, ConcealsAsksAndMarksCasesOfAFrozenSeed) {
  const ScratchDirectory scratch;
  const Outcome outcome =
      Prove({"--cases", "3", "--seed", "1", "--duration", "30", "--out", "proof"}, scratch);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("| false alarm where nothing is wrong | ≤ 2 % |"));
  std::ifstream file(scratch.path() / "proof" / "table.json");
  const auto json = nlohmann::json::parse(file);
  EXPECT_EQ(json["cases"], 3);
  for (const auto& mark : json["marks"]) {
    EXPECT_EQ(mark["fault"], "") << "every case has an answer";
  }
  for (const char* name : {"case_0001", "case_0002", "case_0003"}) {
    const auto folder = scratch.path() / "proof" / name;
    for (const char* part : {"truth.json", "seal.txt", "report/report.html"}) {
      EXPECT_TRUE(std::filesystem::exists(folder / part)) << folder / part;
    }
  }
}

/// For a bucket with play that pulls harder than it pushes, play alone reveals nothing, and the
/// pull is steady only together with it.
TEST(TeraProve, NamesTwoOfWhichEachIsNeededOnlyBesideTheOther) {
  const ScratchDirectory scratch;
  const Outcome outcome =
      Prove({"--seed", "39", "--first", "83", "--cases", "1", "--out", "proof"}, scratch);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("| bucket backlash; bucket asymmetric_gain | "
                                     "bucket asymmetric_gain by lever/bucket; "
                                     "bucket backlash by lever/bucket |"));
}

/// A reader of the bus, whose period appears a step late.
TEST(TeraProve, NamesAReaderThatLooksOnceAPeriod) {
  const ScratchDirectory scratch;
  const Outcome outcome =
      Prove({"--seed", "41", "--first", "33", "--cases", "1", "--out", "proof"}, scratch);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("| bucket input_hold by lever_way/bucket |"));
}

TEST(TeraProve, RefusesAFolderThatIsThereAndRecordingsThatAreTooShort) {
  const ScratchDirectory scratch;
  std::filesystem::create_directory(scratch.path() / "proof");
  const Outcome there = Prove({"--out", "proof"}, scratch);
  EXPECT_EQ(there.status, 2);
  EXPECT_THAT(there.err, AllOf(HasSubstr("proof"), HasSubstr("exists already")));
  const Outcome brief = Prove({"--out", "new", "--duration", "5"}, scratch);
  EXPECT_EQ(brief.status, 2);
  EXPECT_THAT(brief.err, HasSubstr("--duration"));
}

TEST(TeraProve, SaysAnUnknownOptionAndWhichItResembles) {
  const ScratchDirectory scratch;
  const Outcome outcome = Prove({"--out", "proof", "--case", "3"}, scratch);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, TellsOf("--case"));
  EXPECT_TRUE(Entries(scratch.path()).empty());
}

TEST(TeraProve, PrintsItsVersionAndItsManualPage) {
  const ScratchDirectory scratch;
  EXPECT_THAT(Prove({"--version"}, scratch).out,
              ContainsRegex("^tera-prove [0-9]+\\.[0-9]+\\.[0-9]+\n$"));
  const Outcome page = Prove({"--manual"}, scratch);
  EXPECT_EQ(page.status, 0) << page.err;
  EXPECT_THAT(page.out, AllOf(StartsWith(".TH \"TERA\\-PROVE\" 1"), HasSubstr("\\-\\-maker"),
                              HasSubstr("\\-\\-reserve")));
}

}  // namespace
}  // namespace tera
