#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "app/hand_made_recording.h"
#include "app/program.h"
#include "app/refused.h"
#include "core/faults.h"

namespace tera {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

/// A boom with a dead band of 0.1 that its scenario lacks.
class DiagnoseOptions : public testing::Test {
 protected:
  DiagnoseOptions() {
    WriteWholeFile(scratch_.path() / "boom.yaml", kHandMadeScenario);
    WriteHandMade(scratch_.path() / "real", {.valve = DeadTo0_1});
  }
  nlohmann::json Diagnosed(const Arguments& more) const {
    Arguments arguments = {"diagnose", "boom.yaml", "real", "--no-simulation", "--out", "why"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = RunTera(arguments, {scratch_.path()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    out_ = outcome.out;
    std::ifstream file(scratch_.path() / "why" / "diagnosis.json");
    return nlohmann::json::parse(file);
  }

  const ScratchDirectory scratch_;
  mutable std::string out_;
};

TEST_F(DiagnoseOptions, AFurtherRecordingIsJudgedWithWhatTheFirstOneShowed) {
  // The second also has a dead band up to 0.1; the third equals the scenario.
  WriteHandMade(scratch_.path() / "same", {.valve = DeadTo0_1, .seed = 2});
  WriteHandMade(scratch_.path() / "other", {.seed = 3});
  const auto json = Diagnosed({"--held-out", "same", "--held-out", "other"});
  ASSERT_EQ(json["findings"].size(), 1u) << out_;
  EXPECT_EQ(json["findings"][0]["mechanism"], "dead_band");
  ASSERT_EQ(json["held_out_recordings"].size(), 2u);
  const auto& same = json["held_out_recordings"][0];
  EXPECT_EQ(same["recording"], "same");
  const double before = same["channels"][0]["rmse_before"],
               after = same["channels"][0]["rmse_after"];
  EXPECT_NEAR(after, 0.003, 0.001);  // the noise
  EXPECT_GT(before, 3 * after);
  EXPECT_LT(same["channels"][0]["p"].get<double>(), 1e-3);
  const auto& other = json["held_out_recordings"][1]["channels"][0];
  EXPECT_NEAR(other["rmse_before"].get<double>(), 0.003, 0.001);
  EXPECT_GT(other["rmse_after"].get<double>(), 3 * other["rmse_before"].get<double>());
  EXPECT_THAT(out_, HasSubstr("On same, which nothing was fitted to: RMSE of boom rate"));
}

// The first two have a dead band up to 0.1; the third equals the scenario.
TEST_F(DiagnoseOptions, SeveralRecordingsSayWhatTheyShareAndWhereTheyDiffer) {
  WriteHandMade(scratch_.path() / "same", {.valve = DeadTo0_1, .seed = 2});
  WriteHandMade(scratch_.path() / "other", {.seed = 3});
  const Outcome outcome =
      RunTera({"diagnose", "boom.yaml", "real", "same", "other", "--no-simulation", "--out", "why"},
              {scratch_.path()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  std::ifstream file(scratch_.path() / "why" / "recordings.json");
  const auto json = nlohmann::json::parse(file);
  ASSERT_EQ(json["causes"].size(), 1u);
  const auto& cause = json["causes"][0];
  EXPECT_EQ(cause["mechanism"], "dead_band");
  EXPECT_NEAR(cause["parameters"]["width"]["value"].get<double>(), 0.1, 0.01);
  EXPECT_EQ(cause["recordings"][0]["answer"], "named");
  EXPECT_EQ(cause["recordings"][1]["answer"], "named");
  EXPECT_EQ(cause["recordings"][2]["answer"], "absent");
  EXPECT_EQ(cause["shared"], false);
  EXPECT_THAT(outcome.out, HasSubstr("Boom: dead band in recordings 1 and 2"));
  EXPECT_THAT(outcome.out, HasSubstr("Recording 3: not there"));
  for (const char* one : {"recording_1", "recording_2", "recording_3"}) {
    std::ifstream report(scratch_.path() / "why" / one / "diagnosis.json");
    EXPECT_EQ(nlohmann::json::parse(report)["held_out_recordings"].size(), 2u) << one;
  }
}

// The scenario accepts the overlay of the shared causes.
TEST_F(DiagnoseOptions, WhatSeveralRecordingsShareLoads) {
  WriteHandMade(scratch_.path() / "same", {.valve = DeadTo0_1, .seed = 2});
  const Outcome outcome =
      RunTera({"diagnose", "boom.yaml", "real", "same", "--no-simulation", "--out", "why"},
              {scratch_.path()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  std::ifstream file(scratch_.path() / "why" / "effects.yaml");
  const std::string overlay(std::istreambuf_iterator<char>(file), {});
  EXPECT_THAT(overlay, HasSubstr("dead_band: {width: 0."));
  EXPECT_EQ(
      RunTera({"check", "boom.yaml", "--effects", "why/effects.yaml"}, {scratch_.path()}).status,
      0);
}

TEST_F(DiagnoseOptions, ARecordingThatIsNamedTwiceIsRefused) {
  const Outcome outcome =
      RunTera({"diagnose", "boom.yaml", "real", "real", "--out", "why"}, {scratch_.path()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("real: is named twice"));
  EXPECT_FALSE(std::filesystem::exists(scratch_.path() / "why"));
  EXPECT_FALSE(std::filesystem::exists(scratch_.path() / "why.incomplete"));
}

TEST_F(DiagnoseOptions, AFurtherRecordingMayBeNamedBeforeTheScenario) {
  WriteHandMade(scratch_.path() / "same", {.valve = DeadTo0_1, .seed = 2});
  const Outcome outcome = RunTera({"diagnose", "--held-out", "same", "boom.yaml", "real",
                                   "--time-limit", "0.001", "--out", "why"},
                                  {scratch_.path()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

TEST_F(DiagnoseOptions, AFurtherRecordingThatIsNoneStopsBeforeAnythingIsSearched) {
  ExpectRefused(scratch_,
                {"diagnose", "boom.yaml", "real", "--held-out", "nowhere", "--out", "why"},
                HasSubstr("nowhere: no such folder"));
}

TEST_F(DiagnoseOptions, AFolderThatCannotBeMadeStopsBeforeAnythingIsSearched) {
  const Outcome outcome = RunTeraOnTerminal(
      {"diagnose", "boom.yaml", "real", "--no-simulation", "--out", "boom.yaml/why"},
      scratch_.path(), 100);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("boom.yaml/why"), Not(HasSubstr("(1 of 1)"))));
}

TEST_F(DiagnoseOptions, ALibraryLimitsTheCandidates) {
  WriteWholeFile(scratch_.path() / "library.yaml", "without: [dead_band]\n");
  const auto json = Diagnosed({"--library", "library.yaml"});
  for (const auto& finding : json["findings"]) EXPECT_NE(finding["mechanism"], "dead_band");
  EXPECT_THAT(out_, Not(HasSubstr("dead band")));
}

TEST_F(DiagnoseOptions, ALibraryLimitsTheRangeOfANumberOrHoldsIt) {
  WriteWholeFile(
      scratch_.path() / "library.yaml",
      "only: [dead_band]\ncandidates: {dead_band: {width: [0.02, 0.08], asymmetry: 0}}\n");
  const auto json = Diagnosed({"--library", "library.yaml"});
  ASSERT_EQ(json["findings"].size(), 1u) << out_;
  EXPECT_EQ(json["findings"][0]["mechanism"], "unexplained") << "what a wider one would explain";
  // An estimate at the range's end is never confirmed.
  ASSERT_EQ(json["unconfirmed"].size(), 1u);
  EXPECT_EQ(json["unconfirmed"][0]["mechanism"], "dead_band");
  EXPECT_THAT(out_, HasSubstr("dead band 0.08 was chosen"));
  EXPECT_THAT(out_, HasSubstr("the number is at the end of its range"));
}

// A library that leaves no candidate is refused.
TEST_F(DiagnoseOptions, ALibraryAddsAMechanismThatIsNoCandidateByItself) {
  WriteWholeFile(scratch_.path() / "library.yaml",
                 "only: [viscous_friction]\ncandidates: {viscous_friction: "
                 "{coefficient_nmsprad: [100, 5000]}}\n");
  const auto json = Diagnosed({"--library", "library.yaml"});
  ASSERT_EQ(json["findings"].size(), 1u) << out_;
  EXPECT_EQ(json["findings"][0]["mechanism"], "unexplained");
}

TEST_F(DiagnoseOptions, ALibraryWithFaultsNamesThemAllWithTheirPlace) {
  WriteWholeFile(scratch_.path() / "library.yaml",
                 "only: [dead_bend]\ncandidates:\n  dead_band: {width: [0.3, 0.1], wdth: 0}\n");
  const Outcome outcome =
      RunTera({"diagnose", "boom.yaml", "real", "--library", "library.yaml", "--out", "why"},
              {scratch_.path()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err,
              AllOf(HasSubstr("library.yaml:1"), HasSubstr("'dead_bend' is no mechanism"),
                    HasSubstr("did you mean 'dead_band'?"), HasSubstr("library.yaml:3"),
                    HasSubstr("the range from 0.3 to 0.1 is empty"), HasSubstr("wdth"),
                    HasSubstr("did you mean 'width'?")));
  EXPECT_FALSE(std::filesystem::exists(scratch_.path() / "why"));
}

TEST_F(DiagnoseOptions, ALibraryThatLeavesNoCandidateIsRefused) {
  WriteWholeFile(scratch_.path() / "library.yaml", "only: [track_slip]\n");
  ExpectRefused(scratch_,
                {"diagnose", "boom.yaml", "real", "--library", "library.yaml", "--out", "why"},
                TellsOf("library.yaml"));
}

TEST_F(DiagnoseOptions, WhatMakesNoSenseIsRefused) {
  const auto refused = [&](const Arguments& more, const testing::Matcher<const std::string&>& m) {
    Arguments arguments = {"diagnose", "boom.yaml", "real", "--out", "why"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    ExpectRefused(scratch_, arguments, m);
  };
  refused({"--held-out", "./real"}, TellsOf("--held-out ./real"));
  const Outcome threads = RunTera(
      {"diagnose", "boom.yaml", "real", "--out", "why", "--threads", "0"}, {scratch_.path()});
  EXPECT_EQ(threads.status, 2);
  EXPECT_THAT(threads.err, HasSubstr("need a whole number from 1 to 1024"));
  WriteWholeFile(scratch_.path() / "library.yaml", "only: []\n");
  refused({"--library", "library.yaml"},
          AllOf(HasSubstr("library.yaml:1"), HasSubstr("only"), HasSubstr("is empty")));
}

TEST_F(DiagnoseOptions, OutOfTimeSaysSoAndReportsWhatIsDone) {
  const auto json = Diagnosed({"--time-limit", "0.001"});
  EXPECT_EQ(json["findings"].size(), 0u);
  EXPECT_EQ(json["out_of_time"][0], "excavator1/encoders/boom_radps");
  EXPECT_EQ(json["not_judged"][0], "excavator1/encoders/boom_radps");
  EXPECT_EQ(json["verdict"][0], "untestable");
  EXPECT_THAT(out_, AllOf(HasSubstr("Nothing judged: the time was over"),
                          HasSubstr("Boom rate: not judged, for the time was over.")));
  EXPECT_THAT(
      ReadWholeFile(scratch_.path() / "why" / "report.html"),
      AllOf(HasSubstr("Nothing judged: the time was over"), Not(HasSubstr("not at any size"))));
}

TEST_F(DiagnoseOptions, ATimeThatIsNotReachedAndALookAtTheClockChangeNothing) {
  const auto free = Diagnosed({});
  EXPECT_THAT(out_, Not(HasSubstr("search, several blocks")));
  std::filesystem::remove_all(scratch_.path() / "why");
  EXPECT_EQ(Diagnosed({"--time-limit", "500", "--profile"}), free);
  EXPECT_THAT(out_, AllOf(HasSubstr("search, several blocks"), HasSubstr("in all")));
}

TEST_F(DiagnoseOptions, OnATerminalEachBlockHasALineWithWhatCameOfIt) {
  const Outcome outcome = RunTeraOnTerminal(
      {"diagnose", "boom.yaml", "real", "--no-simulation", "--out", "why"}, scratch_.path(), 100);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("excavator1: boom .."),
                                 HasSubstr("excavator1: boom (1 of 1): dead_band")));
}

TEST_F(DiagnoseOptions, IntoAFileEachBlockHasALineAsWell) {
  const Outcome outcome = RunTera(
      {"diagnose", "boom.yaml", "real", "--no-simulation", "--out", "why"}, {scratch_.path()});
  EXPECT_THAT(outcome.err, AllOf(testing::StartsWith("excavator1: boom (1 of 1): dead_band, "),
                                 EndsWith(" s so far\n")));
}

}  // namespace
}  // namespace tera
