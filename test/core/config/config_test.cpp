#include "core/config/config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "core/config/config_beneath.h"
#include "core/config/config_faults.h"
#include "core/config/listed_folder.h"
#include "core/faults.h"
#include "own_folder.h"

namespace tera {
namespace {

using enum FaultKind;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<InputFault> FaultsOf(const Config& config) {
  return FaultsIn([&] { config.Finish(); });
}

TEST(Config, UnknownKeyNamesPlaceAndNearestKey) {
  const Config config = Config::FromText("lidar:\n  max_rang_m: 3\n", "a.yaml");
  const ConfigMap lidar = config.root().Map("lidar");
  lidar.Number("max_range_m", Positive("m"), 10.0);
  EXPECT_THAT(FaultsOf(config), HasOnlyFault(kUnknown, "a.yaml:2:3: lidar.max_rang_m"));
}

TEST(Config, AFileOfXmlIsToldToBeOne) {
  const std::filesystem::path file = OwnFolder() / "digger.urdf";
  std::ofstream(file) << "\n<?xml version=\"1.0\"?>\n<robot/>\n";
  EXPECT_THAT([&] { Config::FromFile(file); }, ThrowsFault(kMalformed, "digger.urdf:1:1"));
}

TEST(Config, NumbersLaidBeneathGiveWayToWhatIsWritten) {
  const Config config = Config::FromText("file: x.urdf\na: {b: 1}\n", "a.yaml", {"a.c=2"});
  config.root().Text("file");
  LayBeneath(config.root(), "x.urdf",
             {{{"a", "b"}, 5}, {{"a", "c"}, 6}, {{"a", "d"}, 7}, {{"extra", "f"}, -8}});
  const ConfigMap a = config.root().Map("a");
  EXPECT_EQ(a.Number("b", Any("m")), 1);
  EXPECT_EQ(a.Number("c", Any("m")), 2);
  EXPECT_EQ(a.Number("d", Any("m")), 7);
  EXPECT_THAT(FaultsOf(config), HasOnlyFault(kUnknown, "x.urdf: extra"));
  config.root().Map("extra").Number("f", Positive("m"));
  config.root().Number("g", Any("m"));
  EXPECT_THAT(FaultsOf(config), ElementsAre(IsFault(kOutOfRange, "x.urdf: extra.f"),
                                            IsFault(kMissing, "a.yaml:1:1: g")));
}

TEST(Config, AChoiceOfKeysThatIsRefusedIsTheOnlyFaultOfItsMapping) {
  const auto faults = [](const std::string& text) {
    const Config config = Config::FromText(text, "a.yaml");
    const ConfigMap map = config.root().Map("m");
    if (ChoiceOfKeys(map, "type", {"ball", "box"}) == "ball") {
      map.Number("radius_m", Positive("m"));
    } else {
      map.Number("edge_m", Positive("m"));
    }
    return FaultsOf(config);
  };
  EXPECT_THAT(faults("m: {type: box, edge_m: 2}"), IsEmpty());
  EXPECT_THAT(faults("m: {type: boxx, edge_m: 2}"),
              HasOnlyFault(kNoSuchName, "a.yaml:1:11: m.type"));
  EXPECT_THAT(faults("m: {edge_m: 2}"), HasOnlyFault(kMissing, "a.yaml:1:4: m.type"));
  EXPECT_THAT(faults("m: {type: box, radius_m: 2}"),
              ElementsAre(IsFault(kUnknown, "m.radius_m"), IsFault(kMissing, "m.edge_m")));
}

TEST(Config, OutOfRangeNumberNamesWhatIsNeeded) {
  const Config config = Config::FromText("sensors:\n  - {range_sigma_m: -0.02}\n", "a.yaml");
  for (const ConfigMap& sensor : config.root().List("sensors")) {
    sensor.Number("range_sigma_m", Between(0, 1, "m"));
  }
  EXPECT_THAT(FaultsOf(config), HasOnlyFault(kOutOfRange, "a.yaml:2:21: sensors[0].range_sigma_m"));
}

TEST(Config, EveryFaultIsReportedTogether) {
  const Config config = Config::FromText("a: x\nb: .nan\nc: [1, 2]\na: 3\nd: 4\n", "f.yaml");
  const ConfigMap root = config.root();
  root.Number("a", Any("m"));
  root.Number("b", Any("m"));
  root.Vector3("c", Any("m"));
  root.Number("e", Positive("s"));
  EXPECT_THAT(FaultsOf(config),
              ElementsAre(IsFault(kRepeated, "f.yaml:4:1: a"), IsFault(kUnknown, "f.yaml:5:1: d"),
                          IsFault(kMistyped, "f.yaml:1:4: a"), IsFault(kMistyped, "f.yaml:2:4: b"),
                          IsFault(kMistyped, "f.yaml:3:4: c"), IsFault(kMissing, "f.yaml:1:1: e")));
}

TEST(Config, OverridesReplaceValuesInsideLists) {
  const Config config =
      Config::FromText("s:\n  - {r: 1}\n  - {r: 2}\n", "a.yaml", {"s[1].r=5", "t=7"});
  const auto list = config.root().List("s");
  EXPECT_EQ(list[0].Number("r", Any("m")), 1);
  EXPECT_EQ(list[1].Number("r", Any("m")), 5);
  EXPECT_EQ(config.root().Number("t", Any("m")), 7);
  EXPECT_THAT(FaultsOf(config), IsEmpty());
}

TEST(Config, OverrideOfAnAbsentItemIsAFault) {
  const Config config = Config::FromText("s: [{r: 1}]\n", "a.yaml", {"s[3].r=5"});
  config.root().List("s")[0].Number("r", Any("m"));
  EXPECT_THAT(FaultsOf(config), HasOnlyFault(kNoSuchName, "--set: s"));
}

TEST(Config, OverridesReplaceNumbersAndTextsInsideLists) {
  const Config config =
      Config::FromText("v: [1, 2]\nr: [[1, 2], [3, 4], [5, 6]]\nt: [a, b]\n", "a.yaml",
                       {"v[0]=30", "r[1][0]=7", "r[2]=[8, 9]", "t[1]=c"});
  EXPECT_EQ(config.root().Vector2("v", Any("m")), Vec2(30, 2));
  EXPECT_EQ(config.root().NumberRows("r", Any("m"), 2, 1),
            (std::vector<std::vector<double>>{{1, 2}, {7, 4}, {8, 9}}));
  EXPECT_EQ(config.root().Texts("t"), (std::vector<std::string>{"a", "c"}));
  EXPECT_THAT(FaultsOf(config), IsEmpty());
}

TEST(Config, OfTwoOverridesTheLaterHolds) {
  const Config config = Config::FromText("v: [1, 2]\nm: {a: 1, b: 2}\n", "a.yaml",
                                         {"v=[3, 4]", "v[1]=5", "m.a=6", "m.a=7", "m={b: 8}"});
  EXPECT_EQ(config.root().Vector2("v", Any("m")), Vec2(3, 5));
  EXPECT_EQ(config.root().Map("m").Number("a", Any("m")), 7);
  EXPECT_EQ(config.root().Map("m").Number("b", Any("m")), 8);
  EXPECT_THAT(FaultsOf(config), IsEmpty());
}

TEST(Config, OverridesWithoutAPathAreRefused) {
  for (const char* text : {"]=1", "=1", "a", ".=1", "a..b=1", "a.=1", ".a=1", "[0]=1", "a[=1",
                           "a[]=1", "a[x]=1", "a[00].b=1", "a[-1]=1", "a[0]b=1", "a]=1"}) {
    EXPECT_THAT([&] { Config::FromText("a: [1]\n", "a.yaml", {text}); },
                ThrowsFault(kMalformed, std::string("--set ") + text))
        << text;
  }
}

TEST(Config, AnOverrideOfAnItemByWhatItCannotBeIsAFault) {
  const auto faults = [](const std::string& override) {
    const Config config = Config::FromText("s: [{r: 1}]\nv: [1, 2]\n", "a.yaml", {override});
    for (const ConfigMap& item : config.root().List("s")) item.Number("r", Any("m"));
    for (const ConfigMap& item : config.root().List("absent")) item.Number("r", Any("m"));
    config.root().Vector2("v", Any("m"));
    return FaultsOf(config);
  };
  EXPECT_THAT(faults("s[0]=foo"), HasOnlyFault(kMistyped, "--set: s[0]"));
  EXPECT_THAT(faults("s.00.r=1"), HasOnlyFault(kNoSuchName, "--set: s"));
  EXPECT_THAT(faults("v[2]=1"), HasOnlyFault(kNoSuchName, "--set: v"));
  EXPECT_THAT(faults("v[0].x=1"), HasOnlyFault(kMistyped, "--set: v[0]"));
  EXPECT_THAT(faults("absent[0].r=1"), HasOnlyFault(kMistyped, "--set: absent"));
}

TEST(Config, NamesKeepTheOrderOfTheFileWithOverridesAtTheEnd) {
  const Config config = Config::FromText("n: {b: 1, a: 2}\nm: {b: {x: 1}, a: {x: 2}}\n", "a.yaml",
                                         {"n.c=3", "n.a=4", "m.c.x=3", "m.a.x=4"});
  std::vector<std::pair<std::string, double>> maps;
  for (const auto& [name, map] : config.root().NamedMaps("m")) {
    maps.emplace_back(name, map.Number("x", Any("m")));
  }
  EXPECT_THAT(maps,
              ::testing::ElementsAre(std::pair("b", 1), std::pair("a", 4), std::pair("c", 3)));
  EXPECT_EQ(config.root().NamedNumbers("n", Any("m")), maps);
}

/// Files of presets in a folder of the test's own.
class Presets : public ::testing::Test {
 protected:
  void Write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << text;
  }
  Config Read(const std::string& name) const { return Config::FromFile(folder_ / name); }

  const std::filesystem::path folder_ = OwnFolder();
};

TEST_F(Presets, OfAPresetAreAppliedBelowIt) {
  Write("a.yaml", "preset: sub/b.yaml\nx: 1\n");
  Write("sub/b.yaml", "preset: c.yaml\nx: 2\ny: 2\n");
  Write("sub/c.yaml", "x: 3\ny: 3\nz: 3\n");
  const Config config = Read("a.yaml");
  config.root().ApplyPreset("preset");
  std::vector<double> values;
  for (const char* key : {"x", "y", "z"}) values.push_back(config.root().Number(key, Any("")));
  EXPECT_EQ(values, (std::vector<double>{1, 2, 3}));
  EXPECT_THAT(FaultsOf(config), IsEmpty());
}

TEST_F(Presets, InACircleAreAFault) {
  Write("a.yaml", "preset: b.yaml\n");
  Write("b.yaml", "preset: ./b.yaml\n");
  const Config config = Read("a.yaml");
  config.root().ApplyPreset("preset");
  EXPECT_THAT(FaultsOf(config), HasOnlyFault(kInconsistent, "b.yaml:1:9: preset"));
}

TEST_F(Presets, WithNamesThatNoFileCanHaveAreNotThere) {
  Write("a.yaml", "preset: " + std::string(300, 'x') + ".yaml\nfile: loop.yaml\n");
  std::filesystem::create_symlink("loop.yaml", folder_ / "loop.yaml");
  const Config config = Read("a.yaml");
  config.root().ApplyPreset("preset");
  config.root().File("file");
  EXPECT_THAT(FaultsOf(config),
              ElementsAre(IsFault(kUnreadable, "preset"), IsFault(kUnreadable, "file")));
  EXPECT_THROW(Read("loop.yaml"), InputError);
  EXPECT_THROW(Read(std::string(300, 'y')), InputError);
}

/// A recorder's folder with the list of its files.
TEST_F(Presets, FolderStandsForItsListOnlyWhereTheReaderSaysSo) {
  Write("run/metadata.yaml", "a: 1\n");
  Write("a.yaml", "log: run\nmesh: run\nmissing: nowhere\n");
  const Config config = Read("a.yaml");
  EXPECT_THAT(FilesOrList(config.root(), "log", "metadata.yaml"),
              testing::ElementsAre(folder_ / "run/metadata.yaml"));
  EXPECT_THAT(config.ResolvedYaml(), HasSubstr("run/metadata.yaml"));
  config.root().File("mesh");
  FilesOrList(config.root(), "missing", "metadata.yaml");
  EXPECT_THAT(FaultsOf(config),
              ElementsAre(IsFault(kUnreadable, "mesh"), IsFault(kUnreadable, "missing")));
}

TEST_F(Presets, ListOfFilesIsReadInItsOrderAndResolvedAgain) {
  Write("a.csv", "");
  Write("sub/b.csv", "");
  Write("a.yaml", "file: [sub/b.csv, a.csv]\ngone: [a.csv, c.csv]\nnone: []\n");
  const Config config = Read("a.yaml");
  const auto files = FilesOrList(config.root(), "file", "metadata.yaml");
  EXPECT_THAT(files, testing::ElementsAre(folder_ / "sub/b.csv", folder_ / "a.csv"));
  const Config again = Config::FromText(config.ResolvedYaml(), "resolved.yaml");
  EXPECT_EQ(FilesOrList(again.root(), "file", ""), files);
  FilesOrList(config.root(), "gone", "");
  FilesOrList(config.root(), "none", "");
  EXPECT_THAT(FaultsOf(config), ElementsAre(IsFault(kUnreadable, "a.yaml:2:15: gone[1]"),
                                            IsFault(kMissing, "a.yaml:3:7: none")));
}

TEST(Config, ResolvedDocumentHoldsDefaultsAndReadsBackTheSame) {
  const Config config = Config::FromText("a: 1.5\nm: {list: [{x: 2}]}\n", "a.yaml", {"m.y=4"});
  const auto read = [](const ConfigMap& root) {
    return std::vector<double>{root.Number("a", Any("m")), root.Number("b", Any("m"), 0.1),
                               root.Map("m").List("list")[0].Number("x", Any("m")),
                               root.Map("m").Number("y", Any("m"))};
  };
  const auto first = read(config.root());
  const Config again = Config::FromText(config.ResolvedYaml(), "resolved.yaml");
  EXPECT_EQ(read(again.root()), first);
  EXPECT_THAT(first, ::testing::ElementsAre(1.5, 0.1, 2, 4));
  EXPECT_THAT(FaultsOf(again), IsEmpty());
}

TEST(Config, MissingIncludedFileIsAFaultOfTheKeyThatNamesIt) {
  const Config config = Config::FromText("machine: nowhere.yaml\n", "a.yaml");
  config.root().MapOrFile("machine");
  EXPECT_THAT(FaultsOf(config), HasOnlyFault(kUnreadable, "a.yaml:1:10: machine"));
}

TEST(Config, BrokenYamlNamesLineAndColumn) {
  EXPECT_THAT([] { Config::FromText("a: [1, 2\nb: 3\n", "a.yaml"); },
              ThrowsFault(kMalformed, "a.yaml:2:2"));
}

TEST(Config, WhatAMappingLacksIsNoFaultWhereItIsNotThereItself) {
  const Config config =
      Config::FromText("file: nowhere.yaml\nlist: [1]\nhere: {depth_m: -2}\n", "a.yaml");
  const ConfigMap root = config.root();
  for (const ConfigMap& map :
       {root.MapOrFile("file"), root.Map("list"), root.Map("gone").Map("below")}) {
    EXPECT_EQ(map.Text("name"), "");
    map.Number("width_m", Positive("m"));
    map.Fault("links", "there are none; need one");
  }
  EXPECT_EQ(FaultCount(root), 3u);
  root.Map("here").Number("depth_m", Positive("m"));
  root.Map("here").Number("width_m", Positive("m"));
  EXPECT_EQ(FaultCount(root), 5u);
  EXPECT_THAT(FaultsOf(config),
              ElementsAre(IsFault(kUnreadable, "file"), IsFault(kMistyped, "list"),
                          IsFault(kMissing, "gone"), IsFault(kOutOfRange, "here.depth_m"),
                          IsFault(kMissing, "here.width_m")));
}

TEST(Config, AnUnknownKeyIsToldBeforeWhatIsMissingForIt) {
  const Config config = Config::FromText("a: {wdth_m: 3}\n", "a.yaml");
  config.root().Map("a").Number("width_m", Positive("m"));
  EXPECT_THAT(FaultsOf(config), ElementsAre(IsFault(kUnknown, "a.yaml:1:5: a.wdth_m"),
                                            IsFault(kMissing, "a.yaml:1:4: a.width_m")));
}

TEST(Config, MergeKeysBringWhatAMappingDoesNotSay) {
  const Config config = Config::FromText(
      "base: &base {width_m: 2, depth_m: 3}\nmore: &more {depth_m: 5, height_m: 7}\n"
      "one: {<<: *base, depth_m: 4}\ntwo: {<<: [*base, *more]}\n",
      "a.yaml");
  const ConfigMap one = config.root().Map("one"), two = config.root().Map("two");
  EXPECT_EQ(one.Number("width_m", Any("m")), 2);
  EXPECT_EQ(one.Number("depth_m", Any("m")), 4);
  EXPECT_EQ(two.Number("width_m", Any("m")), 2);
  EXPECT_EQ(two.Number("depth_m", Any("m")), 3);
  EXPECT_EQ(two.Number("height_m", Any("m")), 7);
  for (const char* key : {"base", "more"}) {
    for (const char* length : {"width_m", "depth_m", "height_m"}) {
      config.root().Map(key).Number(length, Any("m"), 0);
    }
  }
  EXPECT_THAT(FaultsOf(config), IsEmpty());
}

TEST(Config, MergeKeyOfANumberIsAFaultWithItsPlace) {
  EXPECT_THAT([] { Config::FromText("a:\n  <<: 3\n", "a.yaml"); },
              ThrowsFault(kMalformed, "a.yaml:2:7"));
}

}  // namespace
}  // namespace tera
