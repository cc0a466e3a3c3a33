#include "layout/report/report_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/sample_recording.h"
#include "layout/report/sample_report.h"

namespace tera {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;
namespace fs = std::filesystem;

void ExpectSame(const LayoutReport& a, const LayoutReport& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.file, b.file);
  EXPECT_EQ(a.cycle, b.cycle);
  EXPECT_EQ(a.asked_sha256, b.asked_sha256);
  EXPECT_EQ(a.viewers, b.viewers);
  EXPECT_EQ(a.expense.cost, b.expense.cost);
  EXPECT_EQ(a.expense.power_w, b.expense.power_w);
  EXPECT_EQ(a.expense.data_mbyteps, b.expense.data_mbyteps);
  EXPECT_EQ(a.expense.sensors, b.expense.sensors);
  EXPECT_EQ(a.expense.priced, b.expense.priced);
  EXPECT_EQ(a.expense.powered, b.expense.powered);
  EXPECT_EQ(a.t_s, b.t_s);
  EXPECT_EQ(a.outline_m, b.outline_m);
  ASSERT_EQ(a.figures.size(), b.figures.size());
  for (std::size_t i = 0; i < a.figures.size(); ++i) {
    const Figure &f = a.figures[i], &g = b.figures[i];
    EXPECT_EQ(f.id, g.id);
    EXPECT_EQ(f.at, g.at);
    EXPECT_EQ(f.error, g.error);
  }
  ASSERT_EQ(a.maps.size(), b.maps.size());
  for (std::size_t i = 0; i < a.maps.size(); ++i) {
    const PolarMap &m = a.maps[i], &n = b.maps[i];
    EXPECT_EQ(m.id, n.id);
    EXPECT_EQ(m.title, n.title);
    EXPECT_EQ(m.sectors, n.sectors);
    EXPECT_EQ(m.rings, n.rings);
    EXPECT_EQ(m.ring_m, n.ring_m);
    EXPECT_EQ(m.ring_unit, n.ring_unit);
    EXPECT_EQ(m.low, n.low);
    EXPECT_EQ(m.high, n.high);
    EXPECT_EQ(m.value, n.value);
    EXPECT_EQ(m.ticks, n.ticks);
  }
  ASSERT_EQ(a.curves.size(), b.curves.size());
  for (std::size_t i = 0; i < a.curves.size(); ++i) {
    EXPECT_EQ(a.curves[i].id, b.curves[i].id);
    EXPECT_EQ(a.curves[i].title, b.curves[i].title);
    EXPECT_EQ(a.curves[i].most, b.curves[i].most);
    EXPECT_EQ(a.curves[i].mean, b.curves[i].mean);
    EXPECT_EQ(a.curves[i].worst, b.curves[i].worst);
    EXPECT_EQ(a.curves[i].worst_from, b.curves[i].worst_from);
  }
  EXPECT_EQ(a.blind_causes, b.blind_causes);
  EXPECT_EQ(a.overlaps, b.overlaps);
  EXPECT_EQ(a.warnings, b.warnings);
}

class ReportFile : public testing::Test {
 protected:
  fs::path file() const { return scratch_.path() / "front/layout.json"; }
  LayoutReport Read(const std::string& text) const {
    fs::create_directories(file().parent_path());
    WriteWholeFile(file(), text);
    return ReadReport(file());
  }
  void ExpectRefused(const std::string& text) const {
    EXPECT_THAT([&] { Read(text); },
                ThrowsMessage<InputError>(AllOf(HasSubstr(file().string()), HasSubstr("evaluate"))))
        << text.substr(0, 200);
  }
  void ExpectRefused(const std::string& from, const std::string& to) const {
    std::string text = ReportJson(SampleReport());
    const std::size_t at = text.find(from);
    ASSERT_NE(at, text.npos) << from;
    ExpectRefused(text.replace(at, from.size(), to));
  }

  const ScratchDirectory scratch_;
};

TEST_F(ReportFile, IsReadAsItWasWritten) {
  const LayoutReport report = SampleReport();
  ExpectSame(Read(ReportJson(report)), report);
  ExpectSame(ReadReport(file().parent_path()), report);
}

TEST_F(ReportFile, NumbersAreReadToTheLastBit) {
  LayoutReport report = SampleReport();
  report.figures[0].at = {1.0 / 3, 2e-17, 1e300, -0.1 - 0.2};
  report.t_s = {0.1, 0.1 + 0.2, 0.7, 1e6 / 3};
  report.maps[0].value[5] = 1.0 / 7;
  ExpectSame(Read(ReportJson(report)), report);
}

TEST_F(ReportFile, ListsMayBeEmptyAndTextsAnything) {
  LayoutReport report;
  report.name = kMarkup;
  report.file = "with \\ and\nlines\tand \x01";
  report.cycle = "größer €";
  report.t_s = {0.5};
  ExpectSame(Read(ReportJson(report)), report);
  report.figures = {{{Measure::kSkyHidden, "a"}, {2}, {}}};
  report.maps = {PolarMap{
      .id = {Measure::kSeenMap, "0"}, .title = "", .sectors = 1, .rings = 1, .value = {-1}}};
  report.curves = {PolarCurve{.id = {Measure::kPixelCurve, "x"}}};
  report.warnings = {""};
  report.blind_causes = {{"", {}}};
  ExpectSame(Read(ReportJson(report)), report);
}

TEST_F(ReportFile, ANameThatIsNotUtf8DoesNotKeepItFromBeingWritten) {
  LayoutReport report = SampleReport();
  report.file = "gr\xfc\xdf.yaml";
  EXPECT_EQ(Read(ReportJson(report)).figures.size(), report.figures.size());
}

TEST_F(ReportFile, CutShortItIsRefused) {
  const std::string whole = ReportJson(SampleReport());
  for (std::size_t length = 0; length + 2 < whole.size(); length += 1 + whole.size() / 60) {
    ExpectRefused(whole.substr(0, length));
  }
}

TEST_F(ReportFile, CutShortItSaysWhereItBreaksOffAndNothingOfHowItIsRead) {
  const std::string half = ReportJson(SampleReport()).substr(0, 1000);
  EXPECT_THAT([&] { Read(half); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("is not valid JSON"), HasSubstr("of 1000"),
                                              testing::Not(HasSubstr("json.exception")))));
  EXPECT_THAT([&] { Read("{}"); },
              ThrowsMessage<InputError>(testing::Not(HasSubstr("json.exception"))));
}

TEST_F(ReportFile, WhatIsNoReportIsRefused) {
  for (const char* text : {"{}", "[]", "null", "3", "\"format\"", "format: 2", "{\"format\": 2}"}) {
    ExpectRefused(text);
  }
}

TEST_F(ReportFile, AnotherFormatIsRefused) {
  for (const char* other : {"1", "3", "0", "\"1\"", "null", "1.5", "[1]"}) {
    ExpectRefused("\"format\": 2", std::string("\"format\": ") + other);
  }
}

TEST_F(ReportFile, ValuesOfAnotherTypeAreRefused) {
  ExpectRefused("\"name\": \"front\"", "\"name\": 3");
  ExpectRefused("\"cost\": 4500.0", "\"cost\": \"dear\"");
  ExpectRefused("\"cost\": 4500.0", "\"cost\": null");
  ExpectRefused("\"more_is_better\": true", "\"more_is_better\": \"yes\"");
  ExpectRefused("\"unit\": \"\"", "\"unit\": []");
  ExpectRefused("zone/around/seen_by_1", "zone/around/seen_by_none");
  ExpectRefused("\"sectors\": 72", "\"sectors\": \"72\"");
  ExpectRefused("\"most\": 24.0", "\"most\": {}");
  ExpectRefused("\"out of view\": 0.25", "\"out of view\": \"0.25\"");
  ExpectRefused("\"lidar\"", "7");
}

TEST_F(ReportFile, CountsThatDoNotFitAreRefused) {
  ExpectRefused("\"sectors\": 72", "\"sectors\": 71");
  ExpectRefused("\"rings\": 24", "\"rings\": 0");
  ExpectRefused("\"rings\": 24", "\"rings\": 1000000000");
  ExpectRefused("\"rings\": 24,", "\"rings\": -24,");
  for (const char* list : {"\"t_s\": [", "\"at\": [", "\"sampling_error_at\": ["}) {
    ExpectRefused(list, std::string(list) + "0.5,");
  }
  std::string both_negative = ReportJson(SampleReport());
  both_negative.replace(both_negative.find("\"rings\": 24"), 11, "\"rings\": -24");
  both_negative.replace(both_negative.find("\"sectors\": 72"), 13, "\"sectors\": -72");
  ExpectRefused(both_negative);
}

TEST_F(ReportFile, OneWithoutMomentsIsRefused) {
  LayoutReport report = SampleReport();
  report.t_s.clear();
  report.figures.clear();
  ExpectRefused(ReportJson(report));
}

TEST_F(ReportFile, OneThatIsNotThereIsRefused) {
  EXPECT_THAT([&] { ReadReport(scratch_.path() / "absent"); },
              ThrowsMessage<InputError>(HasSubstr("absent")));
  EXPECT_THAT([&] { ReadReport(scratch_.path()); },
              ThrowsMessage<InputError>(HasSubstr("layout.json")));
}

}  // namespace
}  // namespace tera
