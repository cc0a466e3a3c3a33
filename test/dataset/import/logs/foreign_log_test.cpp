#include "dataset/import/logs/foreign_log.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/units.h"
#include "dataset/export/export.h"
#include "dataset/format/epoch.h"
#include "dataset/format/recording.h"
#include "dataset/format/sample_recording.h"
#include "dataset/import/import_csv.h"
#include "dataset/import/logs/log_time.h"
#include "dataset/import/suggest/suggest.h"

/// Logs of known form, by hand and from the exporter.

namespace tera {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;
namespace fs = std::filesystem;

constexpr char kOrigin[] = "origin: {lat_deg: 46.78, lon_deg: -71.27, height_m: 90.5}\n";
constexpr char kReceiver[] = "gnss: [{name: gnss}]\n";

class ForeignLog : public ::testing::Test {
 protected:
  ImportReport Import(const std::string& file, const std::string& keys,
                      const ImportOptions& options = {}) {
    WriteWholeFile(scratch_.path() / "mapping.yaml",
                   "name: logged\nmachine: digger\nfile: " + file + "\n" + keys);
    fs::remove_all(Out());
    return ImportCsv(scratch_.path() / "mapping.yaml", Out(), options);
  }
  ImportReport ImportSuggested(const fs::path& log) {
    WriteWholeFile(scratch_.path() / "mapping.yaml", SuggestMapping(log));
    fs::remove_all(Out());
    return ImportCsv(scratch_.path() / "mapping.yaml", Out());
  }
  std::string FaultOf(const std::string& file, const std::string& keys = kReceiver,
                      const ImportOptions& options = {}) {
    try {
      Import(file, "zero: start\n" + std::string(kOrigin) + keys, options);
    } catch (const InputError& fault) {
      EXPECT_FALSE(fs::exists(Out()) || fs::exists(Out().string() + ".incomplete"));
      return fault.what();
    }
    return "no fault";
  }
  void Log(const std::string& name, const std::string& text) {
    fs::create_directories((scratch_.path() / name).parent_path());
    WriteWholeFile(scratch_.path() / name, text);
  }
  fs::path Exported(ExportFormat format) {
    WriteWholeSample(scratch_.path() / "run", {});
    Export(scratch_.path() / "run", scratch_.path() / "export", {.format = format});
    return scratch_.path() / "export";
  }
  std::vector<GnssSample> Fixes() const { return Recording(Out()).LoadGnss("digger/gnss"); }
  TableRecording Table() const { return Recording(Out()).LoadTable("digger/t.csv"); }
  fs::path Out() const { return scratch_.path() / "out"; }

  ScratchDirectory scratch_;
};

// --- Round trips: equal numbers, to the form's digits.

TEST_F(ForeignLog, ASolutionFileComesBack) {
  Exported(ExportFormat::kPos);
  Import("export/digger/gnss.pos", "zero: start\n" + std::string(kOrigin) + kReceiver);
  const auto fixes = Fixes();
  ASSERT_EQ(fixes.size(), 6u);
  for (int k = 0; k < kSampleFrames; ++k) {
    const GnssSample &s = fixes[static_cast<std::size_t>(k)], expected = SampleGnss(k);
    EXPECT_EQ(s.t_ns, expected.t_ns);
    EXPECT_NEAR(s.lat_deg, expected.lat_deg, 0.51e-9);
    EXPECT_NEAR(s.lon_deg, expected.lon_deg, 0.51e-9);
    EXPECT_NEAR(s.alt_m, expected.alt_m, 0.51e-4);
    EXPECT_EQ(s.fix, expected.fix);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(std::sqrt(s.variance_enu_m2[axis]), std::sqrt(expected.variance_enu_m2[axis]),
                  0.51e-4);
    }
  }
}

TEST_F(ForeignLog, SentencesComeBack) {
  Exported(ExportFormat::kNmea);
  Import("export/digger/gnss.nmea", "zero: start\n" + std::string(kOrigin) + kReceiver);
  const auto fixes = Fixes();
  ASSERT_EQ(fixes.size(), 6u);
  for (int k = 0; k < kSampleFrames; ++k) {
    const GnssSample &s = fixes[static_cast<std::size_t>(k)], expected = SampleGnss(k);
    EXPECT_EQ(s.t_ns, expected.t_ns);
    EXPECT_NEAR(s.lat_deg, expected.lat_deg, 0.51e-7 / 60);
    EXPECT_NEAR(s.lon_deg, expected.lon_deg, 0.51e-7 / 60);
    EXPECT_NEAR(s.alt_m, expected.alt_m, 0.51e-4);
    EXPECT_EQ(s.fix, expected.fix);
    EXPECT_NEAR(std::sqrt(s.variance_enu_m2.y()), std::sqrt(0.02), 0.51e-4);
  }
}

TEST_F(ForeignLog, AFolderOfEurocsFilesComesBackBySuggestion) {
  const fs::path folder = Exported(ExportFormat::kEuroc);
  ImportSuggested(folder);
  const Recording recording(Out());
  const auto imu = recording.LoadImu("machine/imu");
  const auto poses = recording.LoadPose("truth/machine/pose.csv").poses;
  ASSERT_EQ(imu.size(), 6u);
  ASSERT_EQ(poses.size(), 6u);
  for (int k = 0; k < kSampleFrames; ++k) {
    const auto i = static_cast<std::size_t>(k);
    EXPECT_EQ(imu[i].t_ns, SampleImu(k).t_ns);
    EXPECT_EQ(imu[i].w_WS_S_radps, SampleImu(k).w_WS_S_radps);
    EXPECT_EQ(imu[i].f_S_mps2, SampleImu(k).f_S_mps2);
    EXPECT_TRUE(poses[i].X_WB.isApprox(SamplePose(k).X_WB, 1e-12));
  }
}

TEST_F(ForeignLog, SuggestionsForReceiversComeIn) {
  const fs::path pos = Exported(ExportFormat::kPos) / "digger/gnss.pos";
  ImportSuggested(pos);
  EXPECT_EQ(Recording(Out()).LoadGnss("machine/gnss").size(), 6u);
  fs::remove_all(scratch_.path() / "export");
  fs::remove_all(scratch_.path() / "run");
  ImportSuggested(Exported(ExportFormat::kNmea) / "digger/gnss.nmea");
  EXPECT_NEAR(Recording(Out()).LoadGnss("machine/gnss")[0].enu_m.norm(), 0, 1e-3);
}

// --- NMEA 0183. The three sentences are from common descriptions of the format.

constexpr char kGga[] = "$GPGGA,123519,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,*47\r\n";
constexpr char kRmc[] = "$GPRMC,123519,A,4807.038,N,01131.000,E,022.4,084.4,230394,003.1,W*6A\r\n";
constexpr char kVtg[] = "$GPVTG,054.7,T,034.4,M,005.5,N,010.2,K*48\r\n";
constexpr char kNmeaTable[] =
    "tables: [{name: t, columns: {lat: {column: latitude, unit: '1'}, alt: {column: altitude, "
    "unit: '1'}, speed: {column: speed, unit: '1'}, course: {column: course, unit: '1'}}}]\n";

TEST_F(ForeignLog, SentencesOfOneTimeAreOneRow) {
  Log("log.nmea", std::string("# by hand\n\n") + kGga + kRmc);
  Import("log.nmea", "time: {column: time, offset: -764426000}\n" + std::string(kNmeaTable));
  TableRecording table = Table();
  EXPECT_THAT(table.t_ns, ElementsAre(119 * kNsPerSecond));  // 23 March 1994, 12:35:19
  EXPECT_NEAR(table.rows[0][0], 48 + 7.038 / 60, 1e-12);
  EXPECT_NEAR(table.rows[0][1], 545.4 + 46.9, 1e-12);  // above the ellipsoid
  EXPECT_NEAR(table.rows[0][2], 22.4 * 1852 / 3600, 1e-12);
  EXPECT_EQ(table.rows[0][3], 84.4);
  Log("log.nmea", std::string(kGga) + kRmc + kVtg);
  Import("log.nmea", "time: {column: time, offset: -764426000}\n" + std::string(kNmeaTable));
  table = Table();
  EXPECT_NEAR(table.rows[0][2], 5.5 * 1852 / 3600, 1e-12);
  EXPECT_EQ(table.rows[0][3], 54.7);
}

std::string Sentence(const std::string& body) {
  unsigned sum = 0;
  for (const char c : body) sum ^= static_cast<unsigned char>(c);
  return fmt::format("${}*{:02x}\r\n", body, sum);
}

// Headings follow a position of the same time. After midnight the next date applies; before the
// first date, the one that leads up to it.
TEST_F(ForeignLog, DatesGoOnOverMidnightAndBack) {
  Log("log.nmea",
      Sentence("GNGGA,235959.50,4807.0,N,01131.0,E,4,,,500,M,,M,,") + Sentence("GNHDT,12.5,T") +
          Sentence("GNGGA,000000.25,4807.0,N,01131.0,E,4,,,500,M,,M,,") +
          Sentence("GNZDA,000000.25,02,01,2024,00,00") + Sentence("GNHDT,13.5,T") +
          Sentence("GNGGA,235959.75,4807.0,N,01131.0,E,4,,,500,M,,M,,") + Sentence("GNHDT,14.5,T") +
          Sentence("GNGGA,000001.00,4807.0,N,01131.0,E,4,,,500,M,,M,,") + Sentence("GNHDT,15.5,T"));
  Import("log.nmea",
         "zero: start\ntables: [{name: t, columns: {h: {column: heading, unit: deg}}}]\n");
  const TableRecording table = Table();
  constexpr TimeNs kDay_ns = 86'400 * kNsPerSecond;
  EXPECT_THAT(table.t_ns,
              ElementsAre(0, 750'000'000, kDay_ns + 250'000'000, kDay_ns + 1'500'000'000));
  EXPECT_NEAR(table.rows[3][0], 15.5 * kDeg, 1e-12);
}

TEST_F(ForeignLog, ABadChecksumIsAFaultOrCounted) {
  std::string bad = kRmc;
  bad[40] = '9';
  std::string more;  // as many rows as are skipped
  for (int k = 30; k < 36; ++k) {
    more += Sentence(fmt::format("GPGGA,1235{},4807.038,N,01131.0,E,1,8,1,500,M,40,M,,", k));
  }
  Log("log.nmea", std::string(kGga) + bad + "\xb5\x62 binary\n" + "$GPRMC,1235,A*00\n" +
                      Sentence("GPRMC,123519,A,4807.038,N,01131.0,E,1,2,320394,,") +
                      Sentence("GPGGA,123520,4860.038,N,01131.0,E,1,8,1,500,M,40,M,,") +
                      Sentence("GNZDA,123520,02,01,7.8e86,00,00") +
                      Sentence("GPGSV,3,1,11,03,03,111,00") + more + "$GPGGA,123521,48");
  const std::string keys =
      "gnss: [{name: gnss, columns: {var_e: {constant: 4}, var_n: {constant: 4}, var_u: "
      "{constant: 9}}}]\n";
  EXPECT_THAT(FaultOf("log.nmea", keys),
              AllOf(HasSubstr("log.nmea:2: its checksum does not match the sentence"),
                    HasSubstr("--skip-bad-rows")));
  const ImportReport report = Import(
      "log.nmea", "zero: start\norigin: {lat_deg: 48.1, lon_deg: 11.5, height_m: 500}\n" + keys,
      {.skips_bad_rows = true});
  ASSERT_EQ(report.channels.size(), 1u);
  EXPECT_EQ(report.channels[0].rows, 7);
  // The changed line, a line of another kind, a wrong checksum, an invalid date, minutes beyond 60,
  // a year beyond any integer, and a truncated line.
  EXPECT_EQ(report.channels[0].left_out, 7);
}

TEST_F(ForeignLog, WithoutDeviationsTheMappingMustSayThem) {
  Log("log.nmea", kGga);
  EXPECT_THAT(
      FaultOf("log.nmea"),
      AllOf(HasSubstr("log.nmea:1: has a fix, but its position or variance is not a number"),
            HasSubstr("var_e: {constant: 4}")));
  EXPECT_THAT(SuggestMapping(scratch_.path() / "log.nmea"), HasSubstr("guessed: there is no GST"));
  ImportSuggested(scratch_.path() / "log.nmea");
}

// --- .pos

constexpr char kGpsHeader[] =
    "% program   : rtkpost ver.2.4.2\n% inp file  : height.obs\n%\n"
    "% (lat/lon/height=WGS84/ellipsoidal,Q=1:fix,2:float,3:sbas,4:dgps,5:single,6:ppp,ns=# of "
    "satellites)\n"
    "%  GPST                  latitude(deg) longitude(deg)  height(m)   Q  ns   sdn(m)   sde(m)   "
    "sdu(m)  sdne(m)  sdeu(m)  sdun(m) age(s)  ratio\n";
constexpr char kRest[] = "46.78 -71.27 90.5 1 9 0.01 0.02 0.03 0 0 0 0.5 12.5\n";

// Since 2017 GPS time is 18 s ahead of UTC; week 2295 began on 31 December 2023.
TEST_F(ForeignLog, TimesOfGpsBecomeUtc) {
  Log("log.pos",
      std::string(kGpsHeader) + "2024/01/01 00:00:18.000 " + kRest + "2295 86418.250 " + kRest);
  Import("log.pos",
         "time: {column: time, offset: -1704067200}\n" + std::string(kOrigin) + kReceiver);
  const auto fixes = Fixes();
  ASSERT_EQ(fixes.size(), 2u);
  EXPECT_EQ(fixes[0].t_ns, 0);
  EXPECT_EQ(fixes[1].t_ns, 250'000'000);
  EXPECT_EQ(fixes[0].fix, GnssFix::kRtkFixed);
  EXPECT_NEAR(fixes[0].variance_enu_m2.x(), 4e-4, 1e-15);
}

TEST_F(ForeignLog, LeapSecondsAreThoseOfTheDay) {
  EXPECT_EQ(GpsAheadOfUtc(*DayOf(2005, 12, 31)), 13 * kNsPerSecond);
  EXPECT_EQ(GpsAheadOfUtc(*DayOf(2012, 7, 1)), 15 * kNsPerSecond);  // still June by UTC
  EXPECT_EQ(GpsAheadOfUtc(*DayOf(2012, 7, 1) + 16 * kNsPerSecond), 16 * kNsPerSecond);
  EXPECT_EQ(GpsAheadOfUtc(*DayOf(2026, 5, 1)), 18 * kNsPerSecond);
  EXPECT_FALSE(DayOf(2023, 2, 29));
  EXPECT_FALSE(TimeOfDayText("12:60:00"));
  EXPECT_EQ(SecondsOfText("1.0000000019"), 1'000'000'001);
  EXPECT_FALSE(SecondsOfText("1e3"));
}

TEST_F(ForeignLog, WhatASolutionFileMustNotBeIsNamed) {
  Log("log.pos", std::string("2024/01/01 00:00:18.000 ") + kRest);
  EXPECT_THAT(FaultOf("log.pos"), HasSubstr("log.pos:1: no line of column names precedes it"));
  Log("log.pos", "%  UTC  x-ecef(m) y-ecef(m) z-ecef(m) Q\n");
  EXPECT_THAT(FaultOf("log.pos"), HasSubstr("its solution is in x-ecef; need latitude"));
  Log("log.pos", "%  UTC  latitude(d'\") longitude(d'\") height(m) Q\n");
  EXPECT_THAT(FaultOf("log.pos"), HasSubstr("degrees, minutes and seconds"));
  Log("log.pos", std::string(kGpsHeader) + "2024/01/01 00:00:18.000 nan -71.27 90.5 1 9 1 1 1\n");
  EXPECT_THAT(FaultOf("log.pos"), HasSubstr("log.pos:6: latitude is 'nan', need a number"));
  for (const char* quality : {"-71.27", "7", "1e30", "1.5"}) {
    Log("log.pos", std::string(kGpsHeader) + "2024/01/01 00:00:18.000 46.78 -71.27 90.5 " +
                       quality + " 9 1 1 1\n");
    EXPECT_THAT(FaultOf("log.pos"), HasSubstr("log.pos:6: the fix is -1")) << quality;
  }
  Log("log.pos", std::string(kGpsHeader) + "2024/13/01 00:00:18.000 " + kRest);
  EXPECT_THAT(FaultOf("log.pos"), HasSubstr("'2024/13/01 00:00:18.000' is no time"));
  Log("log.pos", std::string(kGpsHeader) + "2024/01/01 00:00:18.000 " + kRest +
                     "2024/01/01 00:00:17.000 " + kRest + "2024/01/01 00:00:20.000 46.");
  EXPECT_THAT(FaultOf("log.pos"), HasSubstr("log.pos:8: found 3 fields, need 10"));
  Log("log.pos", std::string(kGpsHeader) + "2024/01/01 00:00:18.000 " + kRest +
                     "2024/01/01 00:00:17.000 " + kRest);
  EXPECT_THAT(FaultOf("log.pos"), AllOf(HasSubstr("log.pos:7:"), HasSubstr("need a later time")));
  Log("log.pos", std::string(kGpsHeader) + "2024/01/01 00:00:18.000 " + kRest);
  EXPECT_THAT(
      FaultOf("log.pos", "gnss: [{name: gnss, columns: {alt: {column: heigt, unit: m}}}]\n"),
      HasSubstr("has no column 'heigt' (did you mean 'height'?)"));
}

// --- KITTI's raw data

std::string Oxts(double lat_deg, double yaw_rad) {
  return fmt::format(
      "{} 8.4 112.5 0.01 -0.02 {} 1 2 3 4 5 0.1 0.2 9.8 6 7 8 0.01 0.02 0.03 9 10 "
      "11 0.5 0.1 4 10 4 4 0\n",
      lat_deg, yaw_rad);
}

// A hundred-thousandth of a degree of latitude is 1.1121 m at 49 degrees: pi / 180e5 times the
// meridian's radius a (1 - e2) / (1 - e2 sin2 49)^1.5 = 6371.85 km.
TEST_F(ForeignLog, ADriveOfKittiComesInBySuggestion) {
  Log("drive_0001_sync/oxts/timestamps.txt",
      "2011-09-26 13:02:25.964389445\n2011-09-26 13:02:26.064389445\n");
  Log("drive_0001_sync/oxts/data/0000000000.txt", Oxts(49, 0.5));
  Log("drive_0001_sync/oxts/data/0000000001.txt", Oxts(49.00001, 0.6));
  ImportSuggested(scratch_.path() / "drive_0001_sync");
  const Recording recording(Out());
  const auto imu = recording.LoadImu("machine/imu");
  const auto poses = recording.LoadPose("truth/machine/pose.csv").poses;
  const auto fixes = recording.LoadGnss("machine/gnss");
  ASSERT_EQ(imu.size(), 2u);
  EXPECT_EQ(imu[1].t_ns, 100'000'000);
  EXPECT_EQ(imu[0].w_WS_S_radps, Vec3(0.01, 0.02, 0.03));
  EXPECT_EQ(imu[0].f_S_mps2, Vec3(0.1, 0.2, 9.8));
  EXPECT_NEAR(poses[1].X_WB.translation().y(), 1.1121, 1e-4);
  EXPECT_NEAR(poses[1].X_WB.translation().x(), 0, 1e-9);
  EXPECT_NEAR(fixes[1].enu_m.y(), 1.1121, 1e-4);
  const Vec3 rpy_rad = RpyFromRotation(poses[1].X_WB.linear());
  EXPECT_NEAR(rpy_rad.x(), 0.01, 1e-12);
  EXPECT_NEAR(rpy_rad.y(), -0.02, 1e-12);
  EXPECT_NEAR(rpy_rad.z(), 0.6, 1e-12);
  EXPECT_EQ(LoadInputs(Out()).size(), 3u);  // the times and two frames
}

TEST_F(ForeignLog, FramesThatADriveLacksAreNamedOrCounted) {
  Log("drive/oxts/timestamps.txt",
      "2011-09-26 13:02:25.9\n2011-09-26 13:02:26.0\n2011-09-26 13:02:26.1\n2011-09-26 13:02\n"
      "2011-09-26 13:02:26.3\n2011-09-26 13:02:26.4\n");
  for (const int whole : {0, 4, 5}) {
    Log(fmt::format("drive/oxts/data/000000000{}.txt", whole), Oxts(49, 0.5));
  }
  Log("drive/oxts/data/0000000001.txt", "49 8.4 112.5 0.01");
  const std::string file = "drive/oxts/timestamps.txt", keys = "imus: [{name: imu}]\n";
  EXPECT_THAT(FaultOf(file, keys), AllOf(HasSubstr("timestamps.txt:2:"),
                                         HasSubstr("0000000001.txt has 4, need 30 numbers")));
  const ImportReport report = Import(file, "zero: start\n" + keys, {.skips_bad_rows = true});
  EXPECT_EQ(report.channels[0].rows, 3);
  EXPECT_EQ(report.channels[0].left_out, 3);
}

TEST_F(ForeignLog, AFolderOfNoKnownFormIsRefused) {
  Log("things/readme.txt", "nothing");
  EXPECT_THAT([&] { SuggestMapping(scratch_.path() / "things"); },
              ThrowsMessage<InputError>(HasSubstr("things: is a folder of unknown form")));
}

}  // namespace
}  // namespace tera
