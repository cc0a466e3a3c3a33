#include "resimulate/scan_caster.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "dataset/format/sample_recording.h"
#include "resimulate/recorded_cart.h"

namespace tera {
namespace {

/// A wall through (8, 10) whose face looks back at the cart, turned by 25 deg from the x axis.
constexpr const char* kWall = R"(
obstacles:
  - {name: wall1, label: barrier, mesh: FOLDER/wall.obj, xy_m: [8, 10], yaw_deg: 25,
     collision: [{xyz_m: [0, 0.1, 3], size_m: [8, 0.2, 6]}]}
)";
const Vec3 kOnWall_W(8, 10, 0), kOutOfWall_W = RotationFromRpy(0, 0, 25 * kDeg) * -Vec3::UnitY();

/// The cart drives and turns, and its mast turns too.
Pose ScanCasterDriven(double t_s) {
  return MakePose(Vec3(2 + 1.5 * t_s, -1 + t_s, 0.3), RotationFromRpy(0.05, -0.1, 0.4 + 0.2 * t_s));
}
double ScanCasterTurned(double t_s) { return 0.3 - 0.5 * t_s; }

SensorDescription LidarOnMast() {
  SensorDescription sensor;
  sensor.name = "lidar";
  sensor.link = "mast";
  sensor.X_BS = MakePose(Vec3(0.3, -0.2, 0.9), RotationFromRpy(0.1, 0.15, 0.6));
  LidarModel lidar;
  lidar.min_range_m = 1;
  lidar.max_range_m = 30;
  sensor.model = lidar;
  return sensor;
}

SensorCalibration AsDocumented() { return {.X_BT = LidarOnMast().X_BS}; }

/// The sensor's place and attitude, by geometry alone.
Pose SensorAt(double t_s, const Pose& X_BT = LidarOnMast().X_BS) {
  const Pose X_BaseMast =
      MakePose(Vec3(0, 0, kMastHeight_m), RotationFromRpy(0, 0, ScanCasterTurned(t_s)));
  return ScanCasterDriven(t_s) * X_BaseMast * X_BT;
}

double RangeToPlane_m(const Pose& X_WS, const Vec3& d_S, const Vec3& on_plane_W,
                      const Vec3& normal_W) {
  return normal_W.dot(on_plane_W - X_WS.translation()) / normal_W.dot(X_WS.linear() * d_S);
}

/// Direction of a point in S.
Vec3 Towards(const Vec3& p_W, double t_s) { return (SensorAt(t_s).inverse() * p_W).normalized(); }

class CastFromTheCart : public testing::Test {
 protected:
  CastFromTheCart() : scenario_(CartScenario(scratch_.path(), Wall())), assembly_(scenario_) {
    const RecordedCart cart{.pose_t_ns = EvenTimes(0, 3, 0.01),
                            .turn_t_ns = EvenTimes(0, 3, 0.01),
                            .X_WB = ScanCasterDriven,
                            .turn_rad = ScanCasterTurned};
    machines_.emplace_back(scenario_.machines[0].placement, cart.machine,
                           WriteCart(scratch_.path() / "r", cart));
    stage_ = std::make_unique<RecordedStage>(scenario_, machines_, 0);
    caster_ = std::make_unique<ScanCaster>(scenario_, assembly_, *stage_, machines_, 1);
  }
  std::string Wall() const {
    std::string wall = kWall;
    return wall.replace(wall.find("FOLDER"), 6, scratch_.path().string());
  }
  std::vector<SimulatedReturn> Cast(double t_s, double span_s, const std::vector<Beam>& beams,
                                    const SensorCalibration& calibration = AsDocumented()) {
    const TimeNs t_ns = FromSeconds(t_s), span_ns = FromSeconds(span_s);
    return caster_->Cast(0, LidarOnMast(), {t_ns, span_ns, stage_->AdvanceTo(t_ns + span_ns)},
                         calibration, beams);
  }

  const ScratchDirectory scratch_;
  const Scenario scenario_;
  const SceneAssembly assembly_;
  std::vector<RecordedMotion> machines_;
  std::unique_ptr<RecordedStage> stage_;
  std::unique_ptr<ScanCaster> caster_;
};

TEST_F(CastFromTheCart, RayMeetsLevelGroundWhereItsPlaneIs) {
  const Vec3 d_S = Towards(Vec3(7, -4, 0), 1);
  const auto hit = Cast(1, 0, {{d_S, 0}}).front();
  EXPECT_EQ(hit.surface, Surface::kGround);
  EXPECT_NEAR(hit.range_m, RangeToPlane_m(SensorAt(1), d_S, Vec3::Zero(), Vec3::UnitZ()), 1e-4);
  EXPECT_GT(hit.normal_W.z(), 0.9999);
}

TEST_F(CastFromTheCart, EachRayOfARevolutionLeavesFromWhereTheSensorIsThen) {
  const Vec3 p_W = kOnWall_W + Vec3(0.5, 0.5 * std::tan(25 * kDeg), 2.5);
  const Vec3 d_S = Towards(p_W, 1.05);
  const std::vector<Beam> beams = {{d_S, 0}, {d_S, FromSeconds(0.05)}, {d_S, FromSeconds(0.1)}};
  const auto hits = Cast(1, 0.1, beams);
  for (std::size_t k = 0; k < beams.size(); ++k) {
    const double t_s = 1 + ToSeconds(beams[k].since_ns);
    const double range_m = RangeToPlane_m(SensorAt(t_s), d_S, kOnWall_W, kOutOfWall_W);
    EXPECT_EQ(hits[k].surface, Surface::kObstacle);
    EXPECT_EQ(caster_->NameOf(hits[k].object), "wall1");
    EXPECT_NEAR(hits[k].range_m, range_m, 1e-3) << k;
    EXPECT_LT((hits[k].normal_W - kOutOfWall_W).norm(), 1e-4);
    EXPECT_LT((hits[k].v_WB_mps - Vec3(1.5, 1, 0)).norm(), 0.1);  // the mast's, above the base
  }
  EXPECT_GT(std::abs(hits[0].range_m - hits[2].range_m), 0.05);  // one pose would not do
}

TEST_F(CastFromTheCart, RaysLeaveFromWhereTheSensorTrulyIsAtTheTrueTime) {
  const SensorCalibration moved{
      .X_BT = MakePose(Vec3(0.5, -0.2, 0.6), RotationFromRpy(0.15, 0.1, 0.55)),
      .clock_offset_s = 0.4};  // stamped 0.4 s late
  const Vec3 d_S = Towards(Vec3(7, -4, 0), 1);
  const auto hit = Cast(1.4, 0, {{d_S, 0}}, moved).front();
  EXPECT_NEAR(hit.range_m,
              RangeToPlane_m(SensorAt(1, moved.X_BT), d_S, Vec3::Zero(), Vec3::UnitZ()), 1e-4);
}

TEST_F(CastFromTheCart, WhatIsBeyondReachOrTooNearOrNotCoveredIsNotCompared) {
  const Vec3 up_S = SensorAt(1).linear().transpose() * Vec3::UnitZ();
  const auto sky = Cast(1, 0, {{up_S, 0}}).front();
  EXPECT_EQ(sky.surface, Surface::kNothing);
  SensorCalibration low = AsDocumented();  // half a metre above the ground, nearer than its range
  low.X_BT.translation().z() -= SensorAt(1).translation().z() - 0.5;
  EXPECT_EQ(Cast(1, 0, {{-up_S, 0}}, low).front().surface, Surface::kUnknown);
  EXPECT_EQ(Cast(4, 0, {{-up_S, 0}}).front().surface, Surface::kUnknown);
}

TEST(SurfacesOf, PartsOfAMachineAreComparedOnlyWhereAllItsJointsWereMeasured) {
  const Config config = Config::FromText(R"(
name: yard
duration_s: 1
terrain: {size_m: [12, 12], cell_m: 0.2, soil: dirt}
machines:
  - {name: excavator1, machine: tera:config/machines/tb235.yaml, operator: {type: idle},
     start: {xy_m: [1, 2], yaw_deg: 90}}
obstacles: [{name: cone1, preset: tera:config/obstacles/cone.yaml, xy_m: [4, 1], yaw_deg: 30}]
)",
                                         "yard.yaml");
  const Scenario scenario = ReadScenario(config.root());
  config.Finish();
  const SceneAssembly assembly(scenario);
  const ScratchDirectory scratch;
  const Recording poses = WriteCart(
      scratch.path() / "r",
      {.pose_t_ns = EvenTimes(0, 1, 0.1), .X_WB = ScanCasterDriven, .machine = "excavator1"});
  std::vector<RecordedMotion> machines;
  machines.emplace_back(scenario.machines[0].placement, "excavator1", poses);
  const std::vector<Surface> surfaces = SurfacesOf(scenario, assembly, machines);
  const auto& instances = assembly.model().instances;
  ASSERT_EQ(surfaces.size(), instances.size());
  EXPECT_EQ(surfaces.front(), Surface::kGround);
  for (std::size_t i = 1; i < surfaces.size(); ++i) {
    EXPECT_EQ(surfaces[i], instances[i].name == "cone1" ? Surface::kObstacle : Surface::kUnknown)
        << instances[i].name;
  }
}

}  // namespace
}  // namespace tera
