#include "resimulate/recorded_sensors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "dataset/format/sample_recording.h"
#include "resimulate/recorded_cart.h"

namespace tera {
namespace {

using testing::HasSubstr;

constexpr TimeNs kPeriod_ns = kNsPerSecond / 10;
constexpr double kFirst_s = 3;  ///< of the recording's scans

SensorDescription Sensor(const std::string& name, const SensorModel& model,
                         const std::string& link = "mast") {
  SensorDescription sensor;
  sensor.name = name;
  sensor.link = link;
  sensor.clock.rate_hz = 10;
  sensor.model = model;
  return sensor;
}

CameraModel CameraOf(bool rgb, bool depth) {
  CameraModel camera;
  camera.rgb = rgb;
  camera.depth = depth;
  return camera;
}

TEST(RecordedSensor, MeasuresRangesOrTakesPicturesOrIsNotCompared) {
  struct Case {
    SensorModel model;
    bool ranges, pictures;
  };
  for (const auto& [model, ranges, pictures] :
       {Case{LidarModel{}, true, false}, Case{CameraOf(false, true), true, false},
        Case{CameraOf(true, true), true, false}, Case{CameraOf(true, false), false, true},
        Case{CameraOf(false, false), false, false}, Case{ImuModel{}, false, false}}) {
    const SensorDescription sensor = Sensor("any", model);
    EXPECT_EQ(MeasuresRanges(sensor), ranges) << TypeOf(sensor);
    EXPECT_EQ(TakesPictures(sensor), pictures) << TypeOf(sensor);
  }
}

/// Number of scans at 10 Hz, from `kFirst_s` on.
std::vector<TimeNs> Scans(int number) {
  return EvenTimes(kFirst_s, kFirst_s + 0.1 * (number - 1), 0.1);
}

class SensorsOfACart : public testing::Test {
 protected:
  SensorsOfACart() {
    scenario_.machines[0].sensors = {Sensor("imu", ImuModel{}), Sensor("lidar", LidarModel{}),
                                     Sensor("colour", CameraOf(true, false)),
                                     Sensor("depth", CameraOf(true, true)),
                                     Sensor("not_recorded", LidarModel{})};
  }
  /// `number` scans of the lidar and pictures of both cameras; an IMU's channel is there too.
  Recording Record(int number) const {
    return WriteCart(scratch_.path() / "r", {.frames = {{"imu", "imu", Scans(number)},
                                                        {"lidar", "lidar", Scans(number)},
                                                        {"colour", "camera", Scans(number)},
                                                        {"depth", "camera", Scans(number)}}});
  }
  std::vector<RecordedSensor> Seeing(int number, const RecordedPart& part = {}) const {
    return SeeingSensors(scenario_, {"real_cart"}, Record(number), part);
  }

  const ScratchDirectory scratch_;
  Scenario scenario_ = CartScenario(scratch_.path());
};

TEST_F(SensorsOfACart, AreThoseThatSeeAndWereRecorded) {
  const std::vector<RecordedSensor> sensors = Seeing(3);
  ASSERT_EQ(sensors.size(), 3u);
  EXPECT_EQ(sensors[0].channel, "real_cart/lidar");
  EXPECT_EQ(sensors[1].channel, "real_cart/colour");
  EXPECT_EQ(sensors[2].channel, "real_cart/depth");
  for (const RecordedSensor& sensor : sensors) {
    EXPECT_EQ(sensor.machine, 0u);
    EXPECT_EQ(sensor.channel, "real_cart/" + sensor.description->name);
    EXPECT_EQ(sensor.obstacle, "");
  }
}

TEST_F(SensorsOfACart, WithoutASingleScanAreLeftOut) { EXPECT_TRUE(Seeing(0).empty()); }

TEST_F(SensorsOfACart, ALidarTurnsForItsPeriodAPictureIsOfOneInstant) {
  for (const RecordedSensor& sensor : Seeing(3)) {
    const bool turns = sensor.description->name == "lidar";
    ASSERT_EQ(sensor.scans.size(), 3u);
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(sensor.scans[k].t_ns, FromSeconds(kFirst_s) + k * kPeriod_ns);
      EXPECT_EQ(sensor.scans[k].span_ns, turns ? kPeriod_ns : 0);
    }
  }
}

TEST_F(SensorsOfACart, APartIsCountedFromTheFirstScanAndHasBothItsEnds) {
  for (const RecordedSensor& sensor : Seeing(10, {.from_s = 0.2, .to_s = 0.5})) {
    ASSERT_EQ(sensor.scans.size(), 4u) << sensor.channel;
    EXPECT_EQ(sensor.scans.front().t_ns, FromSeconds(kFirst_s + 0.2));
    EXPECT_EQ(sensor.scans.back().t_ns, FromSeconds(kFirst_s + 0.5));
  }
}

// Every second or third of 130 scans is taken to have 60, and every third or fourth picture to have
// 40. The first is one of them, and the gap after the last is no larger than the others.
TEST_F(SensorsOfACart, OfMoreThan60ScansOr40PicturesSomeAreTakenEvenly) {
  constexpr int kNumber = 130;
  for (const RecordedSensor& sensor : Seeing(kNumber)) {
    const int most = sensor.description->name == "colour" ? 40 : 60;
    ASSERT_EQ(std::ssize(sensor.scans), most) << sensor.channel;
    EXPECT_EQ(sensor.scans.front().t_ns, FromSeconds(kFirst_s));
    const TimeNs least_ns = kNumber / most * kPeriod_ns, largest_ns = least_ns + kPeriod_ns;
    for (std::size_t k = 1; k < sensor.scans.size(); ++k) {
      const TimeNs apart_ns = sensor.scans[k].t_ns - sensor.scans[k - 1].t_ns;
      EXPECT_TRUE(apart_ns == least_ns || apart_ns == largest_ns) << sensor.channel << ' ' << k;
    }
    const TimeNs end_ns = FromSeconds(kFirst_s) + kNumber * kPeriod_ns;
    EXPECT_LE(end_ns - sensor.scans.back().t_ns, largest_ns) << sensor.channel;
  }
  EXPECT_EQ(Seeing(60)[0].scans.size(), 60u);
}

TEST_F(SensorsOfACart, ThatAnUnmeasuredJointCarriesHaveAnObstacle) {
  const MachineModel& model = scenario_.machines[0].placement.model;
  const auto still = [](double) { return MakePose(Vec3(1, 2, 0.5), 0.1, -0.2, 0.7); };
  const auto obstacle = [&](const std::string& link, const RecordedCart& cart) {
    const SensorDescription lidar = Sensor("lidar", LidarModel{}, link);
    const RecordedMotion motion(scenario_.machines[0].placement, cart.machine,
                                WriteCart(scratch_.path() / "r", cart));
    return ObstacleTo({0, &lidar, "real_cart/lidar", {}, ""}, motion, model);
  };
  RecordedCart cart{.pose_t_ns = EvenTimes(0, 1, 0.1),
                    .turn_t_ns = EvenTimes(0, 1, 0.1),
                    .X_WB = still,
                    .turn_rad = [](double) { return 0.4; }};
  EXPECT_EQ(obstacle("mast", cart), "");
  cart.turn_rad = nullptr;
  EXPECT_THAT(obstacle("mast", cart), HasSubstr("its link mast has no encoder"));
  EXPECT_EQ(obstacle("base", cart), "");
  cart.X_WB = nullptr;
  EXPECT_THAT(obstacle("base", cart), HasSubstr("no poses of real_cart"));
}

/// An excavator on level soil with a sinkage of 0.1 m, at 2 m/s, with any support.
class GroundUnderTracks : public testing::Test {
 protected:
  static Scenario DiggerOnSoil() {
    const Config config = Config::FromText(R"(
name: sink
duration_s: 10
settle_s: 0
terrain: {size_m: [16, 8], cell_m: 0.1, soil: loose}
machines:
  - name: digger
    machine: tera:config/machines/tb235.yaml
    start: {xy_m: [-4, 0.5], joints_deg: {boom: 60, blade: 25}}
    operator: {type: idle}
)",
                                           "sink.yaml");
    Scenario scenario = ReadScenario(config.root());
    config.Finish();
    return scenario;
  }
  static Pose Sunk(double t_s) {
    return MakePose(Vec3(-4, 0.5, -0.1), RotationFromRpy(0, 0, 10 * kDeg)) *
           MakePose(Vec3(2 * t_s, 0, 0), 0, 0, 0);
  }
  GroundUnderTracks() {
    const RecordedCart digger{
        .pose_t_ns = EvenTimes(0, 2, 0.01), .X_WB = Sunk, .machine = "digger"};
    motions_.emplace_back(scenario_.machines[0].placement, "digger",
                          WriteCart(scratch_.path() / "r", digger));
  }
  /// Height of a place 1.5 m ahead of the left track's middle. The track is level over 1.6 m and
  /// covers the place at 0.35 s.
  static double HeightAhead_m(const ScanCaster::Scan& scan) {
    const Vec3 p_W_m = Sunk(0) * Vec3(1.5, 0.57, 0);
    return scan.moment.ground->HeightAt(p_W_m.x(), p_W_m.y());
  }

  const ScratchDirectory scratch_;
  const Scenario scenario_ = DiggerOnSoil();
  std::vector<RecordedMotion> motions_;
};

TEST_F(GroundUnderTracks, IsThatOfAScansEndWhicheverSensorComesFirst) {
  RecordedStage stage(scenario_, motions_, 0);
  std::vector<RecordedSensor> sensors(2);
  sensors[0].scans = {{FromSeconds(0.1), FromSeconds(0.4), {}},
                      {FromSeconds(0.2), FromSeconds(0.4), {}}};
  sensors[1].scans = {{FromSeconds(0.1), 0, {}}, {FromSeconds(0.6), 0, {}}};
  WorkGround(&stage, &sensors);
  EXPECT_NEAR(HeightAhead_m(sensors[1].scans[0]), 0, 1e-6);
  EXPECT_LT(HeightAhead_m(sensors[0].scans[0]), -0.05);
  // Both end at 0.6 s.
  EXPECT_EQ(sensors[0].scans[1].moment.ground, sensors[1].scans[1].moment.ground);
  EXPECT_NE(sensors[0].scans[0].moment.ground, sensors[0].scans[1].moment.ground);
  for (const RecordedSensor& sensor : sensors) {
    for (const ScanCaster::Scan& scan : sensor.scans) EXPECT_EQ(scan.moment.loads.size(), 1u);
  }
}

}  // namespace
}  // namespace tera
