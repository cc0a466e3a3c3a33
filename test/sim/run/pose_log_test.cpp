#include "sim/run/pose_log.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "core/config/config.h"
#include "core/error.h"
#include "core/units.h"
#include "sim/simulation.h"

namespace tera {
namespace {

constexpr char kScene[] = R"(
name: scene
duration_s: 1
settle_s: 0.1
physics_rate_hz: 200
terrain: {size_m: [14, 14], cell_m: 0.1, soil: dirt}
machines:
  - name: excavator1
    machine: tera:config/machines/tb235.yaml
    start: {xy_m: [1, -2], yaw_deg: 20}
    operator: {type: random_levers, amplitude: 0.8}
    rig: {sensors: [
      {name: imu, preset: tera:config/sensors/xsens_mti_670.yaml, link: boom, xyz_m: [1, 0, 0.3]},
      {name: lidar, preset: tera:config/sensors/vlp16.yaml, link: upper, xyz_m: [0, 0.3, 2.1]},
      {name: encoders, preset: tera:config/sensors/encoder.yaml}]}
effects: {excavator1: {lidar: {extrinsic: {x_m: 0.1, yaw_deg: 2}}}}
obstacles:
  - {name: rock1, preset: tera:config/obstacles/rock.yaml, xy_m: [5, 1]}
  - {name: person1, preset: tera:config/obstacles/person.yaml, xy_m: [4, 3],
     path: [{t_s: 0, xy_m: [4, 3]}, {t_s: 1, xy_m: [3, 2]}]}
)";

/// Keeps the rows of each channel by its file.
class RowsByFile : public MeasurementSink {
 public:
  ChannelId AddChannel(const ChannelInfo& info) override {
    files_.push_back(info.path);
    rows[info.path];
    return static_cast<ChannelId>(files_.size()) - 1;
  }
  void Write(ChannelId channel, Measurement measurement) override {
    rows[files_[channel]].push_back(std::get<RowSample>(std::move(measurement)));
  }
  bool NeedsFrame(ChannelId, TimeNs, TimeNs) const override { return true; }
  void MarkPresent(ChannelId, TimeNs) override {}

  std::map<std::string, std::vector<RowSample>> rows;

 private:
  std::vector<std::string> files_;
};

Scenario ReadPoseLog(const std::string& record) {
  const Config config = Config::FromText(kScene + record, "scene.yaml");
  Scenario scenario = ReadScenario(config.root());
  config.Finish();
  return scenario;
}

Pose PoseOf(const RowSample& row) {
  const std::vector<double>& v = row.values;
  Pose X = Pose::Identity();
  X.translation() = Vec3(v[0], v[1], v[2]);
  X.linear() = Quat(v[3], v[4], v[5], v[6]).toRotationMatrix();
  return X;
}

/// A second at 200 steps/s: the pose at each step, and the log.
struct Second {
  explicit Second(const std::string& record) : scenario(ReadPoseLog(record)) {
    PoseLog log(scenario, &sink);
    Simulation simulation(scenario);
    instants.push_back(simulation.state());
    log.WriteStart(simulation.state());
    for (int k = 0; k < 200; ++k) {
      simulation.Step();
      instants.push_back(simulation.state());
      log.Write(simulation.previous(), simulation.state());
    }
  }
  const MachineModel& model() const { return scenario.machines[0].placement.model; }
  const std::vector<RowSample>& of(const std::string& file) const { return sink.rows.at(file); }

  const Scenario scenario;
  RowsByFile sink;
  std::vector<Instant> instants;
};

TEST(PoseLog, WritesNothingUnlessItIsAskedFor) {
  EXPECT_TRUE(Second("").sink.rows.empty());
  EXPECT_TRUE(Second("record: {every_s: 1}").sink.rows.empty());
}

TEST(PoseLog, OfADynamicObstacleIsWrittenUnasked) {
  const Second second("  - {name: cone1, preset: tera:config/obstacles/cone.yaml, xy_m: [3, 4]}\n");
  EXPECT_EQ(second.of("truth/cone1/pose.csv").size(), 51u);
  EXPECT_EQ(second.sink.rows.size(), 1u);
}

TEST(PoseLog, ARateOutOfRangeIsAFaultWithItsPlace) {
  for (const std::string rate : {"0", "-5", "10000", "often"}) {
    try {
      ReadPoseLog("record: {poses_hz: " + rate + "}");
      ADD_FAILURE() << rate;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("record.poses_hz"), std::string::npos)
          << error.what();
    }
  }
}

TEST(PoseLog, OfALinkIsThatOfTheSimulation) {
  const Second second("record: {poses_hz: 50}");
  for (const char* link : {"undercarriage", "boom", "bucket"}) {
    const auto& rows = second.of(std::string("truth/excavator1/links/") + link + ".csv");
    ASSERT_EQ(rows.size(), 51u);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      EXPECT_EQ(rows[k].t_ns, static_cast<TimeNs>(k) * 20'000'000);
      const Pose& X_WB =
          second.instants[4 * k].machines[0].links[second.model().LinkIndex(link)].X_WB;
      EXPECT_TRUE(PoseOf(rows[k]).isApprox(X_WB, 1e-12)) << link << " " << k;
    }
  }
}

TEST(PoseLog, OfASensorIsThatOfItsLinkAndItsMount) {
  const Second second("record: {poses_hz: 50}");
  const auto& boom = second.of("truth/excavator1/links/boom.csv");
  const auto& imu = second.of("truth/excavator1/sensors/imu.csv");
  ASSERT_EQ(imu.size(), boom.size());
  for (std::size_t k = 0; k < imu.size(); ++k) {
    const Pose X_BS = PoseOf(boom[k]).inverse() * PoseOf(imu[k]);
    EXPECT_LT((X_BS.translation() - Vec3(1, 0, 0.3)).norm(), 1e-9);
    EXPECT_TRUE(X_BS.linear().isIdentity(1e-9));
  }
  EXPECT_FALSE(second.sink.rows.contains("truth/excavator1/sensors/imu.documented.csv"));
  EXPECT_FALSE(second.sink.rows.contains("truth/excavator1/sensors/encoders.csv"));
}

TEST(PoseLog, TellsWhereASensorIsAndWhereItIsDocumented) {
  const Second second("record: {poses_hz: 50}");
  const auto& is = second.of("truth/excavator1/sensors/lidar.csv");
  const auto& documented = second.of("truth/excavator1/sensors/lidar.documented.csv");
  ASSERT_EQ(is.size(), documented.size());
  for (std::size_t k = 0; k < is.size(); ++k) {
    const Pose X_SdS = PoseOf(documented[k]).inverse() * PoseOf(is[k]);
    EXPECT_LT((X_SdS.translation() - Vec3(0.1, 0, 0)).norm(), 1e-9);
    EXPECT_NEAR(Eigen::AngleAxisd(X_SdS.linear()).angle(), 2 * kDeg, 1e-9);
  }
}

TEST(PoseLog, OfAnObstacleThatMovesFollowsItsPath) {
  const Second second("record: {poses_hz: 30}");
  EXPECT_FALSE(second.sink.rows.contains("truth/rock1/pose.csv"));
  const auto& rows = second.of("truth/person1/pose.csv");
  ASSERT_EQ(rows.size(), 31u);
  for (const RowSample& row : rows) {
    // Also between two steps, on a straight path at constant speed.
    const double s = ToSeconds(row.t_ns);
    EXPECT_NEAR(row.values[0], 4 - s, 1e-6) << s;
    EXPECT_NEAR(row.values[1], 3 - s, 1e-6) << s;
  }
}

TEST(PoseLog, AtARateBeyondTheStepsLiesOnTheWayBetweenThem) {
  const Second second("record: {poses_hz: 1000}");
  const auto& rows = second.of("truth/excavator1/links/bucket.csv");
  ASSERT_EQ(rows.size(), 1001u);
  for (std::size_t k = 2; k + 5 < rows.size(); k += 5) {
    const Vec3 before = PoseOf(rows[k - 2]).translation(),
               after = PoseOf(rows[k + 3]).translation();
    EXPECT_LT((PoseOf(rows[k]).translation() - (0.6 * before + 0.4 * after)).norm(), 1e-9) << k;
  }
}

}  // namespace
}  // namespace tera
