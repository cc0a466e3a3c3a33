#include "dataset/import/foreign_csv.h"

/// Tables by foreign loggers.

namespace tera {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

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
      ThrowsFault(FaultKind::kNoSuchName, "log.txt:1"));
}

TEST_F(ForeignCsv, LastLineThatWasCutOffIsTold) {
  Log("t,x,y\n0,1.5,-2\n1,3,4e-3\n2,7");
  EXPECT_THAT([&] { Import(kSeconds + Table("x", "y")); },
              ThrowsFault(FaultKind::kMalformed, "log.txt:4"));
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
              ThrowsFault(FaultKind::kOutOfRange, "log.txt:2"));
  EXPECT_FALSE(fs::exists(Out()));
}

// Memory is reserved for the text's possible content, not for as many wide rows as it has lines.
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
              ThrowsFault(FaultKind::kMalformed, "log.txt:4"));
  const ImportReport report = Import(kSeconds + Table("x", "y"), {.skips_bad_rows = true});
  // 0.2 s is later than the row that is left before it.
  EXPECT_EQ(Rows().size(), 3u);
  EXPECT_EQ(report.channels[0].left_out, 3);
}

TEST_F(ForeignCsv, FileWithoutAnythingIsTold) {
  for (const std::string log : {"", "\n\n", "# nothing\n"}) {
    Log(log);
    EXPECT_THAT(
        [&] { Import("csv: {header: false}\ntime: {column: 1, unit: s}\n" + Table("2", "3")); },
        ThrowsFault(FaultKind::kMissing, "log.txt"))
        << log;
  }
}

TEST_F(ForeignCsv, DecimalCommasAreReadWhereTheMappingSaysSo) {
  Log("t;x;y\n0,0;1,5;-2\n1,0;3;4e-3\n");
  EXPECT_THAT([&] { Import(kSeconds + Table("x", "y")); },
              ThrowsFault(FaultKind::kMistyped, "log.txt:2: column 't'"));
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
      ThrowsFault(FaultKind::kMistyped, "log.txt:2: column 'x'"));
  EXPECT_THAT(
      [&] { Import("csv: {thousands: \".\"}\n" + std::string(kSeconds) + Table("x", "y")); },
      ThrowsFault(FaultKind::kInconsistent, "csv.thousands"));
}

TEST_F(ForeignCsv, LinesOfUnitsAreNoRows) {
  Log("t,x,y\ns,m,m\n\n0,1.5,-2\n1,3,4e-3\n");
  EXPECT_THAT([&] { Import(kSeconds + Table("x", "y")); },
              ThrowsFault(FaultKind::kMistyped, "log.txt:2: column 't'"));
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
              ThrowsFault(FaultKind::kRepeated, "log.txt:1"));
  Import(kSeconds + Table("'x#1'", "'x#2'"));
  EXPECT_EQ(Rows(), kTwoRows);
}

TEST_F(ForeignCsv, ANameInQuotesMayGoOverLines) {
  Log("t,\"x\n[m]\",\"a \"\"y\"\"\"\n0,1.5,-2\n1,\"3\",4e-3\n2,x,1\n");
  EXPECT_THAT([&] { Import(kSeconds + Table("'x [m]'", "'a \"y\"'")); },
              ThrowsFault(FaultKind::kMistyped, "log.txt:5: column 'x [m]'"));
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
              ThrowsFault(FaultKind::kUnsupported, "log.txt"));
  EXPECT_FALSE(fs::exists(Out()));
}

TEST_F(ForeignCsv, FilesWithoutRowsAreRefused) {
  for (const std::string log : {"", "t,x,y\n", "t,x,y\n\n# end\n"}) {
    Log(log);
    EXPECT_THAT([&] { Import(kSeconds + Table("x", "y")); },
                ThrowsFault(FaultKind::kMissing, "log.txt"))
        << log;
  }
}

}  // namespace
}  // namespace tera
