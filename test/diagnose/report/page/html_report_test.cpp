#include "diagnose/report/page/html_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnose/blocks/measured_poses.h"
#include "diagnose/report/made_diagnosis.h"
#include "diagnose/report/page/page.h"
#include "diagnose/report/text/sentences.h"

namespace tera {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// Whether every tag is closed in its order.
bool IsBalanced(const std::string& html) {
  std::vector<std::string> open;
  for (auto at = html.find('<'); at != html.npos; at = html.find('<', at + 1)) {
    const std::string tag = html.substr(at + 1, html.find('>', at) - at - 1);
    const std::string name = tag.substr(0, tag.find_first_of(" /", 1));
    if (tag.starts_with("!") || tag.ends_with("/") || name == "meta") continue;
    if (!tag.starts_with("/")) {
      open.push_back(name);
    } else {
      if (open.empty() || open.back() != tag.substr(1)) return false;
      open.pop_back();
    }
  }
  return open.empty();
}

// A rule for all pictures would also size nested ones, and move curves off their axes.
TEST(HtmlReport, SizesWholePicturesAlone) {
  const std::string page = HtmlReport(Complete(), "recording");
  EXPECT_THAT(page, HasSubstr(":not(svg)>svg{display:block;width:100%"));
  EXPECT_THAT(page, Not(HasSubstr("\nsvg{")));
}

TEST(HtmlReport, SaysEverySentenceOnce) {
  Diagnosis diagnosis = Complete();
  diagnosis.blocks[0].diagnosis.unexplained = {GrowingBeyond12kNm()};
  const std::string page = HtmlReport(diagnosis, "run");
  for (const std::string& sentence : SentencesOf(diagnosis)) {
    const std::string text = Escaped(sentence);
    EXPECT_NE(page.find(text), page.npos) << sentence;
    EXPECT_EQ(page.find(text), page.rfind(text)) << sentence;
  }
}

TEST(HtmlReport, HoldsTheSentencesAndNeedsNothingElse) {
  DiagnosedBlock boom = BoomWithDeadBand();
  boom.diagnosis.unexplained = {GrowingBeyond12kNm()};
  Diagnosis diagnosis = Of(std::move(boom));
  diagnosis.blocks.push_back(Block("arm", "excavator1/encoders/arm_radps", "rad/s"));
  const std::string html = HtmlReport(diagnosis, "a<b>&'c'");
  EXPECT_TRUE(IsBalanced(html));
  for (const std::string& sentence : SentencesOf(diagnosis)) {
    EXPECT_THAT(html, HasSubstr(Escaped(sentence)));
  }
  EXPECT_TRUE(IsBalanced(HtmlReport(Complete(), "run")));
  EXPECT_THAT(HtmlReport(Complete(), "run"), HasSubstr("What to record next"));
  EXPECT_THAT(html, HasSubstr("a&lt;b&gt;&amp;&#39;c&#39;"));
  EXPECT_THAT(html, HasSubstr("Every channel"));
  EXPECT_THAT(html, HasSubstr("<code>backlash</code>"));
  for (const char* outside : {"http", "src=", "url(", "<script", "<link", "@import"}) {
    EXPECT_THAT(html, Not(HasSubstr(outside)));
  }
  for (const char* broken : {"nan", "inf'", "inf "}) EXPECT_THAT(html, Not(HasSubstr(broken)));
}

/// Position of a text on a page; fails the test if it is absent.
std::size_t PlaceOf(const std::string& page, const std::string& text) {
  const auto at = page.find(text);
  EXPECT_NE(at, page.npos) << text;
  return at;
}

TEST(HtmlReport, AnswersFirstAndFoldsTheDetails) {
  DiagnosedBlock boom = BoomWithDeadBand();
  boom.diagnosis.unexplained = {GrowingBeyond12kNm()};
  Diagnosis diagnosis = Of(std::move(boom));
  diagnosis.missing_input = {{"excavator1/encoders/arm_radps", "arm", 0.6, false}};
  const std::string page = HtmlReport(diagnosis, "run");
  std::size_t last = 0;
  for (const char* next :
       {"In short: boom: dead band 0.18", "input is missing", "<ol class='chain'",
        "1. Boom: dead band",
        "The boom does not move while its lever is within 18 % of neutral. Sure. Error is left "
        "beside it",
        "measured and predicted over time", "chosen with p 0.0002", "Boom rate: unexplained",
        "the error depends on |arm load| &gt; 12000 N m", "Left: 0.9 deg/s at a noise of 0.2 deg/s",
        "Every channel", "<details", "residual over the recording", "not at any size"}) {
    const std::size_t at = PlaceOf(page, next);
    EXPECT_GT(at, last) << next;
    last = at;
  }
}

TEST(HtmlReport, AMechanismWithoutNumbersIsSeenOrNot) {
  const Candidate stamps = ArrivalStampsCandidate();
  DiagnosedBlock boom = BoomWithDeadBand();
  boom.diagnosis.detectability = {{&stamps, 1}};
  EXPECT_THAT(HtmlReport(Of(std::move(boom)), "run"), HasSubstr("<td>yes</td>"));
}

TEST(HtmlReport, WhereNothingIsWrongSaysSoWithHowMuchCouldNotHaveBeenSeen) {
  DiagnosedBlock boom = BoomWithDeadBand();
  boom.diagnosis.findings.clear();
  const std::string page = HtmlReport(Of(std::move(boom)), "run");
  EXPECT_THAT(page, HasSubstr("<p class='answer'>Nothing found: boom rate agrees"));
  EXPECT_THAT(page, HasSubstr("1 could not have been seen at any size"));
}

TEST(HtmlReport, WhereNothingWasJudgedDoesNotSayThatNothingIsWrong) {
  DiagnosedBlock boom = BoomWithDeadBand();
  boom.diagnosis = {};
  boom.diagnosis.is_testable = false;
  const std::string page = HtmlReport(Of(std::move(boom)), "run");
  EXPECT_THAT(page, HasSubstr("Nothing compared: no channel of the recording can be judged."));
  EXPECT_THAT(page, HasSubstr("<td>too few manoeuvres</td>"));
}

// The residual is 0.5 m/s2. Successive residuals differ by 0.1, as noise of that size would make
// them.
TEST(HtmlReport, DoesNotSayThatNothingIsWrongWhereSensorsDisagree) {
  Diagnosis diagnosis;
  diagnosis.machine = "excavator1";
  diagnosis.sensors.estimate.channels = {{.name = "excavator1/imu/az_mps2",
                                          .unit = "m/s2",
                                          .noise = 0.1,
                                          .differences = 0.1,
                                          .motion = 1,
                                          .rms_before = 0.5,
                                          .rms_after = 0.5}};
  const std::string page = HtmlReport(diagnosis, "run");
  EXPECT_THAT(page, HasSubstr("In short: nothing named. Unexplained: imu specific force along z."));
  EXPECT_THAT(page, HasSubstr("imu: unexplained</p>"));
  EXPECT_THAT(page, HasSubstr("imu specific force along z 0.5 m/s² (noise 0.1 m/s²)"));
  diagnosis.sensors.estimate.channels[0].rms_after = 0.1;
  EXPECT_THAT(HtmlReport(diagnosis, "run"), HasSubstr("Nothing found: imu measured"));
}

/// Drawn coordinates of the first path of a class.
std::string PathOf(const std::string& html, const std::string& css_class) {
  const std::string head = "<path class='" + css_class + "' d='";
  const auto at = html.find(head);
  if (at == html.npos) return "";
  return html.substr(at + head.size(), html.find('\'', at + head.size()) - at - head.size());
}

TEST(HtmlReport, DrawsPredictionsAsMeasurementsLessResiduals) {
  const std::string html = HtmlReport(Of(BoomWithDeadBand()), "run");
  const std::string measured = PathOf(html, "line measured");
  ASSERT_NE(measured, "");
  EXPECT_EQ(measured, PathOf(html, "line after"));  // nothing is left
  // 3 measured, 2 simulated. The axis is a twentieth wider than 2 to 3, on the 204 px between 10
  // and 214. Measured lies 204 / 22 below the upper edge, simulated as far above the lower one.
  EXPECT_THAT(measured, HasSubstr(" 19.3"));
  EXPECT_THAT(PathOf(html, "line before"), HasSubstr(" 204.7"));
}

}  // namespace
}  // namespace tera
