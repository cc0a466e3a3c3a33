#include "dataset/lint/report/lint_report.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "dataset/lint/healthy_recording.h"

namespace tera {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

class LintReports : public LintTest {
 protected:
  /// Seven rows of levers in percent, and a file too many with a name that a URI cannot hold.
  void Break() const {
    EditRows("digger/commands.csv", [](int line, std::vector<std::string>* fields) {
      if (line >= 10 && line < 17) (*fields)[1] = "50";
    });
    Put("a note #1.txt", "x");
  }
};

TEST_F(LintReports, AHealthyDatasetIsOneSentence) {
  EXPECT_THAT(LintTable(Linted()),
              AllOf(StartsWith(run().string() + ": clean; "), HasSubstr(" rules apply; looked at "),
                    EndsWith("77 pictures, 33 boxes, 21 scans\n")));
}

TEST_F(LintReports, TheTableTellsPlacesAndRemedies) {
  Break();
  const std::string table = LintTable(Linted());
  EXPECT_THAT(table, StartsWith("error commands.range in digger/commands.csv: Lever values lie in "
                                "-1 to +1.\n    digger/commands.csv:10: boom is 50\n"));
  EXPECT_THAT(table, HasSubstr("    and 2 more\n    Scale them;"));
  EXPECT_THAT(table, HasSubstr("warning files.unknown: "));
  EXPECT_THAT(table, HasSubstr("run: 1 error, 1 warning, 0 notes; "));
}

TEST_F(LintReports, JsonHoldsFindingsAndStatistics) {
  Break();
  const json report = json::parse(LintJson(Linted()));
  EXPECT_EQ(report["errors"], 1);
  EXPECT_EQ(report["warnings"], 1);
  const json& finding = report["findings"][0];
  EXPECT_EQ(finding["rule"], "commands.range");
  EXPECT_EQ(finding["severity"], "error");
  EXPECT_EQ(finding["count"], 7);
  EXPECT_EQ(finding["places"][0],
            (json{{"file", "digger/commands.csv"}, {"line", 10}, {"message", "boom is 50"}}));
  EXPECT_EQ(report["statistics"]["channels"]["digger/imu"]["rows"], 200);
  EXPECT_EQ(report["applied"].size() + report["not_applicable"].size(), kLintRules.size());
}

TEST_F(LintReports, TextThatIsNoUtf8StaysJson) {
  EditRows("digger/commands.csv", [](int line, std::vector<std::string>* fields) {
    if (line == 5) (*fields)[1] = "\xff\xfe";
  });
  EXPECT_EQ(json::parse(LintJson(Linted()))["findings"][0]["rule"], "rows.fields");
  EXPECT_FALSE(json::parse(LintSarif(Linted()))["runs"][0]["results"].empty());
}

// The keys that SARIF 2.1.0 requires (sections 3.13, 3.14, 3.27, 3.49), and valid places.
TEST_F(LintReports, SarifHasItsForm) {
  Break();
  const json log = json::parse(LintSarif(Linted()));
  EXPECT_EQ(log["version"], "2.1.0");
  ASSERT_EQ(log["runs"].size(), 1u);
  const json& run = log["runs"][0];
  const json& driver = run["tool"]["driver"];
  EXPECT_EQ(driver["name"], "tera lint");
  ASSERT_EQ(driver["rules"].size(), kLintRules.size());
  ASSERT_EQ(run["results"].size(), 6u);  // five places of the first and one of the second
  for (const json& result : run["results"]) {
    EXPECT_EQ(driver["rules"][result["ruleIndex"].get<std::size_t>()]["id"], result["ruleId"]);
    EXPECT_TRUE(result["message"]["text"].is_string());
    const json& artifact = result["locations"][0]["physicalLocation"]["artifactLocation"];
    EXPECT_TRUE(run["originalUriBaseIds"].contains(artifact["uriBaseId"].get<std::string>()));
  }
  const json& first = run["results"][0]["locations"][0]["physicalLocation"];
  EXPECT_EQ(run["results"][0]["level"], "error");
  EXPECT_EQ(first["artifactLocation"]["uri"], "digger/commands.csv");
  EXPECT_EQ(first["region"]["startLine"], 10);
  EXPECT_EQ(run["results"][5]["locations"][0]["physicalLocation"]["artifactLocation"]["uri"],
            "a%20note%20%231.txt");
  EXPECT_EQ(run["originalUriBaseIds"]["DATASET"]["uri"], "file://" + this->run().string() + "/");
}

TEST_F(LintReports, ThePageOfStatisticsHasEachChannelAndClass) {
  Put("<b>.txt", "x");
  const std::string page = LintStatisticsPage(Linted());
  EXPECT_THAT(page, AllOf(StartsWith("<!DOCTYPE html>"),
                          HasSubstr("<td>digger/imu</td><td>imu</td>"
                                    "<td>200</td>"),
                          HasSubstr("<td>truck</td>"), HasSubstr("Ranges of scans"),
                          HasSubstr("&lt;b&gt;.txt"), EndsWith("</html>\n")));
  EXPECT_EQ(page.find("<b>.txt"), page.npos);
}

// Written by `tera lint --rules`.
TEST(LintRulesTable, IsTheOneOfThePage) {
  EXPECT_THAT(ReadWholeFile("docs/reference/lint.md"), HasSubstr("\n\n" + LintRulesTable() + "\n"));
}

}  // namespace
}  // namespace tera
