#include "sensors/slots/true_mount.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/units.h"
#include "render/hand_made_scene.h"
#include "sensors/encoder/encoder_slots.h"
#include "sensors/gnss/antenna_pair.h"
#include "sensors/imu/imu.h"
#include "sensors/imu/imu_slots.h"
#include "sensors/lidar/lidar.h"
#include "sensors/slots/given_effects.h"

namespace tera {
namespace {

using testing::ExpectNear;
using testing::Given;

constexpr double kG_mps2 = 9.80665;

/// Reading of a unit documented at X_BS, on a body that turns about the vertical at 2 rad/s, with
/// its origin at rest on the axis.
ImuSample OnATurntable(const Pose& X_BS, const Effects& effects) {
  const SampleClock clock{100, 0};
  Imu imu({}, TrueMount(X_BS, effects), clock, 0, 1, "m/imu");
  const auto at = [](int step) {
    BodyState body;
    body.X_WB = MakePose({7, -3, 1}, 0, 0, 0.4 + 2 * 0.001 * step);
    body.w_WB_radps = {0, 0, 2};
    return body;
  };
  std::vector<ImuSample> samples;
  for (int k = 0; k < 100; ++k) {
    imu.Advance(TimeNs{k} * 1'000'000, at(k), TimeNs{k + 1} * 1'000'000, at(k + 1),
                Vec3(0, 0, -kG_mps2), &samples);
  }
  ImuSlots slots(effects, 1, "m/imu");
  for (ImuSample& sample : samples) slots.Apply(&sample);
  return samples.at(5);
}

TEST(SensorGeometry, AnImuOffTheAxisFeelsTheCentripetalAcceleration) {
  // Half a metre along the link's x at 2 rad/s: w^2 r = 2 m/s^2 towards the axis, the link's -x.
  // The sensor's own axes are turned by 90 degrees about z, so that this is its +y.
  const Pose X_BS = MakePose({0, 0, 0.3}, 0, 0, 90 * kDeg);
  ExpectNear(OnATurntable(X_BS, {}).f_S_mps2, {0, 0, kG_mps2}, 1e-5);
  const ImuSample sample =
      OnATurntable(X_BS, Given(EffectTarget::kImu, "{imu_lever_arm: {x_m: 0.5, z_m: 3}}"));
  ExpectNear(sample.f_S_mps2, {0, 2, kG_mps2}, 1e-5);
  ExpectNear(sample.w_WS_S_radps, {0, 0, 2}, 1e-9);
}

TEST(SensorGeometry, ATiltedImuSplitsGravityAndTheTurnOverItsAxes) {
  // Documented as looking along the link's y. The rotation is about its own axes, not the link's:
  // pitched by 30 degrees, x looks down, with -g / 2 along it and g cos 30 along z. The turn
  // likewise.
  const ImuSample sample =
      OnATurntable(MakePose({0, 0, 0.3}, 0, 0, 90 * kDeg),
                   Given(EffectTarget::kImu, "{mount_rotation: {pitch_deg: 30}}"));
  ExpectNear(sample.f_S_mps2, {-4.903325, 0, 8.492808}, 1e-5);
  ExpectNear(sample.w_WS_S_radps, {-1, 0, 1.7320508}, 1e-7);
}

TEST(SensorGeometry, AFlippedAxisChangesItsSignAlone) {
  const Pose X_BS = MakePose({0.5, 0, 0.3}, 0, 0, 0);
  const ImuSample sample =
      OnATurntable(X_BS, Given(EffectTarget::kImu, "{axis_flip: {x: 1, z: 1}}"));
  ExpectNear(sample.f_S_mps2, {2, 0, -kG_mps2}, 1e-5);
  ExpectNear(sample.w_WS_S_radps, {0, 0, -2}, 1e-9);
}

TEST(SensorGeometry, AnAxisOfOneTriadIsFlippedAlone) {
  const Pose X_BS = MakePose({0.5, 0, 0.3}, 0, 0, 0);
  const ImuSample sample =
      OnATurntable(X_BS, Given(EffectTarget::kImu, "{axis_flip: {gyro_z: 1, accel_x: 1}}"));
  ExpectNear(sample.f_S_mps2, {2, 0, kG_mps2}, 1e-5);
  ExpectNear(sample.w_WS_S_radps, {0, 0, -2}, 1e-9);
}

TEST(SensorGeometry, AnAxisThatCountsBackwardsChangesAngleAndRate) {
  EncoderSlots slots({}, {Given(EffectTarget::kEncoderAxis, "{axis_flip: {}}"), {}}, {false, false},
                     {"boom", "arm"}, 1, "m/e");
  EncoderSample sample{0, 0, {0.25, 0.5}, {-1, 3}};
  slots.Apply(&sample);
  EXPECT_EQ(sample.q_rad, (std::vector<double>{-0.25, 0.5}));
  EXPECT_EQ(sample.qd_radps, (std::vector<double>{1, 3}));
}

TEST(SensorGeometry, AnAntennaSitsWhereItsLeverArmPutsIt) {
  const Pose X_BT =
      TrueMount(MakePose({-0.95, 0.55, 1.25}),
                Given(EffectTarget::kGnss, "{gnss_lever_arm: {x_m: 0.3, z_m: -0.1}}"));
  // The base faces north, hence so does the link's x.
  const Pose X_WB = MakePose({10, 20, 0}, 0, 0, 90 * kDeg);
  ExpectNear(X_WB * X_BT.translation(), {10 - 0.55, 20 - 0.65, 1.15}, 1e-12);
}

const Antenna kLeft{"upper", MakePose({-0.95, 0.55, 1.25}), {}};
const Antenna kRight{"mast", MakePose({-0.95, -0.55, 1.35}), {}};

TEST(SensorGeometry, SwappedAntennasGiveEachReceiverTheOthersPlace) {
  for (const bool at_left : {true, false}) {
    Antenna left = kLeft, right = kRight;
    (at_left ? left : right).effects = Given(EffectTarget::kGnss, "{antenna_swap: {}}");
    EXPECT_EQ(TrueAntenna(left, right).link, "mast");
    ExpectNear(TrueAntenna(left, right).X_BT.translation(), {-0.95, -0.55, 1.35}, 1e-12);
    EXPECT_EQ(TrueAntenna(right, left).link, "upper");
    ExpectNear(TrueAntenna(right, left).X_BT.translation(), {-0.95, 0.55, 1.25}, 1e-12);
  }
  EXPECT_EQ(TrueAntenna(kLeft, kRight).link, "upper");
}

TEST(SensorGeometry, TheLeverArmOfAnAntennaGoesWithItThroughASwap) {
  Antenna left = kLeft, right = kRight;
  left.effects = Given(EffectTarget::kGnss, "{antenna_swap: {}, gnss_lever_arm: {x_m: 0.2}}");
  ExpectNear(TrueAntenna(right, left).X_BT.translation(), {-0.75, 0.55, 1.25}, 1e-12);
  ExpectNear(TrueAntenna(left, right).X_BT.translation(), {-0.95, -0.55, 1.35}, 1e-12);
}

TEST(SensorGeometry, ATurnedPairOfAntennasTurnsAboutItsMiddle) {
  Antenna left = kLeft, right = kRight;
  right.link = "upper";
  right.effects = Given(EffectTarget::kGnss, "{antenna_yaw: {yaw_deg: 90}}");
  // The left antenna was 0.55 m left of the middle; a quarter turn puts it 0.55 m behind.
  ExpectNear(TrueAntenna(left, right).X_BT.translation(), {-1.5, 0, 1.25}, 1e-12);
  ExpectNear(TrueAntenna(right, left).X_BT.translation(), {-0.4, 0, 1.35}, 1e-12);
}

TEST(SensorGeometry, ALidarOutOfPlaceSeesItsRoomFromThere) {
  // In a cube with walls 6 m from the middle, one beam, four directions: back, left, front, right.
  RayScene scene(testing::OneBodyEach({testing::CubeMesh(6)}));
  scene.Update({{Pose::Identity()}}, testing::NoGround());
  LidarModel model;
  model.elevation_rad = model.azimuth_offset_rad = model.firing_offset_s = {0};
  model.columns = 4;
  const auto ranges = [&](const Effects& effects) {
    PoseTrack track;
    track.Append(0, MakePose({1, 2, 0.5}) * TrueMount(MakePose({0, 0, 1}), effects));
    std::vector<double> ranges_m;
    const LidarScan scan = Lidar(model, {10, 0}, 0, 1, "m/l").Measure(0, track, scene, 1);
    for (const LidarPoint& p : scan.points) ranges_m.push_back(std::hypot(p.x_m, p.y_m, p.z_m));
    return ranges_m;
  };
  const auto expect = [](const std::vector<double>& found, const std::vector<double>& wanted) {
    ASSERT_EQ(found.size(), wanted.size());
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], wanted[i], 1e-5);
  };
  expect(ranges({}), {7, 4, 5, 8});
  const auto given = [](const std::string& yaml) { return Given(EffectTarget::kLidar, yaml); };
  expect(ranges(given("{extrinsic: {x_m: 0.5, y_m: -0.25}}")), {7.5, 4.25, 4.5, 7.75});
  expect(ranges(given("{extrinsic: {yaw_deg: 90}}")), {8, 7, 4, 5});
  // Rolled by 60 degrees, the left beam hits the ceiling 4.5 m above, the right one the floor.
  const double steep = std::sin(60 * kDeg);
  expect(ranges(given("{extrinsic: {roll_deg: 60}}")), {7, 4.5 / steep, 5, 7.5 / steep});
}

}  // namespace
}  // namespace tera
