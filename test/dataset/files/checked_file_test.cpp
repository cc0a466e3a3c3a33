#include "dataset/files/checked_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/faults.h"
#include "dataset/format/sample_recording.h"

namespace tera {
namespace {

using enum FaultKind;
namespace fs = std::filesystem;

TEST(CheckedFile, ReportsAFullDevice) {
  // /dev/full accepts no byte; the temporary name next to a link to it leads there.
  ScratchDirectory scratch;
  fs::create_symlink("/dev/full", scratch.path() / "data.csv.part");
  CheckedFile file(scratch.path() / "data.csv");
  file.Append("1,2,3\n");
  EXPECT_THAT([&] { file.Commit(); }, ThrowsFault(kUnwritable, "data.csv"));
  EXPECT_FALSE(fs::exists(scratch.path() / "data.csv"));
}

}  // namespace
}  // namespace tera
