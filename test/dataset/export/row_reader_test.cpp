#include "dataset/export/row_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/sample_recording.h"

namespace tera {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
namespace fs = std::filesystem;

class RowReaderTest : public testing::Test {
 protected:
  /// What is said about a file of these bytes when all of it is read.
  std::string FaultOf(const std::string& bytes) {
    const fs::path file = scratch_.path() / "data.csv";
    WriteWholeFile(file, bytes);
    try {
      RowReader reader(file);
      TimeNs t_ns = 0;
      for (std::vector<double> values; reader.Next(&t_ns, &values);) {
      }
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
  ScratchDirectory scratch_;
};

TEST_F(RowReaderTest, GivesRowAfterRow) {
  const fs::path file = scratch_.path() / "data.csv";
  WriteWholeFile(file, "t_ns,a_m,b_rad\n-5,1.5,-2e-3\r\n7,0,4\n");
  RowReader reader(file);
  EXPECT_THAT(reader.columns(), ElementsAre("a_m", "b_rad"));
  TimeNs t_ns = 0;
  std::vector<double> values;
  ASSERT_TRUE(reader.Next(&t_ns, &values));
  EXPECT_EQ(t_ns, -5);
  EXPECT_THAT(values, ElementsAre(1.5, -0.002));
  ASSERT_TRUE(reader.Next(&t_ns, &values));
  EXPECT_EQ(t_ns, 7);
  EXPECT_THAT(values, ElementsAre(0, 4));
  EXPECT_FALSE(reader.Next(&t_ns, &values));
}

TEST_F(RowReaderTest, OfAListOfFramesOnlyTheTimesCount) {
  EXPECT_EQ(FaultOf("t_ns,filename\n5,5.pcd\n6,6.pcd\n"), "");
}

TEST_F(RowReaderTest, FaultsHaveTheirLine) {
  EXPECT_THAT(FaultOf(""), HasSubstr("data.csv:1: the file is empty"));
  EXPECT_THAT(FaultOf("time,a\n"), HasSubstr("data.csv:1: the first column is 'time', need t_ns"));
  EXPECT_THAT(FaultOf("t_ns,a\n1,2\n2,3"), HasSubstr("data.csv:3: the last line is cut off"));
  EXPECT_THAT(FaultOf("t_ns,a\n1.5,2\n"), HasSubstr("data.csv:2: t_ns is '1.5'"));
  EXPECT_THAT(FaultOf("t_ns,a\n99999999999999999999,2\n"), HasSubstr("data.csv:2: t_ns is '9999"));
  EXPECT_THAT(FaultOf("t_ns,a\n2,2\n2,3\n"), HasSubstr("data.csv:3: t_ns is 2, need a later"));
  EXPECT_THAT(FaultOf("t_ns,a\n1,nan\n"), HasSubstr("data.csv:2: column 'a': found 'nan'"));
  EXPECT_THAT(FaultOf("t_ns,a\n1,inf\n"), HasSubstr("column 'a': found 'inf'"));
  EXPECT_THAT(FaultOf("t_ns,a\n1,1e999\n"), HasSubstr("column 'a': found '1e999'"));
  EXPECT_THAT(FaultOf("t_ns,a\n1,\n"), HasSubstr("column 'a': found ''"));
  EXPECT_THAT(FaultOf("t_ns,a,b\n1,2\n"), HasSubstr("data.csv:2: found 2 fields, need 3"));
  EXPECT_THAT(FaultOf("t_ns,a\n1,2,3\n"), HasSubstr("data.csv:2: found more than 2 fields"));
  EXPECT_THAT(FaultOf("t_ns,a\n\n"), HasSubstr("data.csv:2: t_ns is ''"));
}

TEST_F(RowReaderTest, AFileThatIsNotThereIsOneThatTheDatasetPromised) {
  EXPECT_THROW(RowReader(scratch_.path() / "none.csv"), InputError);
  EXPECT_THROW(RowReader{scratch_.path()}, InputError);
}

}  // namespace
}  // namespace tera
