#include "core/config/portable_name.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/config/config.h"
#include "own_folder.h"

namespace tera {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

/// A file of that name in this process's folder, and the folder's path without links.
fs::path NewFile(const std::string& name) {
  const fs::path file = fs::canonical(OwnFolder()) / name;
  fs::create_directories(file.parent_path());
  std::ofstream(file) << name;
  return file;
}

TEST(PortableName, OfAShippedFileIsTheSameEverywhere) {
  EXPECT_EQ(PortableName(DataRoot() / "config/machines/../soils/dirt.yaml"),
            "tera:config/soils/dirt.yaml");
}

TEST(PortableName, OfAFileBesideTheShippedOnesIsItsPath) {
  EXPECT_EQ(PortableName(DataRoot() / "out/run/levers.csv"),
            (fs::canonical(DataRoot()) / "out/run/levers.csv").string());
  EXPECT_EQ(PortableName(DataRoot() / "configs/levers.csv"),
            (fs::canonical(DataRoot()) / "configs/levers.csv").string());
}

TEST(PortableName, FollowsLinksToFoldersButNotTheFileItself) {
  const fs::path file = NewFile("real/digger.urdf");
  const fs::path folder = file.parent_path().parent_path();
  fs::create_directory_symlink("real", folder / "linked");
  EXPECT_EQ(PortableName(folder / "linked/digger.urdf"), file.string());
  // Its meshes lie next to the link.
  fs::create_symlink(file, folder / "digger.urdf");
  EXPECT_EQ(PortableName(folder / "digger.urdf"), (folder / "digger.urdf").string());
}

TEST(PlaceOfInput, IsWhereTheFirstMoveThatConcernsItSays) {
  const std::vector<MovedFiles> moved = {{"/a/site/levers.csv", "l.csv"}, {"/a/site", "/b"}};
  EXPECT_EQ(PlaceOfInput("/a/site/levers.csv", moved), "l.csv");
  EXPECT_EQ(PlaceOfInput("/a/site/robot/arm.urdf", moved), "/b/robot/arm.urdf");
  EXPECT_EQ(PlaceOfInput("/a/site2/arm.urdf", moved), "/a/site2/arm.urdf");
  EXPECT_EQ(PlaceOfInput("/a/site/x.tif", {{"/a/site/", "/b/"}}), "/b/x.tif");
  EXPECT_EQ(PlaceOfInput("tera:assets/cone.glb", {{"tera:", "/old"}}), "/old/assets/cone.glb");
  EXPECT_EQ(PlaceOfInput("tera:assets/cone.glb", moved), DataRoot() / "assets/cone.glb");
}

TEST(Config, ListsEachFileThatWasReadOnce) {
  const fs::path a = NewFile("listed/a.csv"), b = NewFile("listed/b.csv");
  Config config = Config::FromText("one: " + b.string() + "\ntwo: " + b.string() + "\n", "c.yaml");
  config.root().File("one");
  config.root().File("two");
  config.root().AlsoReads(a);
  config.Finish();
  const std::vector<InputFile> inputs = config.root().Inputs();
  ASSERT_EQ(inputs.size(), 2u);
  EXPECT_EQ(inputs[0].name, a.string());
  EXPECT_EQ(inputs[1].name, b.string());
  EXPECT_EQ(inputs[1].path, b);
}

TEST(Config, ReadsAMovedFileAndNamesItAsItWas) {
  const fs::path now = NewFile("moved/levers.csv");
  Config config = Config::FromText("csv: /gone/site/levers.csv\n", "c.yaml");
  config.Move({{"/gone/site", now.parent_path()}});
  EXPECT_EQ(config.root().File("csv"), now);
  config.Finish();
  EXPECT_THAT(config.ResolvedYaml(), HasSubstr("csv: /gone/site/levers.csv"));
  EXPECT_EQ(config.root().Inputs().at(0).name, "/gone/site/levers.csv");
}

}  // namespace
}  // namespace tera
