#include "core/config/csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/faults.h"
#include "own_folder.h"

namespace tera {
namespace {

using enum FaultKind;
using ::testing::ElementsAre;

std::string Write(const std::string& text) {
  const std::string path = OwnFolder() / "table.csv";
  std::ofstream(path) << text;
  return path;
}

std::vector<InputFault> FaultsOfCsv(const std::string& text,
                                    const std::vector<std::string>& names) {
  return FaultsIn([&] { ReadCsvColumns(Write(text), names); });
}

TEST(Csv, ReadsNamedColumnsInTheOrderAskedAndIgnoresOthers) {
  const auto columns = ReadCsvColumns(Write("a,note,b\r\n1,x,-2.5e3\r\n3,,4\r\n"), {"b", "a"});
  EXPECT_THAT(columns[0], ElementsAre(-2500, 4));
  EXPECT_THAT(columns[1], ElementsAre(1, 3));
}

TEST(Csv, NamesFileAndLineOfWhatIsWrong) {
  EXPECT_THAT(FaultsOfCsv("a,b\n1,2\n1,nan\n", {"b"}), HasFault(kMistyped, "table.csv:3: b"));
  EXPECT_THAT(FaultsOfCsv("a,b\n1,2\n1\n", {"b"}), HasFault(kMalformed, "table.csv:3"));
  EXPECT_THAT(FaultsOfCsv("speed,b\n1,2\n", {"sped"}), HasFault(kMissing, "table.csv:1"));
  EXPECT_THAT(FaultsOfCsv("", {"a"}), HasFault(kMalformed, "table.csv:1"));
}

TEST(Csv, RefusesAFileThatIsNotThere) {
  EXPECT_THAT([] { ReadCsvHeader("/nowhere/at/all.csv"); }, ThrowsFault(kUnreadable, "all.csv"));
}

}  // namespace
}  // namespace tera
