#include <gmock/gmock.h>

#include "dataset/lint/healthy_recording.h"

// rows.* and stamps.*: each broken by itself.

namespace tera {
namespace {

using testing::HasSubstr;

class RowRules : public LintTest {};

TEST_F(RowRules, AMissingColumn) {
  Edit("digger/imu/data.csv", "t_ns,wx_radps", "t_ns,wx");
  EXPECT_EQ(Only("rows.header", "digger/imu").places[0].line, 1);
}

TEST_F(RowRules, AnEncodersColumnsInAnotherOrder) {
  Edit("digger/joints/data.csv", "boom_radps,stick_mps", "stick_mps,boom_radps");
  Only("rows.header", "digger/joints");
}

TEST_F(RowRules, AFileWithoutTimes) {
  Edit("digger/commands.csv", "t_ns", "time");
  Only("rows.header", "digger/commands.csv");
}

TEST_F(RowRules, ARowWithTooFewFields) {
  EditRows("digger/commands.csv", [](int line, std::vector<std::string>* fields) {
    if (line == 7) fields->pop_back();
  });
  const LintFinding finding = Only("rows.fields", "digger/commands.csv");
  EXPECT_EQ(finding.places[0].line, 7);
  EXPECT_THAT(finding.places[0].message, HasSubstr("2 fields, need 3"));
}

TEST_F(RowRules, AFieldThatIsNoNumber) {
  EditRows("digger/commands.csv", [](int line, std::vector<std::string>* fields) {
    if (line == 4) (*fields)[1] = "up";
  });
  EXPECT_EQ(Only("rows.fields", "digger/commands.csv").places[0].line, 4);
}

TEST_F(RowRules, ALastLineThatIsCutOff) {
  std::string text = ReadWholeFile(run() / "digger/commands.csv");
  text.resize(text.size() - 2);
  Put("digger/commands.csv", text);
  EXPECT_THAT(Only("rows.fields", "digger/commands.csv").places[0].message, HasSubstr("cut off"));
}

TEST_F(RowRules, NaNAndInfinity) {
  EditRows("digger/commands.csv", [](int line, std::vector<std::string>* fields) {
    if (line == 4) (*fields)[1] = "nan";
    if (line == 9) (*fields)[2] = "-inf";
  });
  const LintFinding finding = Only("rows.finite", "digger/commands.csv");
  ASSERT_EQ(finding.count, 2);
  EXPECT_EQ(finding.places[0].line, 4);
  EXPECT_EQ(finding.places[0].message, "column 'boom': found 'nan', need a finite number");
}

TEST_F(RowRules, AFrameOfAnotherName) {
  Edit("digger/front/data.csv", "200000000.png", "frame1.png");
  EXPECT_EQ(Only("rows.filename", "digger/front").places[0].line, 3);
}

TEST_F(RowRules, AStampThatIsThereTwice) {
  EditRows("digger/imu/data.csv", [](int line, std::vector<std::string>* fields) {
    if (line == 12) (*fields)[0] = "100000000";  // as line 11
  });
  const LintFinding finding = Only("stamps.increasing", "digger/imu");
  EXPECT_EQ(finding.count, 1);
  EXPECT_EQ(finding.places[0].file, "digger/imu/data.csv");
  EXPECT_EQ(finding.places[0].line, 12);
}

TEST_F(RowRules, AMissingRow) {
  EditRows("digger/imu/data.csv", [](int line, std::vector<std::string>* fields) {
    if (line == 31) fields->clear();
  });
  const LintFinding finding = Only("stamps.gap", "digger/imu");
  EXPECT_EQ(finding.count, 1);
  EXPECT_EQ(finding.places[0].line, 31);
}

TEST_F(RowRules, AMissingRowOfATableWithoutARate) {
  EditRows("digger/commands.csv", [](int line, std::vector<std::string>* fields) {
    if (line == 31) fields->clear();
  });
  Only("stamps.gap", "digger/commands.csv");
}

TEST_F(RowRules, AnotherRateThanTheSheets) {
  Edit("digger/imu/sensor.yaml", "rate_hz: 100", "rate_hz: 90");
  EXPECT_THAT(Only("stamps.rate", "digger/imu").places[0].message,
              HasSubstr("100 Hz, sensor.yaml gives 90 Hz"));
}

TEST_F(RowRules, AChannelThatEndsTooEarly) {
  EditRows("digger/commands.csv", [](int line, std::vector<std::string>* fields) {
    if (line > 60) fields->clear();
  });
  Only("stamps.coverage", "digger/commands.csv");
}

TEST_F(RowRules, AChannelThatLiesElsewhereInTime) {
  EditRows("digger/commands.csv", [](int, std::vector<std::string>* fields) {
    (*fields)[0] = std::to_string(std::stoll((*fields)[0]) + 3'000'000'000);
  });
  Only("stamps.coverage", "digger/commands.csv");
}

// A table written on changes has no rate and no gaps.
TEST_F(RowRules, AnIrregularTableIsFine) {
  EditRows("digger/commands.csv", [](int line, std::vector<std::string>* fields) {
    if (line % 7 == 3 || line % 5 == 2) fields->clear();
  });
  EXPECT_TRUE(Found().empty());
}

}  // namespace
}  // namespace tera
