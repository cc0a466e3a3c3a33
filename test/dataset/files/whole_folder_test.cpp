#include "dataset/files/whole_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/faults.h"
#include "dataset/files/checked_file.h"
#include "own_folder.h"

namespace tera {
namespace {

using enum FaultKind;
namespace fs = std::filesystem;

TEST(WholeFolder, AppearsWhenItIsWhole) {
  const fs::path place = OwnFolder() / "reports/whole";
  WholeFolder folder(place / "");
  WriteWholeFile(folder.temporary() / "page.html", "all of it");
  EXPECT_FALSE(fs::exists(place));
  folder.Commit();
  EXPECT_EQ(ReadWholeFile(place / "page.html"), "all of it");
  EXPECT_FALSE(fs::exists(OwnFolder() / "reports/whole.incomplete"));
}

TEST(WholeFolder, LeavesNothingWhereItIsNotCompleted) {
  const fs::path place = OwnFolder() / "given_up";
  {
    const WholeFolder folder(place);
    WriteWholeFile(folder.temporary() / "page.html", "half of");
  }
  EXPECT_FALSE(fs::exists(place));
  EXPECT_FALSE(fs::exists(OwnFolder() / "given_up.incomplete"));
}

TEST(WholeFolder, KeepsWhatAnotherRunHasLeft) {
  const fs::path beside = OwnFolder() / "stopped.incomplete";
  fs::create_directory(beside);
  WriteWholeFile(beside / "page.html", "mine");
  EXPECT_THAT([] { WholeFolder folder(OwnFolder() / "stopped"); },
              ThrowsFault(kUnwritable, "stopped.incomplete"));
  EXPECT_EQ(ReadWholeFile(beside / "page.html"), "mine");
}

TEST(WholeFolder, GoesOnWithWhatAnotherRunHasLeftAndClearsItWhereAsked) {
  const fs::path place = OwnFolder() / "resumed", beside = OwnFolder() / "resumed.incomplete";
  fs::create_directory(beside);
  WriteWholeFile(beside / "page.html", "mine");
  { WholeFolder folder(place, WholeFolder::Left::kIsKept); }
  EXPECT_EQ(ReadWholeFile(beside / "page.html"), "mine");
  {
    WholeFolder folder(place, WholeFolder::Left::kIsKept);
    folder.Clear();
    EXPECT_TRUE(fs::is_empty(beside));
    WriteWholeFile(beside / "page.html", "half of");
  }
  EXPECT_FALSE(fs::exists(beside));
}

TEST(WholeFolder, IsOfOneRunAtATime) {
  WholeFolder first(OwnFolder() / "once");
  EXPECT_THAT([] { WholeFolder second(OwnFolder() / "once"); },
              ThrowsFault(kUnwritable, "once.incomplete"));
  WriteWholeFile(first.temporary() / "page.html", "first");
  first.Commit();
  EXPECT_EQ(ReadWholeFile(OwnFolder() / "once/page.html"), "first");
}

TEST(WholeFolder, TakesTheNameOfAnEmptyFolderAndOfNoOther) {
  fs::create_directory(OwnFolder() / "empty");
  WholeFolder(OwnFolder() / "empty").Commit();
  EXPECT_TRUE(fs::exists(OwnFolder() / "empty"));
  fs::create_directory(OwnFolder() / "full");
  WriteWholeFile(OwnFolder() / "full/diary.txt", "mine");
  EXPECT_THAT([] { WholeFolder(OwnFolder() / "full").Commit(); }, ThrowsFault(kUnwritable));
  EXPECT_EQ(ReadWholeFile(OwnFolder() / "full/diary.txt"), "mine");
  EXPECT_FALSE(fs::exists(OwnFolder() / "full.incomplete"));
}

}  // namespace
}  // namespace tera
