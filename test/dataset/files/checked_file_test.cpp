#include "dataset/files/checked_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "dataset/format/sample_recording.h"

namespace tera {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;
namespace fs = std::filesystem;

TEST(CheckedFile, ReportsAFullDevice) {
  // /dev/full takes no byte; the temporary name beside a link to it leads there.
  ScratchDirectory scratch;
  fs::create_symlink("/dev/full", scratch.path() / "data.csv.part");
  CheckedFile file(scratch.path() / "data.csv");
  file.Append("1,2,3\n");
  EXPECT_THAT([&] { file.Commit(); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("data.csv: cannot be written"),
                                              HasSubstr("free space on that disk"))));
  EXPECT_FALSE(fs::exists(scratch.path() / "data.csv"));
}

}  // namespace
}  // namespace tera
