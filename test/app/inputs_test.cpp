#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <thread>

#include "app/program.h"
#include "core/faults.h"
#include "dataset/format/recording.h"

// Inputs of a dataset other than its scenario, and the effect of their change on a replay and a
// resumed run.

namespace tera {
namespace {

using testing::AllOf;
using testing::ElementsAreArray;
using testing::HasSubstr;
using testing::StartsWith;
namespace fs = std::filesystem;

constexpr const char* kUrdf = R"(<robot name="arm">
  <link name="base">
    <inertial><mass value="80"/><inertia ixx="4" iyy="5" izz="6" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <link name="upper">
    <inertial>
      <origin xyz="0.4 0 0"/><mass value="12"/>
      <inertia ixx="0.1" iyy="0.9" izz="0.9" ixy="0" ixz="0" iyz="0"/>
    </inertial>
    <visual><geometry><mesh filename="package://robot/meshes/upper.obj"/></geometry></visual>
  </link>
  <joint name="turn" type="revolute">
    <origin xyz="0.1 0 0.5" rpy="0.2 0 0.3"/><axis xyz="0 -1 0"/>
    <parent link="base"/><child link="upper"/>
    <limit lower="-1.5" upper="1.2" velocity="0.8" effort="600"/>
  </joint>
</robot>
)";

constexpr const char* kObj =
    "mtllib upper.mtl\nv 0 0 0\nv 0.8 0 0.1\nv 0 0.3 0\nusemtl paint\nf 1 2 3\n";

/// Files of the site that the scenario below names, directly or indirectly.
const std::vector<std::string> kFiles = {"height.tif",
                                         "height.tif.aux.xml",
                                         "levers.csv",
                                         "robot/meshes/upper.mtl",
                                         "robot/meshes/upper.obj",
                                         "robot/urdf/arm.urdf"};

std::string SiteScenario() {
  std::string text =
      Edited(SmallScenario(), "{type: idle}", "{type: lever_replay, csv: levers.csv}");
  text = Edited(text, "size_m: [14, 14]", "geotiff: height.tif");
  return text +
         "  - {name: arm1, machine: arm.yaml, start: {xy_m: [-3, 2]}, operator: {type: idle}}\n";
}

std::string Sha256ByCoreutils(const fs::path& file) {
  std::FILE* pipe = popen(("sha256sum " + file.string()).c_str(), "r");
  char digits[65] = {};
  EXPECT_EQ(std::fread(digits, 1, 64, pipe), 64u);
  pclose(pipe);
  return digits;
}

class Inputs : public testing::Test {
 protected:
  Inputs() {
    // A GeoTIFF as recorded by a run without one.
    WriteWholeFile(path() / "flat.yaml", SmallScenario());
    ExpectDone({"generate", "flat.yaml", "--out", "flat", "--duration", "0.01"});
    fs::create_directories(site() / "robot/urdf");
    fs::create_directories(site() / "robot/meshes");
    fs::copy(path() / "flat/truth/terrain/height_start.tif", site() / "height.tif");
    WriteWholeFile(site() / "height.tif.aux.xml",
                   "<PAMDataset><Metadata><MDI key=\"by\">hand</MDI></Metadata></PAMDataset>\n");
    WriteWholeFile(site() / "levers.csv",
                   "t_ns,left_track,right_track\n0,0.5,0.3\n200000000,0,1\n");
    WriteWholeFile(site() / "robot/urdf/arm.urdf", kUrdf);
    WriteWholeFile(site() / "robot/meshes/upper.obj", kObj);
    WriteWholeFile(site() / "robot/meshes/upper.mtl", "newmtl paint\nKd 0.8 0.2 0.1\n");
    WriteWholeFile(site() / "arm.yaml",
                   "kind: arm\nfixed_base: true\nurdf: robot/urdf/arm.urdf\nlevers: [turn]\n");
    WriteWholeFile(site() / "site.yaml", SiteScenario());
  }

  fs::path path() const { return fs::canonical(scratch_.path()); }
  fs::path site() const { return path() / "site"; }

  void ExpectDone(const Arguments& arguments, const std::string& data = "") const {
    const Outcome outcome = Run(arguments, data);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
  }

  /// With nothing written.
  void ExpectRefused(const Arguments& arguments, const testing::Matcher<std::string>& message,
                     const std::string& data = "") const {
    const auto before = Entries(path());
    const Outcome outcome = Run(arguments, data);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.err, message);
    EXPECT_EQ(Entries(path()), before);
  }

  /// `act` while the file has a further byte, and while it is absent.
  template <typename Act>
  void ChangeAndTakeAway(const fs::path& file, const Act& act) const {
    const std::string bytes = ReadWholeFile(file);
    WriteWholeFile(file, bytes + "\n");
    act("differs from the recorded file: found " + std::to_string(bytes.size() + 1) +
        " bytes with SHA-256 " + Sha256ByCoreutils(file).substr(0, 12) + "..., need ");
    fs::remove(file);
    act("is missing; need the recorded file, ");
    WriteWholeFile(file, bytes);
  }

  std::map<std::string, std::string> Whole() const {
    ExpectDone({"generate", "site/site.yaml", "--out", "whole"});
    return AllFiles(path() / "whole");
  }

  /// State of a run that is killed once it has prefix_result.
  void Kill(const Arguments& arguments, const fs::path& prefix_result) const {
    TeraProcess run(arguments, {path()});
    while (!fs::exists(path() / prefix_result) && run.Running()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_TRUE(run.Running()) << "ended before it could be killed";
    run.Signal(SIGKILL);
    run.Wait();
  }

 private:
  Outcome Run(const Arguments& arguments, const std::string& data) const {
    Surroundings surroundings{path()};
    if (!data.empty()) surroundings.environment["TERA_DATA_DIR"] = data;
    return RunTera(arguments, surroundings);
  }

  ScratchDirectory scratch_;
};

TEST_F(Inputs, AreListedWithTheirSizesAndDigests) {
  Whole();
  std::vector<std::string> names, expected;
  for (const std::string& file : kFiles) expected.push_back((site() / file).string());
  expected.push_back("tera:assets/warthog.glb");
  const Recording recording(path() / "whole");
  for (const RecordedInput& input : recording.info().inputs) {
    names.push_back(input.name);
    const fs::path file = input.name.starts_with("tera:")
                              ? fs::path(TERA_SOURCE_DIR) / input.name.substr(5)
                              : fs::path(input.name);
    EXPECT_EQ(input.bytes, static_cast<std::int64_t>(fs::file_size(file))) << file;
    EXPECT_EQ(input.sha256, Sha256ByCoreutils(file)) << file;
  }
  EXPECT_THAT(names, ElementsAreArray(expected));
}

TEST_F(Inputs, UnchangedTheyGiveTheSameBytesAgain) {
  const auto whole = Whole();
  for (const std::string& file : kFiles) {  // a digest knows no time
    fs::last_write_time(site() / file, fs::file_time_type::clock::now());
  }
  ExpectDone({"replay", "whole", "--out", "again"});
  EXPECT_EQ(AllFiles(path() / "again"), whole);
  ExpectDone({"generate", "whole/scenario.yaml", "--out", "from_scenario"});
  EXPECT_EQ(AllFiles(path() / "from_scenario"), whole);
}

TEST_F(Inputs, ChangedOrMissingTheyAreNotReplayed) {
  Whole();
  for (const std::string& file : kFiles) {
    ChangeAndTakeAway(site() / file, [&](const std::string& finding) {
      ExpectRefused({"replay", "whole", "--out", "again"},
                    AllOf(StartsWith("whole/dataset.yaml:"),
                          HasSubstr((site() / file).string() + " " + finding),
                          HasSubstr("restore that file, or give its place with --moved")));
    });
  }
}

TEST_F(Inputs, ChangedOrMissingTheyEndAStoppedRun) {
  const Arguments generate = {"generate", "site/site.yaml", "--out", "run", "--duration", "3"};
  Arguments resume = generate;
  resume.push_back("--resume");
  Kill(generate, "run.incomplete/rover1/imu");
  for (const std::string& file : kFiles) {
    ChangeAndTakeAway(site() / file, [&](const std::string& finding) {
      const std::string named = (site() / file).string() + " " + finding;
      ExpectRefused(resume, AllOf(StartsWith("run.incomplete/INCOMPLETE.inputs:"), HasSubstr(named),
                                  HasSubstr("delete run.incomplete to start afresh")));
      ExpectRefused({"replay", "run.incomplete", "--out", "again"},
                    AllOf(StartsWith("run.incomplete/INCOMPLETE.inputs:"), HasSubstr(named)));
    });
  }
  ExpectDone(resume);
  ExpectDone({"generate", "site/site.yaml", "--out", "whole", "--duration", "3"});
  EXPECT_EQ(AllFiles(path() / "run"), AllFiles(path() / "whole"));
}

TEST_F(Inputs, MovedTheyAreNamedByTheirNewPlace) {
  const auto whole = Whole();
  const std::string old_site = site();
  fs::rename(site(), path() / "elsewhere");
  ExpectRefused(
      {"replay", "whole", "--out", "again"},
      AllOf(HasSubstr(old_site + "/levers.csv is missing"), HasSubstr("arm.urdf is missing")));
  ExpectDone({"replay", "whole", "--out", "again", "--moved", old_site + "=elsewhere"});
  EXPECT_EQ(AllFiles(path() / "again"), whole);

  fs::rename(path() / "elsewhere/levers.csv", path() / "l.csv");
  ExpectRefused({"replay", "whole", "--out", "more", "--moved", old_site + "=elsewhere"},
                HasSubstr("levers.csv (now elsewhere/levers.csv) is missing"));
  ExpectDone({"replay", "whole", "--out", "more", "--moved", old_site + "/levers.csv=l.csv",
              "--moved", old_site + "=elsewhere"});
  EXPECT_EQ(AllFiles(path() / "more"), whole);
}

TEST_F(Inputs, MovedFromWhereNoneWasIsRefused) {
  Whole();
  for (const std::string moved : {path() / "sit=elsewhere", path() / "site2=elsewhere"}) {
    ExpectRefused({"replay", "whole", "--out", "again", "--moved", moved},
                  AllOf(StartsWith("--moved " + moved), HasSubstr("no input of the recording")));
  }
  for (const std::string moved : {"site", "=site", "site="}) {
    ExpectRefused({"replay", "whole", "--out", "again", "--moved", moved},
                  TellsOf("--moved " + moved));
  }
}

TEST_F(Inputs, AMeshThatIsNowFoundElsewhereIsNotReplayed) {
  Whole();
  // Searched from the URDF's folder upwards.
  fs::create_directories(site() / "robot/urdf/robot/meshes");
  WriteWholeFile(site() / "robot/urdf/robot/meshes/upper.obj", Edited(kObj, "0.8", "0.9"));
  ExpectRefused(
      {"replay", "whole", "--out", "again"},
      HasSubstr("scenario.yaml: reads " + (site() / "robot/urdf/robot/meshes/upper.obj").string()));
}

TEST_F(Inputs, ThatTeraShipsAreFoundOnAnotherMachine) {
  ExpectDone({"generate", "flat.yaml", "--out", "whole"});
  const std::string data = path() / "data";
  fs::create_directory(data);
  for (const char* folder : {"assets", "config", "shaders"}) {
    fs::copy(fs::path(TERA_SOURCE_DIR) / folder, fs::path(data) / folder,
             fs::copy_options::recursive);
  }
  ExpectDone({"replay", "whole", "--out", "again"}, data);
  EXPECT_EQ(AllFiles(path() / "again"), AllFiles(path() / "whole"));

  ChangeAndTakeAway(fs::path(data) / "assets/warthog.glb", [&](const std::string& finding) {
    ExpectRefused({"replay", "whole", "--out", "more"},
                  HasSubstr("inputs[0]: tera:assets/warthog.glb " + finding), data);
  });
  // The old ones may be kept somewhere.
  WriteWholeFile(fs::path(data) / "assets/warthog.glb", "new");
  ExpectDone(
      {"replay", "whole", "--out", "more", "--moved", "tera:assets=" TERA_SOURCE_DIR "/assets"},
      data);
  EXPECT_EQ(AllFiles(path() / "more"), AllFiles(path() / "whole"));
}

}  // namespace
}  // namespace tera
