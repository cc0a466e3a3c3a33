#include "dataset/import/foreign_csv.h"

/// Times of rows in their forms.

namespace tera {
namespace {

namespace fs = std::filesystem;

TEST_F(ForeignCsv, TimesOfAnEpochCountFromTheStart) {
  Log("t,x,y\n1700000000.25,1.5,-2\n1700000001.5,3,4e-3\n");
  EXPECT_THAT([&] { Import(kSeconds + Table("x", "y")); },
              ThrowsFault(FaultKind::kMissing, "mapping.yaml"));
  EXPECT_FALSE(fs::exists(Out()));
  const ImportReport report = Import("zero: start\n" + std::string(kSeconds) + Table("x", "y"));
  EXPECT_EQ(Recording(Out()).LoadTable("digger/levels.csv").t_ns,
            (std::vector<TimeNs>{0, 1'250'000'000}));
  EXPECT_NEAR(ToSeconds(report.zero_ns), 1700000000.25, 1e-6);
}

TEST_F(ForeignCsv, TimesOfDigitsAreExact) {
  Log("t,x,y\n1700000000123456789,1.5,-2\n1700000001123456790,3,4e-3\n");
  Import("zero: start\ntime: {column: t, unit: ns}\n" + Table("x", "y"));
  EXPECT_EQ(Recording(Out()).LoadTable("digger/levels.csv").t_ns,
            (std::vector<TimeNs>{0, 1'000'000'001}));
  Log("t,x,y\n1700000000.000000007,1.5,-2\n1700000000.1,3,4e-3\n");
  Import("zero: start\n" + std::string(kSeconds) + Table("x", "y"));
  EXPECT_EQ(Recording(Out()).LoadTable("digger/levels.csv").t_ns,
            (std::vector<TimeNs>{0, 99'999'993}));
}

TEST_F(ForeignCsv, TimeThatCannotBeIsTold) {
  Log("t,x,y\n1700000000123456789,1.5,-2\n");  // nanoseconds
  EXPECT_THAT([&] { Import(kSeconds + Table("x", "y")); },
              ThrowsFault(FaultKind::kOutOfRange, "log.txt:2: column 't'"));
}

TEST_F(ForeignCsv, RowLeftOutKeepsItsPlaceInTime) {
  Log("x,y\n1,1\n2,2\n3\n4,4\n");
  Import("time: {interval: 10, unit: ms}\n" + Table("x", "y"), {.skips_bad_rows = true});
  EXPECT_EQ(Recording(Out()).LoadTable("digger/levels.csv").t_ns,
            (std::vector<TimeNs>{0, 10'000'000, 30'000'000}));
}

TEST_F(ForeignCsv, ZeroIsThatOfTheEarliestChannel) {
  Log("t,x,y,u\n10,1.5,-2,12\n11,3,4e-3,13\n");
  Import(
      "zero: start\ntables:\n"
      "  - {name: late, time: {column: u, unit: s}, columns: {a: {column: x, unit: '1'}}}\n"
      "  - {name: early, time: {column: t, unit: s}, columns: {a: {column: x, unit: '1'}}}\n");
  EXPECT_EQ(Recording(Out()).LoadTable("digger/early.csv").t_ns.front(), 0);
  EXPECT_EQ(Recording(Out()).LoadTable("digger/late.csv").t_ns.front(), 2'000'000'000);
}

TEST_F(ForeignCsv, ZeroIsOfNoRowThatWasLeftOut) {
  // The value, the fix and the quaternion of the first rows are unreadable.
  Log("t,x,w\n10,ERR,0.5\n12,1.5,1\n13,3,1\n");
  const std::string axes =
      "x: {constant: 0}, y: {constant: 0}, z: {constant: 0}, qx: {constant: 0}, qy: {constant: "
      "0}, qz: {constant: 0}";
  for (const std::string& keys :
       {"tables: [{name: levels, columns: {a: {column: x, unit: '1'}}}]\n" + std::string(),
        "pose: {columns: {qw: {column: w, unit: '1'}, " + axes + "}}\n"}) {
    const ImportReport report =
        Import("zero: start\n" + std::string(kSeconds) + keys, {.skips_bad_rows = true});
    EXPECT_EQ(report.zero_ns, 12 * kNsPerSecond) << keys;
    EXPECT_EQ(report.channels.at(0).first_ns, 0) << keys;
    EXPECT_EQ(report.channels.at(0).left_out, 1) << keys;
  }
}

TEST_F(ForeignCsv, DatesAreTimes) {
  Log("t,x,y\n2024-05-01T12:34:59.990Z,1,1\n2024-05-01T12:35:00.010Z,2,2\n");
  const ImportReport report = Import("zero: start\ntime: {date: t}\n" + Table("x", "y"));
  EXPECT_EQ(Times(), kTwentyMs);
  EXPECT_EQ(report.zero_ns, 1'714'566'899'990'000'000);
  EXPECT_THAT([&] { Import(kSeconds + Table("x", "y")); },
              ThrowsFault(FaultKind::kMistyped, "log.txt:2: column 't'"));
}

TEST_F(ForeignCsv, DatesHaveTheZoneAndTheOrderThatTheMappingSays) {
  Log("t,x,y\n05/01/2024 14:34:59.990,1,1\n05/01/2024 14:35:00.010,2,2\n");
  const std::string table = Table("x", "y");
  const ImportReport report =
      Import("zero: start\ntime: {date: t, order: mdy, zone: \"+02:00\"}\n" + table);
  EXPECT_EQ(Times(), kTwentyMs);
  EXPECT_EQ(report.zero_ns, 1'714'566'899'990'000'000);
  EXPECT_THAT([&] { Import("time: {date: t}\n" + table); },
              ThrowsFault(FaultKind::kMistyped, "log.txt:2: column 't'"));
  EXPECT_THAT([&] { Import("time: {date: t, zone: CEST}\n" + table); },
              ThrowsFault(FaultKind::kInconsistent, "time.zone"));
}

TEST_F(ForeignCsv, DateAndClockMayStandInTwoColumns) {
  Log("day,t,x,y\n31.12.2023,23:59:59.990,1,1\n01.01.2024,00:00:00.010,2,2\n");
  Import("zero: start\ntime: {date: day, clock: t}\n" + Table("x", "y"));
  EXPECT_EQ(Times(), kTwentyMs);
  EXPECT_THAT([&] { Import("time: {date: day}\n" + Table("x", "y")); },
              ThrowsFault(FaultKind::kMissing, "log.txt:2: column 'day'"));
}

TEST_F(ForeignCsv, ClocksGoOnOverMidnight) {
  Log("t,x,y\n23:59:59.990,1,1\n00:00:00.010,2,2\n");
  Import("zero: start\ntime: {clock: t}\n" + Table("x", "y"));
  EXPECT_EQ(Times(), kTwentyMs);
}

TEST_F(ForeignCsv, RowsThatAreLeftOutCountNoDays) {
  Log("t,x,y\n23:00:00.000,1,1\n00:00:00.000,0,0\n23:00:00.020,2,2\n");
  Import(
      "zero: start\ntime: {clock: t}\ntables: [{name: levels, valid_if: [{column: x, above: 0}], "
      "columns: {a: {column: x, unit: '1'}}}]\n");
  EXPECT_EQ(Times(), kTwentyMs);
}

TEST_F(ForeignCsv, WeeksOfGpsBecomeUtc) {
  // 2024-05-01 is a Wednesday of week 2312; GPS time is 18 s ahead of UTC.
  Log("w,t,x,y\n2312,304517.990,1,1\n2312,304518.010,2,2\n");
  const ImportReport report =
      Import("zero: start\ntime: {week: w, column: t, unit: s}\n" + Table("x", "y"));
  EXPECT_EQ(Times(), kTwentyMs);
  EXPECT_EQ(report.zero_ns, 1'714'566'899'990'000'000);
  Log("w,t,x,y\n264,304517.990,1,1\n");
  EXPECT_THAT([&] { Import("time: {week: w, column: t, unit: s}\n" + Table("x", "y")); },
              ThrowsFault(FaultKind::kOutOfRange, "log.txt:2: column 'w'"));
}

TEST_F(ForeignCsv, SerialDaysOfSpreadsheetsAndMinutesAreExact) {
  // Day 45413 of a spreadsheet is 2024-05-01; a quarter of a day is 6 h.
  Log("t,x,y\n45413.25,1,1\n45413.2500002315,2,2\n");
  const ImportReport report =
      Import("zero: start\ntime: {column: t, unit: day, offset: -2209161600}\n" + Table("x", "y"));
  EXPECT_EQ(report.zero_ns, 1'714'543'200 * kNsPerSecond);
  EXPECT_NEAR(ToSeconds(Times().at(1)), 0.02, 1e-5);
  Log("t,x,y\n0.5,1,1\n1.25,2,2\n");
  Import("time: {column: t, unit: min}\n" + Table("x", "y"));
  EXPECT_EQ(Times(), (std::vector<TimeNs>{30 * kNsPerSecond, 75 * kNsPerSecond}));
}

TEST_F(ForeignCsv, SecondsAndNanosecondsOfTwoColumnsAreOneTime) {
  Log("sec,nanosec,x,y\n1700000000,990000001,1,1\n1700000001,10000001,2,2\n");
  const ImportReport report =
      Import("zero: start\ntime: {sum: [{column: sec, unit: s}, {column: nanosec, unit: ns}]}\n" +
             Table("x", "y"));
  EXPECT_EQ(Times(), kTwentyMs);
  EXPECT_EQ(report.zero_ns, 1'700'000'000'990'000'001);
}

TEST_F(ForeignCsv, ATimeThatIsToBeFilledInIsAFaultAtItsLine) {
  Log("t,x,y\n0,1.5,-2\n");
  EXPECT_THAT([&] { Import("time: unknown\n" + Table("x", "y")); },
              ThrowsFault(FaultKind::kMissing, "mapping.yaml:4:7: time"));
  EXPECT_THAT([&] { Import("time: {column: t, unit: unknown}\n" + Table("x", "y")); },
              ThrowsFault(FaultKind::kNoSuchName, "time.unit"));
}

TEST_F(ForeignCsv, TheZoneOfADateIsThatOfTheClockBesideIt) {
  // Midnight of the first of May in Berlin is still April by UTC.
  Log("day,t,x,y\n2024-05-01T00:00:00+02:00,14:34:59.990,1,1\n"
      "2024-05-01T00:00:00+02:00,14:35:00.010,2,2\n");
  const std::string time = "zero: start\ntime: {date: day, clock: t}\n";
  EXPECT_EQ(Import(time + Table("x", "y")).zero_ns, 1'714'566'899'990'000'000);
  EXPECT_EQ(Times(), kTwentyMs);
  // A clock with its own zone keeps it.
  Log("day,t,x,y\n2024-05-01,12:34:59.990Z,1,1\n2024-05-01,12:35:00.010Z,2,2\n");
  EXPECT_EQ(Import(time + Table("x", "y")).zero_ns, 1'714'566'899'990'000'000);
}

TEST_F(ForeignCsv, CountersBeginAnewWhereTheMappingSays) {
  Log("t,x,y\n4294957296,1,1\n10000,2,2\n");
  EXPECT_THAT([&] { Import("time: {column: t, unit: us}\n" + Table("x", "y")); },
              ThrowsFault(FaultKind::kInconsistent, "log.txt:3: column 't'"));
  Import("zero: start\ntime: {column: t, unit: us, wraps_at: 4294967296}\n" + Table("x", "y"));
  EXPECT_EQ(Times(), kTwentyMs);
  Log("t,x,y\n604799.99,1,1\n0.01,2,2\n");
  Import("zero: start\ntime: {column: t, unit: s, wraps_at: 604800}\n" + Table("x", "y"));
  EXPECT_EQ(Times(), kTwentyMs);
  EXPECT_THAT([&] { Import("time: {column: t, unit: h, wraps_at: 1e9}\n" + Table("x", "y")); },
              ThrowsFault(FaultKind::kOutOfRange, "time.wraps_at"));
  EXPECT_THAT(
      [&] {
        Import("time: {sum: [{column: t, unit: s}, {column: x, unit: s}], wraps_at: 60}\n" +
               Table("x", "y"));
      },
      ThrowsFault(FaultKind::kInconsistent, "time.wraps_at"));
}

TEST_F(ForeignCsv, PartsOfAFileAreTakenByTheirLines) {
  Log("t,x,y\n0.00,1,1\n0.02,2,2\n0.04,3,3\n0.00,4,4\n0.02,5,5\n");
  EXPECT_THAT([&] { Import(kSeconds + Table("x", "y")); },
              ThrowsFault(FaultKind::kInconsistent, "log.txt:5: column 't'"));
  Import("csv: {last_line: 4}\n" + std::string(kSeconds) + Table("x", "y"));
  EXPECT_EQ(Rows(), (std::vector<std::vector<double>>{{1, 1}, {2, 2}, {3, 3}}));
  Import("csv: {first_line: 5}\n" + std::string(kSeconds) + Table("x", "y"));
  EXPECT_EQ(Rows(), (std::vector<std::vector<double>>{{4, 4}, {5, 5}}));
}

// --- Epochs.

TEST_F(ForeignCsv, AnEpochThatNoDatasetCanHaveIsRefused) {
  Log("t,x,y\n8000000000,1,1\n8000000001,2,2\n");  // in the year 2223
  EXPECT_THAT([&] { Import("zero: start\n" + std::string(kSeconds) + Table("x", "y")); },
              ThrowsFault(FaultKind::kOutOfRange, "zero"));
  EXPECT_FALSE(fs::exists(Out()));
  Log("t,x,y\n-100,1,1\n-99,2,2\n");
  EXPECT_THAT(
      [&] {
        Import("zero: start\nepoch: {since_1970_ns: \"5\", clock: utc}\n" + std::string(kSeconds) +
               Table("x", "y"));
      },
      ThrowsFault(FaultKind::kOutOfRange, "epoch"));
}

TEST_F(ForeignCsv, AnEpochWithoutANumberIsOfTimesThatCountFrom1970) {
  const std::string clock = "zero: start\nepoch: {clock: utc}\n" + std::string(kSeconds);
  Log("t,x,y\n5,1,1\n6,2,2\n");
  EXPECT_THAT([&] { Import(clock + Table("x", "y")); },
              ThrowsFault(FaultKind::kMissing, "epoch.since_1970_ns"));
  Log("t,x,y\n1700000000,1,1\n1700000001,2,2\n");
  EXPECT_EQ(Import(clock + Table("x", "y")).epoch,
            (RecordingEpoch{1'700'000'000 * kNsPerSecond, ClockScale::kUtc}));
  EXPECT_EQ(Recording(Out()).info().epoch->clock, ClockScale::kUtc);
  // A number next to such times would count twice.
  EXPECT_THAT(
      [&] {
        Import("zero: start\nepoch: {since_1970_ns: \"1700000000000000000\", clock: utc}\n" +
               std::string(kSeconds) + Table("x", "y"));
      },
      ThrowsFault(FaultKind::kInconsistent, "epoch.since_1970_ns"));
}

}  // namespace
}  // namespace tera
