#include "dataset/format/row_scan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/faults.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/sample_recording.h"

namespace tera {
namespace {

using enum FaultKind;
using testing::ElementsAre;
namespace fs = std::filesystem;

class RowScanTest : public testing::Test {
 protected:
  /// The fault of a complete reading of a file with these bytes.
  std::vector<InputFault> FaultOf(const std::string& bytes) {
    const fs::path file = scratch_.path() / "data.csv";
    WriteWholeFile(file, bytes);
    try {
      RowScan scan(file);
      for (ScannedRow row; scan.Next(&row);) {
      }
    } catch (const InputError& e) {
      return e.faults();
    }
    return {};
  }
  ScratchDirectory scratch_;
};

TEST_F(RowScanTest, GivesRowAfterRow) {
  const fs::path file = scratch_.path() / "data.csv";
  WriteWholeFile(file, "t_ns,a_m,b_rad\n-5,1.5,-2e-3\r\n7,0,4\n");
  RowScan scan(file);
  EXPECT_THAT(scan.columns(), ElementsAre("a_m", "b_rad"));
  ScannedRow row;
  ASSERT_TRUE(scan.Next(&row));
  EXPECT_EQ(row.t_ns, -5);
  EXPECT_THAT(row.values, ElementsAre(1.5, -0.002));
  ASSERT_TRUE(scan.Next(&row));
  EXPECT_EQ(row.t_ns, 7);
  EXPECT_THAT(row.values, ElementsAre(0, 4));
  EXPECT_FALSE(scan.Next(&row));
}

TEST_F(RowScanTest, OfAListOfFramesGivesTheFiles) {
  const fs::path file = scratch_.path() / "data.csv";
  WriteWholeFile(file, "t_ns,filename\n5,5.pcd\n6,6.pcd\n");
  RowScan scan(file);
  ScannedRow row;
  ASSERT_TRUE(scan.Next(&row) && scan.Next(&row));
  EXPECT_EQ(row.filename, "6.pcd");
  EXPECT_TRUE(row.values.empty());
}

TEST_F(RowScanTest, GoesOnBehindFaultsThatItTells) {
  const fs::path file = scratch_.path() / "data.csv";
  WriteWholeFile(file, "t_ns,a\n1,2\n1,3\n2,nan\n3,x\n4,7\n5,8");
  std::vector<std::pair<RowFault, int>> told;
  RowScan scan(
      file, [&](RowFault fault, int line, const std::string&) { told.emplace_back(fault, line); });
  std::vector<double> values;
  for (ScannedRow row; scan.Next(&row);) values.push_back(row.values[0]);
  EXPECT_THAT(values, ElementsAre(2, 7));
  EXPECT_THAT(told, ElementsAre(std::pair(RowFault::kStamp, 3), std::pair(RowFault::kNotFinite, 4),
                                std::pair(RowFault::kFields, 5), std::pair(RowFault::kCutOff, 7)));
}

TEST_F(RowScanTest, FaultsHaveTheirLine) {
  EXPECT_THAT(FaultOf(""), HasFault(kMalformed, "data.csv:1"));
  EXPECT_THAT(FaultOf("time,a\n"), HasFault(kMalformed, "data.csv:1"));
  EXPECT_THAT(FaultOf("t_ns,a\n1,2\n2,3"), HasFault(kMalformed, "data.csv:3"));
  EXPECT_THAT(FaultOf("t_ns,a\n1.5,2\n"), HasFault(kMalformed, "data.csv:2"));
  EXPECT_THAT(FaultOf("t_ns,a\n99999999999999999999,2\n"), HasFault(kMalformed, "data.csv:2"));
  EXPECT_THAT(FaultOf("t_ns,a\n2,2\n2,3\n"), HasFault(kMalformed, "data.csv:3"));
  EXPECT_THAT(FaultOf("t_ns,a\n1,nan\n"), HasFault(kMalformed, "data.csv:2"));
  EXPECT_THAT(FaultOf("t_ns,a\n1,inf\n"), HasFault(kMalformed, "data.csv:2"));
  EXPECT_THAT(FaultOf("t_ns,a\n1,1e999\n"), HasFault(kMalformed, "data.csv:2"));
  EXPECT_THAT(FaultOf("t_ns,a\n1,\n"), HasFault(kMalformed, "data.csv:2"));
  EXPECT_THAT(FaultOf("t_ns,a,b\n1,2\n"), HasFault(kMalformed, "data.csv:2"));
  EXPECT_THAT(FaultOf("t_ns,a\n1,2,3\n"), HasFault(kMalformed, "data.csv:2"));
  EXPECT_THAT(FaultOf("t_ns,a\n\n"), HasFault(kMalformed, "data.csv:2"));
}

TEST_F(RowScanTest, AFileThatIsNotThereIsOneThatTheDatasetPromised) {
  EXPECT_THROW(RowScan(scratch_.path() / "none.csv"), InputError);
  EXPECT_THROW(RowScan{scratch_.path()}, InputError);
}

}  // namespace
}  // namespace tera
