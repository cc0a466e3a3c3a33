#include "core/config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"

namespace tera {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// What Finish says, or nothing.
std::string FaultsOf(const Config& config) {
  try {
    config.Finish();
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(Config, UnknownKeyNamesPlaceAndNearestKey) {
  const Config config = Config::FromText("lidar:\n  max_rang_m: 3\n", "a.yaml");
  const ConfigMap lidar = config.root().Map("lidar");
  lidar.Number("max_range_m", Positive("m"), 10.0);
  EXPECT_EQ(FaultsOf(config),
            "a.yaml:2:3: lidar.max_rang_m: unknown key (did you mean 'max_range_m'?)");
}

TEST(Config, OutOfRangeNumberNamesWhatIsNeeded) {
  const Config config = Config::FromText("sensors:\n  - {range_sigma_m: -0.02}\n", "a.yaml");
  for (const ConfigMap& sensor : config.root().List("sensors")) {
    sensor.Number("range_sigma_m", Between(0, 1, "m"));
  }
  EXPECT_EQ(FaultsOf(config),
            "a.yaml:2:21: sensors[0].range_sigma_m: -0.02 is out of range, need 0 to 1 m");
}

TEST(Config, EveryFaultIsReportedTogether) {
  const Config config = Config::FromText("a: x\nb: .nan\nc: [1, 2]\na: 3\nd: 4\n", "f.yaml");
  const ConfigMap root = config.root();
  root.Number("a", Any("m"));
  root.Number("b", Any("m"));
  root.Vector3("c", Any("m"));
  root.Number("e", Positive("s"));
  EXPECT_THAT(FaultsOf(config),
              AllOf(HasSubstr("a: 'x' is not a number"), HasSubstr("f.yaml:2:4: b: '.nan'"),
                    HasSubstr("c: a list of 2 found, need a list of 3"),
                    HasSubstr("f.yaml:4:1: a: repeated key"), HasSubstr("d: unknown key"),
                    HasSubstr("e: missing, need more than 0 s")));
}

TEST(Config, OverridesReplaceValuesInsideLists) {
  const Config config =
      Config::FromText("s:\n  - {r: 1}\n  - {r: 2}\n", "a.yaml", {"s[1].r=5", "t=7"});
  const auto list = config.root().List("s");
  EXPECT_EQ(list[0].Number("r", Any("m")), 1);
  EXPECT_EQ(list[1].Number("r", Any("m")), 5);
  EXPECT_EQ(config.root().Number("t", Any("m")), 7);
  EXPECT_EQ(FaultsOf(config), "");
}

TEST(Config, OverrideOfAnAbsentItemIsAFault) {
  const Config config = Config::FromText("s: [{r: 1}]\n", "a.yaml", {"s[3].r=5"});
  config.root().List("s")[0].Number("r", Any("m"));
  EXPECT_THAT(FaultsOf(config), HasSubstr("no item [3], the list has 1"));
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
  EXPECT_EQ(FaultsOf(again), "");
}

TEST(Config, MissingIncludedFileNamesTheKeyAndTheRemedy) {
  const Config config = Config::FromText("machine: nowhere.yaml\n", "a.yaml");
  config.root().MapOrFile("machine");
  EXPECT_THAT(FaultsOf(config), AllOf(HasSubstr("a.yaml:1:10: machine: file 'nowhere.yaml'"),
                                      HasSubstr("correct the path")));
}

TEST(Config, BrokenYamlNamesLineAndColumn) {
  EXPECT_THROW(
      {
        try {
          Config::FromText("a: [1, 2\nb: 3\n", "a.yaml");
        } catch (const InputError& e) {
          EXPECT_THAT(e.what(), HasSubstr("a.yaml:"));
          EXPECT_THAT(e.what(), HasSubstr("not valid YAML"));
          throw;
        }
      },
      InputError);
}

}  // namespace
}  // namespace tera
