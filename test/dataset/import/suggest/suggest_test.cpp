#include "dataset/import/suggest/suggest.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "dataset/export/export.h"
#include "dataset/format/recording.h"
#include "dataset/format/sample_recording.h"
#include "dataset/import/import_csv.h"

namespace tera {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

class Suggest : public ::testing::Test {
 protected:
  /// The mapping of a table, which the import must accept.
  std::string OfTable(const std::string& text) {
    WriteWholeFile(scratch_.path() / "log.csv", text);
    return Checked(scratch_.path() / "log.csv");
  }
  std::string Checked(const fs::path& log) {
    const std::string yaml = SuggestMapping(log);
    WriteWholeFile(scratch_.path() / "mapping.yaml", yaml);
    try {
      ImportCsv(scratch_.path() / "mapping.yaml", "", {.checks_only = true});
    } catch (const InputError& fault) {
      ADD_FAILURE() << fault.what() << "\n" << yaml;
    }
    return yaml;
  }
  ScratchDirectory scratch_;
};

TEST_F(Suggest, UnitsOfATableComeFromItsNumbers) {
  const std::string yaml = OfTable(
      "time,gyro_x,gyro_y,gyro_z,acc_x,acc_y,acc_z,boom,lever\n"
      "1700000000000,1,-45,0,0.01,0.02,1.0,30,0.5\n"
      "1700000000010,2,-44,0,0.01,0.02,1.0,31,0.6\n"
      "1700000000020,3,-43,0,0.01,0.02,1.0,32,0.7\n");
  EXPECT_THAT(yaml,
              AllOf(HasSubstr("time: {column: time, unit: ms}\nzero: start\n"),
                    HasSubstr("wx: {column: gyro_x, unit: deg/s}   # guessed: "),
                    HasSubstr("az: {column: acc_z, unit: g}\n"),
                    HasSubstr("{name: boom, angle: {column: boom, unit: deg}}\n"),
                    HasSubstr("lever: {column: lever, unit: '1'}   # guessed: unit unknown")));
}

TEST_F(Suggest, NamesThatSayTheirUnitAreBelieved) {
  const std::string yaml = OfTable(
      "t_us,wx_radps,wy_radps,wz_radps,ax,ay,az,boom_deg\n"
      "10,30,0,0,0,0,9.8,0.1\n20,30,0,0,0,0,9.8,0.2\n");
  EXPECT_THAT(yaml, AllOf(HasSubstr("time: {column: t_us, unit: us}\n"), Not(HasSubstr("zero")),
                          HasSubstr("wx: {column: wx_radps, unit: rad/s}\n"),
                          HasSubstr("ax: {column: ax, unit: m/s2}\n"),
                          HasSubstr("angle: {column: boom_deg, unit: deg}}\n")));
}

TEST_F(Suggest, AColumnThatIsTakenIsNotThereTwice) {
  const std::string yaml = OfTable(
      "t_s,boom_deg,gyro_x,gyro_y,gyro_z,acc_x,acc_y,acc_z,fuel\n"
      "0,1,0,0,0,0,0,9.8,7\n1,2,0,0,0,0,0,9.8,7\n");
  for (const std::string column : {"boom_deg", "gyro_x", "acc_z", "fuel"}) {
    const std::string mapped = "{column: " + column + ",";
    const std::size_t first = yaml.find(mapped);
    ASSERT_NE(first, std::string::npos) << column;
    EXPECT_EQ(yaml.find(mapped, first + 1), std::string::npos) << yaml;
  }
}

TEST_F(Suggest, LeversByTheirNamesAreCommandsInPerCentWhereTheyAreBeyondFull) {
  EXPECT_THAT(
      OfTable("t_s,lever_boom,arm_cmd,lever_left_track,fuel\n0,0,-80,0,7\n1,60,10,0,7\n"),
      HasSubstr("tables:\n  - name: commands\n    columns:\n"
                "      boom: {column: lever_boom, unit: '%'}   # guessed: up to 60\n"
                "      arm: {column: arm_cmd, unit: '%'}   # guessed: up to 80\n"
                "      left_track: {column: lever_left_track, unit: '%'}   # guessed: up to 0\n"
                "  - name: others\n"));
  EXPECT_THAT(OfTable("t_s,boom_lever\n0,0.5\n1,-1\n"),
              HasSubstr("boom: {column: boom_lever, unit: '1'}   # guessed: up to 1\n"));
}

TEST_F(Suggest, EpochsAreToldByTheirSize) {
  for (const auto& [first, unit] : {std::pair{"1700000000.5", "s"},
                                    {"1700000000500", "ms"},
                                    {"1700000000500000", "us"},
                                    {"1700000000500000000", "ns"}}) {
    const std::string second = std::string(first).substr(0, std::string(first).find_last_of('5'));
    const std::string later = std::string(first).replace(second.size(), 1, "9");
    EXPECT_THAT(OfTable(fmt::format("stamp,v\n{},1\n{},2\n", first, later)),
                AllOf(HasSubstr(fmt::format("time: {{column: stamp, unit: {}}}\n", unit)),
                      HasSubstr("zero: start")));
  }
}

TEST_F(Suggest, PlacesAreInDegreesOrRadians) {
  EXPECT_THAT(OfTable("t_s,lat,lon,alt\n0,46.78,-71.27,90\n1,46.78,-71.27,90\n"),
              AllOf(HasSubstr("lat: {column: lat, unit: deg}"),
                    HasSubstr("origin: {lat_deg: 46.7800000, lon_deg: -71.2700000")));
  EXPECT_THAT(OfTable("t_s,lat,lon,alt\n0,0.816,-1.244,90\n1,0.816,-1.244,90\n"),
              AllOf(HasSubstr("lat: {column: lat, unit: rad}   # guessed"),
                    HasSubstr("origin: {lat_deg: 46.75")));
}

TEST_F(Suggest, ATableWithoutAHeaderHasItsColumnsByNumber) {
  EXPECT_THAT(OfTable("1700000000000;1.5;7\n1700000000010;2.5;8\n1700000000020;0.5;9\n"),
              AllOf(HasSubstr("csv: {header: false}"), HasSubstr("column: \"1\", unit: ms}"),
                    HasSubstr("column_2: {column: \"2\", unit: '1'}")));
}

TEST_F(Suggest, ABagIsMappedByItsTypes) {
  WriteWholeSample(scratch_.path() / "run", {});
  Export(scratch_.path() / "run", scratch_.path() / "bag", {.format = ExportFormat::kRosbag2});
  for (const char* name : {"bag", "bag/bag_0.mcap"}) {
    const std::string yaml = Checked(scratch_.path() / name);
    EXPECT_THAT(yaml, AllOf(HasSubstr("machine: digger   # guessed"),
                            HasSubstr("topic: \"/digger/imu\"   # 6 messages, 10 Hz\n"),
                            HasSubstr("topic: \"/digger/gps/fix\""), HasSubstr("lat_deg: 46.78"),
                            HasSubstr("topic: \"/digger/joints\""), HasSubstr("pose:"),
                            HasSubstr("{name: digger_front_image_raw, topic: "),
                            HasSubstr("uncalibrated: true}"),
                            HasSubstr("#   /digger/front/instance/image_raw (sensor_msgs/Image)")));
  }
}

TEST_F(Suggest, WhatIsNoLogIsToldOf) {
  WriteWholeFile(scratch_.path() / "README.md", "# A page\n\nof words, and of no number.\n");
  EXPECT_THAT([&] { SuggestMapping(scratch_.path() / "README.md"); },
              testing::ThrowsMessage<InputError>(HasSubstr("README.md: has no column of numbers")));
  WriteWholeFile(scratch_.path() / "log.mcap", "nothing");
  EXPECT_THROW(SuggestMapping(scratch_.path() / "log.mcap"), InputError);
  EXPECT_THROW(SuggestMapping(scratch_.path() / "none.csv"), InputError);
}

}  // namespace
}  // namespace tera
