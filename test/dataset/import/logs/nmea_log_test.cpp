#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/other_program.h"
#include "core/faults.h"
#include "core/units.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/recording.h"
#include "dataset/format/sample_recording.h"
#include "dataset/import/import_csv.h"
#include "dataset/import/logs/foreign_log.h"
#include "dataset/import/suggest/suggest.h"

/// Sentences as written by machines' receivers and their recorders.

namespace tera {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;
namespace fs = std::filesystem;

std::string Checked(const std::string& body) {
  unsigned sum = 0;
  for (const char c : body) sum ^= static_cast<unsigned char>(c);
  return fmt::format("${}*{:02X}\r\n", body, sum);
}

/// 48 deg 7.5' N, 11 deg 30' W; 500 m above the sea, 546 m above the ellipsoid.
std::string GgaAt(int k, const std::string& talker = "GN", double msl_m = 500) {
  return Checked(fmt::format(
      "{}GGA,12000{}.00,4807.5000000,N,01130.0000000,W,4,12,0.7,{:.2f},M,46.00,M,1.0,0000", talker,
      k, msl_m));
}
std::string RmcAt(int k, const std::string& talker = "GN") {
  return Checked(fmt::format("{}RMC,12000{}.00,A,4807.5,N,01130.0,W,0.0,,010524,,,R,V", talker, k));
}

class NmeaLog : public ::testing::Test {
 protected:
  /// The fixes that the suggested mapping imports.
  std::vector<GnssSample> Suggested(const std::string& name, const std::string& text) {
    WriteWholeFile(scratch_.path() / name, text);
    yaml_ = SuggestMapping(scratch_.path() / name);
    return Imported(yaml_);
  }
  std::vector<GnssSample> Imported(const std::string& yaml) {
    WriteWholeFile(scratch_.path() / "mapping.yaml", yaml);
    fs::remove_all(Out());
    report_ = ImportCsv(scratch_.path() / "mapping.yaml", Out());
    return Recording(Out()).LoadGnss("machine/gnss");
  }
  std::string FaultOf(const std::string& yaml) {
    try {
      Imported(yaml);
    } catch (const InputError& fault) {
      EXPECT_FALSE(fs::exists(Out()) || fs::exists(Out().string() + ".incomplete"));
      return fault.what();
    }
    return "no fault";
  }
  void ExpectThePlace(const std::vector<GnssSample>& fixes, std::size_t count) {
    ASSERT_EQ(fixes.size(), count) << yaml_;
    EXPECT_NEAR(fixes[0].lat_deg, 48.125, 1e-9);
    EXPECT_NEAR(fixes[0].lon_deg, -11.5, 1e-9);
    EXPECT_NEAR(fixes[0].alt_m, 546, 1e-9);
    EXPECT_NEAR(fixes[0].enu_m.norm(), 0, 1e-3) << yaml_;
    EXPECT_EQ(fixes[0].fix, GnssFix::kRtkFixed);
    EXPECT_EQ(fixes[1].t_ns - fixes[0].t_ns, kNsPerSecond);
  }
  fs::path Out() const { return scratch_.path() / "out"; }

  ScratchDirectory scratch_;
  std::string yaml_;
  ImportReport report_;
};

TEST_F(NmeaLog, TheSuggestedOriginIsTheFirstRowWithAFixInItsOwnHeight) {
  const std::string no_fix = Checked("GNGGA,115959.00,,,,,0,00,99.9,,M,,M,,");
  const auto fixes = Suggested("rover.nmea", no_fix + RmcAt(0) + GgaAt(0) + RmcAt(1) + GgaAt(1));
  ASSERT_EQ(fixes.size(), 3u);
  EXPECT_EQ(fixes[0].fix, GnssFix::kNone);
  ExpectThePlace({fixes[1], fixes[2]}, 2);
}

TEST_F(NmeaLog, WithoutASeparationHeightsAreThoseAboveTheSea) {
  const std::string gga = "GNGGA,12000{}.00,4807.5,N,01130.0,W,4,12,0.7,500.00,M,,M,1.0,0000";
  const auto fixes = Suggested("rover.nmea", Checked(fmt::format(fmt::runtime(gga), 0)) +
                                                 Checked(fmt::format(fmt::runtime(gga), 1)));
  ASSERT_EQ(fixes.size(), 2u);
  EXPECT_NEAR(fixes[0].enu_m.norm(), 0, 1e-3);
  EXPECT_EQ(fixes[0].alt_m, 500);
}

TEST_F(NmeaLog, SentencesAreKnownByTheirBytesWhateverTheName) {
  for (const char* name : {"base.log", "base.txt", "base.ubx", "base.csv", "base"}) {
    ExpectThePlace(Suggested(name, RmcAt(0) + GgaAt(0) + RmcAt(1) + GgaAt(1)), 2);
  }
  // A table with columns separated by commas is no NMEA log, even with a dollar in it.
  WriteWholeFile(scratch_.path() / "costs.csv", "t,cost\n0,$5\n1,$6\n");
  EXPECT_EQ(TypeOfLog(scratch_.path() / "costs.csv"), "");
}

TEST_F(NmeaLog, ALoggersOwnTimesAroundSentencesArePassedOver) {
  const auto stamped = [](const std::string& before, const std::string& behind) {
    std::string text;
    for (const std::string& line : {RmcAt(0), GgaAt(0), RmcAt(1), GgaAt(1)}) {
      text += before + line.substr(0, line.size() - 2) + behind + "\n";
    }
    return text;
  };
  for (const auto& [before, behind] : {std::pair{"1714564800.000 ", ""},
                                       {"2024-05-01T12:00:00.000Z,", ""},
                                       {"[12:00:00.012] ", "\r"},
                                       {"1714564800,\"", "\""},
                                       {"", ",1714564800.000"}}) {
    ExpectThePlace(Suggested("stamped.log", stamped(before, behind)), 2);
  }
}

// UBX-NAV-EOE (class 1, id 0x61): 4 bytes of payload. The running sums of 01 61 04 00 00 00 00 00
// are 01 62 66 66 66 66 66 66 and 01 63 c9 2f 95 fb 61 c7 (mod 256).
const std::string kUbxFrame("\xb5\x62\x01\x61\x04\x00\x00\x00\x00\x00\x66\xc7", 12);

TEST_F(NmeaLog, FramesOfUbxBetweenSentencesArePassedOver) {
  // A frame whose payload holds a dollar and line ends, with its sums by hand: 02 13 03 00 '$' '\n'
  // '\n' adds up to 02 15 18 18 3c 46 50 and 02 17 2f 47 83 c9 19.
  const std::string other("\xb5\x62\x02\x13\x03\x00$\n\n\x50\x19", 11);
  const std::string log = kUbxFrame + RmcAt(0) + GgaAt(0) + other + RmcAt(1) + kUbxFrame +
                          kUbxFrame + GgaAt(1) + kUbxFrame;
  ExpectThePlace(Suggested("mixed.ubx", log), 2);
  EXPECT_THAT(yaml_, Not(HasSubstr("cannot be read")));
  // A frame with wrong checksums is no frame.
  std::string broken = log;
  broken[10] = 0;
  WriteWholeFile(scratch_.path() / "mixed.ubx", broken);
  EXPECT_THAT(FaultOf(yaml_), HasSubstr("mixed.ubx:1: "));
}

// The standard's example of message 1005: 19 bytes and their CRC-24Q, 36 0b 98.
TEST_F(NmeaLog, FramesOfRtcmBetweenSentencesArePassedOver) {
  const std::string rtcm(
      "\xd3\x00\x13\x3e\xd7\xd3\x02\x02\x98\x0e\xde\xef\x34\xb4\xbd\x62\xac\x09\x41\x98\x6f\x33\x36"
      "\x0b\x98",
      25);
  ExpectThePlace(Suggested("base.log", rtcm + RmcAt(0) + GgaAt(0) + RmcAt(1) + rtcm + GgaAt(1)), 2);
  EXPECT_THAT(yaml_, Not(HasSubstr("cannot be read")));
}

TEST_F(NmeaLog, GnsIsAPositionWithAModeOfEachSystem) {
  const auto gns = [](int k, const std::string& modes) {
    return Checked(fmt::format(
        "GNGNS,12000{}.00,4807.5,N,01130.0,W,{},12,0.7,500.00,46.00,1.0,0000,V", k, modes));
  };
  const auto fixes = Suggested("gns.nmea", RmcAt(0) + gns(0, "RR") + gns(1, "RFNN") + gns(2, "FA") +
                                               gns(3, "AD") + gns(4, "ANN"));
  ExpectThePlace(fixes, 5);
  EXPECT_EQ(fixes[1].fix, GnssFix::kRtkFixed);
  EXPECT_EQ(fixes[2].fix, GnssFix::kRtkFloat);
  EXPECT_EQ(fixes[3].fix, GnssFix::kDifferential);
  EXPECT_EQ(fixes[4].fix, GnssFix::kSingle);
}

// GGK's date is month, day and year, its height above the ellipsoid, and 3 is RTK fixed.
TEST_F(NmeaLog, GgkOfTrimbleIsAPosition) {
  const auto ggk = [](const std::string& head, int k, int quality) {
    return Checked(
        fmt::format("{},12000{}.00,050124,4807.50000000,N,01130.00000000,W,{},12,1.2,EHT546.000,M",
                    head, k, quality));
  };
  for (const char* head : {"PTNL,GGK", "GPGGK"}) {
    const auto fixes = Suggested(
        "ptnl.nmea", ggk(head, 0, 3) + ggk(head, 1, 2) + ggk(head, 2, 4) + ggk(head, 3, 1));
    ExpectThePlace(fixes, 4);
    EXPECT_EQ(fixes[1].fix, GnssFix::kRtkFloat);
    EXPECT_EQ(fixes[2].fix, GnssFix::kDifferential);
    EXPECT_EQ(fixes[3].fix, GnssFix::kSingle);
    EXPECT_EQ(report_.zero_ns, 1'714'564'800 * kNsPerSecond);  // 1 May 2024, 12:00
  }
}

TEST_F(NmeaLog, OfTwoTalkersOneIsAskedFor) {
  std::string log;
  for (int k = 0; k < 3; ++k) log += RmcAt(k) + GgaAt(k) + GgaAt(k, "GP", 501);
  WriteWholeFile(scratch_.path() / "two.nmea", log);
  yaml_ = SuggestMapping(scratch_.path() / "two.nmea");
  EXPECT_THAT(FaultOf(yaml_),
              AllOf(HasSubstr("two.nmea: the talkers GN, GP give positions at the same times"),
                    HasSubstr("'talker: GN'")));
  std::string other = yaml_;
  other.replace(other.find("# talker: GN"), 12, "talker: GN");
  ExpectThePlace(Imported(other), 3);
  other.replace(other.find("talker: GN"), 10, "talker: GP");
  const auto fixes = Imported(other);
  ASSERT_EQ(fixes.size(), 3u);
  EXPECT_NEAR(fixes[0].alt_m, 547, 1e-9);
  EXPECT_EQ(report_.zero_ns, 1'714'564'800 * kNsPerSecond);  // of GN's RMC
  other.replace(other.find("talker: GP"), 10, "talker: GL");
  EXPECT_THAT(FaultOf(other), HasSubstr("no position has the talker 'GL'; the log has GN, GP"));
}

TEST_F(NmeaLog, TwoReceiversOfOneTalkerCannotBeTold) {
  WriteWholeFile(scratch_.path() / "two.nmea", GgaAt(0) + GgaAt(0, "GN", 501));
  EXPECT_THAT(FaultOf("name: n\nmachine: machine\nfile: two.nmea\norigin: {lat_deg: 48, lon_deg: "
                      "-11.5, height_m: 500}\ngnss: [{name: gnss}]\n"),
              HasSubstr("two.nmea:2: gives another position than an earlier GGA of the same time"));
}

TEST_F(NmeaLog, RowsThatHaveNoPlaceOrAreNoMeasurementAreLeftOutByTheSuggestion) {
  const std::string estimated = Checked("GNGGA,120003.00,4807.5,N,01130.0,W,6,12,0.7,500,M,46,M,,");
  // Speed at 2 Hz, positions at 1 Hz, with the deviations of one of them.
  const auto fixes = Suggested(
      "rover.nmea", RmcAt(0) + GgaAt(0) + Checked("GNGST,120000.00,1,,,,0.01,0.02,0.03") +
                        Checked("GNRMC,120000.50,A,4807.5,N,01130.0,W,0.0,,010524,,,R,V") +
                        RmcAt(1) + GgaAt(1) + estimated);
  ExpectThePlace(fixes, 2);
  EXPECT_THAT(yaml_, AllOf(HasSubstr("1 times have no position"), HasSubstr("estimated"),
                           HasSubstr("a GST for 1 of 3 fixes")));
}

TEST_F(NmeaLog, WithoutAPositionTheSuggestionTellsWhatIsThere) {
  WriteWholeFile(
      scratch_.path() / "log.nmea",
      RmcAt(0) + Checked("GPGSV,1,1,00") + Checked("PTNL,AVR,120000.0,+1,Yaw,,,,,0.5,3,2,5"));
  EXPECT_THAT([&] { SuggestMapping(scratch_.path() / "log.nmea"); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("log.nmea: has no GGA, GNS or PTNL,GGK"),
                                              HasSubstr("it has 1 GSV, 1 PTNL,AVR, 1 RMC"))));
}

TEST_F(NmeaLog, APlaceFarFromTheOriginIsAFault) {
  WriteWholeFile(scratch_.path() / "rover.nmea", RmcAt(0) + GgaAt(0));
  const std::string rest =
      "gnss: [{name: gnss, columns: {var_e: {constant: 4}, var_n: {constant: 4}, var_u: {constant: "
      "4}}}]\n";
  // A degree of latitude is 111.2 km here: 0.8 deg are 89 km, 1 deg is too far.
  const std::string head = "name: n\nmachine: machine\nzero: start\nfile: rover.nmea\n";
  EXPECT_EQ(FaultOf(head + "origin: {lat_deg: 48.925, lon_deg: -11.5, height_m: 500}\n" + rest),
            "no fault");
  EXPECT_THAT(FaultOf(head + "origin: {lat_deg: 49.125, lon_deg: -11.5, height_m: 500}\n" + rest),
              AllOf(HasSubstr("rover.nmea:1: is 111 km from the mapping's origin"),
                    HasSubstr("{lat_deg: 48.1250000, lon_deg: -11.5000000, height_m: 546.000}")));
  EXPECT_THAT(FaultOf(head + "origin: {lat_deg: 0, lon_deg: 0, height_m: 0}\n" + rest),
              HasSubstr("km from the mapping's origin"));
}

TEST_F(NmeaLog, RowsThatAreMostlyBadAreAFaultAlsoWhereTheyMayBeSkipped) {
  std::string bad = GgaAt(1);
  bad[20] = '9';
  WriteWholeFile(scratch_.path() / "rover.nmea", GgaAt(0) + bad + bad);
  WriteWholeFile(scratch_.path() / "mapping.yaml",
                 "name: n\nmachine: machine\nzero: start\nfile: rover.nmea\ntables: [{name: t, "
                 "columns: {h: {column: msl, unit: m}}}]\n");
  EXPECT_THAT(
      [&] { ImportCsv(scratch_.path() / "mapping.yaml", Out(), {.skips_bad_rows = true}); },
      ThrowsMessage<InputError>(AllOf(HasSubstr("machine/t.csv: 2 of 3 rows cannot be read"),
                                      HasSubstr("rover.nmea:2: its checksum"))));
  EXPECT_FALSE(fs::exists(Out()));
}

TEST_F(NmeaLog, ChecksumsThatAreAllWrongAreToldOnceAndWhateverTheName) {
  std::string log = RmcAt(0) + GgaAt(0) + RmcAt(1) + GgaAt(1);
  for (std::size_t at = 0; (at = log.find('*', at)) != std::string::npos; ++at) {
    log[at + 1] = log[at + 1] == '0' ? '1' : '0';
  }
  for (const std::string name : {"rover.nmea", "rover.txt"}) {
    EXPECT_THAT([&] { Suggested(name, log); }, ThrowsFault(FaultKind::kMalformed, name));
    WriteWholeFile(scratch_.path() / "mapping.yaml",
                   "name: n\nmachine: machine\nzero: start\nfile: " + name +
                       "\ntables: [{name: t, columns: {h: {column: msl, unit: m}}}]\n");
    for (const bool skips : {false, true}) {
      EXPECT_THAT(
          [&] { ImportCsv(scratch_.path() / "mapping.yaml", Out(), {.skips_bad_rows = skips}); },
          ThrowsFault(FaultKind::kMalformed, name));
    }
  }
}

TEST_F(NmeaLog, ADateOfTrimblesStandsWithItsOwnTime) {
  const auto ggk = [](int k, const std::string& date, double minutes) {
    return Checked(fmt::format(
        "PTNL,GGK,12000{}.00,{},48{:07.4f},N,01130.0000,W,3,12,1.5,EHT546.0,M", k, date, minutes));
  };
  // The second GGK contradicts the first, and a third is from a receiver that is not read.
  const std::string log = ggk(0, "050124", 7.5) + ggk(0, "050224", 7.6) + ggk(1, "050124", 7.5);
  WriteWholeFile(scratch_.path() / "rover.nmea", log);
  WriteWholeFile(scratch_.path() / "mapping.yaml",
                 "name: n\nmachine: machine\nzero: start\nfile: rover.nmea\ntables: [{name: t, "
                 "columns: {h: {column: altitude, unit: m}}}]\n");
  const ImportReport report =
      ImportCsv(scratch_.path() / "mapping.yaml", Out(), {.skips_bad_rows = true});
  EXPECT_EQ(report.channels.at(0).left_out, 1);
  EXPECT_EQ(report.channels[0].last_ns, kNsPerSecond);
  // A single GGK whose position contradicts none, but another talker has precedence.
  WriteWholeFile(scratch_.path() / "rover.nmea", ggk(0, "050124", 7.5) + GgaAt(1) + GgaAt(2));
  WriteWholeFile(scratch_.path() / "mapping.yaml",
                 "name: n\nmachine: machine\nzero: start\nfile: rover.nmea\ntalker: GN\ntables: "
                 "[{name: t, columns: {h: {column: altitude, unit: m}}}]\n");
  fs::remove_all(Out());
  EXPECT_EQ(ImportCsv(scratch_.path() / "mapping.yaml", Out()).channels.at(0).rows, 2);
}

TEST_F(NmeaLog, ATimeOfTextTablesIsNotThatOfALogBesideThem) {
  WriteWholeFile(scratch_.path() / "rover.nmea", RmcAt(0) + GgaAt(0) + RmcAt(1) + GgaAt(1));
  WriteWholeFile(scratch_.path() / "joints.csv",
                 "stamp,boom\n1714564800500,0.1\n1714564801500,0.2\n");
  const auto fixes = Imported(
      "name: n\nmachine: machine\nzero: start\nfile: joints.csv\ntime: {column: stamp, unit: ms}\n"
      "origin: {lat_deg: 48.125, lon_deg: -11.5, height_m: 546}\n"
      "encoders: [{name: joints, joints: [{name: boom, angle: {column: boom, unit: rad}}]}]\n"
      "gnss: [{name: gnss, file: rover.nmea, columns: {var_e: {constant: 4}, var_n: {constant: 4}, "
      "var_u: {constant: 4}}}]\n");
  ASSERT_EQ(fixes.size(), 2u);
  EXPECT_EQ(fixes[0].t_ns, 0);
  EXPECT_EQ(Recording(Out()).LoadEncoder("machine/joints").samples[0].t_ns, kNsPerSecond / 2);
}

// gpsdecode of gpsd reads the same sentences.
TEST_F(NmeaLog, GpsdReadsTheSamePlaceAndTime) {
  if (!HasProgram("gpsdecode")) GTEST_SKIP() << "needs gpsd-clients";
  const std::string log = RmcAt(0) + GgaAt(0) + RmcAt(1) + GgaAt(1) + RmcAt(2) + GgaAt(2);
  WriteWholeFile(scratch_.path() / "rover.nmea", log);
  const auto judge = OutputOf("gpsdecode < '" + (scratch_.path() / "rover.nmea").string() + "'");
  ASSERT_TRUE(judge);
  EXPECT_THAT(*judge, AllOf(HasSubstr("\"time\":\"2024-05-01T12:00:01.000Z\""),
                            HasSubstr("\"lat\":48.125000000"), HasSubstr("\"lon\":-11.500000000"),
                            HasSubstr("\"altHAE\":546.0")));
  ExpectThePlace(Suggested("rover.nmea", log), 3);
  EXPECT_EQ(report_.zero_ns, 1'714'564'800 * kNsPerSecond);
}

}  // namespace
}  // namespace tera
