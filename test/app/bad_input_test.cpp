#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/program.h"
#include "dataset/tiny_disk.h"

// Bad input to the program: exit status 2, one message that says where, what and what to do, and
// nothing left behind.

namespace tera {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
namespace fs = std::filesystem;

/// Runs the program in `scratch`, where it must refuse its input with one line like `message` and
/// leave everything as it was.
void ExpectRefused(const ScratchDirectory& scratch, const Arguments& arguments,
                   const testing::Matcher<const std::string&>& message,
                   const std::map<std::string, std::string>& environment = {}) {
  const auto before = Entries(scratch.path());
  const Outcome outcome = RunTera(arguments, {scratch.path(), environment});
  EXPECT_EQ(outcome.status, 2) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, AllOf(message, EndsWith("\n")));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_EQ(Entries(scratch.path()), before);
}

/// A scenario that neither check nor generate may take.
void ExpectScenarioRefused(const ScratchDirectory& scratch, const std::string& scenario,
                           const testing::Matcher<const std::string&>& message) {
  WriteWholeFile(scratch.path() / "small.yaml", scenario);
  ExpectRefused(scratch, {"check", "small.yaml"}, message);
  ExpectRefused(scratch, {"generate", "small.yaml", "--out", "run"}, message);
}

void ExpectScenarioRefused(const std::string& scenario,
                           const testing::Matcher<const std::string&>& message) {
  const ScratchDirectory scratch;
  ExpectScenarioRefused(scratch, scenario, message);
}

/// "small.yaml:line:column: " of the first `needle`.
std::string At(const std::string& scenario, const std::string& needle) {
  return "small.yaml:" + LineAndColumn(scenario, needle) + ": ";
}

std::string WithObstacle(const std::string& mesh) {
  return SmallScenario() + "obstacles: [{name: rock1, label: rock, xy_m: [3, 1], mesh: " + mesh +
         "}]\n";
}

TEST(BadInput, AnUnknownKeyIsNamedWithTheKeyItResembles) {
  const std::string scenario = Edited(SmallScenario(), "seed", "sead");
  ExpectScenarioRefused(
      scenario, StartsWith(At(scenario, "sead") + "sead: unknown key (did you mean 'seed'?)"));
}

TEST(BadInput, AnUnknownKeyThatResemblesNoneIsAnsweredWithTheKnownOnes) {
  const std::string scenario = SmallScenario() + "weather: fine\n";
  ExpectScenarioRefused(scenario,
                        AllOf(StartsWith(At(scenario, "weather") + "weather: unknown key"),
                              HasSubstr("known here: "), HasSubstr("environment")));
}

TEST(BadInput, AWordForANumberIsRefusedWithWhatIsNeeded) {
  const std::string scenario = Edited(SmallScenario(), "duration_s: 0.4", "duration_s: long");
  ExpectScenarioRefused(
      scenario,
      StartsWith(At(scenario, "long") + "duration_s: 'long' is not a number, need more than 0 s"));
}

TEST(BadInput, AMeshThatIsNotThereIsRefusedWithWhereItWasSought) {
  const std::string scenario = WithObstacle("lost.glb");
  ExpectScenarioRefused(scenario,
                        AllOf(StartsWith(At(scenario, "lost.glb") + "obstacles[0].mesh: "),
                              HasSubstr("'lost.glb' does not exist"),
                              HasSubstr("correct the path (relative to small.yaml")));
}

TEST(BadInput, AMeshThatIsNoneIsRefusedByItsName) {
  const ScratchDirectory scratch;
  WriteWholeFile(scratch.path() / "rock.glb", "not a mesh");
  ExpectScenarioRefused(
      scratch, WithObstacle("rock.glb"),
      AllOf(StartsWith(At(WithObstacle("rock.glb"), "rock.glb") + "obstacles[0].mesh: "),
            HasSubstr("rock.glb: not a readable glTF"), HasSubstr("export it")));
}

TEST(BadInput, AMeshWithoutTheNodeIsRefusedWithItsPlace) {
  const std::string scenario = WithObstacle("tera:assets/rock.glb, node: bodyy");
  ExpectScenarioRefused(
      scenario, AllOf(StartsWith(At(scenario, "tera:assets/rock.glb") + "obstacles[0].mesh: "),
                      HasSubstr("has no node 'bodyy' (did you mean 'body'?)")));
}

TEST(BadInput, ALensThatFoldsItsPictureIsRefusedWithItsPlace) {
  const std::string scenario = SmallScenario(
      "{name: cam, type: camera, link: chassis, rate_hz: 1, width_px: 64, height_px: 48, "
      "horizontal_fov_deg: 90, k1: -3}");
  ExpectScenarioRefused(scenario,
                        AllOf(StartsWith(At(scenario, "-3") + "machines[0].rig.sensors[1].k1: "),
                              HasSubstr("every pixel")));
}

TEST(BadInput, AGeoTiffThatCannotBeReadIsRefused) {
  const ScratchDirectory scratch;
  WriteWholeFile(scratch.path() / "site.tif", "not a raster");
  const std::string scenario = Edited(SmallScenario(), "size_m: [14, 14]", "geotiff: site.tif");
  ExpectScenarioRefused(
      scratch, scenario,
      AllOf(StartsWith(At(scenario, "site.tif") + "terrain.geotiff: "),
            HasSubstr("not readable as a GeoTIFF"), HasSubstr("give a one-band elevation raster")));
}

/// The small scenario on other ground.
std::string OnGround(const std::string& terrain) {
  return Edited(SmallScenario(), "size_m: [14, 14], cell_m: 0.1, soil: dirt", terrain);
}

TEST(BadInput, ASoilThatCannotBeIsRefusedByItsKey) {
  const std::string mine =
      "size_m: [14, 14], soil: mine, custom_soils: [{preset: tera:config/soils/dirt.yaml, name: "
      "mine, KEY}]";
  const std::string light =
      OnGround(Edited(mine, "KEY", "bank_density_kgpm3: -5, max_density_kgpm3: 3000"));
  ExpectScenarioRefused(
      light,
      StartsWith(At(light, "-5") + "terrain.custom_soils[0].bank_density_kgpm3: -5 is out of "
                                   "range, need 500 to 4000 kg/m^3"));
  const std::string steep = OnGround(Edited(mine, "KEY", "friction_angle_deg: 90"));
  ExpectScenarioRefused(
      steep, StartsWith(At(steep, "90}") + "terrain.custom_soils[0].friction_angle_deg: 90 is out "
                                           "of range, need 0 to 89 deg"));
}

TEST(BadInput, LayersThatOverlapOrLeaveAGapAreRefused) {
  const std::string layers =
      "size_m: [14, 14], layers: [{soil: dirt, from_m: 0, to_m: 0.4}, {soil: sand, from_m: BELOW}]";
  const std::string overlap = OnGround(Edited(layers, "BELOW", "0.3"));
  ExpectScenarioRefused(
      overlap, StartsWith(At(overlap, "0.3}") + "terrain.layers[1].from_m: this layer overlaps the "
                                                "one above it, which ends at 0.4 m; begin it "
                                                "there"));
  const std::string gap = OnGround(Edited(layers, "BELOW", "0.5"));
  ExpectScenarioRefused(gap, StartsWith(At(gap, "0.5}") + "terrain.layers[1].from_m: no layer from "
                                                          "0.4 to 0.5 m of depth"));
}

TEST(BadInput, ARegionWithoutAProperOutlineIsRefused) {
  const std::string region =
      "size_m: [14, 14], soil: dirt, regions: [{soil: sand, outline_m: CORNERS}]";
  const std::string crossed =
      OnGround(Edited(region, "CORNERS", "[[0, 0], [2, 2], [2, 0], [0, 2]]"));
  ExpectScenarioRefused(crossed, StartsWith(At(crossed, "[[0, 0]") +
                                            "terrain.regions[0].outline_m: its sides 1 and 3 "
                                            "cross; name the corners in order"));
  const std::string line = OnGround(Edited(region, "CORNERS", "[[0, 0], [2, 2]]"));
  ExpectScenarioRefused(
      line, StartsWith(At(line, "[[0, 0]") +
                       "terrain.regions[0].outline_m: 2 corners found, need at least 3"));
}

TEST(BadInput, AShovelWithADegenerateEdgeIsRefused) {
  const auto refused = [](const std::string& key, const std::string& message) {
    const ScratchDirectory scratch;
    WriteWholeFile(scratch.path() / "small.yaml",
                   Edited(Edited(SmallScenario(), "warthog", "tb235"), "chassis", "arm"));
    const Arguments generate = {"generate", "small.yaml",
                                "--out",    "run",
                                "--set",    "machines[0].machine.shovels.bucket." + key};
    ExpectRefused(scratch, generate, HasSubstr(message));
  };
  refused("width_m=0", "shovels.bucket.width_m: 0 is out of range, need more than 0 m");
  refused("profile_m=[[0.8, 0], [0.4, 0.2], [0, 0.4]]", "profile_m: the points enclose no area");
  refused("profile_m=[[0.8, 0], [0.4, 0.2], [0, 0], [0.8, 0]]",
          "profile_m: points 3 and 0 are the same");
  refused("profile_m=[[0, 0], [1, 1], [1, 0], [0, 1]]",
          "profile_m: the lines from points 0 and 2 cross");
}

/// A raster of 3 x 2 pixels as an ASCII grid, which GDAL reads too.
void WriteAsciiGrid(const fs::path& stem, const std::string& rows, bool projected) {
  WriteWholeFile(stem.string() + ".asc",
                 "ncols 3\nnrows 2\nxllcorner 500000\nyllcorner 4000000\ncellsize 10\n"
                 "NODATA_value -9999\n" +
                     rows);
  if (!projected) return;
  WriteWholeFile(stem.string() + ".prj",
                 "PROJCS[\"UTM 33N\",GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\","
                 "6378137,298.257223563]],PRIMEM[\"Greenwich\",0],UNIT[\"degree\","
                 "0.0174532925199433]],PROJECTION[\"Transverse_Mercator\"],"
                 "PARAMETER[\"latitude_of_origin\",0],PARAMETER[\"central_meridian\",15],"
                 "PARAMETER[\"scale_factor\",0.9996],PARAMETER[\"false_easting\",500000],"
                 "PARAMETER[\"false_northing\",0],UNIT[\"metre\",1]]");
}

TEST(BadInput, HeightsWithGapsOrWithoutAProjectionAreRefused) {
  const ScratchDirectory scratch;
  WriteAsciiGrid(scratch.path() / "gaps", "1 2 -9999\n4 5 6\n", true);
  const std::string gaps = OnGround("geotiff: gaps.asc");
  ExpectScenarioRefused(scratch, gaps,
                        AllOf(StartsWith(At(gaps, "gaps.asc") + "terrain.geotiff: "),
                              HasSubstr("1 of 6 pixels have no height; fill the gaps")));
  WriteAsciiGrid(scratch.path() / "plain", "1 2 3\n4 5 6\n", false);
  ExpectScenarioRefused(scratch, OnGround("geotiff: plain.asc"),
                        AllOf(HasSubstr("terrain.geotiff: "), HasSubstr("has no projection"),
                              HasSubstr("gdal_translate -a_srs")));
}

TEST(BadInput, SoilClassesOfAnotherTypeAreRefused) {
  const ScratchDirectory scratch;
  WriteAsciiGrid(scratch.path() / "soil", "1 1 2\n1 2 2\n", true);
  const std::string scenario =
      OnGround("soil_classes: {geotiff: soil.asc, classes: [{value: 1, soil: sand}]}");
  ExpectScenarioRefused(
      scratch, scenario,
      AllOf(StartsWith(At(scenario, "soil.asc") + "terrain.soil_classes.geotiff: "),
            HasSubstr("its pixels are Int32, need classes as Byte")));
}

TEST(BadInput, WhatCannotBeRecordedOfTheGroundIsRefused) {
  const auto refused = [](const std::string& record, const std::string& place,
                          const std::string& message) {
    const std::string scenario = SmallScenario() + "record: " + record + "\n";
    ExpectScenarioRefused(scenario, AllOf(StartsWith(At(scenario, place)), HasSubstr(message)));
  };
  refused("{terrain: [hight]}", "[hight]", "no raster of the ground (did you mean 'height'?)");
  refused("{terrain: [height, height]}", "[height", "names 'height' twice");
  refused("{pixel_m: 0.25}", "0.25", "no whole multiple of the site's cell of 0.1 m");
  refused("{every_s: 0}", "0}\n", "every_s: 0 is out of range");
  const std::string box = "{voxels: [{name: pit, low_m: [-1, -1, -1], high_m: HIGH}]}";
  refused(Edited(box, "HIGH", "[1, 1, -2]"), "[1, 1, -2]", "needs to lie above low_m");
  refused(Edited(box, "HIGH", "[9, 1, 1]"), "[-1, -1", "reaches beyond the site, x -7 to 7 m");
  refused(Edited(box, "HIGH", "[1, 1, 2e5]"), "{name: pit", "are more than the 5e+06");
}

TEST(BadInput, TwoSensorsOfOneNameAreRefused) {
  const std::string scenario = SmallScenario(Edited(kLidar, "name: lidar", "name: imu"));
  const std::string second = LineAndColumn(scenario, "imu, preset: tera:config/sensors/vlp16");
  ExpectScenarioRefused(scenario,
                        AllOf(StartsWith("small.yaml:" + second +
                                         ": machines[0].rig.sensors[1].name: 'imu' is taken"),
                              HasSubstr("give each its own name")));
}

TEST(BadInput, ASensorOnALinkThatIsNotThereIsRefusedWithTheLinks) {
  const std::string scenario = Edited(SmallScenario(), "link: chassis", "link: chasis");
  ExpectScenarioRefused(
      scenario, AllOf(StartsWith(At(scenario, "chasis,") + "machines[0].rig.sensors[0].link: "),
                      HasSubstr("has no link 'chasis' (did you mean 'chassis'?)"),
                      HasSubstr("its links are chassis")));
}

TEST(BadInput, ASensorThatNeverMeasuresIsRefused) {
  const std::string scenario = Edited(SmallScenario(), "rate_hz: 100", "rate_hz: 0");
  ExpectScenarioRefused(
      scenario, StartsWith(At(scenario, "0}]}") + "machines[0].rig.sensors[0].rate_hz: 0 is out of "
                                                  "range, need more than 0 Hz"));
}

TEST(BadInput, NumbersThatOnlyASlipOfTheFingerGivesAreRefused) {
  const std::string fast = Edited(SmallScenario(), "rate_hz: 100", "rate_hz: 1e10");
  ExpectScenarioRefused(
      fast, StartsWith(At(fast, "1e10") + "machines[0].rig.sensors[0].rate_hz: 1e10 is out of "
                                          "range, need more than 0 Hz, at most 100000 Hz"));
  const std::string endless = Edited(SmallScenario(), "duration_s: 0.4", "duration_s: 1e300");
  ExpectScenarioRefused(endless, StartsWith(At(endless, "1e300") + "duration_s: 1e300 is out of"));
}

TEST(BadInput, ANegativeMassInTheMachineFileIsRefusedThere) {
  const ScratchDirectory scratch;
  const std::string machine =
      "kind: block\nlinks:\n  chassis: {mass_kg: -5, inertia_kgm2: [1, 1, 1], label: vehicle}\n";
  WriteWholeFile(scratch.path() / "block.yaml", machine);
  ExpectScenarioRefused(
      scratch, Edited(SmallScenario(), "tera:config/machines/warthog.yaml", "block.yaml"),
      StartsWith("block.yaml:" + LineAndColumn(machine, "-5") +
                 ": machines[0].machine.links.chassis.mass_kg: -5 is out of range, need more than "
                 "0 kg"));
}

TEST(BadInput, EveryFaultIsReportedAtOnce) {
  const ScratchDirectory scratch;
  const std::string scenario =
      Edited(Edited(SmallScenario(), "seed", "sead"), "rate_hz: 100", "rate_hz: 0");
  WriteWholeFile(scratch.path() / "small.yaml", scenario);
  const Outcome outcome = RunTera({"check", "small.yaml"}, {scratch.path()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("small.yaml:2:1: sead: "), HasSubstr("rate_hz: 0 is")));
}

TEST(BadInput, ATextThatIsNoYamlIsRefusedAtTheLineThatBreaksIt) {
  ExpectScenarioRefused("name: small\nmachines: [\n", StartsWith("small.yaml:3:1: not valid YAML"));
  ExpectScenarioRefused("", StartsWith("small.yaml:1:1: need a mapping of keys"));
}

TEST(BadInput, AnOverrideIsRefusedByItsKey) {
  const ScratchDirectory scratch;
  WriteWholeFile(scratch.path() / "small.yaml", SmallScenario());
  ExpectRefused(scratch, {"check", "small.yaml", "--set", "machines[7].name=x"},
                StartsWith("--set: machines: no item [7], the list has 1"));
  for (const char* text : {"seed", "]=1", "machines[00].name=x"}) {
    ExpectRefused(scratch, {"check", "small.yaml", "--set", text},
                  StartsWith(std::string("--set ") + text + ": need key.path=value"));
  }
  ExpectRefused(scratch, {"check", "small.yaml", "--set", "machines[0]=foo"},
                StartsWith("--set: machines[0]: 'foo' found, need a mapping of keys"));
}

TEST(BadInput, AMachineNamedLikeAFolderElsewhereIsRefused) {
  const std::string scenario = Edited(SmallScenario(), "name: rover1", "name: ..");
  ExpectScenarioRefused(scenario, StartsWith(At(scenario, "..\n") +
                                             "machines[0].name: name '..' cannot name a folder"));
}

TEST(BadInput, AFileThatIsNotThereIsRefusedByEveryCommand) {
  const ScratchDirectory scratch;
  fs::create_symlink("loop", scratch.path() / "loop");
  for (const std::string& name :
       {std::string("nowhere"), std::string("loop"), std::string(300, 'x')}) {
    const auto names_it = StartsWith(name);
    ExpectRefused(scratch, {"check", name}, names_it);
    ExpectRefused(scratch, {"generate", name, "--out", "run"}, names_it);
    ExpectRefused(scratch, {"import", name, "--out", "run"}, names_it);
    ExpectRefused(scratch, {"import-rig", name}, names_it);
    ExpectRefused(scratch, {"overview", name}, names_it);
    ExpectRefused(scratch, {"compare", name, name}, names_it);
    ExpectRefused(scratch, {"replay", name, "--out", "run"}, names_it);
  }
}

TEST(BadInput, AFolderForAFileIsRefusedWithItsPath) {
  const ScratchDirectory scratch;
  const std::string folder = scratch.path() / "folder";
  fs::create_directory(folder);
  const auto says_so = StartsWith(folder + ": is a folder; need a YAML file\n");
  ExpectRefused(scratch, {"check", folder}, says_so);
  ExpectRefused(scratch, {"generate", folder, "--out", "run"}, says_so);
  ExpectRefused(scratch, {"import", folder, "--out", "run"}, says_so);
}

TEST(BadInput, AFolderThatIsNoDatasetIsNeitherComparedNorDrawn) {
  const ScratchDirectory scratch;
  fs::create_directory(scratch.path() / "holiday");
  const auto message = HasSubstr("holiday: is not a complete recording (it has no dataset.yaml)");
  ExpectRefused(scratch, {"compare", "holiday", "holiday"}, message);
  ExpectRefused(scratch, {"replay", "holiday", "--out", "run"}, message);
  ExpectRefused(scratch, {"overview", "holiday"}, message);
}

TEST(BadInput, AReplayIsNotWrittenOverItsOwnSource) {
  const ScratchDirectory scratch;
  fs::create_directory(scratch.path() / "run.incomplete");
  WriteWholeFile(scratch.path() / "run.incomplete/INCOMPLETE.txt", "killed");
  const auto message =
      AllOf(StartsWith("--out "), HasSubstr("run.incomplete, which is the recording"),
            HasSubstr("another name"), Not(HasSubstr("delete")));
  for (const char* out : {"run", "run/", "./run"}) {
    ExpectRefused(scratch, {"replay", "run.incomplete", "--out", out}, message);
    ExpectRefused(scratch, {"replay", "run.incomplete/", "--out", out, "--resume"}, message);
  }
  ExpectRefused(scratch, {"replay", "run.incomplete", "--out", "run.incomplete"}, message);
}

TEST(BadInput, AReplayIsNotWrittenInsideItsSource) {
  const ScratchDirectory scratch;
  fs::create_directories(scratch.path() / "run.incomplete/rover1");
  fs::create_directory(scratch.path() / "other");
  WriteWholeFile(scratch.path() / "run.incomplete/INCOMPLETE.txt", "killed");
  fs::create_directory_symlink("run.incomplete", scratch.path() / "link");
  fs::create_directory_symlink(scratch.path() / "run.incomplete/rover1", scratch.path() / "inner");
  for (const std::string out :
       {"run.incomplete/again", "run.incomplete/not/yet/there", "other/../run.incomplete/again",
        "link/again", "inner/again", "inner", "inner/../again"}) {
    ExpectRefused(scratch, {"replay", "run.incomplete", "--out", out},
                  AllOf(StartsWith("--out " + out + ": lies inside run.incomplete"),
                        HasSubstr("choose a folder outside it")));
    ExpectRefused(scratch, {"replay", "link", "--out", out},
                  StartsWith("--out " + out + ": lies inside link"));
  }
}

TEST(BadInput, AnImportedColumnThatIsNotThereIsRefusedWithTheOneItResembles) {
  const ScratchDirectory scratch;
  WriteWholeFile(scratch.path() / "drive.csv", "t_s,wz\n0,0.1\n");
  WriteWholeFile(scratch.path() / "mapping.yaml", R"(name: drive
machine: rover
file: drive.csv
time: {column: t_s, unit: s}
tables: [{name: yaw, columns: {w_radps: {column: wy, unit: rad/s}}}]
)");
  ExpectRefused(scratch, {"import", "mapping.yaml", "--out", "run"},
                StartsWith("drive.csv:1: column 'wy' is missing (did you mean 'wz'?)"));
}

TEST(BadInput, AnImportedNumberThatIsNoneIsRefusedAtItsLine) {
  const ScratchDirectory scratch;
  WriteWholeFile(scratch.path() / "drive.csv", "t_s,wz\n0,0.1\n1,nan\n");
  WriteWholeFile(scratch.path() / "mapping.yaml", R"(name: drive
machine: rover
file: drive.csv
time: {column: t_s, unit: s}
tables: [{name: yaw, columns: {w_radps: {column: wz, unit: rad/s}}}]
)");
  ExpectRefused(scratch, {"import", "mapping.yaml", "--out", "run"},
                AllOf(HasSubstr("drive.csv:3"), HasSubstr("'nan'")));
}

// Where a dataset cannot go.

constexpr char kNeedsTinyDisk[] = "needs root, or the right to make user namespaces";

class BadOutput : public testing::Test {
 protected:
  BadOutput() { WriteWholeFile(scratch_.path() / "small.yaml", SmallScenario()); }

  void ExpectOutRefused(const std::string& out,
                        const testing::Matcher<const std::string&>& message) {
    ExpectRefused(scratch_, {"generate", "small.yaml", "--out", out}, message);
  }

  ScratchDirectory scratch_;
};

TEST_F(BadOutput, ADirectoryThatIsNotEmptyIsRefused) {
  fs::create_directory(scratch_.path() / "run");
  WriteWholeFile(scratch_.path() / "run/diary.txt", "mine");
  ExpectOutRefused("run", StartsWith("run: is not an empty directory; choose another place"));
  ExpectOutRefused("small.yaml", StartsWith("small.yaml: is not an empty directory"));
}

TEST_F(BadOutput, ANameThatIsNoneIsRefused) {
  for (const char* out : {"", ".", "..", "/"}) {
    ExpectOutRefused(out, HasSubstr("give the recording's folder a name"));
  }
}

TEST_F(BadOutput, ADirectoryThatMayNotBeWrittenIsRefused) {
  // Root may write whatever a folder's mode says, but not on a disk that is read-only.
  TinyDisk disk(scratch_.path() / "disk", "1m");
  ASSERT_TRUE(disk.mounted() && disk.MakeReadOnly("1m")) << kNeedsTinyDisk;
  ExpectOutRefused("disk/run", AllOf(StartsWith("disk/run"), HasSubstr("cannot be created: "),
                                     HasSubstr("Read-only file system"),
                                     HasSubstr("choose a folder that you may write to")));
}

TEST_F(BadOutput, ANameThatNoFileCanHaveIsRefused) {
  ExpectOutRefused(std::string(300, 'x'), HasSubstr("File name too long"));
  fs::create_symlink("loop", scratch_.path() / "loop");
  ExpectOutRefused("loop/run", HasSubstr("symbolic links"));
}

TEST_F(BadOutput, ADiskThatIsFullBeforeTheRunIsLeftAsItWas) {
  const TinyDisk disk(scratch_.path() / "disk", "8k");
  ASSERT_TRUE(disk.mounted()) << kNeedsTinyDisk;
  ExpectOutRefused("disk/run", AllOf(StartsWith("disk/run"), HasSubstr("No space left on device"),
                                     HasSubstr("free space on that disk")));
}

TEST_F(BadOutput, ADiskThatFillsUpKeepsARunThatCanBeFinished) {
  TinyDisk disk(scratch_.path() / "disk", "512k");
  ASSERT_TRUE(disk.mounted()) << kNeedsTinyDisk;
  WriteWholeFile(scratch_.path() / "small.yaml",
                 Edited(SmallScenario(Edited(kLidar, "columns: 128", "columns: 512")),
                        "duration_s: 0.4", "duration_s: 3"));
  const Arguments on_disk = {"generate", "small.yaml", "--out", "disk/run"};
  const Outcome full = RunTera(on_disk, {scratch_.path()});
  EXPECT_EQ(full.status, 2);
  EXPECT_THAT(full.err, AllOf(HasSubstr("No space left on device; free space on that disk"),
                              HasSubstr("disk/run.incomplete"), HasSubstr("--resume")));
  EXPECT_FALSE(fs::exists(scratch_.path() / "disk/run"));

  ASSERT_TRUE(disk.Grow("64m"));
  Arguments resume = on_disk;
  resume.push_back("--resume");
  const Outcome resumed = RunTera(resume, {scratch_.path()});
  EXPECT_EQ(resumed.status, 0) << resumed.err;
  const Outcome whole = RunTera({"generate", "small.yaml", "--out", "whole"}, {scratch_.path()});
  EXPECT_EQ(whole.status, 0) << whole.err;
  EXPECT_TRUE(AllFiles(scratch_.path() / "disk/run") == AllFiles(scratch_.path() / "whole"));
}

// No OpenGL: a loader that finds no driver.

const std::map<std::string, std::string> kNoEgl = {{"__EGL_VENDOR_LIBRARY_DIRS", "/nonexistent"},
                                                   {"__EGL_VENDOR_LIBRARY_FILENAMES", ""}};

TEST(NoEgl, ACameraIsRefusedWithThePackagesToInstall) {
  const ScratchDirectory scratch;
  WriteWholeFile(scratch.path() / "small.yaml", SmallScenario(kCamera));
  const auto message = AllOf(StartsWith("no EGL platform gives an OpenGL 4.5 core context"),
                             HasSubstr("install Mesa's software renderer"));
  ExpectRefused(scratch, {"generate", "small.yaml", "--out", "run"}, message, kNoEgl);
  ExpectRefused(scratch, {"info"}, message, kNoEgl);
}

TEST(NoEgl, ADeviceThatIsNotThereIsRefused) {
  const ScratchDirectory scratch;
  WriteWholeFile(scratch.path() / "small.yaml", SmallScenario(kCamera));
  const auto message = AllOf(StartsWith("EGL device 99 asked for, but there "),
                             HasSubstr("give an index below that, or none"));
  ExpectRefused(scratch, {"generate", "small.yaml", "--out", "run", "--egl-device", "99"}, message);
  ExpectRefused(scratch, {"info", "--egl-device", "99"}, message);
}

TEST(NoEgl, ARigWithoutCamerasNeedsNone) {
  const ScratchDirectory scratch;
  WriteWholeFile(scratch.path() / "small.yaml", SmallScenario(kLidar));
  const Outcome outcome =
      RunTera({"generate", "small.yaml", "--out", "run"}, {scratch.path(), kNoEgl});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(fs::exists(scratch.path() / "run/rover1/lidar/data.csv"));
}

}  // namespace
}  // namespace tera
