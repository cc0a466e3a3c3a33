#include <cmath>
#include <cstring>
#include <vector>

#include "serve/live_stage_fixture.h"
#include "serve/sample_keeper.h"
#include "sim/run/live_run.h"

// Observations of a simulation: description, state, samples, patches of ground.

namespace tera {
namespace {

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
  EXPECT_EQ(observation.samples(1).imu_size(), 39);  // the 40th is available a physics step later
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

TEST(LiveStage, TheLatestFrameOfASensorComesWhateverItsClockSays) {
  for (const double offset_s : {-0.5, 0.5, 18.0}) {
    const auto late = [&](std::optional<std::uint64_t>) {
      const std::string effects =
          "effects: {digger: {lidar: {clock_offset: {offset_s: " + std::to_string(offset_s) +
          "}}}}\n";
      const Config config = Config::FromText(std::string(kStageScenario) + effects, "stage.yaml");
      auto scenario = std::make_shared<const Scenario>(ReadScenario(config.root()));
      config.Finish();
      return SeededScenario{std::move(scenario), {}};
    };
    const std::unique_ptr<Stage> stage = LiveStages(
        *late(std::nullopt).scenario, late, {}, [](const std::string&) {})([] { return false; });
    stage->Reset(v1::Reset());
    v1::Step step = StepOf(200);  // 0.4 s: revolutions begin at 0, 0.1, 0.2 and 0.3 s
    v1::SensorSelection& lidar = *step.mutable_observe()->add_sensors();
    lidar.set_machine("digger");
    lidar.set_sensor("lidar");
    lidar.set_latest_only(true);
    const v1::Observation observation = stage->Step(step).value();
    ASSERT_EQ(observation.samples(0).lidar_size(), 1) << offset_s;
    EXPECT_EQ(observation.samples(0).lidar(0).time_ns(), FromSeconds(0.3 + offset_s));
  }
}

/// Counts the scans measured for it.
class CountingKeeper : public SampleKeeper {
 public:
  void Write(ChannelId channel, Measurement measurement) override {
    scans += std::holds_alternative<LidarScan>(measurement) ? 1 : 0;
    SampleKeeper::Write(channel, std::move(measurement));
  }
  int scans = 0;
};

TEST(SampleKeeper, OfTheLatestFrameAloneNoOtherIsMeasured) {
  for (const int rate_hz : {10, 30}) {
    std::string text = kStageScenario;
    const std::string rate = "columns: 64, rate_hz: ";
    text.replace(text.find(rate), rate.size() + 2, rate + std::to_string(rate_hz));
    const Config config = Config::FromText(text, "stage.yaml");
    CountingKeeper keeper;
    LiveRun run(std::make_shared<const Scenario>(ReadScenario(config.root())), "", {}, {&keeper});
    const SampleClock clock{.rate_hz = static_cast<double>(rate_hz)};
    TimeNs end_ns = 0;
    // Steps that end with a revolution, and one in between.
    for (const double end_s : {0.4, 0.8, 1.15}) {
      end_ns = FromSeconds(end_s);
      keeper.scans = 0;
      keeper.Keep({{"digger", "lidar", true}}, end_ns);
      while (run.simulation().state().t_ns < end_ns) run.Step();
      ASSERT_EQ(run.simulation().state().t_ns, end_ns);
      EXPECT_EQ(keeper.scans, 1) << rate_hz << " Hz, until " << end_s << " s";
      v1::Observation observation;
      keeper.Take(&observation);
      ASSERT_EQ(observation.samples(0).lidar_size(), 1);
      const auto last = static_cast<std::int64_t>(std::floor(end_s * rate_hz + 1e-9)) - 1;
      EXPECT_EQ(observation.samples(0).lidar(0).time_ns(), clock.Due(last));
    }
  }
}

TEST(LiveStage, ASensorWithoutAMessageOfItsOwnSendsRowsOfItsColumns) {
  const auto with_tilt = [](std::optional<std::uint64_t>) {
    std::string text = kStageScenario;
    const std::string before = "rig: {sensors: [\n";
    text.insert(text.find(before) + before.size(),
                "      {name: tilt, type: inclinometer, link: boom, rate_hz: 50},\n");
    const Config config = Config::FromText(text, "stage.yaml");
    SeededScenario seeded{.scenario = std::make_shared<const Scenario>(ReadScenario(config.root())),
                          .resolved_yaml = {}};
    config.Finish();
    return seeded;
  };
  const std::unique_ptr<Stage> stage = LiveStages(*with_tilt(std::nullopt).scenario, with_tilt, {},
                                                  [](const std::string&) {})([] { return false; });
  const v1::Sensor sensor = stage->Describe(0).machines(0).sensors(0);
  EXPECT_EQ(sensor.type(), "inclinometer");
  ASSERT_EQ(sensor.columns_size(), 2);
  EXPECT_EQ(sensor.columns(0), "tilt_rad");
  stage->Reset(v1::Reset());
  v1::Step step = StepOf(200);  // 0.4 s
  v1::SensorSelection& tilt = *step.mutable_observe()->add_sensors();
  tilt.set_machine("digger");
  tilt.set_sensor("tilt");
  const v1::Observation observation = stage->Step(step).value();
  // The 20th is available a physics step later.
  ASSERT_EQ(observation.samples(0).row_size(), 19);
  const v1::RowSample& row = observation.samples(0).row(18);
  EXPECT_EQ(row.time_ns(), 380'000'000);
  ASSERT_EQ(row.value_size(), 2);
  // The boom stands 40 deg up, on ground that slopes by some degrees.
  EXPECT_NEAR(row.value(0), -40 * M_PI / 180, 10 * M_PI / 180);
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
  const std::shared_ptr<const Scenario> scenario = Source(std::nullopt).scenario;
  const Vec2 p_W_m = Vec2(patch.centre_w_m().x(), patch.centre_w_m().y()) +
                     Eigen::Rotation2Dd(patch.yaw_rad()) * Vec2(1.5, -1.0);
  EXPECT_NEAR(height_m[2 * 9 + 7] + patch.centre_w_m().z(),
              scenario->site->surface().HeightAt(p_W_m.x(), p_W_m.y()), 0.01);
  // The bucket hangs ahead of the machine, above the ground.
  const v1::Vector3& edge = start.patches(1).centre_w_m();
  EXPECT_GT(std::hypot(edge.x() - 1, edge.y() + 2), 1.5);
  std::memcpy(height_m.data(), start.patches(1).height_m().data(), 81 * sizeof(float));
  EXPECT_LT(height_m[40], 0);
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

}  // namespace
}  // namespace tera
