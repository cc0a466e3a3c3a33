#include "dataset/lint/lint.h"

#include <gmock/gmock.h>

#include "core/error.h"
#include "dataset/lint/healthy_recording.h"

namespace tera {
namespace {

using testing::Contains;
using testing::HasSubstr;
namespace fs = std::filesystem;

TEST_F(LintTest, AHealthyRecordingIsCleanAndEveryRuleAppliesToIt) {
  WriteFrameHashes(run());
  const LintReport report = Linted();
  for (const LintFinding& finding : report.findings) {
    ADD_FAILURE() << finding.rule->id << " " << finding.channel << ": "
                  << finding.places.front().message;
  }
  for (const LintRule* rule : report.not_applicable) ADD_FAILURE() << rule->id << " did not apply";
  EXPECT_EQ(report.applied.size(), kLintRules.size());
}

TEST_F(LintTest, CountsWhatItLookedAt) {
  const LintReport report = Linted();
  EXPECT_EQ(report.statistics.channels.at("digger/imu").rows, 200);
  EXPECT_EQ(report.statistics.channels.at("digger/imu").median_interval_ns, 10'000'000);
  EXPECT_EQ(report.statistics.scans, 21);
  EXPECT_EQ(report.statistics.points, 2100);
  EXPECT_EQ(report.statistics.boxes, 33);
  // rgb, depth, semantic, instance, distance, normal and flow of 11 frames.
  EXPECT_EQ(report.statistics.pictures, 77);
  EXPECT_EQ(report.statistics.classes.at("sky").pixels, 11 * 2 * kHealthyWidth_px);
  EXPECT_EQ(report.statistics.classes.at("truck").points, 210);
  EXPECT_EQ(report.statistics.depth_m[5], 11 * 14 * kHealthyWidth_px);
}

TEST_F(LintTest, OpensOneOfSoManyFrames) {
  EXPECT_EQ(Linted({.every_frame = 5}).statistics.scans, 5);
  Put("digger/lidar/scans/100000000.pcd", "");
  EXPECT_TRUE(Linted({.every_frame = 2}).findings.empty());
  EXPECT_FALSE(Linted({.every_frame = 1}).findings.empty());
}

TEST_F(LintTest, TellsTheFirstPlacesAndCountsTheOthers) {
  Scale("digger/commands.csv", {"boom"}, 100);
  const LintFinding finding = Only("commands.range", "digger/commands.csv");
  EXPECT_EQ(finding.count, 101);
  ASSERT_EQ(finding.places.size(), 5u);
  EXPECT_EQ(finding.places[0].line, 2);
  EXPECT_EQ(finding.places[0].message, "boom is 50");
}

TEST_F(LintTest, TellsErrorsBeforeWarnings) {
  Put("notes.txt", "x");                                        // files.unknown, a warning
  Edit("digger/lidar/data.csv", "100000000.pcd", "scan1.pcd");  // rows.filename, an error
  const LintReport report = Linted();
  ASSERT_EQ(report.findings.size(), 2u);
  EXPECT_EQ(report.findings[0].rule->severity, Severity::kError);
  EXPECT_EQ(report.CountOf(Severity::kError), 1);
  EXPECT_EQ(report.CountOf(Severity::kWarning), 1);
}

TEST_F(LintTest, ADamagedChannelDoesNotKeepOthersFromBeingChecked) {
  Put("digger/imu/data.csv", "");
  Scale("digger/commands.csv", {"boom"}, 100);
  Put("digger/lidar/scans/0.pcd", "");
  EXPECT_EQ(Found(), (std::set<std::string>{"rows.header", "commands.range", "scans.readable"}));
}

TEST_F(LintTest, ARuleWithoutItsChannelsDoesNotApply) {
  fs::remove_all(run() / "digger/gnss");
  Edit("dataset.yaml", "  - {path: \"digger/gnss\", type: gnss}\n", "");
  const LintReport report = Linted();
  EXPECT_TRUE(report.findings.empty());
  std::set<std::string> ids;
  for (const LintRule* rule : report.not_applicable) ids.emplace(rule->id);
  EXPECT_EQ(ids, (std::set<std::string>{"gnss.values", "gnss.geodesy", "gnss.pose", "files.hash"}));
}

TEST_F(LintTest, WhatIsNoDatasetIsRefused) {
  EXPECT_THROW(Lint(run() / "digger"), InputError);
  EXPECT_THROW(Lint(run() / "nowhere"), InputError);
  Put("dataset.yaml", "format: [");
  EXPECT_THROW(Linted(), InputError);
}

TEST(LintRules, IdsAreUniqueAndSayTheirTopic) {
  std::set<std::string> ids;
  for (const LintRule& rule : kLintRules) {
    EXPECT_TRUE(ids.emplace(rule.id).second) << rule.id;
    EXPECT_NE(rule.id.find('.'), rule.id.npos) << rule.id;
    EXPECT_TRUE(rule.text.ends_with('.') && rule.remedy.ends_with('.')) << rule.id;
  }
}

}  // namespace
}  // namespace tera
