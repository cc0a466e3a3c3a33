#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/refused.h"
#include "core/faults.h"
#include "render/meshes/textured_gltf.h"

// Bad scenarios, machines, recordings and arguments.

namespace tera {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
namespace fs = std::filesystem;

std::string WithObstacle(const std::string& mesh) {
  return SmallScenario() + "obstacles: [{name: rock1, label: rock, xy_m: [3, 1], mesh: " + mesh +
         "}]\n";
}

TEST(BadInput, AnUnknownKeyIsNamedWithTheKeyItResembles) {
  const std::string scenario = Edited(SmallScenario(), "seed", "sead");
  ExpectScenarioRefused(scenario, TellsOf(At(scenario, "sead") + "sead"));
}

TEST(BadInput, AnUnknownKeyThatResemblesNoneIsAnsweredWithTheKnownOnes) {
  const std::string scenario = SmallScenario() + "weather: fine\n";
  ExpectScenarioRefused(scenario, TellsOf(At(scenario, "weather") + "weather"));
}

TEST(BadInput, AWordForANumberIsRefusedWithWhatIsNeeded) {
  const std::string scenario = Edited(SmallScenario(), "duration_s: 0.4", "duration_s: long");
  ExpectScenarioRefused(scenario, TellsOf(At(scenario, "long") + "duration_s"));
}

TEST(BadInput, AMeshThatIsNotThereIsRefusedWithWhereItWasSought) {
  const std::string scenario = WithObstacle("lost.glb");
  ExpectScenarioRefused(scenario, TellsOf(At(scenario, "lost.glb") + "obstacles[0].mesh"));
}

TEST(BadInput, AMeshThatIsNoneIsRefusedByItsName) {
  const ScratchDirectory scratch;
  WriteWholeFile(scratch.path() / "rock.glb", "not a mesh");
  ExpectScenarioRefused(
      scratch, WithObstacle("rock.glb"),
      AllOf(TellsOf(At(WithObstacle("rock.glb"), "rock.glb") + "obstacles[0].mesh"),
            TellsOf("rock.glb")));
}

TEST(BadInput, AMeshWhosePictureIsMissingOrNoneIsRefusedWithWhatIsNeeded) {
  const ScratchDirectory scratch;
  testing_mesh::WriteTexturedSquare(scratch.path(), R"("normalTexture":{"index":0})",
                                    R"({"uri":"paint.png"})", 1);
  const std::string scenario = WithObstacle("square.gltf, node: square");
  const std::string place = At(scenario, "square.gltf") + "obstacles[0].mesh: ";
  ExpectScenarioRefused(scratch, scenario,
                        AllOf(StartsWith(place), HasSubstr("material 'paint' needs the picture "
                                                           "'paint.png', which is missing")));
  WriteWholeFile(scratch.path() / "paint.png", "no picture");
  ExpectScenarioRefused(scratch, scenario,
                        AllOf(StartsWith(place),
                              HasSubstr("has 'paint.png', 10 bytes that are no "
                                        "picture"),
                              HasSubstr("need PNG or JPEG: export the file again")));
}

TEST(BadInput, AMeshWithoutTheNodeIsRefusedWithItsPlace) {
  const std::string scenario = WithObstacle("tera:assets/rock.glb, node: bodyy");
  ExpectScenarioRefused(scenario,
                        TellsOf(At(scenario, "tera:assets/rock.glb") + "obstacles[0].mesh"));
}

TEST(BadInput, ALensThatFoldsItsPictureIsRefusedWithItsPlace) {
  const std::string scenario = SmallScenario(
      "{name: cam, type: camera, link: chassis, rate_hz: 1, width_px: 64, height_px: 48, "
      "horizontal_fov_deg: 90, k1: -3}");
  ExpectScenarioRefused(scenario, TellsOf(At(scenario, "-3") + "machines[0].rig.sensors[1].k1"));
}

TEST(BadInput, AShutterThatIsOpenLongerThanFromPictureToPictureIsRefusedWithItsPlace) {
  const std::string scenario = SmallScenario(
      "{name: cam, type: camera, link: chassis, rate_hz: 10, width_px: 64, height_px: 48, "
      "horizontal_fov_deg: 90, image_sensor: {exposure_s: 0.125}}");
  ExpectScenarioRefused(scenario, TellsOf(At(scenario, "0.125") +
                                          "machines[0].rig.sensors[1].image_sensor.exposure_s"));
}

TEST(BadInput, AReadoutThatIsLongerThanFromPictureToPictureIsRefusedWithItsPlace) {
  const std::string scenario = SmallScenario(
      "{name: cam, type: camera, link: chassis, rate_hz: 20, width_px: 64, height_px: 48, "
      "horizontal_fov_deg: 90, image_sensor: {shutter: {readout_s: 0.0625}}}");
  ExpectScenarioRefused(scenario,
                        TellsOf(At(scenario, "0.0625") +
                                "machines[0].rig.sensors[1].image_sensor.shutter.readout_s"));
}

TEST(BadInput, OpticsWithoutAnImageSensorAreRefusedWithTheirPlace) {
  const std::string scenario = SmallScenario(
      "{name: cam, type: camera, link: chassis, rate_hz: 1, width_px: 64, height_px: 48, "
      "horizontal_fov_deg: 90, optics: {focus_m: 2.25}}");
  ExpectScenarioRefused(scenario, TellsOf("machines[0].rig.sensors[1].optics"));
}

TEST(BadInput, AStereoMatcherWithAnEvenBlockIsRefusedWithItsPlace) {
  const std::string scenario = SmallScenario(
      "{name: cam, type: camera, link: chassis, rate_hz: 1, width_px: 64, height_px: 48, "
      "horizontal_fov_deg: 90, depth: true, stereo: {disparities_px: 16, block_px: 6}}");
  ExpectScenarioRefused(
      scenario, TellsOf(At(scenario, "6}}") + "machines[0].rig.sensors[1].stereo.block_px"));
}

TEST(BadInput, AFisheyeThatFoldsItsPictureIsRefusedWithItsPlace) {
  const std::string scenario = SmallScenario(
      "{name: cam, type: camera, link: chassis, rate_hz: 1, width_px: 64, height_px: 48, "
      "fx_px: 20, lens: kannala_brandt, k1: -0.375}");
  ExpectScenarioRefused(scenario,
                        TellsOf(At(scenario, "-0.375") + "machines[0].rig.sensors[1].k1"));
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

TEST(BadInput, TwoSensorsOfOneNameAreRefused) {
  const std::string scenario = SmallScenario(Edited(kLidar, "name: lidar", "name: imu"));
  const std::string second = LineAndColumn(scenario, "imu, preset: tera:config/sensors/vlp16");
  ExpectScenarioRefused(scenario,
                        TellsOf("small.yaml:" + second + ": machines[0].rig.sensors[1].name"));
}

TEST(BadInput, ASensorOnALinkThatIsNotThereIsRefusedWithTheLinks) {
  const std::string scenario = Edited(SmallScenario(), "link: chassis", "link: chasis");
  ExpectScenarioRefused(scenario,
                        TellsOf(At(scenario, "chasis,") + "machines[0].rig.sensors[0].link"));
}

TEST(BadInput, ASensorThatNeverMeasuresIsRefused) {
  const std::string scenario = Edited(SmallScenario(), "rate_hz: 100", "rate_hz: 0");
  ExpectScenarioRefused(scenario,
                        TellsOf(At(scenario, "0}]}") + "machines[0].rig.sensors[0].rate_hz"));
}

TEST(BadInput, NumbersThatOnlyASlipOfTheFingerGivesAreRefused) {
  const std::string fast = Edited(SmallScenario(), "rate_hz: 100", "rate_hz: 1e10");
  ExpectScenarioRefused(fast, TellsOf(At(fast, "1e10") + "machines[0].rig.sensors[0].rate_hz"));
  const std::string endless = Edited(SmallScenario(), "duration_s: 0.4", "duration_s: 1e300");
  ExpectScenarioRefused(endless, TellsOf(At(endless, "1e300") + "duration_s"));
}

TEST(BadInput, ANegativeMassInTheMachineFileIsRefusedThere) {
  const ScratchDirectory scratch;
  const std::string machine =
      "kind: block\nlinks:\n  chassis: {mass_kg: -5, inertia_kgm2: [1, 1, 1], label: vehicle}\n";
  WriteWholeFile(scratch.path() / "block.yaml", machine);
  ExpectScenarioRefused(scratch,
                        Edited(SmallScenario(), "tera:config/machines/warthog.yaml", "block.yaml"),
                        TellsOf("block.yaml:" + LineAndColumn(machine, "-5") +
                                ": machines[0].machine.links.chassis.mass_kg"));
}

TEST(BadInput, EveryFaultIsReportedAtOnce) {
  const ScratchDirectory scratch;
  const std::string scenario =
      Edited(Edited(SmallScenario(), "seed", "sead"), "rate_hz: 100", "rate_hz: 0");
  WriteWholeFile(scratch.path() / "small.yaml", scenario);
  const Outcome outcome = RunTera({"check", "small.yaml"}, {scratch.path()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, TellsOf("small.yaml:2:1: sead"));
}

TEST(BadInput, ATextThatIsNoYamlIsRefusedAtTheLineThatBreaksIt) {
  ExpectScenarioRefused("name: small\nmachines: [\n", TellsOf("small.yaml:3:1"));
  ExpectScenarioRefused("", TellsOf("small.yaml:1:1"));
}

TEST(BadInput, AnOverrideIsRefusedByItsKey) {
  const ScratchDirectory scratch;
  WriteWholeFile(scratch.path() / "small.yaml", SmallScenario());
  ExpectRefused(scratch, {"check", "small.yaml", "--set", "machines[7].name=x"},
                TellsOf("--set: machines"));
  for (const char* text : {"seed", "]=1", "machines[00].name=x"}) {
    ExpectRefused(scratch, {"check", "small.yaml", "--set", text},
                  TellsOf(std::string("--set ") + text));
  }
  ExpectRefused(scratch, {"check", "small.yaml", "--set", "machines[0]=foo"},
                TellsOf("--set: machines[0]"));
}

TEST(BadInput, AMachineNamedLikeAFolderElsewhereIsRefused) {
  const std::string scenario = Edited(SmallScenario(), "name: rover1", "name: ..");
  ExpectScenarioRefused(scenario, TellsOf(At(scenario, "..\n") + "machines[0].name"));
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
  const auto says_so = TellsOf(folder);
  ExpectRefused(scratch, {"check", folder}, says_so);
  ExpectRefused(scratch, {"generate", folder, "--out", "run"}, says_so);
  ExpectRefused(scratch, {"import", folder, "--out", "run"}, says_so);
  // A recording in place of its scenario.
  WriteWholeFile(fs::path(folder) / "scenario.yaml", "name: dug\n");
  const auto names_it = StartsWith(folder + ": is a folder; need a YAML file, such as " + folder +
                                   "/scenario.yaml\n");
  ExpectRefused(scratch, {"check", folder}, names_it);
}

TEST(BadInput, AFolderThatIsNoDatasetIsNeitherComparedNorDrawn) {
  const ScratchDirectory scratch;
  fs::create_directory(scratch.path() / "holiday");
  const auto message = HasSubstr("holiday: is not a complete recording (it has no dataset.yaml)");
  ExpectRefused(scratch, {"compare", "holiday", "holiday"}, message);
  ExpectRefused(scratch, {"replay", "holiday", "--out", "run"}, message);
  ExpectRefused(scratch, {"overview", "holiday"}, message);
}

TEST(BadInput, ARecordingThatIsNotThereIsNoIncompleteOne) {
  const ScratchDirectory scratch;
  const auto message = TellsOf("nope");
  ExpectRefused(scratch, {"replay", "nope", "--out", "run"}, message);
  ExpectRefused(scratch, {"overview", "nope"}, message);
}

TEST(BadInput, AReplayIsNotWrittenOverItsOwnSource) {
  const ScratchDirectory scratch;
  fs::create_directory(scratch.path() / "run.incomplete");
  WriteWholeFile(scratch.path() / "run.incomplete/INCOMPLETE.txt", "killed");
  const auto message =
      AllOf(StartsWith("--out "), HasSubstr("run.incomplete, the recording to replay"),
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
    ExpectRefused(scratch, {"replay", "run.incomplete", "--out", out}, TellsOf("--out " + out));
    ExpectRefused(scratch, {"replay", "link", "--out", out}, TellsOf("--out " + out));
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
  ExpectRefused(scratch, {"import", "mapping.yaml", "--out", "run"}, TellsOf("drive.csv:1"));
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

}  // namespace
}  // namespace tera
