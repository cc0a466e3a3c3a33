#include "layout/compare/comparison_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <sstream>

#include "core/error.h"
#include "layout/report/sample_report.h"

namespace tera {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// Sees 0.25 more of the space around the machine, and 15 m^3 more of it, at every moment.
LayoutReport Better(const std::string& name = "rear") {
  LayoutReport report = SampleReport(name);
  for (double& seen : report.figures[0].at) seen += 0.25;
  for (double& blind_m3 : report.figures[1].at) blind_m3 -= 15;
  report.maps[0].value.assign(report.maps[0].value.size(), 0.5);
  return report;
}

std::vector<std::string> Lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST(PageOfAComparison, IsWellFormedAndAlone) {
  for (const auto& reports : {std::vector{SampleReport(), Better()},
                              std::vector{SampleReport(), Better(), Better("third"),
                                          Better("fourth"), Better("fifth"), Better("sixth")}}) {
    const std::string html = ComparisonPage(reports);
    ExpectWellFormed(html);
    ExpectSelfContained(html);
    for (const LayoutReport& report : reports) EXPECT_THAT(html, HasSubstr(report.name));
  }
}

TEST(PageOfAComparison, HasNothingButWhatBothHave) {
  LayoutReport bare;
  bare.name = "bare";
  bare.cycle = SampleReport().cycle;
  bare.asked_sha256 = SampleReport().asked_sha256;
  bare.t_s = SampleReport().t_s;
  ExpectWellFormed(ComparisonPage({SampleReport(), bare}));
  ExpectWellFormed(ComparisonPage({bare, SampleReport()}));
}

TEST(PageOfAComparison, WhatLooksLikeMarkupIsText) {
  LayoutReport first = SampleReport(kMarkup), other = Better(kMarkup);
  for (LayoutReport* report : {&first, &other}) {
    report->maps[0].title = report->curves[0].title = kMarkup;
    report->figures.push_back({{Measure::kSeenBy2, kMarkup}, {0, 0, 0, 0}, {}});
  }
  const std::string html = ComparisonPage({first, other});
  ExpectWellFormed(html);
  EXPECT_THAT(html, Not(HasSubstr("<b>")));
  EXPECT_THAT(html, HasSubstr(kEscapedMarkup));
}

TEST(PageOfAComparison, DifferencesOfMapsAreOfTheirOwnScale) {
  // Half of the map's scale less or more: red or blue, never the grey of unknown cells.
  LayoutReport first = SampleReport(), worse = SampleReport("worse"),
               better = SampleReport("better");
  for (const auto& [report, value] :
       {std::pair(&first, 125.0), std::pair(&worse, 5.0), std::pair(&better, 245.0)}) {
    report->maps = {SampleMap(value)};
    report->maps[0].id = {Measure::kPixelMap, "1.5"};
    report->maps[0].high = 250;
  }
  const auto difference_of = [&](const LayoutReport& other) {
    const std::string html = ComparisonPage({first, other});
    const std::size_t end = html.find(other.name + " against front</figcaption>");
    const std::size_t begin = html.rfind("<svg", end), cell = html.find("fill=\"#", begin) + 7;
    return std::array{std::stoi(html.substr(cell, 2), nullptr, 16),
                      std::stoi(html.substr(cell + 4, 2), nullptr, 16)};
  };
  const auto [worse_red, worse_blue] = difference_of(worse);
  EXPECT_GT(worse_red, worse_blue + 50);
  const auto [better_red, better_blue] = difference_of(better);
  EXPECT_GT(better_blue, better_red + 50);
  // A hundredth of the scale is negligible.
  better.maps[0] = first.maps[0];
  better.maps[0].value.assign(better.maps[0].value.size(), 127.5);
  const auto [red, blue] = difference_of(better);
  EXPECT_LT(std::abs(red - blue), 50);
}

TEST(PageOfAComparison, SaysInWordsWhichSeesMore) {
  const std::vector<std::string> words = ComparisonWords({SampleReport(), Better()});
  EXPECT_THAT(
      words, Contains(AllOf(StartsWith("rear against front"), HasSubstr("space around the machine"),
                            HasSubstr("better by"), HasSubstr("25.0 percentage points"))));
  EXPECT_THAT(words, Contains(AllOf(HasSubstr("cutting edge"),
                                    HasSubstr("not distinguishable over this cycle"))));
  EXPECT_THAT(ComparisonWords({Better(), SampleReport()}), Contains(HasSubstr("worse by")));
  const std::string html = ComparisonPage({SampleReport(), Better()});
  EXPECT_LT(html.find("25.0 percentage points"), html.find("<svg"));
}

/// The chart's outline of the first layout.
std::string OutlineIn(const std::string& html) {
  const std::string begin = "<path class=\"outline a\" d=\"";
  const std::size_t at = html.find(begin) + begin.size();
  return html.substr(at, html.find('"', at) - at);
}

// The chart has seven axes; its middle is at 320, 210, and its outermost ring has a radius of 150.
TEST(PageOfAComparison, AFigureThatIsAbsentIsAGapInTheChartAndIsTold) {
  LayoutReport whole = SampleReport();
  whole.figures.push_back({{Measure::kSeenBy2, "around"}, {1, 1, 1, 1}, {}});
  whole.figures.push_back({{Measure::kDetectedShare, "crouching"}, {1, 1, 1, 1}, {}});
  whole.figures.push_back({{Measure::kLoadSeen, "bucket"}, {0, 0, 0, 0}, {}});
  whole.figures.push_back({{Measure::kElevationGaps}, {0, 0, 0, 0}, {}});
  const std::string all = ComparisonPage({whole, whole});
  EXPECT_THAT(all, Not(HasSubstr("lacks these figures")));
  EXPECT_THAT(OutlineIn(all), Not(HasSubstr("M320 210")));
  EXPECT_THAT(OutlineIn(all), StartsWith("M320.0 135.0L"));  // half of the space, straight up
  EXPECT_THAT(OutlineIn(all), HasSubstr("L320.0 210.0"));    // no load is visible: the worst value

  LayoutReport without = whole;
  std::erase_if(without.figures,
                [](const Figure& f) { return f.id.measure == Measure::kLoadSeen; });
  const std::string html = ComparisonPage({without, without});
  EXPECT_THAT(html, HasSubstr("front lacks these figures: load. The chart has a gap there."));
  EXPECT_THAT(OutlineIn(html), Not(HasSubstr("L320.0 210.0")));
  EXPECT_THAT(OutlineIn(html), HasSubstr("M320 210L"));  // the two sides of the gap
  ExpectWellFormed(html);
}

// A dozer has a blade and no bucket.
TEST(PageOfAComparison, TheShovelThatDigsIsWhicheverTheMachineHas) {
  LayoutReport first = SampleReport(), other = Better();
  for (LayoutReport* report : {&first, &other}) report->figures.back().id.of = "blade";
  other.figures.back().at.assign(4, 1);
  EXPECT_THAT(ComparisonWords({first, other}),
              Contains(StartsWith("rear against front, blade: share of its cutting edge")));
  EXPECT_THAT(ComparisonPage({first, other}), HasSubstr("front lacks these figures: seen by two, "
                                                        "crouching person, load, map"));
}

TEST(PageOfAComparison, SaysLossesAsWellAsGainsAndWhatBothTake) {
  LayoutReport other = Better();
  other.figures.back().at.assign(4, 0);  // of the bucket's edge
  other.figures.push_back({{Measure::kSeenBy1, "truck"}, {0, 0, 0, 0}, {}});
  LayoutReport first = SampleReport();
  first.figures.push_back({{Measure::kSeenBy1, "truck"}, {1, 1, 1, 1}, {}});
  other.expense = {0, 20, 5, 4, 0, 4};
  const std::vector<std::string> words = ComparisonWords({first, other});
  EXPECT_THAT(words, Contains(AllOf(StartsWith("rear against front: better in 2 of 8 figures"),
                                    HasSubstr("worse in "),
                                    HasSubstr(". Largest losses: zone 'truck' seen by 1 or more "
                                              "sensors."),
                                    Not(HasSubstr("seen_by_1")))));
  EXPECT_THAT(words,
              Contains("Expense of rear: cost unknown (no sensor priced), power 20 W (4 of 4 "
                       "sensors with a power), 5 MB/s of raw data; of front: cost "
                       "4500 (2 of 3 sensors priced), power 8.5 W (1 of 3 sensors with a "
                       "power), 33.2 MB/s of raw data."));
  const std::string html = ComparisonPage({first, other});
  EXPECT_THAT(html, HasSubstr("<li>front: cost 4500 (2 of 3 sensors priced)"));
}

TEST(PageOfAComparison, RowsOfItsTableAreTheDifferences) {
  const std::vector<std::string> lines = Lines(ComparisonCsv({SampleReport(), Better()}));
  ASSERT_EQ(lines.size(), 8u);
  EXPECT_EQ(lines[0], "layout,against,figure,unit,mean,mean_of_other,low,high,verdict");
  EXPECT_THAT(lines[1], AllOf(StartsWith("rear,front,zone/around/seen_by_1,,0.75,0.5,"),
                              testing::EndsWith(",better")));
  EXPECT_THAT(lines[2], AllOf(StartsWith("rear,front,zone/around/blind_m3,m^3,15,30,"),
                              testing::EndsWith(",better")));
  EXPECT_EQ(lines[4], "rear,front,person/standing/detected_to_m_behind,m,5,5,0,0,undecided");
  EXPECT_EQ(lines[7], "rear,front,dig/bucket/edge_seen,,0.375,0.375,0,0,undecided");
}

TEST(PageOfAComparison, NamesWithCommasStayInOneColumn) {
  const std::vector<std::string> lines = Lines(ComparisonCsv({SampleReport(), Better("a,b")}));
  EXPECT_THAT(lines[1], StartsWith("\"a,b\",front,"));
}

TEST(PageOfAComparison, EachIsHeldAgainstTheFirst) {
  const std::vector<std::string> lines =
      Lines(ComparisonCsv({SampleReport(), Better(), Better("third")}));
  EXPECT_THAT(lines, Contains(StartsWith("rear,front,")).Times(7));
  EXPECT_THAT(lines, Contains(StartsWith("third,front,")).Times(7));
}

TEST(PageOfAComparison, OfOtherCyclesIsRefused) {
  LayoutReport other = Better();
  other.cycle = "elsewhere";
  EXPECT_THROW(ComparisonPage({SampleReport(), other}), InputError);
  EXPECT_THROW(ComparisonCsv({SampleReport(), other}), InputError);
}

}  // namespace
}  // namespace tera
