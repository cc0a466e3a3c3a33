#include "core/config/csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/error.h"
#include "own_folder.h"

namespace tera {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string Write(const std::string& text) {
  const std::string path = OwnFolder() / "table.csv";
  std::ofstream(path) << text;
  return path;
}

std::string MessageOf(const std::string& text, const std::vector<std::string>& names) {
  try {
    ReadCsvColumns(Write(text), names);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(Csv, ReadsNamedColumnsInTheOrderAskedAndIgnoresOthers) {
  const auto columns = ReadCsvColumns(Write("a,note,b\r\n1,x,-2.5e3\r\n3,,4\r\n"), {"b", "a"});
  EXPECT_THAT(columns[0], ElementsAre(-2500, 4));
  EXPECT_THAT(columns[1], ElementsAre(1, 3));
}

TEST(Csv, NamesFileAndLineOfWhatIsWrong) {
  EXPECT_THAT(MessageOf("a,b\n1,2\n1,nan\n", {"b"}), HasSubstr("table.csv:3: b: 'nan' is not"));
  EXPECT_THAT(MessageOf("a,b\n1,2\n1\n", {"b"}), HasSubstr("table.csv:3: 1 fields, need 2"));
  EXPECT_THAT(MessageOf("speed,b\n1,2\n", {"sped"}),
              HasSubstr("no column 'sped' (did you mean 'speed'?)"));
  EXPECT_THAT(MessageOf("", {"a"}), HasSubstr("table.csv:1: empty"));
}

TEST(Csv, RefusesAFileThatIsNotThere) {
  EXPECT_THROW(ReadCsvHeader("/nowhere/at/all.csv"), InputError);
}

}  // namespace
}  // namespace tera
