#include "layout/report/write_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <sstream>

#include "core/error.h"
#include "dataset/format/png.h"
#include "dataset/format/sample_recording.h"
#include "layout/report/answer.h"
#include "layout/report/polar_drawing.h"
#include "layout/report/report_json.h"
#include "layout/report/sample_report.h"
#include "layout/report/words.h"

namespace tera {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

std::vector<std::vector<std::string>> Rows(const fs::path& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(ReadWholeFile(csv));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

class WrittenReport : public testing::Test {
 protected:
  const fs::path& path() const { return scratch_.path(); }

  const ScratchDirectory scratch_;
};

TEST_F(WrittenReport, IsAPageAndItsTables) {
  WriteReport(SampleReport(), path() / "front");
  std::set<std::string> names;
  for (const auto& [name, bytes] : AllFiles(path() / "front")) names.insert(name);
  EXPECT_EQ(names,
            (std::set<std::string>{"blind.csv", "figures.csv", "layout.json", "maps/seen_0.9_m.png",
                                   "moments.csv", "people.csv", "report.html"}));
  EXPECT_EQ(ReadReport(path() / "front").name, "front");
}

TEST_F(WrittenReport, FiguresHaveTheirMeansWorstMomentsAndErrors) {
  WriteReport(SampleReport(), path());
  EXPECT_THAT(
      Rows(path() / "figures.csv"),
      ElementsAre(
          ElementsAre("figure", "unit", "more_is_better", "mean", "worst", "sampling_error"),
          ElementsAre("zone/around/seen_by_1", "", "1", "0.5", "0.25", "0.02"),
          ElementsAre("zone/around/blind_m3", "m^3", "0", "30", "45", "2"),
          ElementsAre("person/standing/detected_from_m_behind", "m", "0", "2", "3", testing::_),
          ElementsAre("person/standing/detected_to_m_behind", "m", "1", "5", "4", testing::_),
          ElementsAre("person/standing/detected_over_m_behind", "m", "1", "4", "3", testing::_),
          ElementsAre("person/standing/detected_within_12m", "", "1", "0.375", "0.25", testing::_),
          ElementsAre("dig/bucket/edge_seen", "", "1", "0.375", "0", testing::_)));
}

TEST_F(WrittenReport, MomentsHaveAllFigures) {
  WriteReport(SampleReport(), path());
  EXPECT_THAT(
      Rows(path() / "moments.csv"),
      ElementsAre(ElementsAre("t_s", "zone/around/seen_by_1", "zone/around/blind_m3",
                              "person/standing/detected_from_m_behind",
                              "person/standing/detected_to_m_behind",
                              "person/standing/detected_over_m_behind",
                              "person/standing/detected_within_12m", "dig/bucket/edge_seen"),
                  ElementsAre("0", "0.5", "30", "1", "4", "4", "0.25", "0"),
                  ElementsAre("0.2", "0.75", "15", "2", "4", "3", "0.5", "1"),
                  ElementsAre("0.4", "0.25", "45", "2", "5", "4", "0.25", "0.125"),
                  ElementsAre("0.6", "0.5", "30", "3", "7", "5", "0.5", "0.375")));
}

TEST_F(WrittenReport, CausesOfEachZoneHaveTheirShares) {
  WriteReport(SampleReport(), path());
  EXPECT_THAT(
      Rows(path() / "blind.csv"),
      ElementsAre(ElementsAre("zone", "cause", "share"), ElementsAre("around", "arm", "0.75"),
                  ElementsAre("around", "out of view", "0.25")));
}

TEST_F(WrittenReport, ProbabilitiesOfPeopleStandPlaceByPlace) {
  LayoutReport report = SampleReport();
  report.maps.push_back({.id = {Measure::kProbabilityMap, "standing"},
                         .title = "of a standing person",
                         .sectors = 4,
                         .rings = 2,
                         .value = {1, 0.5, -1, 0.25, -1, -1, 0, -1}});
  WriteReport(report, path());
  // Each quarter is 90 degrees left of the previous one; a ring is named by its outer side.
  EXPECT_THAT(Rows(path() / "people.csv"),
              ElementsAre(ElementsAre("map", "azimuth_deg", "distance_m", "probability"),
                          ElementsAre("person/standing/probability", "0", "1", "1"),
                          ElementsAre("person/standing/probability", "0", "2", "0.5"),
                          ElementsAre("person/standing/probability", "90", "2", "0.25"),
                          ElementsAre("person/standing/probability", "270", "1", "0")));
  EXPECT_TRUE(fs::exists(path() / "maps/person_standing_probability.png"));
  const std::string html = ReportPage(report);
  ExpectWellFormed(html);
  EXPECT_THAT(html, HasSubstr("Probability that lidars detect a person<"));
  EXPECT_THAT(html, HasSubstr("of a standing person"));
  EXPECT_THAT(ReportPage(SampleReport()),
              Not(HasSubstr("Probability that lidars detect a person<")));
}

TEST_F(WrittenReport, APageSaysWithWhatProbabilityAPersonIsDetected) {
  LayoutReport report = SampleReport();
  report.figures.push_back({{Measure::kProbability, "standing"}, {0.75, 0.25, 0.75, 0.75}, {}});
  report.figures.push_back({{Measure::kProbabilityOfQuarter, "standing", kLeft}, {0, 0, 0, 0}, {}});
  const std::string html = ReportPage(report);
  EXPECT_THAT(html, HasSubstr("mean over the places: 62.5 % on average"));
  EXPECT_THAT(html, HasSubstr("25.0 % at the worst moment (0.2 s)"));
  EXPECT_THAT(html, HasSubstr("probability that lidars detect a standing person: mean over the "
                              "places up to 12 m, left"));
}

TEST_F(WrittenReport, AFolderThatCannotBeMadeIsRefused) {
  WriteWholeFile(path() / "file", "");
  EXPECT_THROW(WriteReport(SampleReport(), path() / "file/front"), InputError);
}

TEST_F(WrittenReport, APageIsWellFormedAndAlone) {
  const std::string html = ReportPage(SampleReport());
  ExpectWellFormed(html);
  ExpectSelfContained(html);
  LayoutReport bare;
  bare.t_s = {0};
  ExpectWellFormed(ReportPage(bare));
}

TEST_F(WrittenReport, APageSaysTheAnswerFirst) {
  const std::string html = ReportPage(SampleReport());
  const std::size_t answer = html.find("50.0 %"), map = html.find("<svg");
  ASSERT_NE(answer, html.npos);
  EXPECT_LT(answer, map);
  // The worst moment, in terms of people, and its reason.
  EXPECT_THAT(html, HasSubstr("25.0 %"));
  EXPECT_THAT(html, HasSubstr("detected at every moment from 3 to 4 m behind"));
  EXPECT_THAT(html, HasSubstr("arm 75 %"));
  EXPECT_THAT(html, HasSubstr("inside of boom"));
}

TEST_F(WrittenReport, AMeanHasItsWorstMomentAndWhenThatIs) {
  const std::vector<std::string> lines = Answer(SampleReport());
  EXPECT_THAT(lines, testing::Contains(AllOf(
                         HasSubstr("space around"),
                         HasSubstr("50.0 % on average, 25.0 % at the worst moment (0.4 s)"))));
  EXPECT_THAT(lines, testing::Contains(
                         AllOf(HasSubstr("cutting edge"),
                               HasSubstr("37.5 % on average, 0.0 % at the worst moment (0 s)"))));
}

TEST_F(WrittenReport, OfSeveralPosturesTheHardestIsNamedFirstAndAllAreTold) {
  LayoutReport report = SampleReport();
  const auto add = [&](Measure measure, std::size_t quarter, std::vector<double> at) {
    report.figures.push_back({{measure, "lying", quarter}, std::move(at), {}});
  };
  // Nothing at the first moment behind; from 1 m on with a gap at the last moment on the left.
  add(Measure::kDetectedFrom, kLeft, {1, 1, 1, 1});
  add(Measure::kDetectedTo, kLeft, {5, 5, 6, 6});
  add(Measure::kDetectedOver, kLeft, {5, 5, 6, 4});
  add(Measure::kDetectedFrom, kBehind, {25, 1, 1, 1});
  add(Measure::kDetectedTo, kBehind, {0, 5, 5, 5});
  add(Measure::kDetectedOver, kBehind, {0, 5, 5, 5});
  report.figures.push_back({{Measure::kDetectedShare, "lying"}, {0.5, 0.5, 0.125, 0.5}, {}});
  const std::vector<std::string> lines = Answer(report);
  EXPECT_THAT(lines,
              testing::Contains(
                  "A lying person is the hardest to detect; share of the places up to 12 m from "
                  "the machine: 40.6 % on average, 12.5 % at the worst moment (0.4 s)."));
  EXPECT_THAT(lines, testing::Contains("A lying person is detected at every moment from 1 to 5 m "
                                       "(with gaps) to the left; at no distance behind."));
  EXPECT_THAT(lines, testing::Contains(
                         "A standing person is detected at every moment from 3 to 4 m behind."));
  EXPECT_THAT(ReportPage(report),
              HasSubstr("<td>lying</td><td>behind</td><td>at no distance</td>"));
}

TEST_F(WrittenReport, APageSaysOfHowManySensorsCostAndPowerAre) {
  LayoutReport report = SampleReport();
  EXPECT_THAT(ReportPage(report),
              HasSubstr("cost 4500 (2 of 3 sensors priced), power 8.5 W (1 of 3 sensors with a "
                        "power), 33.2 MB/s of raw data"));
  report.expense = {0, 0, 1, 3, 0, 0};
  EXPECT_THAT(ReportPage(report), HasSubstr("cost unknown (no sensor priced), power unknown"));
}

TEST_F(WrittenReport, APageSaysWhatAQuarterIsAndFromWhereItMeasures) {
  const std::string html = ReportPage(SampleReport());
  EXPECT_THAT(html, AllOf(HasSubstr("within 45°"), HasSubstr("machine's outline")));
}

TEST_F(WrittenReport, WhatLooksLikeMarkupIsText) {
  LayoutReport report = SampleReport(kMarkup);
  report.file = report.cycle = report.viewers[0] = report.warnings[0] = kMarkup;
  report.maps[0].title = report.curves[0].title = kMarkup;
  report.blind_causes[kMarkup][kMarkup] = report.blind_causes["around"][kMarkup] = 0.5;
  report.overlaps[kMarkup][kMarkup] = 0.5;
  for (const FigureId& id : std::vector<FigureId>{{Measure::kSeenBy2, kMarkup},
                                                  {Measure::kDetectedTo, kMarkup, kLeft},
                                                  {Measure::kLoadSeen, kMarkup},
                                                  {Measure::kSkyHidden, kMarkup},
                                                  {Measure::kAngleSigma, kMarkup}}) {
    report.figures.push_back({id, {0, 0, 0, 0}, {}});
  }
  const std::string html = ReportPage(report);
  ExpectWellFormed(html);
  EXPECT_THAT(html, Not(HasSubstr("<b>")));
  EXPECT_THAT(html, HasSubstr(kEscapedMarkup));
}

// Kinds of colours, so that slight shades do not matter.
enum class Hue { kRed, kBlue, kGrey, kPaper };

Hue HueAt(const Image<std::uint8_t>& rgb, int x_px, int y_px) {
  const int r = rgb.at(x_px, y_px, 0), g = rgb.at(x_px, y_px, 1), b = rgb.at(x_px, y_px, 2);
  if (r == 255 && g == 255 && b == 255) return Hue::kPaper;
  if (r > b + 50) return Hue::kRed;
  if (b > r + 50) return Hue::kBlue;
  return Hue::kGrey;
}

TEST_F(WrittenReport, OfAMapAheadIsUpAndLeftIsLeft) {
  LayoutReport report = SampleReport();
  PolarMap& map = report.maps[0];
  map = SampleMap(0);
  const auto fill = [&](int sector, double value) {
    for (int ring = 0; ring < map.rings; ++ring) map.value[sector * map.rings + ring] = value;
  };
  fill(0, 1);    // ahead
  fill(18, -1);  // left: counterclockwise from above
  const Image<std::uint8_t> rgb = DrawMap(map, 480);
  const int size_px = rgb.width_px, middle_px = size_px / 2, some_px = size_px / 4;
  ASSERT_EQ(rgb.height_px, size_px);
  ASSERT_GT(size_px, 100);
  EXPECT_EQ(HueAt(rgb, middle_px, middle_px - some_px), Hue::kBlue);
  EXPECT_EQ(HueAt(rgb, middle_px - some_px, middle_px), Hue::kGrey);
  EXPECT_EQ(HueAt(rgb, middle_px, middle_px + some_px), Hue::kRed);
  EXPECT_EQ(HueAt(rgb, middle_px + some_px, middle_px), Hue::kRed);
  EXPECT_EQ(HueAt(rgb, 0, 0), Hue::kPaper);
  EXPECT_EQ(HueAt(rgb, size_px - 1, 0), Hue::kPaper);
  // A sector is 5 degrees wide about its direction.
  EXPECT_EQ(HueAt(rgb, middle_px + some_px / 9, middle_px - some_px), Hue::kRed);
}

TEST_F(WrittenReport, AMapAsAFileHasItsTitleAboveAndItsColoursBelow) {
  WriteReport(SampleReport(), path());
  const Image<std::uint8_t> rgb = ReadRgbPng(path() / "maps/seen_0.9_m.png");
  ASSERT_GT(rgb.height_px, rgb.width_px);
  const auto dark_in = [&](int from_px, int to_px) {
    int dark = 0;
    for (int y = from_px; y < to_px; ++y) {
      for (int x = 0; x < rgb.width_px; ++x) dark += rgb.at(x, y, 0) < 60;
    }
    return dark;
  };
  EXPECT_GT(dark_in(0, 40), 100);
  const int below_px = (rgb.height_px + rgb.width_px) / 2 + 10;
  EXPECT_EQ(HueAt(rgb, 10, below_px), Hue::kRed);
  EXPECT_EQ(HueAt(rgb, rgb.width_px - 10, below_px), Hue::kBlue);
}

TEST_F(WrittenReport, OfAMapWithTicksWhatIsNothingIsNotWhatIsPoor) {
  LayoutReport report = SampleReport();
  PolarMap pixels = SampleMap(0);
  pixels.id = {Measure::kPixelMap, "1.5"};
  pixels.high = 250;
  pixels.ticks = {0, 25, 62.5, 125, 250};
  const Image<std::uint8_t> none = DrawMap(pixels, 100);
  EXPECT_EQ(HueAt(none, 50, 20), Hue::kGrey);
  pixels.value.assign(pixels.value.size(), 5);
  EXPECT_EQ(HueAt(DrawMap(pixels, 100), 50, 20), Hue::kRed);
  // The middle of the colours is the middle tick, however high the last is.
  pixels.value.assign(pixels.value.size(), 62.5);
  const Image<std::uint8_t> middle = DrawMap(pixels, 100);
  for (int c = 0; c < 3; ++c) EXPECT_GT(middle.at(50, 20, c), 200) << c;
  report.maps = {pixels};
  EXPECT_THAT(ReportPage(report), HasSubstr("0, 25, 62.5, 125, 250; dark grey: none"));
}

TEST_F(WrittenReport, MapsAboutTheMachineHaveItsOutline) {
  LayoutReport report = SampleReport();
  EXPECT_THAT(ReportPage(report), Not(HasSubstr("class=\"machine\"")));
  report.outline_m.assign(72, 3);
  EXPECT_THAT(ReportPage(report), HasSubstr("class=\"machine\""));
  report.maps[0].id = {Measure::kDetectedMap, "standing"};  // measured from the outline
  EXPECT_THAT(ReportPage(report), Not(HasSubstr("class=\"machine\"")));
}

TEST_F(WrittenReport, OfAMapRingsLieInOrderFromTheMiddle) {
  PolarMap map = SampleMap(0);
  for (int sector = 0; sector < map.sectors; ++sector) {
    for (int ring = 0; ring < 12; ++ring) map.value[sector * map.rings + ring] = 1;
  }
  const Image<std::uint8_t> rgb = DrawMap(map, 200);
  // Along any direction, equal parts of the disc's radius are blue and red, to a pixel each.
  for (const auto& [dx, dy] : {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1)}) {
    std::array<int, 4> count = {};
    for (int r = 1; r < 100; ++r) {
      ++count[static_cast<std::size_t>(HueAt(rgb, 100 + r * dx, 100 + r * dy))];
    }
    EXPECT_NEAR(count[std::size_t(Hue::kBlue)], count[std::size_t(Hue::kRed)], 2);
    EXPECT_GT(count[std::size_t(Hue::kRed)], 30);
    EXPECT_EQ(count[std::size_t(Hue::kGrey)], 0);
  }
}

TEST(ColourOfAShare, GoesFromRedByWhiteToBlue) {
  const auto low = ColourOf(0), middle = ColourOf(0.5), high = ColourOf(1);
  EXPECT_GT(low[0], low[2] + 50);
  EXPECT_GT(high[2], high[0] + 50);
  EXPECT_GT(std::min({middle[0], middle[1], middle[2]}), 200);
  EXPECT_EQ(ColourOf(-3), low);
  EXPECT_EQ(ColourOf(7), high);
}

}  // namespace
}  // namespace tera
