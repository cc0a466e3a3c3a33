#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "dataset/format/recording.h"
#include "dataset/format/sample_recording.h"
#include "dataset/import/import_csv.h"

/// Logs as other people's loggers write them.

namespace tera {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;
namespace fs = std::filesystem;

class ForeignCsv : public ::testing::Test {
 protected:
  void Log(const std::string& text) { WriteWholeFile(scratch_.path() / "log.txt", text); }

  ImportReport Import(const std::string& keys, ImportOptions options = {}) {
    WriteWholeFile(scratch_.path() / "mapping.yaml",
                   "name: logged\nmachine: digger\nfile: log.txt\n" + keys);
    fs::remove_all(Out());
    return ImportCsv(scratch_.path() / "mapping.yaml", Out(), options);
  }

  /// One table of two columns, by their names.
  static std::string Table(const std::string& a, const std::string& b,
                           const std::string& name = "levels") {
    return "tables: [{name: " + name + ", columns: {a: {column: " + a +
           ", unit: '1'}, b: {column: " + b + ", unit: '1'}}}]\n";
  }

  std::vector<std::vector<double>> Rows(const std::string& name = "levels") const {
    return Recording(Out()).LoadTable("digger/" + name + ".csv").rows;
  }
  fs::path Out() const { return scratch_.path() / "out"; }

  ScratchDirectory scratch_;
};

constexpr char kSeconds[] = "time: {column: t, unit: s}\n";
const std::vector<std::vector<double>> kTwoRows = {{1.5, -2}, {3, 4e-3}};

TEST_F(ForeignCsv, SeparatorsAreFound) {
  for (const std::string log :
       {"t,x,y\n0,1.5,-2\n1,3,4e-3\n", "t;x;y\n0;1.5;-2\n1;3;4e-3\n",
        "t\tx\ty\n0\t1.5\t-2\n1\t3\t4e-3\n", "t x y\n0  1.5 -2\n1 3   4e-3\n",
        "  t  x  y\n  0\t1.5 -2 \n 1 3 \t 4e-3\n"}) {
    Log(log);
    Import(kSeconds + Table("x", "y"));
    EXPECT_EQ(Rows(), kTwoRows) << log;
  }
}

TEST_F(ForeignCsv, SeparatorCanBeSaid) {
  Log("t|1;x;y\n0;1.5;-2\n1;3;4e-3\n");
  Import("csv: {separator: ';'}\ntime: {column: 't|1', unit: s}\n" + Table("x", "y"));
  EXPECT_EQ(Rows(), kTwoRows);
}

TEST_F(ForeignCsv, QuotesBlanksCommentsMarksAndEmptyLinesAreNoMatter) {
  Log("\xef\xbb\xbf# a logger of 2011\n#t, \"x, first\", y\r\n\r\n\"0\", 1.5 ,-2\r\n# pause\r\n"
      "1,\"3\",+4e-3\r\n\r\n");
  // A first line that begins with '#' names the columns unless it is skipped.
  Import("csv: {skip_lines: 1}\n" + std::string(kSeconds) + Table("'x, first'", "y"));
  EXPECT_EQ(Rows(), kTwoRows);
}

TEST_F(ForeignCsv, ColumnsWithoutNamesAreNumbered) {
  Log("0 1.5 -2\n1 3 4e-3\n");
  Import("csv: {header: false}\ntime: {column: 1, unit: s}\n" + Table("2", "3"));
  EXPECT_EQ(Rows(), kTwoRows);
  EXPECT_THAT(
      [&] { Import("csv: {header: false}\ntime: {column: 1, unit: s}\n" + Table("2", "4")); },
      ThrowsMessage<InputError>(HasSubstr("column '4' is missing")));
}

TEST_F(ForeignCsv, LastLineThatWasCutOffIsTold) {
  Log("t,x,y\n0,1.5,-2\n1,3,4e-3\n2,7");
  EXPECT_THAT([&] { Import(kSeconds + Table("x", "y")); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("log.txt:4: found 2 fields, need 3"),
                                              HasSubstr("cut off"), HasSubstr("--skip-bad-rows"))));
  EXPECT_FALSE(fs::exists(Out()));
  const ImportReport report = Import(kSeconds + Table("x", "y"), {.skips_bad_rows = true});
  EXPECT_EQ(Rows(), kTwoRows);
  ASSERT_EQ(report.channels.size(), 1u);
  EXPECT_EQ(report.channels[0].rows, 2);
  EXPECT_EQ(report.channels[0].left_out, 1);
  EXPECT_THAT(report.channels[0].first_fault, HasSubstr("log.txt:4:"));
}

TEST_F(ForeignCsv, AFieldThatNoTableHasIsRefused) {
  Log("t,x,y\n0,1.5," + std::string(1 << 24, '7') + "\n");
  EXPECT_THAT([&] { Import(kSeconds + Table("x", "y")); },
              ThrowsMessage<InputError>(HasSubstr("log.txt:2: a field of 16777216 bytes")));
  EXPECT_FALSE(fs::exists(Out()));
}

// Room is made for what the text can hold, not for as many wide rows as it has lines.
TEST_F(ForeignCsv, AWideTableWithMillionsOfEmptyLinesIsRead) {
  std::string head = "t,x,y", first = "0,1.5,-2", second = "1,3,4e-3";
  for (int k = 0; k < 200'000; ++k) {
    head += ",c" + std::to_string(k);
    first += ",";
    second += ",";
  }
  Log(head + "\n" + first + "\n" + second + std::string(5'000'000, '\n'));
  Import(kSeconds + Table("x", "y"));
  EXPECT_EQ(Rows(), kTwoRows);
}

TEST_F(ForeignCsv, BadRowsAreLeftOutAndCounted) {
  Log("t,x,y\n0,1.5,-2\n0.5,ERR,1\n0.6,1,2,3\n0.2,9,9\n1,3,4e-3\n1,8,8\n");
  EXPECT_THAT([&] { Import(kSeconds + Table("x", "y")); },
              ThrowsMessage<InputError>(HasSubstr("log.txt:4: found 4 fields")));
  const ImportReport report = Import(kSeconds + Table("x", "y"), {.skips_bad_rows = true});
  // 0.2 s is later than the row that is left before it.
  EXPECT_EQ(Rows().size(), 3u);
  EXPECT_EQ(report.channels[0].left_out, 3);
}

TEST_F(ForeignCsv, EmptyFieldsOfSlowerChannelsAreNoRows) {
  Log("t,x,y,z\n0,1.5,-2,1\n0.1,,,2\n0.2,nan,1,3\n1,3,4e-3,\n");
  EXPECT_THAT([&] { Import(kSeconds + Table("x", "y")); },
              ThrowsMessage<InputError>(
                  AllOf(HasSubstr("log.txt:3: column 'x'"), HasSubstr("present: true"))));
  Import(std::string(kSeconds) +
         "tables: [{name: levels, valid_if: [{column: x, present: true}], columns: {a: {column: x, "
         "unit: '1'}, b: {column: y, unit: '1'}}}]\n");
  EXPECT_EQ(Rows(), kTwoRows);
}

TEST_F(ForeignCsv, TimesOfAnEpochCountFromTheStart) {
  Log("t,x,y\n1700000000.25,1.5,-2\n1700000001.5,3,4e-3\n");
  EXPECT_THAT([&] { Import(kSeconds + Table("x", "y")); },
              ThrowsMessage<InputError>(HasSubstr("zero: start")));
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
              ThrowsMessage<InputError>(
                  AllOf(HasSubstr("log.txt:2: column 't'"), HasSubstr("need -9e+09 to 9e+09 s"))));
}

TEST_F(ForeignCsv, RowLeftOutKeepsItsPlaceInTime) {
  Log("x,y\n1,1\n2,2\n3\n4,4\n");
  Import("time: {interval: 10, unit: ms}\n" + Table("x", "y"), {.skips_bad_rows = true});
  EXPECT_EQ(Recording(Out()).LoadTable("digger/levels.csv").t_ns,
            (std::vector<TimeNs>{0, 10'000'000, 30'000'000}));
}

TEST_F(ForeignCsv, RuleOnAFieldWithoutANumberDoesNotHold) {
  Log("t,x,y,ok\n0,1.5,-2,1\n0.5,7,7,\n1,3,4e-3,1\n");
  Import(std::string(kSeconds) +
         "tables: [{name: levels, valid_if: [{column: ok, equals: 1}], columns: {a: {column: x, "
         "unit: '1'}, b: {column: y, unit: '1'}}}]\n");
  EXPECT_EQ(Rows(), kTwoRows);
}

TEST_F(ForeignCsv, CheckAndSkippingKnowQuaternions) {
  Log("t,x,w\n0,1,1\n1,2,0.5\n2,3,-1\n");
  const std::string keys =
      std::string(kSeconds) +
      "pose: {columns: {x: {column: x, unit: m}, y: {constant: 0}, z: {constant: 0}, qw: {column: "
      "w, "
      "unit: '1'}, qx: {constant: 0}, qy: {constant: 0}, qz: {constant: 0}}}\n";
  for (const bool checks_only : {true, false}) {
    EXPECT_THAT([&] { Import(keys, {.checks_only = checks_only}); },
                ThrowsMessage<InputError>(HasSubstr("log.txt:3: the quaternion has norm 0.5")));
  }
  const ImportReport report = Import(keys, {.skips_bad_rows = true});
  EXPECT_EQ(report.channels[0].left_out, 1);
  EXPECT_EQ(Recording(Out()).LoadPose("truth/digger/pose.csv").poses.size(), 2u);
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
  // Of the first rows the value, the fix and the quaternion cannot be read.
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

TEST_F(ForeignCsv, LeversAHairBeyondFullAreFull) {
  Log("t,x,y\n0,1.000001,-1.00005\n1,0.5,1.3\n");
  const ImportReport report = Import(kSeconds + Table("x", "y", "commands"));
  EXPECT_EQ(Rows("commands"), (std::vector<std::vector<double>>{{1, -1}, {0.5, 1.3}}));
  EXPECT_EQ(report.channels[0].clamped_levers, 2);
  EXPECT_EQ(report.channels[0].levers_beyond_full, 1);
  EXPECT_EQ(report.channels[0].largest_lever, 1.3);
}

TEST_F(ForeignCsv, WayRolledBesideATravelIsRefused) {
  Log("t,odo\n0,100\n1,350\n");
  EXPECT_THAT(
      [&] {
        Import(std::string(kSeconds) +
               "encoders: [{name: e, joints: [{name: a, rolled: {column: odo, unit: cm}, radius_m: "
               "0.5, "
               "travel: {column: odo, unit: m}}]}]\n");
      },
      ThrowsMessage<InputError>(HasSubstr("joints[0].travel: given beside rolled")));
}

TEST_F(ForeignCsv, WayRolledIsAnAngle) {
  Log("t,odo\n0,100\n1,350\n");
  Import(std::string(kSeconds) +
         "encoders: [{name: wheels, joints: [{name: left, rolled: {column: odo, unit: cm}, "
         "radius_m: 0.5}]}]\n");
  const auto samples = Recording(Out()).LoadEncoder("digger/wheels").samples;
  EXPECT_NEAR(samples[0].q_rad[0], 2, 1e-12);
  EXPECT_NEAR(samples[1].q_rad[0], 7, 1e-12);
  EXPECT_NEAR(samples[0].qd_radps[0], 5, 1e-12);
}

TEST_F(ForeignCsv, StrokeNeedsAMachine) {
  Log("t,s\n0,0.1\n1,0.2\n");
  EXPECT_THAT(
      [&] {
        Import(std::string(kSeconds) +
               "encoders: [{name: e, joints: [{name: boom, stroke: {column: s, unit: m}}]}]\n");
      },
      ThrowsMessage<InputError>(HasSubstr("joints[0].stroke: needs the machine's geometry")));
}

TEST_F(ForeignCsv, CheckWritesNothing) {
  Log("t,x,y\n0,1,1\n0.1,1,1\n0.2,1,1\n0.9,1,1\n1,1,1\n");
  const ImportReport report = Import(kSeconds + Table("x", "y"), {.checks_only = true});
  EXPECT_FALSE(fs::exists(Out()));
  ASSERT_EQ(report.channels.size(), 1u);
  EXPECT_EQ(report.channels[0].rows, 5);
  EXPECT_EQ(report.channels[0].interval_ns, 100'000'000);
  EXPECT_EQ(report.channels[0].longest_gap_ns, 700'000'000);
  EXPECT_EQ(report.channels[0].irregular, 1);
}

TEST_F(ForeignCsv, FileWithoutAnythingIsTold) {
  for (const std::string log : {"", "\n\n", "# nothing\n"}) {
    Log(log);
    EXPECT_THAT(
        [&] { Import("csv: {header: false}\ntime: {column: 1, unit: s}\n" + Table("2", "3")); },
        ThrowsMessage<InputError>(HasSubstr("log.txt:1: holds no line of numbers")))
        << log;
  }
}

TEST_F(ForeignCsv, AGyroOfOneAxisIsAChannelOfItsOwn) {
  Log("t,rate\n0,90\n1,-45\n");
  Import(std::string(kSeconds) +
         "gyros: [{name: cab, mount: {link: upper, xyz_m: [0, 0, 1], rpy_deg: [0, 0, 0]}, columns: "
         "{wz: {column: rate, unit: deg/s}}}]\n");
  const Recording recording(Out());
  EXPECT_EQ(recording.TypeOf("digger/cab"), "gyro");
  const TableRecording rows = recording.LoadRows("digger/cab");
  EXPECT_EQ(rows.columns, (std::vector<std::string>{"wz_radps"}));
  EXPECT_NEAR(rows.rows[1][0], -0.78539816339744831, 1e-15);
  EXPECT_THAT(ReadWholeFile(Out() / "digger/cab/sensor.yaml"), HasSubstr("parent_link: upper"));
  EXPECT_THAT(recording.SeriesChannels(), ::testing::Contains("digger/cab"));
  EXPECT_THAT([&] { Import(std::string(kSeconds) + "gyros: [{name: cab, columns: {}}]\n"); },
              ThrowsMessage<InputError>(HasSubstr("need at least one of wx, wy and wz")));
  EXPECT_THAT(
      [&] {
        Import(std::string(kSeconds) +
               "gyros: [{name: cab, columns: {w: {column: rate, unit: deg/s}}}]\n");
      },
      ThrowsMessage<InputError>(HasSubstr("unknown key")));
}

// --- How tables are written.

TEST_F(ForeignCsv, DecimalCommasAreReadWhereTheMappingSaysSo) {
  Log("t;x;y\n0,0;1,5;-2\n1,0;3;4e-3\n");
  EXPECT_THAT([&] { Import(kSeconds + Table("x", "y")); },
              ThrowsMessage<InputError>(HasSubstr(
                  "log.txt:2: column 't': found '0,0', need a finite number; where commas are "
                  "decimal signs say csv: {decimal: \",\"}")));
  Import("csv: {decimal: \",\"}\n" + std::string(kSeconds) + Table("x", "y"));
  EXPECT_EQ(Rows(), kTwoRows);
}

TEST_F(ForeignCsv, SignsBetweenThousandsAreReadWhereTheMappingSaysSo) {
  Log("t;x;y\n0;1.234,5;-2\n1;1.234.567;0,004\n");
  Import("csv: {decimal: \",\", thousands: \".\"}\n" + std::string(kSeconds) + Table("x", "y"));
  EXPECT_EQ(Rows(), (std::vector<std::vector<double>>{{1234.5, -2}, {1234567, 4e-3}}));
  Log("t;x;y\n0;1.23,5;-2\n");  // no group of three digits
  EXPECT_THAT(
      [&] {
        Import("csv: {decimal: \",\", thousands: \".\"}\n" + std::string(kSeconds) +
               Table("x", "y"));
      },
      ThrowsMessage<InputError>(HasSubstr("found '1.23,5'")));
  EXPECT_THAT(
      [&] { Import("csv: {thousands: \".\"}\n" + std::string(kSeconds) + Table("x", "y")); },
      ThrowsMessage<InputError>(HasSubstr("csv.thousands: '.' is the decimal sign")));
}

TEST_F(ForeignCsv, LinesOfUnitsAreNoRows) {
  Log("t,x,y\ns,m,m\n\n0,1.5,-2\n1,3,4e-3\n");
  EXPECT_THAT([&] { Import(kSeconds + Table("x", "y")); },
              ThrowsMessage<InputError>(
                  HasSubstr("log.txt:2: column 't': found 's', need a finite number; where this "
                            "line holds units say csv: {unit_lines: 1}")));
  Import("csv: {unit_lines: 1}\n" + std::string(kSeconds) + Table("x", "y"));
  EXPECT_EQ(Rows(), kTwoRows);
}

std::string Utf16(const std::string& text, bool big_endian, bool has_mark) {
  std::string bytes = has_mark ? big_endian ? "\xfe\xff" : "\xff\xfe" : "";
  for (const char c : text) {
    bytes += big_endian ? std::string{'\0', c} : std::string{c, '\0'};
  }
  return bytes;
}

TEST_F(ForeignCsv, Utf16AndLatin1BecomeUtf8) {
  for (const bool big_endian : {false, true}) {
    for (const bool has_mark : {false, true}) {
      Log(Utf16("t,x,y\r\n0,1.5,-2\r\n1,3,4e-3\r\n", big_endian, has_mark));
      Import(kSeconds + Table("x", "y"));
      EXPECT_EQ(Rows(), kTwoRows) << big_endian << has_mark;
    }
  }
  Log("t,x [\xb0],y\n0,1.5,-2\n1,3,4e-3\n");
  Import(kSeconds + Table("'x [°]'", "y"));
  EXPECT_EQ(Rows(), kTwoRows);
}

TEST_F(ForeignCsv, SeparatorsAtTheEndOfRowsAreNoColumns) {
  for (const std::string log :
       {"t,x,y,\n0,1.5,-2,\n1,3,4e-3,\n", "t,x,y\n0,1.5,-2,\n1,3,4e-3,\n",
        "t,x,y,,\n0,1.5,-2,,\n1,3,4e-3\n", "t\tx\ty\t\n0\t1.5\t-2\t\n1\t3\t4e-3\t\n"}) {
    Log(log);
    Import(kSeconds + Table("x", "y"));
    EXPECT_EQ(Rows(), kTwoRows) << log;
  }
}

TEST_F(ForeignCsv, ColumnsOfOneNameAreChosenByTheirNumber) {
  Log("t,x,x\n0,1.5,-2\n1,3,4e-3\n");
  EXPECT_THAT([&] { Import(kSeconds + Table("x", "x#2")); },
              ThrowsMessage<InputError>(HasSubstr(
                  "log.txt:1: column 'x' is there more than once; name one of them: 'x#1' is "
                  "field 2, 'x#2' the next of that name")));
  Import(kSeconds + Table("'x#1'", "'x#2'"));
  EXPECT_EQ(Rows(), kTwoRows);
}

TEST_F(ForeignCsv, ANameInQuotesMayGoOverLines) {
  Log("t,\"x\n[m]\",\"a \"\"y\"\"\"\n0,1.5,-2\n1,\"3\",4e-3\n2,x,1\n");
  EXPECT_THAT([&] { Import(kSeconds + Table("'x [m]'", "'a \"y\"'")); },
              ThrowsMessage<InputError>(HasSubstr("log.txt:5: column 'x [m]': found 'x'")));
  Import(kSeconds + Table("'x [m]'", "'a \"y\"'"), {.skips_bad_rows = true});
  EXPECT_EQ(Rows(), kTwoRows);
}

TEST_F(ForeignCsv, AnInchSignOpensNoField) {
  Log("t,bore 3\",y\n0,1.5,-2\n1,3,4e-3\n");
  Import(kSeconds + Table("'bore 3\"'", "y"));
  EXPECT_EQ(Rows(), kTwoRows);
}

TEST_F(ForeignCsv, WordsForNoNumberAreNoRows) {
  for (const std::string word : {"NaN", "-nan(ind)", "NULL", "#N/A", "n/a", "1.#QNAN", "--", ""}) {
    Log("t,x,y\n0,1.5,-2\n0.5," + word + ",1\n1,3,4e-3\n");
    Import(std::string(kSeconds) +
           "tables: [{name: levels, valid_if: [{column: x, present: true}], columns: {a: {column: "
           "x, unit: '1'}, b: {column: y, unit: '1'}}}]\n");
    EXPECT_EQ(Rows(), kTwoRows) << word;
  }
}

TEST_F(ForeignCsv, AFileThatIsNoTableIsToldWithTheWayToOne) {
  Log("(1436509052.249713) vcan0 044#2A366C2BBA\n");
  EXPECT_THAT([&] { Import(kSeconds + Table("x", "y")); },
              ThrowsMessage<InputError>(
                  AllOf(HasSubstr("log.txt: is a log of a CAN bus by candump"), HasSubstr("DBC"))));
  EXPECT_FALSE(fs::exists(Out()));
}

// --- Times.

std::vector<TimeNs> TimesOf(const fs::path& out) {
  return Recording(out).LoadTable("digger/levels.csv").t_ns;
}
const std::vector<TimeNs> kTwentyMs = {0, 20'000'000};

TEST_F(ForeignCsv, DatesAreTimes) {
  Log("t,x,y\n2024-05-01T12:34:59.990Z,1,1\n2024-05-01T12:35:00.010Z,2,2\n");
  const ImportReport report = Import("zero: start\ntime: {date: t}\n" + Table("x", "y"));
  EXPECT_EQ(TimesOf(Out()), kTwentyMs);
  EXPECT_EQ(report.zero_ns, 1'714'566'899'990'000'000);
  EXPECT_THAT([&] { Import(kSeconds + Table("x", "y")); },
              ThrowsMessage<InputError>(HasSubstr("say time: {date: NAME}")));
}

TEST_F(ForeignCsv, DatesHaveTheZoneAndTheOrderThatTheMappingSays) {
  Log("t,x,y\n05/01/2024 14:34:59.990,1,1\n05/01/2024 14:35:00.010,2,2\n");
  const std::string table = Table("x", "y");
  const ImportReport report =
      Import("zero: start\ntime: {date: t, order: mdy, zone: \"+02:00\"}\n" + table);
  EXPECT_EQ(TimesOf(Out()), kTwentyMs);
  EXPECT_EQ(report.zero_ns, 1'714'566'899'990'000'000);
  EXPECT_THAT([&] { Import("time: {date: t}\n" + table); },
              ThrowsMessage<InputError>(
                  AllOf(HasSubstr("log.txt:2: column 't': found '05/01/2024 14:34:59.990'"),
                        HasSubstr("order: dmy or mdy"))));
  EXPECT_THAT([&] { Import("time: {date: t, zone: CEST}\n" + table); },
              ThrowsMessage<InputError>(HasSubstr("time.zone: 'CEST' is no zone")));
}

TEST_F(ForeignCsv, DateAndClockMayStandInTwoColumns) {
  Log("day,t,x,y\n31.12.2023,23:59:59.990,1,1\n01.01.2024,00:00:00.010,2,2\n");
  Import("zero: start\ntime: {date: day, clock: t}\n" + Table("x", "y"));
  EXPECT_EQ(TimesOf(Out()), kTwentyMs);
  EXPECT_THAT([&] { Import("time: {date: day}\n" + Table("x", "y")); },
              ThrowsMessage<InputError>(HasSubstr("which has no time of day")));
}

TEST_F(ForeignCsv, ClocksGoOnOverMidnight) {
  Log("t,x,y\n23:59:59.990,1,1\n00:00:00.010,2,2\n");
  Import("zero: start\ntime: {clock: t}\n" + Table("x", "y"));
  EXPECT_EQ(TimesOf(Out()), kTwentyMs);
}

TEST_F(ForeignCsv, RowsThatAreLeftOutCountNoDays) {
  Log("t,x,y\n23:00:00.000,1,1\n00:00:00.000,0,0\n23:00:00.020,2,2\n");
  Import(
      "zero: start\ntime: {clock: t}\ntables: [{name: levels, valid_if: [{column: x, above: 0}], "
      "columns: {a: {column: x, unit: '1'}}}]\n");
  EXPECT_EQ(TimesOf(Out()), kTwentyMs);
}

TEST_F(ForeignCsv, WeeksOfGpsBecomeUtc) {
  // 2024-05-01 is a Wednesday of week 2312; GPS time is 18 s ahead of UTC.
  Log("w,t,x,y\n2312,304517.990,1,1\n2312,304518.010,2,2\n");
  const ImportReport report =
      Import("zero: start\ntime: {week: w, column: t, unit: s}\n" + Table("x", "y"));
  EXPECT_EQ(TimesOf(Out()), kTwentyMs);
  EXPECT_EQ(report.zero_ns, 1'714'566'899'990'000'000);
  Log("w,t,x,y\n264,304517.990,1,1\n");
  EXPECT_THAT([&] { Import("time: {week: w, column: t, unit: s}\n" + Table("x", "y")); },
              ThrowsMessage<InputError>(HasSubstr("need a week since 1980-01-06, 1024 to 8192")));
}

TEST_F(ForeignCsv, SerialDaysOfSpreadsheetsAndMinutesAreExact) {
  // Day 45413 of a spreadsheet is 2024-05-01; a quarter of a day is 6 h.
  Log("t,x,y\n45413.25,1,1\n45413.2500002315,2,2\n");
  const ImportReport report =
      Import("zero: start\ntime: {column: t, unit: day, offset: -2209161600}\n" + Table("x", "y"));
  EXPECT_EQ(report.zero_ns, 1'714'543'200 * kNsPerSecond);
  EXPECT_NEAR(ToSeconds(TimesOf(Out()).at(1)), 0.02, 1e-5);
  Log("t,x,y\n0.5,1,1\n1.25,2,2\n");
  Import("time: {column: t, unit: min}\n" + Table("x", "y"));
  EXPECT_EQ(TimesOf(Out()), (std::vector<TimeNs>{30 * kNsPerSecond, 75 * kNsPerSecond}));
}

TEST_F(ForeignCsv, SecondsAndNanosecondsOfTwoColumnsAreOneTime) {
  Log("sec,nanosec,x,y\n1700000000,990000001,1,1\n1700000001,10000001,2,2\n");
  const ImportReport report =
      Import("zero: start\ntime: {sum: [{column: sec, unit: s}, {column: nanosec, unit: ns}]}\n" +
             Table("x", "y"));
  EXPECT_EQ(TimesOf(Out()), kTwentyMs);
  EXPECT_EQ(report.zero_ns, 1'700'000'000'990'000'001);
}

TEST_F(ForeignCsv, ATimeThatIsToBeFilledInIsAFaultAtItsLine) {
  Log("t,x,y\n0,1.5,-2\n");
  EXPECT_THAT([&] { Import("time: unknown\n" + Table("x", "y")); },
              ThrowsMessage<InputError>(
                  AllOf(HasSubstr("mapping.yaml:4:7: time: 'unknown' says nothing of the time"),
                        HasSubstr("{column: NAME, unit: s}"))));
  EXPECT_THAT([&] { Import("time: {column: t, unit: unknown}\n" + Table("x", "y")); },
              ThrowsMessage<InputError>(HasSubstr("time.unit: 'unknown' does not fit here")));
}

// --- Mappings.

TEST_F(ForeignCsv, ALeverOfTwoDirectionsIsTheirDifference) {
  Log("t,up,down\n0,25,0\n1,0,100\n");
  Import(std::string(kSeconds) +
         "tables: [{name: commands, columns: {boom: {sum: [{column: up, unit: \"%\"}, {column: "
         "down, unit: \"%\", scale: -1}]}}}]\n");
  EXPECT_EQ(Rows("commands"), (std::vector<std::vector<double>>{{0.25}, {-1}}));
  EXPECT_THAT(
      [&] { Import(std::string(kSeconds) + "tables: [{name: c, columns: {b: {sum: []}}}]\n"); },
      ThrowsMessage<InputError>(HasSubstr("columns.b.sum: need at least one column")));
}

TEST_F(ForeignCsv, RowsAreChosenByAText) {
  Log("t,signal,value\n0,boom,20\n0.5,arm,-60\n1,boom,21\n1.5,bucket 2,4\n");
  const auto table = [](const std::string& signal) {
    return "tables: [{name: levels, valid_if: [{column: signal, equals: " + signal +
           "}], columns: {a: {column: value, unit: '1'}}}]\n";
  };
  Import(kSeconds + table("boom"));
  EXPECT_EQ(Rows(), (std::vector<std::vector<double>>{{20}, {21}}));
  Import(kSeconds + table("bucket 2"));
  EXPECT_EQ(Rows(), (std::vector<std::vector<double>>{{4}}));
}

class ForeignCsvFiles : public ForeignCsv {
 protected:
  ForeignCsvFiles() {
    WriteWholeFile(scratch_.path() / "a.csv", "t,x,y\n0,1.5,-2\n");
    WriteWholeFile(scratch_.path() / "b.csv", "t,x,y\n1,3,4e-3\n");
  }
  ImportReport ImportBoth(const std::string& keys = kSeconds, ImportOptions options = {}) {
    WriteWholeFile(
        scratch_.path() / "mapping.yaml",
        "name: logged\nmachine: digger\nfile: [a.csv, b.csv]\n" + keys + Table("x", "y"));
    fs::remove_all(Out());
    return ImportCsv(scratch_.path() / "mapping.yaml", Out(), options);
  }
};

TEST_F(ForeignCsvFiles, AreJoinedInTheirOrder) {
  ImportBoth();
  EXPECT_EQ(Rows(), kTwoRows);
  ImportBoth("time: {interval: 20, unit: ms}\n");
  EXPECT_EQ(TimesOf(Out()), kTwentyMs);
  EXPECT_THAT(ReadWholeFile(Out() / "dataset.yaml"), AllOf(HasSubstr("a.csv"), HasSubstr("b.csv")));
}

TEST_F(ForeignCsvFiles, MustHaveTheSameColumnsAndTimesThatGoOn) {
  WriteWholeFile(scratch_.path() / "b.csv", "t,y,x\n1,3,4e-3\n");
  EXPECT_THAT([&] { ImportBoth(); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("b.csv: has column 'y' where"),
                                              HasSubstr("a.csv has column 'x'"))));
  WriteWholeFile(scratch_.path() / "b.csv", "t,x,y\n\n0,3,4e-3\n");
  EXPECT_THAT([&] { ImportBoth(); },
              ThrowsMessage<InputError>(HasSubstr("b.csv:3: column 't': found '0', need a later")));
  WriteWholeFile(scratch_.path() / "b.csv", "t,x,y\n1,oh,4e-3\n");
  EXPECT_THAT([&] { ImportBoth(); },
              ThrowsMessage<InputError>(HasSubstr("b.csv:2: column 'x': found 'oh'")));
}

}  // namespace
}  // namespace tera
