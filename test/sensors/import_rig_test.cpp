#include "sensors/import_rig.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "core/error.h"
#include "own_folder.h"
#include "sensors/sensor.h"

namespace tera {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// A file of the foreign form.
std::filesystem::path ForeignFile(const std::string& text) {
  const std::filesystem::path file = OwnFolder() / "excavator.yaml";
  std::ofstream(file) << text;
  return file;
}

const char* const kExample = R"(
Excavator:
  - id: 1
    type: TB235
    offset: [0, 0, 0]
    rotation: [0, 0, 0]
    sensors:
      - {id: 1, type: IMU, topic: /excavator1/imu_chassis, location: CHASIS, noise: [0.01, 0.05],
         offset: [0.3436, 0.15, -0.2921], rotation: [0, -90, 90]}
      - {id: 2, type: IMU, topic: /excavator1/imu_boom, location: BOOM, noise: [0, 0.1],
         offset: [-0.06, 1, 0.1], rotation: [0, 0, 0]}
      - {id: 3, type: GPS, topic: /excavator1/gps, location: CHASSIS, noise: [0.2, 0.75]}
      - {id: 4, type: LIDAR, topic: /excavator1/lidar, location: CHASSIS, noise: [0, 0.02],
         offset: [0, 0.745, -1.125], rotation: [0, 30, 0]}
      - {id: 5, type: RGB_CAMERA, topic: /excavator1/rgb, location: ARM, noise: [0, 2]}
      - {id: 6, type: RGBD_CAMERA, topic: /excavator1/rgbd, location: BUCKET}
)";

/// The imported rig, read back as a machine's sensors.
std::vector<SensorDescription> Imported(const std::string& text, const std::string& machine = "") {
  const std::filesystem::path file = ForeignFile(text);
  const Config config = Config::FromText(ImportRig(file, machine), "imported.yaml");
  std::vector<SensorDescription> sensors;
  for (const ConfigMap& item : config.root().List("sensors")) sensors.push_back(ReadSensor(item));
  config.Finish();
  return sensors;
}

std::string FaultOf(const std::string& text, const std::string& machine = "") {
  const std::filesystem::path file = ForeignFile(text);
  try {
    ImportRig(file, machine);
  } catch (const InputError& e) {
    return e.what();
  }
  return "no fault";
}

TEST(ImportRig, TheChassisImuOfThePaperStandsWhereUnityHasIt) {
  // By hand. Place: Unity's (right, up, forward) = (0.3436, 0.15, -0.2921) is -0.2921 forward,
  // -0.3436 left, 0.15 up. Rotation: Unity's Ry(-90) Rz(90), left-handed. It takes the sensor's
  // forward to the machine's left (Rz keeps forward, and -90 about up turns it from z to -x). It
  // takes the sensor's left, -x, to down (Rz takes x to y, Ry keeps y), and its up to the rear.
  const SensorDescription imu = Imported(kExample).at(0);
  EXPECT_EQ(imu.name, "imu_chassis");
  EXPECT_EQ(imu.link, "upper");
  EXPECT_EQ(TypeOf(imu), "imu");
  EXPECT_NEAR((imu.X_BS.translation() - Vec3(-0.2921, -0.3436, 0.15)).norm(), 0, 1e-9);
  EXPECT_NEAR((imu.X_BS.linear() * Vec3::UnitX() - Vec3::UnitY()).norm(), 0, 1e-9);
  EXPECT_NEAR((imu.X_BS.linear() * Vec3::UnitY() + Vec3::UnitZ()).norm(), 0, 1e-9);
  EXPECT_NEAR((imu.X_BS.linear() * Vec3::UnitZ() + Vec3::UnitX()).norm(), 0, 1e-9);
}

TEST(ImportRig, ATurnAboutUnitysUpAxisIsToTheRight) {
  // Unity is left-handed: +30 degrees about up turns forward towards right.
  const SensorDescription lidar = Imported(kExample).at(3);
  const Vec3 ahead = lidar.X_BS.linear() * Vec3::UnitX();
  EXPECT_NEAR((ahead - Vec3(std::sqrt(0.75), -0.5, 0)).norm(), 0, 1e-9);
  EXPECT_NEAR((lidar.X_BS.translation() - Vec3(-1.125, 0, 0.745)).norm(), 0, 1e-9);
}

TEST(ImportRig, EverySensorKeepsItsTypeAndLink) {
  const auto sensors = Imported(kExample);
  ASSERT_EQ(sensors.size(), 6u);
  const char* const types[] = {"imu", "imu", "gnss", "lidar", "camera", "camera"};
  const char* const links[] = {"upper", "boom", "upper", "upper", "arm", "bucket"};
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(TypeOf(sensors[i]), types[i]);
    EXPECT_EQ(sensors[i].link, links[i]);
  }
  EXPECT_FALSE(std::get<CameraModel>(sensors[4].model).depth);
  EXPECT_TRUE(std::get<CameraModel>(sensors[5].model).depth);
}

TEST(ImportRig, TheNoiseIsApplied) {
  const auto sensors = Imported(kExample);
  EXPECT_DOUBLE_EQ(std::get<LidarModel>(sensors[3].model).range_noise_m, 0.02);
  EXPECT_DOUBLE_EQ(std::get<CameraModel>(sensors[4].model).rgb_noise, 2);
  const auto& gps = std::get<GnssModel>(sensors[2].model);
  EXPECT_DOUBLE_EQ(gps.white_horizontal_m, 0.75);
  EXPECT_EQ(gps.bias_enu_m, Vec3(0.2, 0.2, 0.2));

  // The IMU's own output: mean 0.01 and deviation 0.05 on every axis. n = 10000: five standard
  // errors are 0.05 * 5 / 100 of the mean, 5 / sqrt(2 n) = 3.5 % of the deviation.
  const SensorDescription& s = sensors[0];
  Imu imu(std::get<ImuModel>(s.model), s.X_BS, s.clock, 0, 1, "excavator1/imu_chassis");
  BodyState body;
  std::vector<ImuSample> samples;
  imu.Advance(0, body, s.clock.Due(10000), body, Vec3(0, 0, -9.81), &samples);
  imu.Finish(&samples);
  ASSERT_EQ(samples.size(), 10000u);
  const Vec3 at_rest = s.X_BS.linear().transpose() * Vec3(0, 0, 9.81);
  Vec3 gyro = Vec3::Zero(), gyro2 = Vec3::Zero(), accel = Vec3::Zero(), accel2 = Vec3::Zero();
  for (const ImuSample& sample : samples) {
    const Vec3 f = sample.f_S_mps2 - at_rest;
    gyro += sample.w_WS_S_radps / 10000;
    gyro2 += sample.w_WS_S_radps.cwiseAbs2() / 10000;
    accel += f / 10000;
    accel2 += f.cwiseAbs2() / 10000;
  }
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(gyro[axis], 0.01, 0.0025);
    EXPECT_NEAR(accel[axis], 0.01, 0.0025);
    EXPECT_NEAR(std::sqrt(gyro2[axis] - gyro[axis] * gyro[axis]), 0.05, 0.035 * 0.05);
    EXPECT_NEAR(std::sqrt(accel2[axis] - accel[axis] * accel[axis]), 0.05, 0.035 * 0.05);
  }
}

TEST(ImportRig, AnInclinometerIsKnownByItsNameAndIsAsItsPresetHasIt) {
  const auto with = [](const std::string& noise) {
    return "Excavator:\n  - {id: 1, sensors: [{id: tilt, type: INCLINOMETER, location: ARM, "
           "offset: [0, 0.2, 0]" +
           noise + "}]}\n";
  };
  const SensorDescription tilt = Imported(with("")).at(0);
  EXPECT_EQ(TypeOf(tilt), "inclinometer");
  EXPECT_EQ(tilt.link, "arm");
  EXPECT_DOUBLE_EQ(tilt.X_BS.translation().z(), 0.2);  // up
  EXPECT_DOUBLE_EQ(tilt.clock.rate_hz, 100);
  EXPECT_DOUBLE_EQ(std::get<InclinometerModel>(tilt.model).time_constant_s, 0.032);
  EXPECT_THAT(FaultOf(with(", noise: [0, 0.1]")), HasSubstr("its preset has its noise"));
}

TEST(ImportRig, OneOfSeveralMachinesIsChosenById) {
  const std::string two =
      "Excavator:\n"
      "  - {id: left, sensors: [{id: a, type: IMU, location: ARM}]}\n"
      "  - {id: right, sensors: [{id: b, type: IMU, location: BOOM}]}\n";
  EXPECT_EQ(Imported(two, "right").at(0).name, "b");
  EXPECT_THAT(FaultOf(two, "middle"), HasSubstr("no machine 'middle'; need one of left, right"));
}

/// Two machines as the original project writes them.
const char* const kTwoMachines = R"(
Excavator:
  - id: excavator1
    name: Excavator_with_sensors_1
    type: excavator
    offset:
      x: 5
      y: 1
      z: 0.75
    rotation: {x: 0, y: 90, z: 0}
    sensors:
      - id: Chasis_IMU
        type: IMU
        topic: /imu_chasis
        location: CHASIS
        noise:
          mean: 0.1
          std_dev: 0.01
        offset: {x: 0.3436, y: 0.15, z: -0.2921}
        rotation: {x: 0, y: -90, z: 90}
      - {id: Chasis_LIDAR, type: LIDAR, topic: /lidar_chasis, location: CHASIS,
         noise: {mean: 0.2, std_dev: 0.02}, offset: {x: 0, y: 0.745, z: -1.125}}
  - id: excavator2
    type: excavator
    offset: {x: -2, y: 0, z: -5}
    rotation: {x: 3, y: -30, z: 0}
)";

TEST(ImportRig, VectorsAndNoiseMayBeMappings) {
  const std::vector<SensorDescription> sensors = Imported(kTwoMachines, "excavator1");
  ASSERT_EQ(sensors.size(), 2u);
  const Pose as_list = Imported(kExample).at(0).X_BS;
  EXPECT_TRUE(sensors[0].X_BS.isApprox(as_list, 1e-12));
  EXPECT_EQ(sensors[0].name, "imu_chasis");
  EXPECT_DOUBLE_EQ(std::get<ImuModel>(sensors[0].model).accel_bias_mps2.y(), 0.1);
  EXPECT_DOUBLE_EQ(std::get<LidarModel>(sensors[1].model).range_noise_m, 0.02);
}

TEST(ImportRig, SeveralMachinesBecomeThoseOfAScenario) {
  const std::string text = ImportRig(ForeignFile(kTwoMachines));
  const Config config = Config::FromText(text, "imported.yaml");
  const std::vector<ConfigMap> machines = config.root().List("machines");
  ASSERT_EQ(machines.size(), 2u);
  EXPECT_EQ(machines[0].Text("name"), "excavator1");
  EXPECT_EQ(machines[0].Map("rig").List("sensors").size(), 2u);
  // Unity's (right, up, forward) = (5, 1, 0.75) is 0.75 forward and 5 to the right; a turn of 90
  // degrees about up is to the right.
  EXPECT_EQ(machines[0].Map("start").Vector2("xy_m", Any("m")), Vec2(0.75, -5));
  EXPECT_NEAR(machines[0].Map("start").Number("yaw_deg", Any("deg")), -90, 1e-9);
  EXPECT_EQ(machines[1].Map("rig").List("sensors").size(), 0u);
  EXPECT_EQ(machines[1].Map("start").Vector2("xy_m", Any("m")), Vec2(-5, 2));
  EXPECT_NEAR(machines[1].Map("start").Number("yaw_deg", Any("deg")), 30, 1e-9);
  // The comment states what the ground determines; the lidar's mean is an effect. A rotation of 3
  // degrees about right, left-handed, lowers the nose.
  EXPECT_THAT(text, HasSubstr("# height 1 m, roll 0 and pitch 0 deg are left to the ground"));
  EXPECT_THAT(text, HasSubstr("# height 0 m, roll 0 and pitch 3 deg are left to the ground"));
  EXPECT_THAT(text,
              HasSubstr("effects:\n  excavator1: {lidar_chasis: {range_bias: {range_m: 0.2}}}"));
}

TEST(ImportRig, ARigTellsWhatOfItsMachineBelongsToTheScenario) {
  EXPECT_THAT(
      ImportRig(ForeignFile(kTwoMachines), "excavator1"),
      AllOf(HasSubstr("# In a scenario the machine has start: {xy_m: [0.75, -5], yaw_deg: -90}"),
            HasSubstr("# In a scenario it has effects: {excavator1: {lidar_chasis: ")));
}

TEST(ImportRig, MachinesMayBeAMappingByTheirIds) {
  const std::string body = "{sensors: [{id: a, type: IMU, location: ARM}]}";
  for (const char* key : {"Excavator", "machines"}) {
    const std::string text = std::string(key) + ":\n  left: " + body + "\n  right: " + body + "\n";
    EXPECT_EQ(Imported(text, "right").at(0).name, "a");
    EXPECT_THAT(FaultOf(text, "middle"), HasSubstr("no machine 'middle'; need one of left, right"));
  }
  EXPECT_THAT(FaultOf("Excavator: [{id: a}, {id: a}]\n"), HasSubstr("a second machine 'a'"));
  EXPECT_THAT(FaultOf("Excavator: [{id: a b}, {id: c}]\n"),
              HasSubstr("'a b' cannot name a folder"));
  EXPECT_THAT(FaultOf("Excavator: [{id: a, offset: {x: 1, w: 2}}]\n"), HasSubstr("unknown key"));
}

TEST(ImportRig, FaultsSayWhereAndWhatIsNeeded) {
  const auto with = [](const std::string& item) {
    return "Excavator:\n  - id: 1\n    sensors:\n      - {" + item + "}\n";
  };
  EXPECT_THAT(FaultOf(with("id: 1, type: RADAR, location: BOOM")),
              HasSubstr("excavator.yaml:4:23: Excavator[0].sensors[0].type: 'RADAR' is not known"));
  EXPECT_THAT(FaultOf(with("id: 1, type: IMU, location: CABIN")), HasSubstr("need one of CHASSIS"));
  EXPECT_THAT(FaultOf(with("id: 1, type: IMU, location: ARM, noise: [0, -1]")),
              HasSubstr("negative std"));
  EXPECT_THAT(FaultOf(with("id: 1, type: RGB_CAMERA, location: ARM, noise: [1, 0.1]")),
              HasSubstr("only IMU, GPS and LIDAR have a bias"));
  EXPECT_THAT(FaultOf(with("id: 1, type: IMU, location: ARM, ofset: [0, 0, 0]")),
              HasSubstr("unknown key (did you mean 'offset'?)"));
  EXPECT_THAT(FaultOf("Excavator: []\n"), HasSubstr("no machine under 'Excavator'"));
  EXPECT_THAT(FaultOf("Digger: 1\n"), HasSubstr("no machine under 'Excavator'"));
  EXPECT_THROW(ImportRig("/nonexistent/rig.yaml"), InputError);
}

TEST(ImportRig, TwoSensorsCannotShareAName) {
  EXPECT_THAT(FaultOf("Excavator:\n  - id: 1\n    sensors:\n"
                      "      - {id: 1, type: IMU, location: ARM, topic: /a/imu}\n"
                      "      - {id: 2, type: IMU, location: BOOM, topic: /b/imu}\n"),
              HasSubstr("a second sensor named 'imu'"));
}

}  // namespace
}  // namespace tera
