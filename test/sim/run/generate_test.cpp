#include "sim/run/generate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <thread>

#include "core/config/config.h"
#include "core/config/csv.h"
#include "core/error.h"
#include "own_folder.h"
#include "physics/actuation/cylinder_fixture.h"

// Whole small datasets: a digging excavator with every kind of sensor.

namespace tera {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDigging = "{type: dig_cycle, reach_m: 4.0}";
constexpr const char* kScenario = R"(
name: small
seed: 5
duration_s: 1.2
settle_s: 0.2
terrain: {size_m: [14, 14], cell_m: 0.1, soil: dirt}
machines:
  - name: excavator1
    machine: tera:config/machines/tb235.yaml
    operator: OPERATOR
    rig: {sensors: [
      {name: imu_boom, preset: tera:config/sensors/xsens_mti_670.yaml, link: boom, xyz_m: [1, 0, 0.3]},
      {name: gnss, preset: tera:config/sensors/rtk_f9p.yaml, link: upper, xyz_m: [-0.9, 0.5, 1.2]},
      {name: camera, preset: tera:config/sensors/realsense_d435i.yaml, link: upper, xyz_m: [0.8, 0.3, 1.8], rpy_deg: [0, 30, 0], width_px: 96, height_px: 72, rate_hz: 5},
      {name: lidar, preset: tera:config/sensors/vlp16.yaml, link: upper, xyz_m: [0, 0.3, 2.1], columns: 256},
      MORE_SENSORS
      {name: encoders, preset: tera:config/sensors/encoder.yaml}]}
obstacles: [{name: cone1, preset: tera:config/obstacles/cone.yaml, xy_m: [5, 1]}]
)";

/// The scenario above with its words in capitals replaced.
std::string ScenarioText(const std::string& driver = kDigging, const std::string& sensors = "") {
  std::string text = kScenario;
  const auto put = [&](const std::string& word, const std::string& by) {
    text.replace(text.find(word), word.size(), by);
  };
  put("OPERATOR", driver);
  put("MORE_SENSORS", sensors);
  return text;
}

using Files = std::map<std::string, std::string>;

Files ReadAll(const fs::path& root) {
  Files files;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    if (!entry.is_regular_file()) continue;
    std::ifstream stream(entry.path(), std::ios::binary);
    std::stringstream bytes;
    bytes << stream.rdbuf();
    files[entry.path().lexically_relative(root).generic_string()] = bytes.str();
  }
  return files;
}

fs::path Fresh(const std::string& name) {
  const fs::path path = OwnFolder() / name;
  fs::remove_all(path);
  fs::remove_all(path.string() + ".incomplete");
  return path;
}

void Simulate(const fs::path& out, const std::string& scenario_text, GenerateOptions options = {}) {
  const Config config = Config::FromText(scenario_text, "small.yaml");
  const Scenario scenario = ReadScenario(config.root());
  config.Finish();
  options.out = out;
  Generate(scenario, config.ResolvedYaml(), options);
}

GenerateOptions Resume() {
  GenerateOptions options;
  options.resume = true;
  return options;
}

std::string WithSeed(int seed) {
  std::string text = ScenarioText();
  return text.replace(text.find("seed: 5"), 7, "seed: " + std::to_string(seed));
}

Files Generated(const std::string& name, const std::string& scenario_text = ScenarioText(),
                int threads = 2) {
  const fs::path out = Fresh(name);
  GenerateOptions options;
  options.threads = threads;
  Simulate(out, scenario_text, options);
  return ReadAll(out);
}

void ExpectSame(const Files& a, const Files& b) {
  ASSERT_EQ(a.size(), b.size());
  for (const auto& [name, bytes] : a) {
    ASSERT_TRUE(b.contains(name)) << name;
    EXPECT_TRUE(b.at(name) == bytes) << name << " differs";
  }
}

TEST(Generate, SameSeedGivesTheSameBytesWithAnyNumberOfThreads) {
  const std::string scenario = ScenarioText() + "record: {poses_hz: 30}\n";
  const Files one = Generated("one", scenario, 1), two = Generated("two", scenario, 2);
  EXPECT_GT(one.size(), 40u);
  ExpectSame(one, two);
}

TEST(Generate, OneScenarioGivesTheSameBytesAgainAndOnTwoThreadsAtOnce) {
  const Config config = Config::FromText(ScenarioText(), "small.yaml");
  const Scenario scenario = ReadScenario(config.root());
  config.Finish();
  const std::string yaml = config.ResolvedYaml();
  const auto generate = [&](const fs::path& out) { Generate(scenario, yaml, {.out = out}); };
  const fs::path alone = Fresh("alone"), left = Fresh("left"), right = Fresh("right");
  generate(alone);
  std::thread on_left([&] { generate(left); }), on_right([&] { generate(right); });
  on_left.join();
  on_right.join();
  ExpectSame(ReadAll(alone), ReadAll(left));
  ExpectSame(ReadAll(alone), ReadAll(right));
}

TEST(Generate, AnotherSeedChangesTheNoiseButNotTheTruth) {
  const Files a = Generated("seed5"), b = Generated("seed6", WithSeed(6));
  EXPECT_NE(a.at("excavator1/imu_boom/data.csv"), b.at("excavator1/imu_boom/data.csv"));
  EXPECT_EQ(a.at("truth/excavator1/pose.csv"), b.at("truth/excavator1/pose.csv"));
}

TEST(Generate, AnotherSensorLeavesTheOthersUnchanged) {
  const Files few = Generated("few");
  const Files more = Generated("more", ScenarioText(kDigging, R"(
      {name: imu_arm, preset: tera:config/sensors/icm_20948.yaml, link: arm},
      {name: camera2, preset: tera:config/sensors/rgb_640.yaml, link: upper, xyz_m: [0, 0, 2.5]},
      {name: lidar2, preset: tera:config/sensors/vlp16.yaml, link: upper, xyz_m: [0, 1, 2], columns: 128},)"));
  EXPECT_TRUE(more.contains("excavator1/imu_arm/data.csv"));
  EXPECT_TRUE(more.contains("excavator1/lidar2/data.csv"));
  for (const auto& [name, bytes] : few) {
    if (name == "dataset.yaml" || name == "scenario.yaml") continue;  // these name the sensors
    EXPECT_TRUE(more.contains(name) && more.at(name) == bytes) << name;
  }
}

/// Files of `effects` that differ from those of a run without them, or are new.
std::vector<std::string> ChangedBy(const std::string& effects, const std::string& name) {
  const Files plain = Generated("plain");
  const Files files =
      Generated(name, ScenarioText() + "effects: {excavator1: {" + effects + "}}\n");
  std::vector<std::string> changed;
  for (const auto& [file, bytes] : files) {
    const auto before = plain.find(file);
    if (before == plain.end() || before->second != bytes) changed.push_back(file);
  }
  return changed;
}

TEST(Generate, AnEffectOfASensorChangesWhatItMeasuresAndNothingElse) {
  using ::testing::Each, ::testing::AnyOf, ::testing::StartsWith, ::testing::Not,
      ::testing::EndsWith, ::testing::Contains;
  const auto changed = ChangedBy(
      "imu_boom: {imu_lever_arm: {x_m: 0.5}}, lidar: {extrinsic: {yaw_deg: 2}}", "two_effects");
  EXPECT_THAT(changed, Each(AnyOf(StartsWith("excavator1/imu_boom/data.csv"),
                                  StartsWith("excavator1/lidar/scans/"), "scenario.yaml")));
  EXPECT_THAT(changed, Contains("excavator1/imu_boom/data.csv"));
  EXPECT_THAT(changed, Contains("excavator1/lidar/scans/0.pcd"));

  const auto others = ChangedBy(
      "gnss: {multipath: {}}, camera: {extrinsic: {pitch_deg: 3}, range_bias: {depth_m: 0.1}}, "
      "encoders/arm: {bias: {angle_deg: 1}}",
      "three_effects");
  EXPECT_THAT(others, Each(AnyOf("excavator1/gnss/data.csv", StartsWith("excavator1/camera/"),
                                 "excavator1/encoders/data.csv", "scenario.yaml")));
  EXPECT_THAT(others, Contains("excavator1/gnss/data.csv"));
  EXPECT_THAT(others, Contains("excavator1/camera/depth/0.png"));
  EXPECT_THAT(others, Contains("excavator1/encoders/data.csv"));
  EXPECT_THAT(others, Each(Not(EndsWith("sensor.yaml"))));  // which stays as documented
}

constexpr const char* kWrongClocks =
    "effects: {excavator1: {camera: {latency: {delay_s: 0.05, jitter_s: 0.2}}, "
    "lidar: {clock_offset: {offset_s: -18}, latency: {delay_s: 0, jitter_s: 0.1}}, "
    "imu_boom: {latency: {delay_s: 0.01, jitter_s: 0.05}}}}\n";

TEST(Generate, AKilledRunWithSensorsThatStampLateIsFinishedWithTheSameBytes) {
  struct Killed {};
  const Files whole = Generated("late", ScenarioText() + kWrongClocks);
  EXPECT_THAT(whole.at("excavator1/lidar/data.csv"), ::testing::HasSubstr("\n-17"));
  const fs::path out = Fresh("late_killed");
  GenerateOptions until_half;
  until_half.progress = [](const GenerateProgress& progress) {
    if (progress.simulated_s > 0.6) throw Killed();
  };
  EXPECT_THROW(Simulate(out, ScenarioText() + kWrongClocks, until_half), Killed);
  Simulate(out, ScenarioText() + kWrongClocks, Resume());
  ExpectSame(whole, ReadAll(out));
}

TEST(Generate, AKilledRunIsFinishedWithTheSameBytes) {
  struct Killed {};
  const Files whole = Generated("whole");
  const fs::path out = Fresh("killed");
  GenerateOptions until_half;
  until_half.progress = [](const GenerateProgress& progress) {
    if (progress.simulated_s > 0.6) throw Killed();
  };
  EXPECT_THROW(Simulate(out, ScenarioText(), until_half), Killed);
  EXPECT_FALSE(fs::exists(out));
  ASSERT_TRUE(fs::exists(out.string() + ".incomplete"));
  Simulate(out, ScenarioText(), Resume());
  ExpectSame(whole, ReadAll(out));
}

/// The scenario above with a worker in the machine's reach.
std::string WithWorker(const std::string& driver = kDigging) {
  std::string text = ScenarioText(driver);
  const std::string cone = "{name: cone1, preset: tera:config/obstacles/cone.yaml, xy_m: [5, 1]}";
  return text.replace(text.find(cone), cone.size(),
                      "{name: worker, preset: tera:config/obstacles/person.yaml, xy_m: [3, 3]}");
}

TEST(Generate, EventsAreTheSameOnOtherThreadsAfterAKillAndInAReplay) {
  struct Killed {};
  const std::string file = "truth/events.csv";
  const Files one = Generated("events_one", WithWorker(), 1);
  const std::string begin =
      "t_ns,end_ns,kind,machine,part,other,value,unit\n0,1200000000,person_near,excavator1,,"
      "worker,";
  EXPECT_THAT(one.at(file), ::testing::StartsWith(begin));
  EXPECT_THAT(one.at("dataset.yaml"),
              ::testing::HasSubstr("path: \"truth/events.csv\", type: events"));
  EXPECT_EQ(Generated("events_two", WithWorker(), 2).at(file), one.at(file));
  const fs::path out = Fresh("events_killed");
  GenerateOptions until_half;
  until_half.progress = [](const GenerateProgress& progress) {
    if (progress.simulated_s > 0.6) throw Killed();
  };
  EXPECT_THROW(Simulate(out, WithWorker(), until_half), Killed);
  EXPECT_FALSE(fs::exists(out.string() + ".incomplete/" + file));
  Simulate(out, WithWorker(), Resume());
  ExpectSame(one, ReadAll(out));
  const fs::path csv = OwnFolder() / "events_commands.csv";
  std::ofstream(csv, std::ios::binary) << one.at("excavator1/commands.csv");
  const std::string replay = "{type: lever_replay, csv: " + csv.string() + "}";
  EXPECT_EQ(Generated("events_replayed", WithWorker(replay)).at(file), one.at(file));
}

TEST(Generate, ARunThatLacksOnlyItsNameGetsItWithoutAnotherSimulation) {
  const Files whole = Generated("named");
  const fs::path out = OwnFolder() / "named";
  fs::rename(out, out.string() + ".incomplete");
  GenerateOptions options = Resume();
  options.progress = [](const GenerateProgress&) { FAIL() << "simulated again"; };
  Simulate(out, ScenarioText(), options);
  ExpectSame(whole, ReadAll(out));
}

TEST(Generate, EncodersOfSlidingJointsAreInMetres) {
  const Files files = Generated("slide", R"(
name: slide
duration_s: 0.1
settle_s: 0
terrain: {size_m: [6, 6], cell_m: 0.2, soil: dirt}
machines:
  - name: lift1
    machine:
      kind: lift
      fixed_base: true
      links:
        post: {mass_kg: 50, inertia_kgm2: [1, 1, 1]}
        carriage: {mass_kg: 5, inertia_kgm2: [0.1, 0.1, 0.1]}
      joints:
        slide: {type: prismatic, parent: post, child: carriage, xyz_m: [0, 0, 1], axis: [0, 0, 1],
                limits_m: [0, 2], initial_m: 1.234, max_rate_mps: 0.5, max_effort_n: 5000}
      levers: [slide]
    operator: {type: idle}
    rig: {sensors: [{name: e, type: encoder, rate_hz: 100, resolution_deg: 90, resolution_m: 0.5}]}
)");
  const std::string& table = files.at("lift1/e/data.csv");
  // 1.234 m is nearest to two steps of 0.5 m; steps of 90 deg would be 1.57.
  EXPECT_THAT(table, ::testing::StartsWith("t_ns,slide_m,slide_mps\n0,1,"));
}

TEST(Generate, HydraulicsHaveTheLengthsAndPressuresOfACylinderInItsPose) {
  std::ofstream(OwnFolder() / "cylinder_arm.yaml") << kCylinderArm;
  const fs::path out = Fresh("hydraulics");
  Simulate(out, R"(
name: hydraulics
duration_s: 1
settle_s: 0
terrain: {size_m: [8, 8], cell_m: 0.2, soil: dirt}
machines:
  - {name: arm1, machine: ")" +
                    (OwnFolder() / "cylinder_arm.yaml").string() + R"(",
     start: {xy_m: [0.4, -0.3], yaw_deg: 70}, operator: {type: idle}}
)");
  const fs::path file = out / "truth/arm1/hydraulics.csv";
  EXPECT_THAT(ReadCsvHeader(file),
              ::testing::ElementsAre("t_ns", "ram_length_m", "ram_stroke_m", "ram_mps", "ram_n",
                                     "ram_head_pressure_pa", "ram_rod_pressure_pa"));
  const auto columns =
      ReadCsvColumns(file, {"t_ns", "ram_length_m", "ram_stroke_m", "ram_mps", "ram_n",
                            "ram_head_pressure_pa", "ram_rod_pressure_pa"});
  EXPECT_EQ(columns[0].front(), 0);
  EXPECT_EQ(columns[0].back(), 1e9);
  for (std::size_t i = 1; i < columns[0].size(); ++i) EXPECT_GT(columns[0][i], columns[0][i - 1]);
  // Pins 0.5 m and 1.3 m from the joint, at a right angle: sqrt(1.94) m. The joint's upper limit of
  // 70 deg leaves 34.25 deg between them and the shortest length: sqrt(1.94 - 1.3 cos 34.25 deg).
  EXPECT_NEAR(columns[1].back(), 1.392839, 1e-6);
  EXPECT_NEAR(columns[2].back(), 1.392839 - 0.930287, 1e-6);
  EXPECT_NEAR(columns[3].back(), 0, 1e-9);
  // It hangs on its rod: 20 kg at 0.8 m and the hook's 1 kg at the pin, at 14.25 deg, over the
  // lever arm of 0.5 * 1.3 / 1.392839 m. The piston's other side is open to the return line of 0.2
  // MPa.
  const double pull_n = 20 * 9.81 * 0.8 * 0.969231 / 0.466673;
  EXPECT_NEAR(columns[4].back(), -pull_n, 1e-3 * pull_n);
  EXPECT_NEAR(columns[5].back(), 0.2e6, 1);
  EXPECT_NEAR(columns[6].back(), (pull_n + 0.2e6 * 7.853982e-3) / 5.026548e-3, 100);
}

/// Names of the ground's files.
std::vector<std::string> GroundFiles(const Files& files) {
  const std::string folder = "truth/terrain/";
  std::vector<std::string> names;
  for (const auto& [name, bytes] : files) {
    if (name.starts_with(folder)) names.push_back(name.substr(folder.size()));
  }
  return names;
}

TEST(Generate, TheGroundIsKeptAtTheStartAndTheEnd) {
  EXPECT_THAT(GroundFiles(Generated("ground")),
              ::testing::ElementsAre("change_end.tif", "density_end.tif", "density_start.tif",
                                     "height_end.tif", "height_start.tif", "soil_class_end.tif",
                                     "soil_class_start.tif"));
}

/// Pixels of a row of a little-endian TIFF: tag 256 of its first directory.
std::uint32_t WidthOfTiff(const std::string& bytes) {
  const auto number = [&](std::size_t at, int size) {
    std::uint32_t value = 0;
    for (int b = size - 1; b >= 0; --b) {
      value = value << 8 | static_cast<unsigned char>(bytes.at(at + b));
    }
    return value;
  };
  EXPECT_EQ(bytes.substr(0, 4), std::string("II*\0", 4));
  const std::size_t directory = number(4, 4);
  for (std::size_t k = 0; k < number(directory, 2); ++k) {
    const std::size_t entry = directory + 2 + 12 * k;
    if (number(entry, 2) == 256) return number(entry + 8, number(entry + 2, 2) == 3 ? 2 : 4);
  }
  ADD_FAILURE() << "no width";
  return 0;
}

TEST(Generate, WhatIsKeptOfTheGroundAndWhenIsTheScenariosToSay) {
  const std::string record =
      "record: {terrain: [mass_change], PIXEL every_s: 0.5, "
      "voxels: [{name: pit, low_m: [2, -2, -1], high_m: [4, 2, 0.5], edge_m: 0.2}]}\n";
  const auto with = [&](const std::string& pixel) {
    std::string text = record;
    return ScenarioText() + text.replace(text.find("PIXEL"), 5, pixel);
  };
  const Files fine = Generated("kept", with(""));
  EXPECT_THAT(GroundFiles(fine),
              ::testing::ElementsAre("mass_change_1000000000.tif", "mass_change_500000000.tif",
                                     "mass_change_end.tif", "pit_1000000000.vti",
                                     "pit_500000000.vti", "pit_end.vti", "pit_start.vti"));
  const Files coarse = Generated("kept_coarse", with("pixel_m: 0.7,"));
  EXPECT_LT(2 * WidthOfTiff(coarse.at("truth/terrain/mass_change_end.tif")),
            WidthOfTiff(fine.at("truth/terrain/mass_change_end.tif")));
  EXPECT_EQ(coarse.at("truth/terrain/pit_end.vti"), fine.at("truth/terrain/pit_end.vti"));
}

TEST(Generate, RefusesToResumeAnotherScenario) {
  struct Killed {};
  const fs::path out = Fresh("other");
  GenerateOptions at_once;
  at_once.progress = [](const GenerateProgress&) { throw Killed(); };
  EXPECT_THROW(Simulate(out, ScenarioText(), at_once), Killed);
  EXPECT_THROW(Simulate(out, WithSeed(99), Resume()), InputError);
}

TEST(Generate, RefusesADirectoryThatIsNotEmpty) {
  const fs::path out = Fresh("full");
  fs::create_directories(out);
  std::ofstream(out / "mine.txt") << "keep me";
  EXPECT_THROW(Simulate(out, ScenarioText()), InputError);
  EXPECT_TRUE(fs::exists(out / "mine.txt"));
  EXPECT_EQ(std::distance(fs::directory_iterator(out), fs::directory_iterator()), 1);
}

TEST(Generate, RecordedCommandsReplayToTheSameMotion) {
  const Files dug = Generated("dug");
  const fs::path csv = OwnFolder() / "replayed_commands.csv";
  std::ofstream(csv, std::ios::binary) << dug.at("excavator1/commands.csv");
  const Files replayed =
      Generated("replayed", ScenarioText("{type: lever_replay, csv: " + csv.string() + "}"));
  EXPECT_EQ(dug.at("truth/excavator1/pose.csv"), replayed.at("truth/excavator1/pose.csv"));
  EXPECT_EQ(dug.at("truth/excavator1/joints.csv"), replayed.at("truth/excavator1/joints.csv"));
}

TEST(Generate, ResolvedScenarioInTheDatasetGeneratesItAgain) {
  const Files first = Generated("first");
  const fs::path out = Fresh("second");
  const Config config = Config::FromText(first.at("scenario.yaml"), "scenario.yaml");
  const Scenario scenario = ReadScenario(config.root());
  config.Finish();
  GenerateOptions options;
  options.out = out;
  Generate(scenario, config.ResolvedYaml(), options);
  ExpectSame(first, ReadAll(out));
}

/// The scenario above with its driver on tracks, cameras of all kinds and weather.
std::string InWeather(const std::string& weather) {
  const std::string camera =
      "preset: tera:config/sensors/realsense_d435i.yaml, link: upper, xyz_m: [0.8, 0.3, 1.8], "
      "rpy_deg: [0, 30, 0], width_px: 64, height_px: 48, rate_hz: 2, labels: false, ";
  std::string text = ScenarioText(
      "{type: waypoints, waypoints: [{xy_m: [3, 0]}], speed_mps: 1.0}",
      "{name: disparity, " + camera + "rgb: false}, {name: stereo, " + camera +
          "rgb: false, disparity_noise_px: 0, stereo: {disparities_px: 16}}, {name: flight, " +
          camera + "rgb: false, disparity_noise_px: 0, time_of_flight: {}},");
  text += "environment: {cloud_cover: 1" + weather + "}\n";
  const std::string ground = "soil: dirt}";
  return text.replace(text.find(ground), ground.size(),
                      "custom_soils: [{preset: 'tera:config/soils/dirt.yaml', name: dry, moisture: "
                      "0.01}], soil: dry}");
}

TEST(Generate, AllThatIsInTheAirReachesEverySensorThatLooksThroughIt) {
  const Files clear = Generated("clear", InWeather(""));
  for (const auto& [name, weather] : std::map<std::string, std::string>{
           {"fog", ", visibility_m: 40"},
           {"rain", ", rain_mmph: 40"},
           {"snow", ", snowfall_mmph: 5"},
           {"dust", ", wind_mps: 8, wind_from_deg: 270, dust: {emission_factor: 1000}"}}) {
    const Files files = Generated(name, InWeather(weather));
    for (const std::string sensor : {"camera", "disparity", "stereo", "flight", "lidar"}) {
      bool differs = false;
      for (const auto& [file, bytes] : files) {
        if (!file.starts_with("excavator1/" + sensor + "/") || file.ends_with(".yaml")) continue;
        differs = differs || !clear.contains(file) || clear.at(file) != bytes;
      }
      EXPECT_TRUE(differs) << name << " leaves " << sensor << " as it is";
    }
  }
}

}  // namespace
}  // namespace tera
