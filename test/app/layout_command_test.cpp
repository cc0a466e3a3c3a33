#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/refused.h"
#include "core/faults.h"

// `tera layout` from a user's view: accepted and refused inputs.

namespace tera {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;
namespace fs = std::filesystem;

constexpr char kSite[] = R"(name: site
duration_s: 0.4
settle_s: 0
physics_rate_hz: 100
terrain: {size_m: [40, 40], cell_m: 1, soil: asphalt}
machines:
  - {name: mast1, machine: tera:config/machines/mast.yaml, start: {xy_m: [2, -3], yaw_deg: 40}, operator: {type: idle}}
)";
constexpr char kRig[] = R"(sensors:
  - {name: lidar, preset: tera:config/sensors/vlp16.yaml, link: mast, xyz_m: [0, 0.5, 2], cost: 4000}
)";
constexpr char kStudy[] = R"(points: 100
rate_hz: 5
map_heights_m: [0.9]
person: {postures: [{name: standing, size_m: [0.3, 0.5, 1.75]}], farthest_m: 12}
zones: [{name: behind, frame: mast, xyz_m: [-4, 0, 1], box_m: [3, 3, 1]}]
)";
constexpr char kSearch[] = R"(cycle: base
study: study.yaml
moments: 1
population: 8
generations: 2
sensors:
  - name: lidar
    types: [{preset: tera:config/sensors/vlp16.yaml, cost: 100}]
    mounts: [{link: mast, low_xyz_m: [0, -1, 2], high_xyz_m: [0, 1, 2]}]
objectives: [{figure: zone/behind/blind_m3}, {figure: cost}]
)";

class LayoutCommand : public testing::Test {
 protected:
  LayoutCommand() {
    Write("site.yaml", kSite);
    Write("rig.yaml", kRig);
    Write("study.yaml", kStudy);
    Write("search.yaml", kSearch);
  }

  const fs::path& path() const { return scratch_.path(); }
  void Write(const std::string& name, const std::string& text) const {
    fs::create_directories((path() / name).parent_path());
    WriteWholeFile(path() / name, text);
  }
  std::string Succeed(const Arguments& arguments) const {
    const Outcome outcome = RunTera(arguments, {path()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.out;
  }
  void KeepState() const { Succeed({"generate", "site.yaml", "--out", "base", "--keep-state"}); }
  void Refuse(const Arguments& arguments,
              const testing::Matcher<const std::string&>& message) const {
    ExpectRefused(scratch_, arguments, message);
  }
  static Arguments Evaluate(const std::string& cycle, const std::string& rig = "rig.yaml",
                            const Arguments& more = {}) {
    Arguments arguments = {"layout",  "evaluate",   cycle,   rig,
                           "--study", "study.yaml", "--out", "seen"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  const ScratchDirectory scratch_;
};

TEST_F(LayoutCommand, EvaluatesComparesAndFindsBetter) {
  KeepState();
  Write("low.yaml", Edited(kRig, "[0, 0.5, 2]", "[0, 0.5, 0.3]"));
  const std::string seen = Succeed(Evaluate("base", "rig.yaml", {"low.yaml"}));
  EXPECT_THAT(seen, AllOf(HasSubstr("rig: Coverage of the space around"),
                          HasSubstr("low: Coverage of the space"),
                          HasSubstr("report: seen/rig/report.html\n")));
  for (const char* name :
       {"rig/report.html", "rig/layout.json", "rig/figures.csv", "rig/moments.csv", "rig/blind.csv",
        "rig/people.csv", "low/layout.json"}) {
    EXPECT_TRUE(fs::exists(path() / "seen" / name)) << name;
  }
  EXPECT_THAT(
      Succeed({"layout", "compare", "seen/rig", "seen/low", "--out", "compared"}),
      AllOf(HasSubstr("low against rig, "), HasSubstr("report: compared/comparison.html\n")));
  EXPECT_TRUE(fs::exists(path() / "compared/comparison.csv"));
  EXPECT_THAT(Succeed({"layout", "optimise", "search.yaml", "--out", "found"}),
              AllOf(HasSubstr("generation 1 of 2: hypervolume "),
                    HasSubstr("generation 2 of 2: hypervolume "),
                    HasSubstr("report: found/search.html\n")));
  EXPECT_TRUE(fs::exists(path() / "found/front/01.yaml"));
  EXPECT_TRUE(fs::exists(path() / "found/greedy.yaml"));
}

TEST_F(LayoutCommand, AScenarioIsACycleToo) {
  KeepState();
  Succeed(Evaluate("base"));
  const std::string of_dataset = ReadWholeFile(path() / "seen/rig/figures.csv");
  fs::remove_all(path() / "seen");
  Succeed(Evaluate("site.yaml"));
  EXPECT_EQ(ReadWholeFile(path() / "seen/rig/figures.csv"), of_dataset);
}

TEST_F(LayoutCommand, EveryLayoutThatWasFoundIsARigThatGenerateTakes) {
  KeepState();
  Succeed({"layout", "optimise", "search.yaml", "--out", "found"});
  std::size_t taken = 0;
  for (const auto& rig : fs::directory_iterator(path() / "found/front")) {
    Succeed({"generate", "site.yaml", "--out", "data" + std::to_string(taken++), "--set",
             "machines[0].rig=" + rig.path().string()});
    // Its only sensor is optional: a layout without it costs nothing but sees nothing.
    Succeed(Evaluate("base", rig.path().string()));
    fs::remove_all(path() / "seen");
  }
  EXPECT_GE(taken, 1u);
}

TEST_F(LayoutCommand, WrongUseIsStatus2AndPointsToTheHelp) {
  const Arguments wrong[] = {{"layout"},
                             {"layout", "fly"},
                             {"layout", "evaluate"},
                             {"layout", "evaluate", "site.yaml", "--out", "seen"},
                             {"layout", "evaluate", "site.yaml", "rig.yaml"},
                             {"layout", "compare", "seen/rig", "--out", "compared"},
                             {"layout", "optimise", "--out", "found"},
                             {"layout", "optimise", "search.yaml"}};
  const auto before = Entries(path());
  for (const Arguments& arguments : wrong) {
    const Outcome outcome = RunTera(arguments, {path()});
    EXPECT_EQ(outcome.status, 2) << testing::PrintToString(arguments);
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(outcome.err, HasSubstr("Run with --help for more information."));
  }
  for (const char* command : {"evaluate", "compare", "optimise"}) {
    EXPECT_EQ(RunTera({"layout", command, "--help"}, {path()}).status, 0) << command;
  }
  EXPECT_THAT(RunTera({"layout", "compare", "--help"}, {path()}).out, HasSubstr("REPORT..."));
  EXPECT_EQ(Entries(path()), before);
}

TEST_F(LayoutCommand, ARigThatSeesNothingIsRefused) {
  Write("blind.yaml",
        "sensors: [{name: imu, preset: tera:config/sensors/xsens_mti_670.yaml, link: mast}]\n");
  Refuse(Evaluate("site.yaml", "blind.yaml"), TellsOf("blind.yaml"));
  Write("none.yaml", "sensors: []\n");
  Refuse(Evaluate("site.yaml", "none.yaml"), TellsOf("none.yaml"));
  Refuse(Evaluate("site.yaml", "absent.yaml"), TellsOf("absent.yaml"));
}

TEST_F(LayoutCommand, TwoRigsOfOneNameAreRefused) {
  Write("other/rig.yaml", kRig);
  Refuse(Evaluate("site.yaml", "rig.yaml", {"other/rig.yaml"}),
         AllOf(TellsOf("other/rig.yaml"), HasSubstr("'rig'")));
}

TEST_F(LayoutCommand, AZoneBesideTheSiteOrOfAnUnknownFrameIsRefused) {
  Write("study.yaml", "zones: [{name: far, xyz_m: [100, 0, 0], box_m: [1, 1, 1]}]\n");
  Refuse(Evaluate("site.yaml"),
         AllOf(TellsOf("study.yaml:1:16: zones[0].name"), HasSubstr("'far'")));
  Write("study.yaml", "zones: [{name: far, frame: roof, box_m: [1, 1, 1]}]\n");
  Refuse(Evaluate("site.yaml"), AllOf(StartsWith("study.yaml:1:"), HasSubstr("'far'"),
                                      HasSubstr("roof"), HasSubstr("mast")));
  Write("study.yaml", "rate_hz: 5\nupper: roof\n");
  Refuse(Evaluate("site.yaml"), AllOf(TellsOf("study.yaml:2:8: upper"), HasSubstr("roof")));
  Write("study.yaml", "eye: {link: roof, xyz_m: [0, 0, 1]}\n");
  Refuse(Evaluate("site.yaml"), AllOf(TellsOf("study.yaml:1:13: eye.link"), HasSubstr("roof")));
}

TEST_F(LayoutCommand, WithoutUnitsWhatIsNotKnownOfJointsIsOneWarning) {
  Write("site.yaml",
        Edited(kSite, "tera:config/machines/mast.yaml", "tera:config/machines/tb235.yaml"));
  Write("roof.yaml",
        "sensors: [{name: lidar, preset: tera:config/sensors/vlp16.yaml, link: upper, xyz_m: "
        "[0, 0, 2.6]}]\n");
  Write("study.yaml", Edited(kStudy, "frame: mast", "frame: upper"));
  const std::string out = Succeed(Evaluate("site.yaml", "roof.yaml"));
  const std::size_t first = out.find("warning: ");
  EXPECT_THAT(out.substr(first), AllOf(StartsWith("warning: state/: "), HasSubstr("boom")));
  EXPECT_EQ(out.find("warning: ", first + 1), out.npos) << out;
}

TEST_F(LayoutCommand, AStudyWithAFaultIsRefusedWithItsPlace) {
  const std::string study = Edited(kStudy, "rate_hz: 5", "rate_hz: -5");
  Write("study.yaml", study);
  Refuse(Evaluate("site.yaml"), TellsOf("study.yaml:" + LineAndColumn(study, "-5")));
}

TEST_F(LayoutCommand, ADatasetWithoutStateIsRefusedWithWhatToDo) {
  Succeed({"generate", "site.yaml", "--out", "base"});
  Refuse(Evaluate("base"), AllOf(HasSubstr("base"), HasSubstr("--keep-state")));
  Refuse({"layout", "optimise", "search.yaml", "--out", "found"},
         AllOf(HasSubstr("base"), HasSubstr("--keep-state")));
}

TEST_F(LayoutCommand, AStateOfAnotherScenarioIsRefused) {
  KeepState();
  Write("turned.yaml", Edited(kSite, "yaw_deg: 40", "yaw_deg: 41"));
  Succeed({"generate", "turned.yaml", "--out", "turned", "--keep-state"});
  fs::copy_file(path() / "turned/truth/state.blocks", path() / "base/truth/state.blocks",
                fs::copy_options::overwrite_existing);
  Refuse(Evaluate("base"), HasSubstr("base/truth/state.blocks"));
}

TEST_F(LayoutCommand, WhatIsNoCycleIsRefused) {
  Refuse(Evaluate("absent"), AllOf(TellsOf("absent"), HasSubstr("--keep-state")));
  fs::create_directories(path() / "empty");
  Refuse(Evaluate("empty"), HasSubstr("empty"));
}

TEST_F(LayoutCommand, ReportsOfOtherCyclesAreRefused) {
  Succeed(Evaluate("site.yaml"));
  fs::rename(path() / "seen", path() / "one");
  Write("other.yaml", Edited(kSite, "yaw_deg: 40", "yaw_deg: 41"));
  Succeed(Evaluate("other.yaml"));
  Refuse({"layout", "compare", "one/rig", "seen/rig", "--out", "compared"},
         AllOf(HasSubstr("site.yaml"), HasSubstr("other.yaml"), HasSubstr("evaluate both")));
}

TEST_F(LayoutCommand, ReportsOfOneNameAreCalledByTheirFolders) {
  Succeed(Evaluate("site.yaml"));
  fs::rename(path() / "seen", path() / "one");
  Write("rig.yaml", Edited(kRig, "[0, 0.5, 2]", "[0, 0.5, 0.3]"));
  Succeed(Evaluate("site.yaml"));
  EXPECT_THAT(
      Succeed({"layout", "compare", "one/rig", "seen/rig/layout.json", "--out", "compared"}),
      HasSubstr("seen/rig against one/rig"));
}

TEST_F(LayoutCommand, AReportBesideItselfIsRefused) {
  Succeed(Evaluate("site.yaml"));
  Refuse({"layout", "compare", "seen/rig", "seen/rig/layout.json", "--out", "compared"},
         TellsOf("seen/rig/layout.json"));
}

TEST_F(LayoutCommand, ADamagedReportIsRefusedByItsName) {
  Succeed(Evaluate("site.yaml"));
  const std::string good = ReadWholeFile(path() / "seen/rig/layout.json");
  for (const std::string& bad :
       {std::string(), std::string("{}"), good.substr(0, good.size() / 2)}) {
    Write("bad/layout.json", bad);
    Refuse({"layout", "compare", "seen/rig", "bad", "--out", "compared"},
           TellsOf("bad/layout.json"));
  }
  Refuse({"layout", "compare", "seen/rig", "absent", "--out", "compared"}, HasSubstr("absent"));
  // The folder of all rigs instead of one rig's.
  Refuse({"layout", "compare", "seen", "seen/rig", "--out", "compared"},
         TellsOf("seen/layout.json"));
}

TEST_F(LayoutCommand, AMountInsideOfTheMachineIsAWarningAndWithStrictAnError) {
  Write("site.yaml",
        Edited(kSite, "tera:config/machines/mast.yaml", "tera:config/machines/tb235.yaml"));
  // Inside the boom, by its collision box.
  Write("inside.yaml",
        "sensors: [{name: lidar, preset: tera:config/sensors/vlp16.yaml, link: boom, xyz_m: "
        "[0.65, 0, 0.25]}]\n");
  Write("study.yaml",
        Edited(Edited(kStudy, "frame: mast", "frame: upper"), "rate_hz: 5", "rate_hz: 2"));
  EXPECT_THAT(Succeed(Evaluate("site.yaml", "inside.yaml")),
              AllOf(HasSubstr("warning: "), HasSubstr("lidar"), HasSubstr("boom")));
  fs::remove_all(path() / "seen");
  Refuse(Evaluate("site.yaml", "inside.yaml", {"--strict"}),
         AllOf(TellsOf("inside.yaml"), HasSubstr("lidar"), HasSubstr("boom")));
}

TEST_F(LayoutCommand, ASensorThatItsOwnMachineHidesIsAWarningAndWithStrictAnError) {
  Write("site.yaml",
        Edited(kSite, "tera:config/machines/mast.yaml", "tera:config/machines/tb235.yaml"));
  // Within the hollow cab's frame and engine cover, but in the air.
  Write("enclosed.yaml",
        "sensors: [{name: lidar, preset: tera:config/sensors/vlp16.yaml, link: upper, xyz_m: "
        "[-0.5, 0, 0.5]}]\n");
  Write("study.yaml",
        Edited(Edited(kStudy, "frame: mast", "frame: upper"), "rate_hz: 5", "rate_hz: 2"));
  const auto words = AllOf(HasSubstr("lidar: it sees only 0.0 %"), HasSubstr("upper"));
  EXPECT_THAT(Succeed(Evaluate("site.yaml", "enclosed.yaml")),
              AllOf(HasSubstr("warning: "), words));
  fs::remove_all(path() / "seen");
  Refuse(Evaluate("site.yaml", "enclosed.yaml", {"--strict"}),
         AllOf(TellsOf("enclosed.yaml"), words));
  // On the roof it sees enough.
  Write("roof.yaml",
        "sensors: [{name: lidar, preset: tera:config/sensors/vlp16.yaml, link: upper, xyz_m: "
        "[0, 0, 2.6]}]\n");
  Succeed(Evaluate("site.yaml", "roof.yaml", {"--strict"}));
}

TEST_F(LayoutCommand, ASensorThatLooksAwayIsSaidToSeeNothing) {
  Write("away.yaml",
        "sensors: [{name: camera, preset: tera:config/sensors/rgb_640.yaml, link: mast, xyz_m: [0, "
        "0, 3], rpy_deg: [0, -90, 0]}]\n");
  EXPECT_THAT(Succeed(Evaluate("site.yaml", "away.yaml")),
              HasSubstr("warning: camera: it sees nothing around the machine"));
}

TEST_F(LayoutCommand, AMountOfASearchThatLiesInsideTheMachineIsAWarning) {
  Write("site.yaml",
        Edited(kSite, "tera:config/machines/mast.yaml", "tera:config/machines/tb235.yaml"));
  Write("study.yaml", Edited(kStudy, "frame: mast", "frame: upper"));
  const std::string search =
      Edited(Edited(kSearch, "cycle: base", "cycle: site.yaml"),
             "{link: mast, low_xyz_m: [0, -1, 2], high_xyz_m: [0, 1, 2]}",
             "{link: boom, low_xyz_m: [0.65, 0, 0.25]}, {link: upper, low_xyz_m: [0, -0.5, 2.6]}");
  Write("search.yaml", search);
  EXPECT_THAT(
      Succeed({"layout", "optimise", "search.yaml", "--out", "found"}),
      AllOf(HasSubstr("warning: search.yaml:" + LineAndColumn(search, "boom")),
            HasSubstr("'lidar' lies inside mast1/boom"), HasSubstr("1 layout on the Pareto front"),
            testing::Not(HasSubstr("inside mast1/upper"))));
}

TEST_F(LayoutCommand, AnOutputThatHoldsSomethingIsRefused) {
  Write("seen/mine.txt", "keep me");
  Refuse(Evaluate("site.yaml"), TellsOf("seen"));
  Refuse({"layout", "compare", "a", "b", "--out", "seen"}, TellsOf("seen"));
  Refuse({"layout", "optimise", "search.yaml", "--out", "seen"}, TellsOf("seen"));
}

TEST_F(LayoutCommand, ASearchWithAFaultIsRefusedWithItsPlace) {
  const std::string search = Edited(kSearch, "population: 8", "population: 10");
  Write("search.yaml", search);
  Refuse({"layout", "optimise", "search.yaml", "--out", "found"},
         TellsOf("search.yaml:" + LineAndColumn(search, "10")));
  Write("search.yaml", kSearch);
  Refuse({"layout", "optimise", "search.yaml", "--out", "found"}, HasSubstr("base"));
  KeepState();
  Write("search.yaml", Edited(kSearch, "link: mast", "link: roof"));
  Refuse({"layout", "optimise", "search.yaml", "--out", "found"},
         AllOf(HasSubstr("roof"), HasSubstr("mast")));
  Write("search.yaml", Edited(kSearch, "zone/behind/", "zone/before/"));
  Refuse({"layout", "optimise", "search.yaml", "--out", "found"},
         AllOf(HasSubstr("zone/before/blind_m3"), HasSubstr("zone/behind/blind_m3")));
}

TEST_F(LayoutCommand, GoesOnWithNoOtherSearchThanTheOneThatWasStopped) {
  KeepState();
  Write("search.yaml", Edited(kSearch, "generations: 2", "generations: 100000"));
  {
    TeraProcess process({"layout", "optimise", "search.yaml", "--out", "found"}, {path()});
    while (process.Running() && !fs::exists(path() / "found.incomplete/search_state.json")) {
    }
  }  // ends it
  Refuse({"layout", "optimise", "search.yaml", "--out", "found"}, HasSubstr("--resume"));
  Write("search.yaml", kSearch);
  Refuse({"layout", "optimise", "search.yaml", "--out", "found", "--resume"},
         HasSubstr("another search"));
}

}  // namespace
}  // namespace tera
