#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>

#include "app/diagnosed_scenario.h"

namespace tera {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

const std::string kScenario = TERA_SOURCE_DIR "/config/scenarios/paper_drive.yaml";

/// Result of `tera compare` for two trajectories.
struct Compared {
  double reference_m = 0, compared_m = 0;  ///< lengths
  double aligned_m = 0;                    ///< RMSE after the best rotation and shift in the plane
};

Compared Read(const std::string& text) {
  std::smatch lengths, ape;
  EXPECT_TRUE(std::regex_search(text, lengths, std::regex("path length (\\S+) m and (\\S+) m")));
  EXPECT_TRUE(std::regex_search(text, ape, std::regex("APE, SE\\(2\\) aligned +(\\S+)")));
  if (lengths.empty() || ape.empty()) return {};
  return {std::stod(lengths[1]), std::stod(lengths[2]), std::stod(ape[1])};
}

/// The numbers of the TERA paper, by three causes (docs/reference/diagnose.md).
class PaperDrive : public testing::Test {
 protected:
  Outcome Run(const Arguments& arguments) const {
    const Outcome outcome = RunTera(arguments, {scratch_.path()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome;
  }
  void Record(const std::string& cause, const std::string& out, const Arguments& more = {}) const {
    Arguments arguments = {"generate", kScenario, "--out", out};
    if (!cause.empty()) {
      arguments.insert(arguments.end(),
                       {"--effects", TERA_SOURCE_DIR "/config/effects/paper_" + cause + ".yaml"});
    }
    arguments.insert(arguments.end(), more.begin(), more.end());
    Run(arguments);
  }
  /// diagnosis.json.
  Json Diagnose(const std::string& recording, const Arguments& more = {}) const {
    Arguments arguments = {"diagnose", kScenario, recording, "--out", recording + "_why"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    Run(arguments);
    std::ifstream file(scratch_.path() / (recording + "_why") / "diagnosis.json");
    return Json::parse(file);
  }
  std::filesystem::path folder() const { return scratch_.path(); }

 private:
  const ScratchDirectory scratch_;
};

/// "mechanism of target" of each finding; "unexplained of channel" of unexplained errors.
Names NamesIn(const Json& report) {
  Names names;
  for (const Json& finding : report["findings"]) {
    const std::string mechanism = finding["mechanism"];
    const Json& place = finding[mechanism == "unexplained" ? "channel" : "target"];
    names.push_back(mechanism + " of " + place.get<std::string>());
  }
  return names;
}

double NumberIn(const Json& list, const std::string& mechanism, const std::string& target,
                const std::string& parameter) {
  for (const Json& finding : list) {
    if (finding["mechanism"] == mechanism && finding["target"] == target) {
      return finding["parameters"][parameter]["value"];
    }
  }
  ADD_FAILURE() << "no " << mechanism << " of " << target;
  return 0;
}

TEST_F(PaperDrive, ThreeCausesGiveTheLengthsAndTheErrorOfThePaper) {
  Record("", "sim");
  for (const std::string cause : {"gain", "gauge_and_slip", "lost_commands"}) {
    SCOPED_TRACE(cause);
    Record(cause, cause);
    const Compared compared = Read(Run({"compare", cause, "sim"}).out);
    EXPECT_NEAR(compared.reference_m, 57.39, 0.05);
    EXPECT_NEAR(compared.compared_m, 50.47, 0.05);
    EXPECT_NEAR(compared.aligned_m, 1.376, 0.02);
  }
}

TEST_F(PaperDrive, WithReceiversAloneNoneOfTheThreeIsTold) {
  const Arguments receivers = {
      "--set", "machines[0].rig=" TERA_SOURCE_DIR "/config/rigs/paper_receivers.yaml"};
  for (const std::string cause : {"gain", "gauge_and_slip", "lost_commands"}) {
    SCOPED_TRACE(cause);
    Record(cause, cause, receivers);
    RemoveTruth(folder() / cause);
    const Json report = Diagnose(cause, receivers);
    EXPECT_THAT(NamesIn(report), IsEmpty());
    EXPECT_TRUE(report["next_manoeuvre"].is_null());
    EXPECT_THAT(report["not_compared"].dump(), HasSubstr("excavator1/base: what its tracks"));
  }
}

TEST_F(PaperDrive, AGainOfBothTracksIsNamed) {
  Record("gain", "real");
  const Json report = Diagnose("real");
  const Names names = NamesIn(report);
  EXPECT_THAT(names, Contains("rate_gain of left_track"));
  EXPECT_THAT(names, Contains("rate_gain of right_track"));
  for (const std::string track : {"left_track", "right_track"}) {
    EXPECT_NEAR(NumberIn(report["findings"], "rate_gain", track, "gain"), 1.138, 0.03);
  }
}

TEST_F(PaperDrive, AFirmerGroundIsNamedBySlipAndGauge) {
  Record("gauge_and_slip", "real");
  const Json report = Diagnose("real");
  EXPECT_THAT(NamesIn(report), Contains("effective_gauge of base"));
  EXPECT_NEAR(NumberIn(report["findings"], "effective_gauge", "base", "ratio"), 1.103, 0.06);
  bool is_slip_named = false;
  for (const Json& finding : report["findings"]) {
    Names alike = finding["class"].get<Names>();
    alike.push_back(finding["mechanism"]);
    is_slip_named =
        is_slip_named || std::find(alike.begin(), alike.end(), "track_slip") != alike.end();
  }
  EXPECT_TRUE(is_slip_named);
}

TEST_F(PaperDrive, LostCommandsOfBothTracksAreNamedAndNothingElse) {
  Record("lost_commands", "real");
  EXPECT_THAT(NamesIn(Diagnose("real")),
              UnorderedElementsAre("command_drops of left_track", "command_drops of right_track"));
}

}  // namespace
}  // namespace tera
