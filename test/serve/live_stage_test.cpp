#include "serve/live_stage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <set>

#include "core/config.h"
#include "core/error.h"
#include "own_folder.h"
#include "serve/session.h"

// Requests acted upon: what they do to a simulation, what is told of it, and what is refused. No
// socket and no camera.

namespace tera {
namespace {

using testing::AllOf;
using testing::HasSubstr;
namespace fs = std::filesystem;

constexpr const char* kScenario = R"(
name: stage
seed: 5
duration_s: 2
settle_s: 0.2
terrain: {size_m: [16, 16], cell_m: 0.1, soil: dirt, relief: {amplitude_m: 0.1, wavelength_m: 5}}
machines:
  - name: digger
    machine: tera:config/machines/tb235.yaml
    start: {xy_m: [1, -2], yaw_deg: 30, joints_deg: {boom: 40, arm: -95, bucket: -20}}
    operator: {type: idle}
    rig: {sensors: [
      {name: imu, preset: tera:config/sensors/xsens_mti_670.yaml, link: boom, xyz_m: [1, 0, 0.3], rate_hz: 100},
      {name: gnss, preset: tera:config/sensors/rtk_f9p.yaml, link: upper, xyz_m: [-0.9, 0.5, 1.2], rate_hz: 10},
      {name: lidar, preset: tera:config/sensors/vlp16.yaml, link: upper, xyz_m: [0, 0.3, 2.1], columns: 64, rate_hz: 10},
      {name: encoders, preset: tera:config/sensors/encoder.yaml, rate_hz: 50}]}
  - name: rover
    machine: tera:config/machines/warthog.yaml
    start: {xy_m: [-5, 4], yaw_deg: -70}
    operator: {type: idle}
    rig: {sensors: [{name: imu, preset: tera:config/sensors/xsens_mti_670.yaml, link: chassis}]}
)";

SeededScenario Source(std::optional<std::uint64_t> seed) {
  std::vector<std::string> overrides;
  if (seed) overrides.push_back("seed=" + std::to_string(*seed));
  const Config config = Config::FromText(kScenario, "stage.yaml", overrides);
  SeededScenario seeded{.scenario = ReadScenario(config.root()), .resolved_yaml = {}};
  config.Finish();
  seeded.resolved_yaml = config.ResolvedYaml();
  return seeded;
}

std::unique_ptr<Stage> NewStage(
    const StageOptions& options = {}, std::function<bool()> ended = [] { return false; }) {
  return LiveStages(Source(std::nullopt).scenario, Source, options,
                    [](const std::string&) {})(std::move(ended));
}

v1::Step StepOf(std::uint32_t physics_steps) {
  v1::Step step;
  step.set_physics_steps(physics_steps);
  return step;
}

/// Index of a machine's lever of that name.
int LeverOf(const v1::Machine& machine, const std::string& name) {
  for (int k = 0; k < machine.levers_size(); ++k) {
    if (machine.levers(k).name() == name) return k;
  }
  ADD_FAILURE() << "no lever " << name;
  return 0;
}

int JointOf(const v1::Machine& machine, const std::string& name) {
  for (int k = 0; k < machine.joints_size(); ++k) {
    if (machine.joints(k).name() == name) return k;
  }
  ADD_FAILURE() << "no joint " << name;
  return 0;
}

class LiveStageTest : public testing::Test {
 protected:
  v1::Observation Reset(std::uint64_t seed = 1) {
    v1::Reset reset;
    reset.set_seed(seed);
    return stage_->Reset(reset).value();
  }
  v1::Observation Step(const v1::Step& step) { return stage_->Step(step).value(); }
  void ExpectRefused(const v1::Step& step, const std::string& words) {
    try {
      stage_->Step(step);
      FAIL() << "done: " << step.ShortDebugString();
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(words));
    }
  }
  /// One lever of the digger at `position`, the others at rest.
  v1::Step Lever(const std::string& name, double position, std::uint32_t physics_steps) {
    v1::Step step = StepOf(physics_steps);
    v1::Action& action = *step.add_actions();
    action.set_machine("digger");
    for (int k = 0; k < digger_.levers_size(); ++k) action.mutable_levers()->add_position(0);
    action.mutable_levers()->set_position(LeverOf(digger_, name), position);
    return step;
  }
  double JointAt(const v1::Observation& observation, const std::string& name) const {
    return observation.machines(0).joint_position(JointOf(digger_, name));
  }

  std::unique_ptr<Stage> stage_ = NewStage();
  v1::Description description_ = stage_->Describe();
  v1::Machine digger_ = description_.machines(0);
};

TEST_F(LiveStageTest, DescribesTheScenario) {
  EXPECT_EQ(description_.scenario(), "stage");
  EXPECT_EQ(description_.seed(), 5u);
  EXPECT_EQ(description_.duration_s(), 2);
  EXPECT_EQ(description_.machines(1).name(), "rover");
  EXPECT_DOUBLE_EQ(description_.site().x_max_m() - description_.site().x_min_m(), 16);
  const v1::Joint& boom = digger_.joints(JointOf(digger_, "boom"));
  EXPECT_EQ(boom.type(), v1::Joint::REVOLUTE);
  EXPECT_LT(boom.lower(), boom.upper());
  EXPECT_EQ(boom.lever(), "boom");
  EXPECT_EQ(digger_.levers(LeverOf(digger_, "boom")).joint(), "boom");
  EXPECT_EQ(digger_.levers(LeverOf(digger_, "left_track")).gear(), "left_track");
  const v1::Sensor& lidar = digger_.sensors(2);
  EXPECT_EQ(lidar.type(), "lidar");
  EXPECT_EQ(lidar.link(), "upper");
  EXPECT_DOUBLE_EQ(lidar.x_bs().position_m().z(), 2.1);
  EXPECT_EQ(lidar.lidar().rings(), 16u);
  EXPECT_EQ(lidar.lidar().columns(), 64u);
  EXPECT_EQ(description_.semantic_classes(3).name(), "upper_structure");
}

TEST_F(LiveStageTest, ResetsToTheStartOfTheScenario) {
  const v1::Observation start = Reset();
  EXPECT_EQ(start.time_ns(), 0);
  EXPECT_EQ(start.machines_size(), 2);
  const v1::MachineState& digger = start.machines(0);
  EXPECT_EQ(digger.name(), "digger");
  EXPECT_NEAR(digger.x_wb().position_m().x(), 1, 0.05);
  EXPECT_NEAR(digger.x_wb().position_m().y(), -2, 0.05);
  // Half of 30 degrees about z.
  EXPECT_NEAR(digger.x_wb().rotation().w(), std::cos(M_PI / 12), 0.02);
  EXPECT_NEAR(digger.x_wb().rotation().z(), std::sin(M_PI / 12), 0.02);
  EXPECT_NEAR(JointAt(start, "boom"), 40 * M_PI / 180, 0.05);
}

TEST_F(LiveStageTest, StepsByPhysicsStepsOrBySeconds) {
  Reset();
  const double rate_hz = description_.physics_rate_hz();
  EXPECT_EQ(Step(StepOf(7)).time_ns(), std::llround(7e9 / rate_hz));
  v1::Step seconds;
  seconds.set_duration_s(0.1);
  EXPECT_EQ(Step(seconds).time_ns(), std::llround(1e9 * (7 / rate_hz + 0.1)));
  seconds.set_duration_s(1e-6);
  EXPECT_EQ(Step(seconds).time_ns(), std::llround(1e9 * (8 / rate_hz + 0.1)));
}

TEST_F(LiveStageTest, ALeverMovesItsJointForTheWholeOfALongStep) {
  const double before_rad = JointAt(Reset(), "boom");
  const v1::Observation after = Step(Lever("boom", -0.5, 250));
  const double half_second_rad = JointAt(after, "boom") - before_rad;
  EXPECT_LT(half_second_rad, -0.05);
  EXPECT_EQ(after.machines(0).lever(LeverOf(digger_, "boom")), -0.5);
  // Longer than a command lasts by itself.
  Reset();
  const v1::Observation late = Step(Lever("swing", 0.2, 800));
  EXPECT_EQ(late.machines(0).lever(LeverOf(digger_, "swing")), 0.2);
}

TEST_F(LiveStageTest, WhoIsNotNamedAnyMoreHoldsTheLeversNeutral) {
  Reset();
  Step(Lever("boom", -0.5, 50));
  EXPECT_EQ(Step(StepOf(1)).machines(0).lever(LeverOf(digger_, "boom")), 0.0);
}

TEST_F(LiveStageTest, AnActionWithoutACommandAndALockAreNeutral) {
  Reset();
  v1::Step step = Lever("boom", -0.5, 1);
  step.mutable_actions(0)->set_hydraulic_lock(true);
  EXPECT_EQ(Step(step).machines(0).lever(LeverOf(digger_, "boom")), 0.0);
  step.mutable_actions(0)->clear_hydraulic_lock();
  EXPECT_EQ(Step(step).machines(0).lever(LeverOf(digger_, "boom")), -0.5);
  step.mutable_actions(0)->clear_levers();
  EXPECT_EQ(Step(step).machines(0).lever(LeverOf(digger_, "boom")), 0.0);
}

TEST_F(LiveStageTest, JointRatesAndPositionsAreReached) {
  const v1::Observation start = Reset();
  v1::Step step = StepOf(500);
  v1::Action& action = *step.add_actions();
  action.set_machine("digger");
  for (const v1::Lever& lever : digger_.levers()) {
    action.mutable_joint_rates()->add_rate(lever.joint() == "arm" ? 0.15 : 0.0);
  }
  const v1::Observation turned = Step(step);
  EXPECT_NEAR(JointAt(turned, "arm") - JointAt(start, "arm"), 0.15, 0.03);
  for (const v1::Lever& lever : digger_.levers()) {
    const double at = lever.joint().empty() ? 0 : JointAt(turned, lever.joint());
    action.mutable_joint_positions()->add_position(lever.joint() == "arm" ? at - 0.2 : at);
  }
  step.set_physics_steps(1500);
  EXPECT_NEAR(JointAt(Step(step), "arm"), JointAt(turned, "arm") - 0.2, 0.02);
}

TEST_F(LiveStageTest, TheSameSeedGivesTheSameBytesAndAnotherOtherNoise) {
  const auto whole = [&](std::uint64_t seed) {
    v1::Reset reset;
    reset.set_seed(seed);
    stage_->Reset(reset);
    v1::Step step = Lever("boom", -0.3, 60);
    for (const char* sensor : {"imu", "gnss", "lidar", "encoders"}) {
      v1::SensorSelection& selection = *step.mutable_observe()->add_sensors();
      selection.set_machine("digger");
      selection.set_sensor(sensor);
    }
    return Step(step).SerializeAsString();
  };
  const std::string first = whole(1);
  EXPECT_TRUE(whole(1) == first);
  EXPECT_FALSE(whole(2) == first);
}

TEST_F(LiveStageTest, GivesTheSamplesOfTheStepOfThoseSensorsThatWereAskedFor) {
  v1::Reset reset;
  v1::SensorSelection imu, gnss, lidar;
  imu.set_machine("digger");
  imu.set_sensor("imu");
  gnss.set_machine("digger");
  gnss.set_sensor("gnss");
  lidar.set_machine("digger");
  lidar.set_sensor("lidar");
  *reset.mutable_observe()->add_sensors() = gnss;
  const v1::Observation start = stage_->Reset(reset).value();
  ASSERT_EQ(start.samples_size(), 1);
  EXPECT_EQ(start.samples(0).gnss_size(), 1);  // due at t = 0

  v1::Step step = StepOf(200);  // 0.4 s
  *step.mutable_observe()->add_sensors() = lidar;
  *step.mutable_observe()->add_sensors() = imu;
  *step.mutable_observe()->add_sensors() = gnss;
  v1::Observation observation = Step(step);
  ASSERT_EQ(observation.samples_size(), 3);
  EXPECT_EQ(observation.samples(0).sensor(), "lidar");
  EXPECT_EQ(observation.samples(0).lidar_size(), 4);
  EXPECT_EQ(observation.samples(1).imu_size(), 39);  // the 40th is known a physics step later
  EXPECT_EQ(observation.samples(2).gnss_size(), 4);
  EXPECT_EQ(observation.samples(2).gnss(3).time_ns(), 400'000'000);
  const v1::LidarScan& scan = observation.samples(0).lidar(0);
  ASSERT_GT(scan.points(), 100u);
  EXPECT_EQ(scan.xyz_s_m().size(), 12 * scan.points());
  EXPECT_EQ(scan.instance().size(), 2 * scan.points());

  step.mutable_observe()->mutable_sensors(0)->set_latest_only(true);
  observation = Step(step);
  EXPECT_EQ(observation.samples(0).lidar_size(), 1);
  EXPECT_EQ(observation.samples(0).lidar(0).time_ns(), 700'000'000);
  EXPECT_EQ(observation.samples(1).imu_size(), 40);
  EXPECT_EQ(Step(StepOf(200)).samples_size(), 0);
}

TEST_F(LiveStageTest, ATerrainPatchIsTheGroundAroundTheMachine) {
  v1::Reset reset;
  v1::PatchSelection& around = *reset.mutable_observe()->add_patches();
  around.set_machine("digger");
  around.set_size_m(4);
  around.set_resolution_m(0.5);
  v1::PatchSelection& tool = *reset.mutable_observe()->add_patches();
  tool = around;
  tool.set_shovel("bucket");
  const v1::Observation start = stage_->Reset(reset).value();
  ASSERT_EQ(start.patches_size(), 2);
  const v1::TerrainPatch& patch = start.patches(0);
  ASSERT_EQ(patch.n(), 9u);
  EXPECT_NEAR(patch.yaw_rad(), M_PI / 6, 0.02);
  EXPECT_NEAR(patch.centre_w_m().x(), 1, 0.05);
  std::vector<float> height_m(81);
  ASSERT_EQ(patch.height_m().size(), 81 * sizeof(float));
  std::memcpy(height_m.data(), patch.height_m().data(), patch.height_m().size());
  // Vertex (7, 2): 1.5 m ahead and 1 m to the right of the machine.
  const Scenario scenario = Source(std::nullopt).scenario;
  const Vec2 p_W_m = Vec2(patch.centre_w_m().x(), patch.centre_w_m().y()) +
                     Eigen::Rotation2Dd(patch.yaw_rad()) * Vec2(1.5, -1.0);
  EXPECT_NEAR(height_m[2 * 9 + 7] + patch.centre_w_m().z(),
              scenario.soil->surface().HeightAt(p_W_m.x(), p_W_m.y()), 0.01);
  // The bucket hangs ahead of the machine, above the ground.
  const v1::Vector3& edge = start.patches(1).centre_w_m();
  EXPECT_GT(std::hypot(edge.x() - 1, edge.y() + 2), 1.5);
  std::memcpy(height_m.data(), start.patches(1).height_m().data(), 81 * sizeof(float));
  EXPECT_LT(height_m[40], 0);
}

TEST_F(LiveStageTest, RefusesWhatCannotBeDoneAndChangesNothing) {
  Reset();
  ExpectRefused(StepOf(0), "at least one physics step");
  ExpectRefused(v1::Step(), "at least one physics step");
  v1::Step step;
  step.set_duration_s(-1);
  ExpectRefused(step, "a step of -1 s");
  step.set_duration_s(std::nan(""));
  ExpectRefused(step, "a step of nan s");
  step.set_duration_s(1e9);
  ExpectRefused(step, "at most 3600 s");
  step = Lever("boom", 1.5, 1);
  ExpectRefused(step, "lever 'boom' is 1.5, need -1 to 1");
  step = Lever("boom", std::nan(""), 1);
  ExpectRefused(step, "need a finite number");
  step = Lever("boom", 1, 1);
  step.mutable_actions(0)->mutable_levers()->add_position(0);
  ExpectRefused(step, "one for each lever");
  step = Lever("boom", 1, 1);
  *step.add_actions() = step.actions(0);
  ExpectRefused(step, "two actions in one step");
  step.mutable_actions(1)->set_machine("crane");
  ExpectRefused(step, "no machine named 'crane'; need one of: digger, rover");
  step = StepOf(1);
  step.add_actions()->set_machine("digger");
  step.mutable_actions(0)->mutable_tool_pose()->set_frame("nose");
  ExpectRefused(step, "no frame 'nose'");
  v1::ToolPose& pose = *step.mutable_actions(0)->mutable_tool_pose();
  pose.set_frame("bucket_tip");
  pose.mutable_rotation_b();  // all 0, as an empty message is
  ExpectRefused(step, "the quaternion of tool frame 'bucket_tip' has length 0, need 1");
  pose.mutable_rotation_b()->set_w(5);
  ExpectRefused(step, "has length 5, need 1");
  EXPECT_EQ(Step(StepOf(1)).time_ns(), 2'000'000);
}

TEST_F(LiveStageTest, RefusesObservationsThatCannotBeMade) {
  Reset();
  const auto with = [](const std::string& sensor) {
    v1::Step step = StepOf(1);
    v1::SensorSelection& selection = *step.mutable_observe()->add_sensors();
    selection.set_machine("digger");
    selection.set_sensor(sensor);
    return step;
  };
  ExpectRefused(
      with("radar"),
      "no sensor of machine 'digger' named 'radar'; need one of: imu, gnss, lidar, encoders");
  v1::Step step = with("imu");
  *step.mutable_observe()->add_sensors() = step.observe().sensors(0);
  ExpectRefused(step, "'digger/imu' is asked for twice");
  step = with("lidar");
  step.clear_physics_steps();
  step.set_duration_s(3000);
  ExpectRefused(step, "MB; ask for the latest pictures and scans alone, fewer patches");
  const auto patch = [](double size_m, double resolution_m, const std::string& shovel) {
    v1::Step with_patch = StepOf(1);
    v1::PatchSelection& selection = *with_patch.mutable_observe()->add_patches();
    selection.set_machine("digger");
    selection.set_size_m(size_m);
    selection.set_resolution_m(resolution_m);
    selection.set_shovel(shovel);
    return with_patch;
  };
  ExpectRefused(patch(0, 0.1, ""), "terrain patch of 0 m");
  ExpectRefused(patch(std::nan(""), 0.1, ""), "terrain patch of nan m");
  ExpectRefused(patch(1000, 1, ""), "at most 200 m");
  ExpectRefused(patch(4, 0, ""), "resolution of 0 m");
  ExpectRefused(patch(4, 5, ""), "resolution of 5 m");
  ExpectRefused(patch(100, 0.01, ""), "at most 1024 vertices");
  ExpectRefused(patch(4, 0.1, "spoon"), "named 'spoon'; need one of: bucket");
  // 4 MiB each; a request for them is small.
  v1::Step many = patch(102.3, 0.1, "");
  for (int i = 1; i < 100; ++i) {
    *many.mutable_observe()->add_patches() = many.observe().patches(0);
  }
  ExpectRefused(many, "fewer patches");
  EXPECT_EQ(Step(StepOf(1)).time_ns(), 2'000'000);
}

TEST(LiveStages, LeavesALongStepWhenTheSessionHasEnded) {
  int asked = 0;
  const std::unique_ptr<Stage> stage = NewStage({}, [&] { return ++asked > 100; });
  stage->Reset(v1::Reset());
  EXPECT_FALSE(stage->Step(StepOf(100000)).has_value());
  EXPECT_EQ(asked, 101);
}

TEST(LiveStages, RecordsEveryEpisodeAsADataset) {
  const fs::path folder = OwnFolder() / "episodes";
  const auto names = [&] {
    std::set<std::string> found;
    for (const auto& entry : fs::directory_iterator(folder)) {
      found.insert(entry.path().filename());
    }
    return found;
  };
  const StageOptions options{.record = folder};
  {
    const std::unique_ptr<Stage> stage = NewStage(options);
    stage->Reset(v1::Reset());
    stage->Step(StepOf(50));
    stage->Reset(v1::Reset());
    EXPECT_TRUE(fs::exists(folder / "episode_0001" / "digger" / "commands.csv"));
    stage->Step(StepOf(20));
  }
  EXPECT_EQ(names(), (std::set<std::string>{"episode_0001", "episode_0002"}));
  {
    const std::unique_ptr<Stage> next_session = NewStage(options);
    next_session->Reset(v1::Reset());
  }
  EXPECT_TRUE(names().contains("episode_0003"));
}

TEST(LiveStages, AnEpisodeThatCannotBeRecordedIsRefused) {
  const fs::path file = OwnFolder() / "file";
  std::fclose(std::fopen(file.c_str(), "w"));
  const StageOptions options{.record = file};
  EXPECT_THROW(NewStage(options)->Reset(v1::Reset()), InputError);
}

}  // namespace
}  // namespace tera
