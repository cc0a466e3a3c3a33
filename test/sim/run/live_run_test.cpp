#include "sim/run/live_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "core/config/config.h"
#include "core/faults.h"
#include "own_folder.h"
#include "sim/run/generate.h"
#include "sim/run/replay.h"

// Remotely driven runs, step by step, recorded and replayed.

namespace tera {
namespace {

using enum FaultKind;
namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kLiveRunScenario = R"(
name: live
seed: 5
duration_s: 60
settle_s: 0.2
terrain: {size_m: [14, 14], cell_m: 0.1, soil: dirt}
machines:
  - name: excavator1
    machine: tera:config/machines/tb235.yaml
    start: {yaw_deg: 30}
    operator: {type: idle}
    rig: {sensors: [
      {name: imu_boom, preset: tera:config/sensors/xsens_mti_670.yaml, link: boom, xyz_m: [1, 0, 0.3]},
      {name: camera, preset: tera:config/sensors/rgb_640.yaml, link: upper, xyz_m: [0.8, 0.3, 1.8], rpy_deg: [0, 30, 0], width_px: 64, height_px: 48, rate_hz: 5},
      {name: encoders, preset: tera:config/sensors/encoder.yaml}]}
  - name: excavator2
    machine: tera:config/machines/tb235.yaml
    start: {xy_m: [-5, 3], yaw_deg: -70}
    operator: {type: dig_cycle, reach_m: 4.0}
)";

struct Loaded {
  std::shared_ptr<const Scenario> scenario;
  std::string yaml;
};

/// Read once for all runs.
const Loaded& Load() {
  static const Loaded loaded = [] {
    const Config config = Config::FromText(kLiveRunScenario, "live.yaml");
    auto scenario = std::make_shared<const Scenario>(ReadScenario(config.root()));
    config.Finish();
    return Loaded{std::move(scenario), config.ResolvedYaml()};
  }();
  return loaded;
}

/// Levers of a TB235: left and right track, slew, swing, boom, arm, bucket, blade.
ControlMessage Levers(const std::map<std::string, double>& positions, const MachineModel& model) {
  ControlMessage::Levers levers;
  levers.position.assign(model.levers.size(), 0.0);
  for (const auto& [name, u] : positions) levers.position[model.LeverIndex(name)] = u;
  return {.command = levers};
}

std::map<std::string, std::string> ReadLiveRun(const fs::path& root) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    if (!entry.is_regular_file()) continue;
    std::ifstream stream(entry.path(), std::ios::binary);
    std::stringstream bytes;
    bytes << stream.rdbuf();
    files[entry.path().lexically_relative(root).generic_string()] = bytes.str();
  }
  return files;
}

/// Counts the measurements of each channel.
class CountingSink : public MeasurementSink {
 public:
  ChannelId AddChannel(const ChannelInfo& info) override {
    names.push_back(info.path);
    return static_cast<ChannelId>(names.size()) - 1;
  }
  void Write(ChannelId channel, Measurement) override { ++count[names[channel]]; }
  bool NeedsFrame(ChannelId, TimeNs, TimeNs) const override { return wants_frames; }
  void MarkPresent(ChannelId channel, TimeNs) override { ++skipped[names[channel]]; }

  bool wants_frames = true;
  std::vector<std::string> names;
  std::map<std::string, int> count, skipped;
};

TEST(LiveRun, ObeysLeversUntilTheyAreASecondOldAndThenStands) {
  LiveRun run(Load().scenario, "", {}, {});
  const MachineModel& model = run.scenario().machines[0].placement.model;
  const int slew = model.JointIndex("slew");
  const auto rate_radps = [&] { return run.simulation().state().machines[0].qd_radps[slew]; };
  run.Command(0, Levers({{"slew", 0.5}}, model));
  for (int i = 0; i < 490; ++i) run.Step();
  // Half of 9 rpm.
  EXPECT_NEAR(rate_radps(), 0.5 * 9 * 2 * M_PI / 60, 0.01);
  EXPECT_EQ(run.simulation().state().machines[0].levers[model.LeverIndex("slew")], 0.5);
  for (int i = 0; i < 20; ++i) run.Step();
  EXPECT_EQ(run.simulation().state().machines[0].levers[model.LeverIndex("slew")], 0.0);
  for (int i = 0; i < 1000; ++i) run.Step();
  EXPECT_NEAR(rate_radps(), 0, 0.01);
}

TEST(LiveRun, LeavesAMachineToItsOwnOperatorUntilItsFirstMessage) {
  LiveRun run(Load().scenario, "", {}, {});
  const MachineModel& model = run.scenario().machines[1].placement.model;
  const auto moves = [&] {
    const auto& levers = run.simulation().state().machines[1].levers;
    return std::any_of(levers.begin(), levers.end(), [](double u) { return u != 0; });
  };
  for (int i = 0; i < 50; ++i) run.Step();
  EXPECT_TRUE(moves());
  ControlMessage stop = Levers({}, model);
  stop.enable = false;
  run.Command(1, stop);
  run.Step();
  EXPECT_FALSE(moves());
}

TEST(LiveRun, SendsEverythingToEverySink) {
  CountingSink a, b;
  b.wants_frames = false;
  {
    LiveRun run(Load().scenario, "", {}, {&a, &b});
    for (int i = 0; i < 250; ++i) run.Step();
    run.Finish();
  }
  EXPECT_EQ(a.count, b.count);
  EXPECT_EQ(a.count["excavator1/camera"], 3);  // at 0, 0.2 and 0.4 s
  EXPECT_EQ(a.count["truth/excavator1/joints.csv"], 251);
  EXPECT_EQ(a.count["excavator2/commands.csv"], 251);  // with the levers in force at the end
}

TEST(LiveRun, TakesNoPictureThatNobodyWants) {
  CountingSink sink;
  sink.wants_frames = false;
  LiveRun run(Load().scenario, "", {}, {&sink});
  for (int i = 0; i < 250; ++i) run.Step();
  EXPECT_EQ(sink.count.count("excavator1/camera"), 0u);
  EXPECT_EQ(sink.skipped["excavator1/camera"], 3);
}

TEST(LiveRun, IsReplayedFromItsCommandsToTheSameBytes) {
  const fs::path live = OwnFolder() / "live", again = OwnFolder() / "again";
  const Loaded& loaded = Load();
  {
    LiveRun run(loaded.scenario, loaded.yaml, {.record = live}, {});
    const MachineModel& model = run.scenario().machines[0].placement.model;
    for (int i = 0; i < 600; ++i) {
      if (i == 37) run.Command(0, Levers({{"boom", -0.7}, {"left_track", 1.0 / 3}}, model));
      if (i == 311)
        run.Command(
            0, {.command = ControlMessage::JointPositions{{0, 0, 0.3, 0, 0.5, -1.5, -0.2, 0.1}}});
      run.Step();
    }
    run.Finish();
  }
  Scenario replayed = *loaded.scenario;
  CommandAsRecorded(Recording(live), &replayed);
  Generate(replayed, loaded.yaml, {.out = again});
  const auto first = ReadLiveRun(live), second = ReadLiveRun(again);
  ASSERT_EQ(first.size(), second.size());
  EXPECT_TRUE(first.contains("excavator1/camera/rgb/1000000000.png"));
  for (const auto& [name, bytes] : first) {
    ASSERT_TRUE(second.contains(name)) << name;
    EXPECT_TRUE(second.at(name) == bytes) << name << " differs";
  }
}

/// `steps` steps with one lever of the first machine, into `folder`; complete only if `finish`.
void Record(const fs::path& folder, int steps, bool finish) {
  const Loaded& loaded = Load();
  LiveRun run(loaded.scenario, loaded.yaml, {.record = folder}, {});
  const MachineModel& model = run.scenario().machines[0].placement.model;
  for (int i = 0; i < steps; ++i) {
    if (i % 200 == 37) run.Command(0, Levers({{"boom", -0.7 + i * 1e-3}}, model));
    run.Step();
  }
  if (finish) run.Finish();
}

TEST(LiveRun, ThatWasStoppedIsReplayedAsFarAsItsCommandsCame) {
  const fs::path folder = OwnFolder() / "of_stopped";
  Record(folder / "stopped", 640, false);
  const fs::path stopped = folder / "stopped.incomplete";
  ASSERT_TRUE(WasStopped(stopped));
  EXPECT_THAT(ReadLiveRun(stopped)["INCOMPLETE.txt"],
              AllOf(HasSubstr("tera replay"), Not(HasSubstr("--resume"))));
  const Loaded& loaded = Load();
  EXPECT_THAT(
      [&] { Generate(*loaded.scenario, loaded.yaml, {.out = folder / "stopped", .resume = true}); },
      ThrowsFault(kUnwritable, "stopped.incomplete"));
  // State after a kill in the middle of a row.
  const fs::path commands = stopped / "excavator1/commands.csv.part";
  fs::resize_file(commands, fs::file_size(commands) - 3);

  Scenario as_commanded = *loaded.scenario;
  CommandAsFarAsRecorded(stopped, &as_commanded);
  // 640 rows. One is cut, and the last has the levers in force at the end.
  EXPECT_DOUBLE_EQ(as_commanded.duration_s, 638 / as_commanded.physics_rate_hz);
  Generate(as_commanded, loaded.yaml, {.out = folder / "replayed"});
  Record(folder / "whole", 638, true);
  const auto replayed = ReadLiveRun(folder / "replayed"), recorded = ReadLiveRun(stopped);
  EXPECT_TRUE(ReadLiveRun(folder / "whole") == replayed);
  for (const auto& [name, bytes] : replayed) {
    if (!name.ends_with(".csv") || name == "excavator1/commands.csv") continue;
    if (name == kEventsFile) continue;  // a stopped run has not written it
    ASSERT_TRUE(recorded.contains(name + ".part")) << name;
    EXPECT_TRUE(recorded.at(name + ".part").starts_with(bytes)) << name;
  }
}

TEST(LiveRun, ThatIsKilledHasItsCommandsOnTheDiskUpToASecond) {
  const Loaded& loaded = Load();
  const double rate_hz = loaded.scenario->physics_rate_hz;
  LiveRun run(loaded.scenario, loaded.yaml, {.record = OwnFolder() / "of_killed"}, {});
  for (int i = 0; i < 2.6 * rate_hz; ++i) run.Step();
  Scenario replayed = *loaded.scenario;
  CommandAsFarAsRecorded(OwnFolder() / "of_killed.incomplete", &replayed);
  EXPECT_GE(replayed.duration_s, 2);
}

TEST(LiveRun, ThatStoppedBeforeAnyCommandCannotBeReplayed) {
  const Loaded& loaded = Load();
  const LiveRun run(loaded.scenario, loaded.yaml, {.record = OwnFolder() / "of_early"}, {});
  Scenario replayed = *loaded.scenario;
  EXPECT_THROW(CommandAsFarAsRecorded(OwnFolder() / "of_early.incomplete", &replayed), InputError);
}

TEST(LiveRun, WhoseRecordingFailsSaysWhatIsKept) {
  const fs::path folder = OwnFolder() / "faulty";
  const Loaded& loaded = Load();
  LiveRun run(loaded.scenario, loaded.yaml, {.record = folder}, {});
  fs::remove_all(folder.string() + ".incomplete/excavator1/camera");
  try {
    for (int i = 0; i < 1000; ++i) run.Step();
    FAIL() << "pictures have no place, but were written";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("kept in " + folder.string() + ".incomplete"),
                                    HasSubstr("tera replay"), Not(HasSubstr("--resume"))));
  }
}

TEST(LiveRun, ThatCannotBeginLeavesNoRecordingBehind) {
  const Loaded& loaded = Load();
  LiveOptions options{.record = OwnFolder() / "none"};
  options.egl.device = 99;  // beyond the number of devices
  EXPECT_THROW(LiveRun(loaded.scenario, loaded.yaml, options, {}), InputError);
  EXPECT_FALSE(fs::exists(OwnFolder() / "none"));
  EXPECT_FALSE(fs::exists(OwnFolder() / "none.incomplete"));
}

TEST(Replay, RefusesARecordingOfOtherMachines) {
  const fs::path live = OwnFolder() / "of_two";
  const Loaded& loaded = Load();
  {
    LiveRun run(loaded.scenario, loaded.yaml, {.record = live}, {});
    run.Step();
    run.Finish();
  }
  Scenario other = *loaded.scenario;
  other.machines[1].placement.name = "excavator3";
  EXPECT_THROW(CommandAsRecorded(Recording(live), &other), InputError);
  other = *loaded.scenario;
  other.machines[1].placement.model.levers.pop_back();
  EXPECT_THROW(CommandAsRecorded(Recording(live), &other), InputError);
}

}  // namespace
}  // namespace tera
