#include "view/served_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "core/faults.h"
#include "view/small_recording.h"

namespace tera {
namespace {

using enum FaultKind;
namespace fs = std::filesystem;

class ServedFolderOfThree : public testing::Test {
 protected:
  ServedFolderOfThree() {
    WriteFileAt(base_ / "outside.txt", "secret");
    WriteFileAt(base_ / "data-beside" / "file.txt", "a folder whose name begins as the other's");
    WriteFileAt(base_ / "data" / "in" / "file.txt", "0123456789");
    fs::create_directories(base_ / "data" / "links");
    const auto link = [&](const fs::path& to, const char* name) {
      fs::remove(base_ / "data" / "links" / name);
      fs::create_symlink(to, base_ / "data" / "links" / name);
    };
    link(base_ / "outside.txt", "out");
    link("../../data-beside", "beside");
    link("../in/file.txt", "within");
  }

  fs::path base_ = OwnFolder() / "served";
};

TEST_F(ServedFolderOfThree, FindsRegularFilesBelowIt) {
  const ServedFolder folder(base_ / "data");
  const auto file = folder.Find("in/file.txt");
  ASSERT_TRUE(file.has_value());
  EXPECT_TRUE(fs::equivalent(*file, base_ / "data" / "in" / "file.txt"));
  EXPECT_TRUE(folder.Find("links/within").has_value());
}

TEST_F(ServedFolderOfThree, FindsNothingElse) {
  const ServedFolder folder(base_ / "data");
  for (const std::string path :
       {"", "/", "in", "in/", "in/none.txt", "/etc/passwd", "..", "../outside.txt",
        "in/../../outside.txt", "in/../in/file.txt", "./in/file.txt", "in//file.txt", "links/out",
        "links/beside/file.txt", "links/beside"}) {
    EXPECT_FALSE(folder.Find(path).has_value()) << path;
  }
  EXPECT_FALSE(folder.Find(std::string("in/file.txt\0.png", 16)).has_value());
}

TEST_F(ServedFolderOfThree, IsFoundThroughALinkToItself) {
  const fs::path link = base_ / "link_to_data";
  fs::remove(link);
  fs::create_symlink(base_ / "data", link);
  EXPECT_TRUE(ServedFolder(link).Find("in/file.txt").has_value());
  EXPECT_FALSE(ServedFolder(link).Find("../outside.txt").has_value());
}

TEST_F(ServedFolderOfThree, IsNeededToBeThere) {
  for (const char* name : {"none", "outside.txt"}) {
    EXPECT_THAT([&] { const ServedFolder folder(base_ / name); }, ThrowsFault(kUnreadable, name));
  }
}

TEST_F(ServedFolderOfThree, PartsOfFilesEndWhereTheFileDoes) {
  const fs::path file = base_ / "data" / "in" / "file.txt";
  EXPECT_EQ(ReadPart(file, 0, 10), "0123456789");
  EXPECT_EQ(ReadPart(file, 3, 4), "3456");
  EXPECT_EQ(ReadPart(file, 8, 100), "89");
  EXPECT_EQ(ReadPart(file, 100, 4), "");
}

}  // namespace
}  // namespace tera
