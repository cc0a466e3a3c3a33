#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "core/config/config.h"
#include "core/error.h"
#include "core/units.h"
#include "dataset/ros/from_samples.h"
#include "ros2/from_machine.h"
#include "ros2/lever_input.h"
#include "ros2/names.h"

// Conversion of samples, machines and levers to messages, without a network.

namespace tera {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kExcavator = R"(
name: one
seed: 1
duration_s: 1
terrain: {size_m: [14, 14], cell_m: 0.1, soil: dirt}
machines:
  - name: digger
    machine: tera:config/machines/tb235.yaml
    operator: {type: idle}
    rig: {sensors: [
      {name: gnss_left, preset: tera:config/sensors/rtk_f9p.yaml, link: upper, xyz_m: [-0.9, 0.5, 1.2]},
      {name: eye, preset: tera:config/sensors/rgb_640.yaml, link: boom, xyz_m: [1, 2, 3], rpy_deg: [0, 0, 90]}]}
)";

Scenario Read(std::string text, const std::string& from = "", const std::string& to = "") {
  if (!from.empty()) text.replace(text.find(from), from.size(), to);
  const Config config = Config::FromText(text, "one.yaml");
  Scenario scenario = ReadScenario(config.root());
  config.Finish();
  return scenario;
}

/// The excavator at X_WB with the boom level, the arm and the bucket straight down, slewed to the
/// left by a quarter turn.
MachineState StretchedDown(const MachineModel& model, const Pose& X_WB) {
  MachineState state;
  state.q_rad.assign(model.joints.size(), 0.0);
  state.q_rad[model.JointIndex("slew")] = 90 * kDeg;
  state.q_rad[model.JointIndex("arm")] = -90 * kDeg;
  state.q_rad[model.JointIndex("bucket")] = 45 * kDeg;
  for (const Pose& X_WL : ForwardKinematics(model, X_WB, state.q_rad)) {
    state.links.emplace_back().X_WB = X_WL;
  }
  state.qd_radps.assign(model.joints.size(), 0.5);
  state.effort_nm.assign(model.joints.size(), 700);
  state.gear_angle_rad = {1, 2};
  state.gear_rate_radps = {3, 4};
  state.gear_torque_nm = {5, 6};
  state.shovel_load.resize(2);
  state.shovel_load[0].mass_kg = 81;
  return state;
}

Pose SkewPose() { return MakePose(Vec3(4, -3, 0.5), 10 * kDeg, -20 * kDeg, 130 * kDeg); }

TEST(MachineMessages, EndEffectorIsTheCuttingEdgeSeenFromTheUndercarriage) {
  const Scenario scenario = Read(kExcavator);
  const ScenarioMachine& digger = scenario.machines[0];
  const auto tool = EndEffectorOf(digger.placement.model);
  ASSERT_TRUE(tool.has_value());
  const MachineState state = StretchedDown(digger.placement.model, SkewPose());
  const ros::PoseStamped message = ros::EndEffectorMessage(7, digger, state, *tool);
  EXPECT_EQ(message.header.frame_id, "digger/undercarriage");
  EXPECT_EQ(message.header.t_ns, 7);
  // Slew axis to boom pin 0.62 + 0.18 forward and 0.56 + 0.10 + 0.20 up, boom 2.5 level, then arm
  // 1.545 and bucket 0.78 straight down. Forward is the undercarriage's left.
  const Vec3 tip(0, 0.62 + 0.18 + 2.5, 0.86 - 1.545 - 0.78);
  EXPECT_LT((message.pose.translation() - tip).norm(), 1e-9);
  EXPECT_LT((message.pose.linear().col(0) - Vec3(0, 0, -1)).norm(), 1e-9);
  EXPECT_EQ(ros::BucketMassMessage(state, *tool).data, 81);
}

TEST(MachineMessages, TransformsLeadFromTheMapToEveryLinkAndSensor) {
  const Scenario scenario = Read(kExcavator);
  const ScenarioMachine& digger = scenario.machines[0];
  const MachineModel& model = digger.placement.model;
  const MachineState state = StretchedDown(model, SkewPose());
  std::map<std::string, ros::TransformStamped> to;
  for (const auto& t : ros::MovingTransforms(5, digger, state)) to[t.child_frame_id] = t;
  for (const auto& t : ros::StaticTransforms(5, digger, state)) to[t.child_frame_id] = t;
  const auto from_map = [&](std::string frame) {
    Pose pose = Pose::Identity();
    while (frame != "map") {
      const ros::TransformStamped& step = to.at(frame);
      EXPECT_EQ(step.header.t_ns, 5);
      pose = step.pose * pose;
      frame = step.header.frame_id;
    }
    return pose;
  };
  EXPECT_EQ(to.size(), model.links.size() + 3);
  for (std::size_t l = 0; l < model.links.size(); ++l) {
    EXPECT_TRUE(from_map("digger/" + model.links[l].name).isApprox(state.links[l].X_WB, 1e-9));
  }
  const Pose& X_WB = state.links[model.LinkIndex("boom")].X_WB;
  const Vec3 p_WS = X_WB * Vec3(1, 2, 3);
  EXPECT_LT((from_map("digger/eye").translation() - p_WS).norm(), 1e-9);
  // The camera looks along the boom's y: that is the optical z; its down is the optical y.
  const Mat3 R_WC = from_map("digger/eye_optical").linear();
  EXPECT_LT((R_WC.col(2) - X_WB.linear().col(1)).norm(), 1e-9);
  EXPECT_LT((R_WC.col(1) + X_WB.linear().col(2)).norm(), 1e-9);
}

TEST(MachineMessages, MachineThatStandsFastHasItsRootAmongTheStaticTransforms) {
  const Scenario scenario = Read(kExcavator, "tera:config/machines/tb235.yaml\n    operator",
                                 "tera:config/machines/mast.yaml\n    operator: {type: idle}\n"
                                 "  - name: other\n    machine: "
                                 "tera:config/machines/tb235.yaml\n    operator");
  const ScenarioMachine& mast = scenario.machines[0];
  const MachineModel& model = mast.placement.model;
  MachineState state;
  state.q_rad.assign(model.joints.size(), 0.0);
  for (const Pose& X : ForwardKinematics(model, SkewPose(), state.q_rad)) {
    state.links.emplace_back().X_WB = X;
  }
  EXPECT_THAT(ros::MovingTransforms(0, mast, state), IsEmpty());
  const auto fast = ros::StaticTransforms(0, mast, state);
  ASSERT_FALSE(fast.empty());
  EXPECT_EQ(fast[0].header.frame_id, "map");
  EXPECT_TRUE(fast[0].pose.isApprox(SkewPose()));
  EXPECT_FALSE(EndEffectorOf(model).has_value());
}

TEST(MachineMessages, OdometryHasItsVelocitiesInTheMachinesOwnFrame) {
  const Scenario scenario = Read(kExcavator);
  const ScenarioMachine& digger = scenario.machines[0];
  MachineState state =
      StretchedDown(digger.placement.model, MakePose(Vec3(1, 2, 3), 0, 0, 90 * kDeg));
  state.links[0].v_WB_mps = Vec3(0, 1.5, 0.25);
  state.links[0].w_WB_radps = Vec3(-0.5, 0, 2);
  const ros::Odometry message = ros::OdometryMessage(9, digger, state);
  EXPECT_EQ(message.header.frame_id, "map");
  EXPECT_EQ(message.child_frame_id, "digger/undercarriage");
  EXPECT_LT((message.pose.translation() - Vec3(1, 2, 3)).norm(), 1e-12);
  EXPECT_LT((message.linear_mps - Vec3(1.5, 0, 0.25)).norm(), 1e-12);
  EXPECT_LT((message.angular_radps - Vec3(0, 0.5, 2)).norm(), 1e-12);
}

TEST(MachineMessages, JointStatesNameJointsAndTracks) {
  const Scenario scenario = Read(kExcavator);
  const ScenarioMachine& digger = scenario.machines[0];
  const MachineState state = StretchedDown(digger.placement.model, SkewPose());
  const ros::JointState message = ros::JointStateMessage(3, digger, state);
  EXPECT_THAT(message.name, ElementsAre("slew", "swing", "boom", "arm", "bucket", "blade",
                                        "left_track", "right_track"));
  EXPECT_THAT(message.position,
              ElementsAre(DoubleNear(M_PI / 2, 1e-12), 0, 0, DoubleNear(-M_PI / 2, 1e-12),
                          DoubleNear(M_PI / 4, 1e-12), 0, 1, 2));
  EXPECT_THAT(message.velocity, ElementsAre(0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 3, 4));
  EXPECT_THAT(message.effort, ElementsAre(700, 700, 700, 700, 700, 700, 5, 6));
}

TEST(SampleMessages, ImuHasTheVarianceOfOneSample) {
  ImuNoise noise;
  noise.gyro_density_radpsrthz = 0.01;  // over 10 ms: sigma 0.1
  noise.gyro_sample_radps = 0.2;
  noise.accel_density_mps2rthz = 0.03;  // sigma 0.3
  noise.accel_sample_mps2 = 0.4;
  const ImuSample sample{11, 12, Vec3(1, 2, 3), Vec3(4, 5, 6)};
  const ros::Imu message = ros::ImuMessage(sample, "digger/imu", noise, 0.01);
  EXPECT_EQ(message.header.t_ns, 11);
  EXPECT_EQ(message.header.frame_id, "digger/imu");
  EXPECT_EQ(message.angular_velocity_radps, Vec3(1, 2, 3));
  EXPECT_EQ(message.linear_acceleration_mps2, Vec3(4, 5, 6));
  const auto gyro = DoubleNear(0.05, 1e-12), accel = DoubleNear(0.25, 1e-12);
  EXPECT_THAT(message.angular_velocity_covariance, ElementsAre(gyro, 0, 0, 0, gyro, 0, 0, 0, gyro));
  EXPECT_THAT(message.linear_acceleration_covariance,
              ElementsAre(accel, 0, 0, 0, accel, 0, 0, 0, accel));
}

TEST(SampleMessages, ARowIsJointsByTheNamesAndUnitsOfItsColumns) {
  const RowSample row{5, 6, {0.25, 1.5, -2, 0.75, 300}};
  const ros::JointState message = ros::JointStateOfRow(
      row, "digger/s", {"tilt_rad", "rod_m", "tilt_radps", "rod_mps", "temperature_k"});
  EXPECT_EQ(message.header.t_ns, 5);
  EXPECT_EQ(message.header.frame_id, "digger/s");
  EXPECT_THAT(message.name, ElementsAre("tilt", "rod", "temperature_k"));
  EXPECT_THAT(message.position, ElementsAre(0.25, 1.5, 300));
  EXPECT_EQ(message.velocity.at(0), -2);
  EXPECT_EQ(message.velocity.at(1), 0.75);
  EXPECT_TRUE(std::isnan(message.velocity.at(2)));
  EXPECT_TRUE(message.effort.empty());
}

TEST(SampleMessages, FixHasStatusPlaceAndVariance) {
  GnssSample sample;
  sample.lat_deg = 47;
  sample.lon_deg = 8;
  sample.alt_m = 460;
  sample.variance_enu_m2 = Vec3(1, 2, 3);
  sample.fix = GnssFix::kRtkFloat;
  const ros::NavSatFix message = ros::NavSatFixMessage(sample, "digger/gnss");
  EXPECT_EQ(message.status, ros::NavSatFix::kGroundAugmented);
  EXPECT_THAT((std::array{message.latitude_deg, message.longitude_deg, message.altitude_m}),
              ElementsAre(47, 8, 460));
  EXPECT_THAT(message.position_covariance_m2, ElementsAre(1, 0, 0, 0, 2, 0, 0, 0, 3));
  EXPECT_EQ(message.covariance_type, ros::NavSatFix::kDiagonalKnown);
  sample.fix = GnssFix::kSingle;
  EXPECT_EQ(ros::NavSatFixMessage(sample, "").status, ros::NavSatFix::kFix);
}

TEST(SampleMessages, LostFixSaysSoAndNothingElse) {
  const ros::NavSatFix message = ros::NavSatFixMessage({.lat_deg = 0, .fix = GnssFix::kNone}, "g");
  EXPECT_EQ(message.status, ros::NavSatFix::kNoFix);
  EXPECT_EQ(message.covariance_type, ros::NavSatFix::kUnknown);
}

TEST(SampleMessages, PicturesKeepTheirRowsAndDepthHasNanWhereNothingWasMeasured) {
  CameraFrame frame;
  frame.t_ns = 4;
  frame.rgb = Image<std::uint8_t>(2, 1, 3);
  frame.rgb.data = {1, 2, 3, 4, 5, 6};
  frame.depth_m = Image<float>(2, 1);
  frame.depth_m.data = {2.5f, 0.0f};
  frame.instance = Image<std::uint16_t>(1, 2);
  frame.instance.data = {1, 258};
  const ros::Image colour = ros::ColourMessage(frame, "eye");
  EXPECT_EQ(colour.encoding, "rgb8");
  EXPECT_EQ(colour.width_px, 2u);
  EXPECT_EQ(colour.height_px, 1u);
  EXPECT_EQ(colour.step_bytes, 6u);
  EXPECT_THAT(colour.data, ElementsAre(1, 2, 3, 4, 5, 6));
  const ros::Image depth = ros::DepthMessage(frame, "eye");
  EXPECT_EQ(depth.encoding, "32FC1");
  EXPECT_EQ(depth.step_bytes, 8u);
  float z_m[2];
  std::memcpy(z_m, depth.data.data(), sizeof z_m);
  EXPECT_EQ(z_m[0], 2.5f);
  EXPECT_TRUE(std::isnan(z_m[1]));
  const ros::Image instance = ros::LabelMessage(kLabelChannels[kInstanceChannel], frame, "eye");
  EXPECT_EQ(instance.encoding, "mono16");
  EXPECT_EQ(instance.step_bytes, 2u);
  EXPECT_THAT(instance.data, ElementsAre(1, 0, 2, 1));
  frame.normal = Image<std::uint16_t>(1, 1, 3);
  frame.normal.data = {1, 258, 65534};
  const ros::Image normal = ros::LabelMessage(kLabelChannels[kNormalChannel], frame, "eye");
  EXPECT_EQ(normal.encoding, "rgb16");
  EXPECT_EQ(normal.step_bytes, 6u);
  EXPECT_THAT(normal.data, ElementsAre(1, 0, 2, 1, 254, 255));
}

TEST(SampleMessages, PointsAreWhereTheirFieldsSay) {
  LidarScan scan;
  scan.t_ns = 6;
  scan.points = {{}, {1, 2, 3, 0.5f, 250'000'000, 17, 300, 5}};
  const ros::PointCloud2 cloud = ros::PointCloudMessage(scan, "digger/lidar");
  ASSERT_EQ(cloud.data.size(), 2 * cloud.point_step_bytes);
  const auto value = [&](const std::string& name, auto zero, ros::PointField::Datatype type) {
    for (const ros::PointField& field : cloud.fields) {
      if (field.name != name) continue;
      EXPECT_EQ(field.datatype, type) << name;
      std::memcpy(&zero, &cloud.data[cloud.point_step_bytes + field.offset], sizeof zero);
      return zero;
    }
    ADD_FAILURE() << "no field " << name;
    return zero;
  };
  EXPECT_EQ(value("x", 0.0f, ros::PointField::kFloat32), 1);
  EXPECT_EQ(value("y", 0.0f, ros::PointField::kFloat32), 2);
  EXPECT_EQ(value("z", 0.0f, ros::PointField::kFloat32), 3);
  EXPECT_EQ(value("intensity", 0.0f, ros::PointField::kFloat32), 0.5);
  EXPECT_EQ(value("time", 0.0f, ros::PointField::kFloat32), 0.25);
  EXPECT_EQ(value("ring", std::uint16_t{}, ros::PointField::kUint16), 17);
  EXPECT_EQ(value("instance", std::uint16_t{}, ros::PointField::kUint16), 300);
  EXPECT_EQ(value("label", std::uint8_t{}, ros::PointField::kUint8), 5);
}

TEST(Levers, EachFieldMovesTheLeverOfItsName) {
  const Scenario scenario = Read(kExcavator);
  const MachineModel& model = scenario.machines[0].placement.model;
  ros::DeltaCan message;
  message.slew = 0.1f;
  message.boom = 0.2f;
  message.arm = 0.3f;
  message.bucket = 0.4f;
  message.left_travel = 0.5f;
  message.right_travel = 0.6f;
  message.blade = 0.7f;
  message.swing = 0.8f;
  message.enable = true;
  const ControlMessage control = ros::ControlOf(message, model);
  // tb235.yaml: left_track, right_track, slew, swing, boom, arm, bucket, blade.
  EXPECT_THAT(std::get<ControlMessage::Levers>(control.command).position,
              ElementsAre(0.5f, 0.6f, 0.1f, 0.8f, 0.2f, 0.3f, 0.4f, 0.7f));
  EXPECT_TRUE(control.enable);
  EXPECT_FALSE(control.hydraulic_lock);
  EXPECT_FALSE(control.high_speed);
}

TEST(Levers, OnesWithoutAFieldAreAmongTheOthersInTheMachinesOrder) {
  EXPECT_EQ(ros::FieldOf({.name = "elbow", .joint = 0}), nullptr);
  EXPECT_EQ(ros::FieldOf({.name = "rear_wheel", .gear = 0}), nullptr);
  EXPECT_EQ(ros::FieldOf({.name = "left_wheel", .gear = 0}), &ros::DeltaCan::left_travel);
  MachineModel model;
  model.levers = {{.name = "lift", .joint = 0}, {.name = "boom", .joint = 1}, {.name = "tilt"}};
  ros::DeltaCan message;
  message.boom = 0.5f;
  const auto positions = [&] {
    EXPECT_EQ(ros::FaultOf(message, model), std::nullopt);
    return std::get<ControlMessage::Levers>(ros::ControlOf(message, model).command).position;
  };
  EXPECT_THAT(positions(), ElementsAre(0, 0.5f, 0));
  message.others = {-0.25f, 0.75f};
  EXPECT_THAT(positions(), ElementsAre(-0.25f, 0.5f, 0.75f));
  message.others = {-0.25f};
  EXPECT_THAT(ros::FaultOf(message, model).value_or("none"), HasSubstr("need none or 2"));
  message.others = {0, NAN};
  EXPECT_THAT(ros::FaultOf(message, model).value_or("none"), HasSubstr("others[1] is nan"));
}

TEST(Levers, NoNumberBeyondFullAndNoTimeAreFaults) {
  const MachineModel model;
  EXPECT_EQ(ros::FaultOf(ros::DeltaCan{}, model), std::nullopt);
  ros::DeltaCan full;
  full.boom = 1;
  full.swing = -1;
  EXPECT_EQ(ros::FaultOf(full, model), std::nullopt);
  const auto fault = [&](auto field, auto value) {
    ros::DeltaCan message;
    message.*field = value;
    return ros::FaultOf(message, model).value_or("none");
  };
  EXPECT_THAT(fault(&ros::DeltaCan::swing, NAN), HasSubstr("swing is nan"));
  EXPECT_THAT(fault(&ros::DeltaCan::bucket, INFINITY), HasSubstr("bucket is inf"));
  EXPECT_THAT(fault(&ros::DeltaCan::left_travel, -1.001f), HasSubstr("left_travel is -1.001"));
  EXPECT_THAT(fault(&ros::DeltaCan::stamp_nanosec, 1'000'000'000u), HasSubstr("stamp"));
  EXPECT_THAT(fault(&ros::DeltaCan::stamp_sec, -1), HasSubstr("stamp"));
}

TEST(RosNames, GnssTopicsAreCalledGps) {
  const Scenario scenario = Read(kExcavator);
  EXPECT_EQ(ros::TopicOf(scenario.machines[0].sensors[0]), "gps_left");
  EXPECT_EQ(ros::TopicOf(scenario.machines[0].sensors[1]), "eye");
  EXPECT_EQ(ros::DdsTopicOf(ros::TopicOf("digger", "odom")), "rt/digger/odom");
  EXPECT_NO_THROW(ros::RequireRosNames(scenario));
}

TEST(RosNames, NamesThatRosDoesNotHaveAreRefused) {
  const auto fault = [](const std::string& from, const std::string& to) -> std::string {
    try {
      ros::RequireRosNames(Read(kExcavator, from, to));
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_THAT(fault("name: digger", "name: digger-1"), HasSubstr("machine 'digger-1'"));
  EXPECT_THAT(fault("name: digger", "name: 1digger"), HasSubstr("machine '1digger'"));
  EXPECT_THAT(fault("name: eye", "name: eye-2"), HasSubstr("sensor 'eye-2'"));
  EXPECT_THAT(fault("name: eye", "name: upper"), HasSubstr("sensor 'upper'"));
  EXPECT_THAT(fault("name: eye", "name: gps_left"), HasSubstr("'gps_left'"));
  for (const char* own : {"odom", "joint_states", "ee_pose", "bucket_mass", "delta_can"}) {
    EXPECT_THAT(fault("name: eye", std::string("name: ") + own), HasSubstr(own));
  }
}

TEST(RosNames, LinksThatCannotNameAFrameAreRefused) {
  Scenario scenario = Read(kExcavator);
  MachineModel& model = scenario.machines[0].placement.model;
  std::string& blade = model.links[model.LinkIndex("blade")].name;
  for (const std::string good : {"blade_2", "_blade", "blade/left/Edge"}) {
    blade = good;
    EXPECT_NO_THROW(ros::RequireRosNames(scenario)) << good;
  }
  for (const std::string bad :
       {"", "/blade", "blade/", "blade//edge", "blade/2nd", "2nd_blade", "blade-2", "the blade",
        "sch\xc3\xbc"
        "ld"}) {
    blade = bad;
    try {
      ros::RequireRosNames(scenario);
      ADD_FAILURE() << bad;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("link '" + bad + "' of machine 'digger'"));
    }
  }
}

}  // namespace
}  // namespace tera
