#include "layout/optimise/search.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/units.h"
#include "layout/optimise/appraisal.h"
#include "layout/optimise/optimise.h"
#include "layout/optimise/walled_site.h"

namespace tera {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;
namespace fs = std::filesystem;

constexpr char kSearch[] = R"(cycle: ../cycles/base
study: study.yaml
keep: keep.yaml
sensors:
  - name: roof
    optional: false
    types:
      - {preset: tera:config/sensors/vlp16.yaml, cost: 4000, power_w: 8.5}
      - {preset: tera:config/sensors/os1_64.yaml}
    mounts:
      - {link: upper, low_xyz_m: [-1, -0.5, 2], high_xyz_m: [1, 0.5, 2], low_rpy_deg: [-10, 0, -180], high_rpy_deg: [10, 20, 180]}
      - {link: boom, low_xyz_m: [1, 0.25, 0.5], low_rpy_deg: [0, 30, 0]}
      - {link: arm, low_xyz_m: [0.5, 0, 0.25]}
  - name: rear
    types: [{preset: tera:config/sensors/rgb_640.yaml, cost: 150, power_w: 2}]
    mounts: [{link: upper, low_xyz_m: [-1, 0, 1]}]
limits: {cost: 5000, power_w: 30, data_mbyteps: 40, sensors: 3}
objectives:
  - {figure: zone/around/blind_m3, at: worst}
  - {figure: person/standing/detected_within_12m, at: mean}
  - {figure: cost}
moments: 3
population: 20
generations: 7
seed: 99
)";

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

class Search : public testing::Test {
 protected:
  Search() {
    fs::create_directories(folder());
    WriteWholeFile(folder() / "study.yaml", "points: 100\n");
    WriteWholeFile(folder() / "keep.yaml", "sensors: []\n");
  }
  fs::path folder() const { return scratch_.path() / "searches"; }
  LayoutSearch Load(const std::string& text) const {
    WriteWholeFile(folder() / "search.yaml", text);
    return LoadSearch(folder() / "search.yaml");
  }
  /// Expects a refusal at the line of the first `place`, with all of `words`.
  void ExpectRefused(const std::string& text, const std::string& place,
                     const std::vector<std::string>& words) const {
    const std::size_t at = text.find(place);
    ASSERT_NE(at, std::string::npos) << place;
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<long>(at), '\n');
    try {
      Load(text);
      ADD_FAILURE() << "taken: " << place;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(fmt::format("search.yaml:{}:", line)));
      for (const std::string& word : words) EXPECT_THAT(error.what(), HasSubstr(word));
    }
  }
  void ExpectRefused(const std::string& from, const std::string& to, const std::string& place,
                     const std::vector<std::string>& words) const {
    ExpectRefused(Replaced(kSearch, from, to), place, words);
  }

  const ScratchDirectory scratch_;
};

TEST_F(Search, EveryKeyIsRead) {
  const LayoutSearch search = Load(kSearch);
  EXPECT_EQ(search.cycle, scratch_.path() / "cycles/base");
  EXPECT_EQ(search.study, folder() / "study.yaml");
  EXPECT_EQ(search.keep, folder() / "keep.yaml");
  EXPECT_EQ(search.limits.cost, 5000);
  EXPECT_EQ(search.limits.power_w, 30);
  EXPECT_EQ(search.limits.data_mbyteps, 40);
  EXPECT_EQ(search.limits.sensors, 3);
  ASSERT_EQ(search.objectives.size(), 3u);
  EXPECT_EQ(search.objectives[0].figure, "zone/around/blind_m3");
  EXPECT_TRUE(search.objectives[0].at_worst);
  EXPECT_EQ(search.objectives[1].figure, "person/standing/detected_within_12m");
  EXPECT_FALSE(search.objectives[1].at_worst);
  EXPECT_FALSE(search.objectives[2].at_worst);
  EXPECT_EQ(search.moments, 3);
  EXPECT_EQ(search.population, 20);
  EXPECT_EQ(search.generations, 7);
  EXPECT_EQ(search.seed, 99u);
}

TEST_F(Search, EveryKeyOfASensorIsRead) {
  const LayoutSearch search = Load(kSearch);
  ASSERT_EQ(search.slots.size(), 2u);
  const SensorSlot& roof = search.slots[0];
  EXPECT_EQ(roof.name, "roof");
  EXPECT_FALSE(roof.optional);
  ASSERT_EQ(roof.types.size(), 2u);
  EXPECT_EQ(roof.types[0].preset.filename(), "vlp16.yaml");
  EXPECT_EQ(roof.types[0].sensor.cost, 4000);
  EXPECT_EQ(roof.types[0].sensor.power_w, 8.5);
  EXPECT_TRUE(std::holds_alternative<LidarModel>(roof.types[0].sensor.model));
  EXPECT_EQ(roof.types[1].sensor.cost, 0);
  EXPECT_EQ(roof.types[1].sensor.power_w, 0);
  ASSERT_EQ(roof.mounts.size(), 3u);
  EXPECT_EQ(roof.mounts[0].link, "upper");
  EXPECT_EQ(roof.mounts[0].low_B_m, Vec3(-1, -0.5, 2));
  EXPECT_EQ(roof.mounts[0].high_B_m, Vec3(1, 0.5, 2));
  EXPECT_TRUE(roof.mounts[0].low_rpy_rad.isApprox(kDeg * Vec3(-10, 0, -180)));
  EXPECT_TRUE(roof.mounts[0].high_rpy_rad.isApprox(kDeg * Vec3(10, 20, 180)));
  EXPECT_TRUE(search.slots[1].optional);
  EXPECT_TRUE(std::holds_alternative<CameraModel>(search.slots[1].types[0].sensor.model));
}

TEST_F(Search, BoundsThatAreNotSaidAreEqual) {
  const LayoutSearch search = Load(kSearch);
  const MountBounds &boom = search.slots[0].mounts[1], &arm = search.slots[0].mounts[2];
  EXPECT_EQ(boom.high_B_m, Vec3(1, 0.25, 0.5));
  EXPECT_TRUE(boom.low_rpy_rad.isApprox(Vec3(0, 30 * kDeg, 0)));
  EXPECT_EQ(boom.high_rpy_rad, boom.low_rpy_rad);
  EXPECT_EQ(arm.low_rpy_rad, Vec3(0, 0, 0));
  EXPECT_EQ(arm.high_rpy_rad, Vec3(0, 0, 0));
}

TEST_F(Search, WhatNeedNotBeSaidHasTheValuesThatTheDocumentationNames) {
  const LayoutSearch search = Load(R"(cycle: base
sensors: [{name: a, types: [{preset: tera:config/sensors/vlp16.yaml}], mounts: [{link: u, low_xyz_m: [0, 0, 1]}]}]
objectives: [{figure: cost}]
)");
  EXPECT_TRUE(search.study.empty());
  EXPECT_TRUE(search.keep.empty());
  EXPECT_FALSE(search.limits.cost || search.limits.power_w || search.limits.data_mbyteps ||
               search.limits.sensors);
  EXPECT_EQ(search.moments, 12);
  EXPECT_EQ(search.population, 48);
  EXPECT_EQ(search.generations, 40);
  EXPECT_EQ(search.seed, 1u);
  EXPECT_EQ(search.start, SearchStart::kGreedy);
}

TEST_F(Search, AKeyThatThereIsNotIsRefusedWhereverItStands) {
  ExpectRefused("moments: 3", "momnets: 3", "momnets", {"momnets"});
  ExpectRefused("optional: false", "optinal: false", "optinal", {"optinal"});
  ExpectRefused("cost: 4000", "csot: 4000", "csot", {"csot"});
  ExpectRefused("{link: arm,", "{lnik: arm,", "{lnik", {"link"});
  ExpectRefused("data_mbyteps: 40", "data_mbps: 40", "data_mbps", {"data_mbps"});
  ExpectRefused("at: worst", "when: worst", "when: worst", {"when"});
}

TEST_F(Search, WhatMustBeSaidIsAskedFor) {
  ExpectRefused("cycle: ../cycles/base\n", "", "study", {"cycle"});
  ExpectRefused("{figure: cost}", "{at: worst}", "{at: worst}", {"figure"});
  ExpectRefused("  - name: rear\n    types", "  - types", "- types", {"name"});
  ExpectRefused(", low_xyz_m: [-1, 0, 1]", "", "{link: upper}]", {"low_xyz_m"});
  ExpectRefused("{preset: tera:config/sensors/rgb_640.yaml, cost: 150, power_w: 2}", "{cost: 150}",
                "{cost: 150}", {"preset"});
}

TEST_F(Search, SensorsAndObjectivesAreNeeded) {
  const std::string head = "cycle: base\n";
  const std::string objectives = "objectives: [{figure: cost}]\n";
  ExpectRefused(head + "sensors: []\n" + objectives, "sensors", {"sensors", "need"});
  ExpectRefused("types: [{preset: tera:config/sensors/rgb_640.yaml, cost: 150, power_w: 2}]",
                "types: []", "types: []", {"types", "need"});
  ExpectRefused("mounts: [{link: upper, low_xyz_m: [-1, 0, 1]}]", "mounts: []", "mounts: []",
                {"mounts", "need"});
  const std::string text = kSearch;
  const std::size_t from = text.find("objectives:"), to = text.find("moments:");
  ExpectRefused(text.substr(0, from) + "objectives: []\n" + text.substr(to), "objectives: []",
                {"objectives", "need"});
}

TEST_F(Search, NumbersOutOfTheirRangeAreRefused) {
  ExpectRefused("population: 20", "population: 18", "population", {"population", "multiple of 4"});
  ExpectRefused("population: 20", "population: 4", "population", {"population", "8"});
  ExpectRefused("population: 20", "population: 20.5", "population", {"population"});
  ExpectRefused("generations: 7", "generations: 0", "generations", {"generations", "1"});
  ExpectRefused("moments: 3", "moments: 0", "moments", {"moments", "1"});
  ExpectRefused("moments: 3", "moments: many", "moments", {"moments"});
  ExpectRefused("seed: 99", "seed: -1", "seed", {"seed", "0"});
  ExpectRefused("cost: 5000", "cost: -1", "limits", {"cost", "0"});
  ExpectRefused("sensors: 3}", "sensors: 0}", "limits", {"sensors", "1"});
  ExpectRefused("power_w: 8.5", "power_w: -8.5", "-8.5", {"power_w", "0"});
  ExpectRefused("cost: 4000", "cost: .inf", ".inf", {"cost"});
  ExpectRefused("at: worst", "at: best", "at: best", {"best", "mean", "worst"});
}

TEST_F(Search, BoundsThatAreReversedAreRefused) {
  ExpectRefused("high_xyz_m: [1, 0.5, 2]", "high_xyz_m: [1, -0.6, 2]", "high_xyz_m",
                {"high_xyz_m", "low_xyz_m", "need"});
  ExpectRefused("high_rpy_deg: [10, 20, 180]", "high_rpy_deg: [10, 20, -181]", "high_rpy_deg",
                {"high_rpy_deg", "low_rpy_deg", "need"});
}

TEST_F(Search, APresetThatDoesNotSeeIsRefused) {
  for (const char* preset : {"xsens_mti_670", "rtk_f9p", "encoder"}) {
    ExpectRefused("rgb_640", preset, preset, {"preset", "lidar nor a camera"});
  }
  ExpectRefused("rgb_640", "of_nobody", "of_nobody", {"of_nobody.yaml"});
}

TEST_F(Search, APresetOfALidarOfOneBeamIsRefused) {
  WriteWholeFile(folder() / "flat.yaml",
                 "type: lidar\nrate_hz: 10\nelevation_deg: [0]\ncolumns: 360\n");
  ExpectRefused("tera:config/sensors/rgb_640.yaml", "flat.yaml", "flat.yaml",
                {"preset", "one elevation", "need"});
}

TEST_F(Search, TwoSensorsOfOneNameAreRefused) {
  ExpectRefused("name: rear", "name: roof", "- name: roof\n    types", {"name", "taken"});
  ExpectRefused("name: rear", "name: \"../rear\"", "../rear", {"name"});
}

TEST_F(Search, AFileThatIsMissingIsRefused) {
  EXPECT_THAT([&] { LoadSearch(folder() / "absent.yaml"); },
              ThrowsMessage<InputError>(HasSubstr("absent.yaml")));
  ExpectRefused("study: study.yaml", "study: absent.yaml", "absent.yaml", {"absent.yaml"});
  ExpectRefused("keep: keep.yaml", "keep: absent.yaml", "absent.yaml", {"absent.yaml"});
}

// Faults that only the cycle reveals.

class SearchOfACycle : public testing::Test {
 protected:
  void ExpectRefused(const std::string& text, const std::vector<std::string>& words) {
    const fs::path file = site_.path() / "search.yaml";
    WriteWholeFile(file, text);
    try {
      Optimise(LoadSearch(file), text, {.out = site_.path() / "out", .threads = 1});
      ADD_FAILURE() << "taken";
    } catch (const InputError& error) {
      for (const std::string& word : words) EXPECT_THAT(error.what(), HasSubstr(word));
    }
    EXPECT_FALSE(fs::exists(site_.path() / "out"));
    EXPECT_FALSE(fs::exists(site_.path() / "out.incomplete"));
  }
  std::string TwoLidars() { return ReadWholeFile(site_.TwoLidars()); }

  WalledSite site_;
};

TEST_F(SearchOfACycle, ACycleThatIsMissingIsRefused) {
  ExpectRefused(Replaced(TwoLidars(), "cycle: site.yaml", "cycle: absent"), {"absent"});
}

TEST_F(SearchOfACycle, AFigureThatThereIsNotIsRefusedWhereItStandsWithTheNearest) {
  ExpectRefused(Replaced(TwoLidars(), "zone/behind_wall/blind_m3", "zone/behind_wal/blind_m3"),
                {"search.yaml:21:23: objectives[0].figure", "zone/behind_wal/blind_m3",
                 "did you mean 'zone/behind_wall/blind_m3'", "zone/around/blind_m3"});
  // For a name without similar ones, the message lists how figures begin.
  ExpectRefused(Replaced(TwoLidars(), "zone/behind_wall/blind_m3", "visibility"),
                {"visibility", "need one of", "zone/...", "person/...", "information/...", "cost",
                 "power_w", "data_mbyteps", "sensors"});
}

TEST_F(SearchOfACycle, WhatInertialUnitsTellIsNoObjective) {
  ExpectRefused(Replaced(TwoLidars(), "zone/behind_wall/blind_m3", "state/heading/sigma_deg"),
                {"state/heading/sigma_deg", "no search places", "need"});
}

TEST_F(SearchOfACycle, WhatNoLayoutChangesIsRefused) {
  WriteWholeFile(site_.path() / "study.yaml", "eye: {link: mast, xyz_m: [0, 0, 1.5]}\n");
  ExpectRefused(Replaced(TwoLidars(), "zone/behind_wall/blind_m3", "eye/circle/masked_share"),
                {"objectives", "eye/circle/masked_share", "no layout changes", "need"});
}

TEST_F(SearchOfACycle, ALinkThatTheMachineHasNotIsRefused) {
  ExpectRefused(
      Replaced(TwoLidars(), "link: mast", "link: roof"),
      {"search.yaml:13:16: sensors[0].mounts[0].link", "first", "roof", "links are", "mast"});
}

TEST_F(SearchOfACycle, TheNameOfASensorThatIsKeptIsRefused) {
  ExpectRefused(Replaced(TwoLidars(), "name: second", "name: imu"), {"sensors", "imu", "need"});
}

TEST_F(SearchOfACycle, LimitsThatNoLayoutCanKeepAreRefused) {
  // The inertial unit alone costs 10, with the cheapest lidar 110.
  ExpectRefused(Replaced(TwoLidars(), "cost: 420", "cost: 9"), {"limits", "kept"});
  ExpectRefused(Replaced(TwoLidars(), "cost: 420", "cost: 109"),
                {"search.yaml:7:", "limits", "cost 109", "need 110", "optional"});
  ExpectRefused(Replaced(TwoLidars(), "limits: {cost: 420}", "limits: {power_w: 8}"),
                {"limits", "power_w 8", "need 8.5"});
  ExpectRefused(Replaced(TwoLidars(), "limits: {cost: 420}", "limits: {sensors: 1}"),
                {"limits", "sensors 1", "need 2"});
}

TEST_F(SearchOfACycle, LimitsThatOnlyALayoutWithoutEyesKeepsAreRefused) {
  // Both lidars are optional: without them nothing sees, and the cheapest costs 100.
  const std::string text = Replaced(TwoLidars(), "optional: false", "optional: true");
  ExpectRefused(Replaced(text, "cost: 420", "cost: 109"), {"limits", "cost 109", "need 110"});
}

TEST_F(SearchOfACycle, MomentsThatDoNotFitIntoMemoryAreRefused) {
  const LayoutSearch search = LoadSearch(site_.TwoLidars());
  const LayoutStudy study = LoadStudy(search.study);
  const Cycle cycle(search.cycle, {});
  EXPECT_NO_THROW(Appraisal(search, study, cycle, 1));
  // The two walls alone have 8 vertices and 12 triangles each, of three numbers of 4 bytes.
  const std::int64_t walls_bytes = 2 * (8 + 12) * 3 * 4;
  EXPECT_THAT([&] { Appraisal(search, study, cycle, 1, search.moments * walls_bytes); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("moments: 2"), HasSubstr("need"))));
}

TEST_F(SearchOfACycle, AStudyOfAMachineOrLinkThatThereIsNotIsRefused) {
  WriteWholeFile(site_.path() / "study.yaml", "machine: digger\n");
  ExpectRefused(Replaced(TwoLidars(), "behind_wall", "around"), {"digger"});
  WriteWholeFile(site_.path() / "study.yaml",
                 "zones: [{name: z, frame: roof, box_m: [1, 1, 1]}]\n");
  ExpectRefused(Replaced(TwoLidars(), "behind_wall", "around"), {"z", "roof"});
}

}  // namespace
}  // namespace tera
