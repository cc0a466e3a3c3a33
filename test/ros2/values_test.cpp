#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>

#include "core/units.h"
#include "dataset/format/recording.h"
#include "dataset/format/sample_recording.h"
#include "ros2/live_run.h"

// Every message of a driven machine against geometry or the files of the same run.

namespace tera {
namespace {

using testing::ElementsAre;

/// Messages of one run, all from a moment at which red travels, slews and raises its boom, and the
/// dataset recorded at the same time.
class DrivenRun : public testing::Test {
 protected:
  static constexpr TimeNs kMoving_ns = 800'000'000;

  static void SetUpTestSuite() {
    scratch_ = new ScratchDirectory;
    FastPeer peer(OwnDomainId());
    for (const auto& [topic, type] : Topics()) {
      peer.Subscribe({.topic = topic, .type = type, .reliable = IsReliable(topic)});
    }
    peer.Subscribe({.topic = "rt/tf_static",
                    .type = "tf2_msgs::msg::dds_::TFMessage_",
                    .reliable = true,
                    .transient_local = true});
    peer.Advertise(LeversOf("red"));
    ros::LiveRosOptions options;
    options.live.record = scratch_->path() / "run";
    BackgroundRun run(options);
    messages_["rt/tf_static"] = Require(peer.Next("rt/tf_static"), "tf_static");
    LeverMessage levers;
    levers.left_travel = 0.8f;
    levers.right_travel = 0.4f;
    levers.slew = 0.5f;
    levers.boom = 0.4f;
    // Messages in the inbox may precede the first levers: only the motion itself shows their
    // arrival.
    std::optional<TimeNs> moving_ns;
    const auto drive = [&](const Payload& payload) {
      peer.Publish("rt/red/delta_can", levers.Encode());
      const JointView joints = JointsOf(payload);
      const bool moves = joints.velocity.at("boom") > 0.05 && joints.velocity.at("slew") > 0.05;
      if (moves && !moving_ns) moving_ns = joints.t_ns;
      return moving_ns && joints.t_ns > *moving_ns + kMoving_ns;
    };
    ASSERT_TRUE(peer.WaitForReader("rt/red/delta_can"));
    messages_["rt/red/joint_states"] = Require(peer.Next("rt/red/joint_states", drive), "driven");
    ASSERT_TRUE(moving_ns);
    for (const auto& [topic, type] : Topics()) {
      const auto after = [&](const Payload& payload) {
        return StampOf(topic, payload) > *moving_ns + kMoving_ns / 2;
      };
      if (!messages_.contains(topic)) messages_[topic] = Require(peer.Next(topic, after), topic);
    }
    run.End();
    recording_ = new Recording(scratch_->path() / "run");
  }
  static void TearDownTestSuite() {
    delete recording_;
    delete scratch_;
  }

  static std::map<std::string, std::string> Topics() {
    const auto sensor = [](const std::string& type) { return "sensor_msgs::msg::dds_::" + type; };
    return {{"rt/red/odom", "nav_msgs::msg::dds_::Odometry_"},
            {"rt/red/joint_states", sensor("JointState_")},
            {"rt/red/cylinders", sensor("JointState_")},
            {"rt/red/ee_pose", "geometry_msgs::msg::dds_::PoseStamped_"},
            {"rt/red/bucket_mass", "std_msgs::msg::dds_::Float64_"},
            {"rt/tf", "tf2_msgs::msg::dds_::TFMessage_"},
            {"rt/red/imu_boom", sensor("Imu_")},
            {"rt/red/gps_left/fix", sensor("NavSatFix_")},
            {"rt/red/encoders", sensor("JointState_")},
            {"rt/red/camera/image_raw", sensor("Image_")},
            {"rt/red/camera/camera_info", sensor("CameraInfo_")},
            {"rt/red/camera/depth/image_raw", sensor("Image_")},
            {"rt/red/camera/depth/camera_info", sensor("CameraInfo_")},
            {"rt/red/camera/semantic/image_raw", sensor("Image_")},
            {"rt/red/camera/instance/image_raw", sensor("Image_")},
            {"rt/red/lidar/points", sensor("PointCloud2_")}};
  }
  static bool IsReliable(const std::string& topic) {
    return topic != "rt/red/imu_boom" && topic != "rt/red/gps_left/fix" &&
           topic != "rt/red/encoders";
  }
  static TimeNs StampOf(const std::string& topic, const Payload& payload) {
    CdrReader cdr(payload);
    if (topic == "rt/red/bucket_mass") return std::numeric_limits<TimeNs>::max();
    if (topic == "rt/tf") cdr.U32();
    return cdr.Time();
  }

  static const Payload& Of(const std::string& below) { return messages_.at("rt/red/" + below); }

  /// The value of truth/red/joints.csv at a time.
  static double Truth(TimeNs t_ns, const std::string& column) {
    static const TableRecording table = recording_->LoadTable("truth/red/joints.csv");
    const auto c = std::ranges::find(table.columns, column) - table.columns.begin();
    return table.rows.at(RowAt(table.t_ns, t_ns)).at(c);
  }
  static TruthPose TruePose(TimeNs t_ns) {
    const PoseRecording recording = recording_->LoadPose("truth/red/pose.csv");
    return At(recording.poses, t_ns);
  }
  template <typename T>
  static T At(const std::vector<T>& samples, TimeNs t_ns) {
    const auto found = std::ranges::find(samples, t_ns, &T::t_ns);
    EXPECT_NE(found, samples.end()) << "no row at " << t_ns;
    return found == samples.end() ? T{} : *found;
  }
  static std::size_t RowAt(const std::vector<TimeNs>& times, TimeNs t_ns) {
    return std::ranges::find(times, t_ns) - times.begin();
  }

  static inline ScratchDirectory* scratch_ = nullptr;
  static inline Recording* recording_ = nullptr;
  static inline std::map<std::string, Payload> messages_;
};

struct Transform {
  TimeNs t_ns = 0;
  std::string parent;
  Vec3 p = Vec3::Zero();
  Quat q = Quat::Identity();
};

Vec3 ReadVec3(CdrReader* cdr) {
  const auto v = cdr->Array<3>();
  return {v[0], v[1], v[2]};
}

Quat ReadQuat(CdrReader* cdr) {
  const auto v = cdr->Array<4>();
  return {v[3], v[0], v[1], v[2]};
}

/// By the child's frame.
std::map<std::string, Transform> TransformsOf(const Payload& payload) {
  CdrReader cdr(payload);
  std::map<std::string, Transform> transforms;
  for (std::uint32_t n = cdr.U32(); n > 0; --n) {
    Transform t{.t_ns = cdr.Time(), .parent = cdr.Text()};
    const std::string child = cdr.Text();
    t.p = ReadVec3(&cdr);
    t.q = ReadQuat(&cdr);
    transforms[child] = t;
  }
  EXPECT_TRUE(cdr.AtEnd());
  return transforms;
}

// Rates in the files are means over two steps of the physics, 2 ms apart.
constexpr double kRateStep = 0.03;
constexpr TimeNs kStep_ns = 2'000'000;

TEST_F(DrivenRun, OdometryIsTheTruePoseWithItsVelocitiesInTheMachinesFrame) {
  CdrReader odom(Of("odom"));
  const TruthPose truth = TruePose(odom.Time());
  EXPECT_EQ(odom.Text(), "map");
  EXPECT_EQ(odom.Text(), "red/undercarriage");
  EXPECT_LT((ReadVec3(&odom) - truth.X_WB.translation()).norm(), 1e-9);
  const Quat q = ReadQuat(&odom);
  EXPECT_LT(q.angularDistance(Quat(truth.X_WB.linear())), 1e-7);
  odom.Array<36>();
  const Vec3 v_B_mps = ReadVec3(&odom), w_B_radps = ReadVec3(&odom);
  EXPECT_LT((q * v_B_mps - truth.v_WB_mps).norm(), kRateStep);
  EXPECT_LT((w_B_radps - truth.w_WB_B_radps).norm(), kRateStep);
  EXPECT_GT(v_B_mps.norm(), 0.1) << "it travels";
}

TEST_F(DrivenRun, JointStatesAreTheTrueOnes) {
  const JointView joints = JointsOf(Of("joint_states"));
  EXPECT_EQ(joints.position.size(), 8u);
  for (const auto& [name, position] : joints.position) {
    EXPECT_NEAR(position, Truth(joints.t_ns, name + "_rad"), 1e-9) << name;
    // A row's rate is the mean over the next step; here that of the neighbouring steps.
    const double rate_radps = 0.5 * (Truth(joints.t_ns - kStep_ns, name + "_radps") +
                                     Truth(joints.t_ns, name + "_radps"));
    EXPECT_NEAR(joints.velocity.at(name), rate_radps, 0.02 * std::abs(rate_radps) + 1e-3) << name;
    const double effort_nm = Truth(joints.t_ns, name + "_nm");
    EXPECT_NEAR(joints.effort.at(name), effort_nm, 1e-6 * std::abs(effort_nm)) << name;
  }
  EXPECT_GT(joints.velocity.at("boom"), 0.05);
  EXPECT_GT(joints.velocity.at("slew"), 0.05);
  EXPECT_GT(joints.effort.at("boom"), 1000) << "holds the arm and the bucket";
}

TEST_F(DrivenRun, CylindersAreAsFarOutAsTheirPinsAreApart) {
  const JointView cylinders = JointsOf(Of("cylinders"));
  const TableRecording truth = recording_->LoadTable("truth/red/hydraulics.csv");
  const std::vector<double>& row = truth.rows.at(RowAt(truth.t_ns, cylinders.t_ns));
  EXPECT_EQ(cylinders.position.size(), 5u);
  for (const auto& [name, stroke_m] : cylinders.position) {
    const auto column = std::ranges::find(truth.columns, name + "_stroke_m");
    EXPECT_NEAR(stroke_m, row.at(column - truth.columns.begin()), 1e-9) << name;
  }
  EXPECT_GT(cylinders.velocity.at("boom_cylinder"), 0.01) << "raises the boom";
  EXPECT_GT(cylinders.effort.at("boom_cylinder"), 5000) << "and carries it";
}

TEST_F(DrivenRun, EndEffectorIsWhereTheJointAnglesLead) {
  CdrReader pose(Of("ee_pose"));
  const TimeNs t_ns = pose.Time();
  EXPECT_EQ(pose.Text(), "red/undercarriage");
  const auto q = [&](const std::string& joint) { return Truth(t_ns, joint + "_rad"); };
  // tb235.yaml: pins, and the bucket's pitch of 45 degrees less than the sum of the angles.
  const double boom = q("boom"), arm = boom + q("arm"), bucket = arm + q("bucket") - 45 * kDeg;
  const double x_m = 0.18 + 2.5 * std::cos(boom) + 1.545 * std::cos(arm) + 0.78 * std::cos(bucket);
  const double z_m = 0.86 + 2.5 * std::sin(boom) + 1.545 * std::sin(arm) + 0.78 * std::sin(bucket);
  const Quat slewed(Eigen::AngleAxisd(q("slew"), Vec3::UnitZ()));
  const Quat swung(Eigen::AngleAxisd(q("swing"), Vec3::UnitZ()));
  const Vec3 tip_B = slewed * (Vec3(0.62, 0, 0) + swung * Vec3(x_m, 0, z_m));
  EXPECT_LT((ReadVec3(&pose) - tip_B).norm(), 1e-6);
  const Vec3 along_B = slewed * (swung * Vec3(std::cos(bucket), 0, std::sin(bucket)));
  EXPECT_LT((ReadQuat(&pose) * Vec3::UnitX() - along_B).norm(), 1e-6);
  EXPECT_TRUE(pose.AtEnd());
  EXPECT_EQ(CdrReader(Of("bucket_mass")).F64(), Truth(t_ns, "bucket_soil_kg"));
}

TEST_F(DrivenRun, TransformsLeadFromTheMapThroughTheJointsToTheSensors) {
  auto to = TransformsOf(messages_.at("rt/tf"));
  const TimeNs t_ns = to.at("red/undercarriage").t_ns;
  const Transform root = to.at("red/undercarriage");
  const Pose X_WB = TruePose(t_ns).X_WB;
  EXPECT_EQ(root.parent, "map");
  EXPECT_LT((root.p - X_WB.translation()).norm(), 1e-9);
  EXPECT_LT(root.q.angularDistance(Quat(X_WB.linear())), 1e-7);
  // tb235.yaml: the boom on the swing post, turning about -y.
  const Transform boom = to.at("red/boom");
  EXPECT_LT((boom.p - Vec3(0.18, 0, 0.20)).norm(), 1e-6);
  const Quat raised(Eigen::AngleAxisd(Truth(t_ns, "boom_rad"), Vec3(0, -1, 0)));
  EXPECT_LT(boom.q.angularDistance(raised), 1e-6);
  const Transform upper = to.at("red/upper");
  EXPECT_EQ(upper.parent, "red/undercarriage");
  EXPECT_LT((upper.p - Vec3(0, 0, 0.56)).norm(), 1e-6);
  EXPECT_LT(
      upper.q.angularDistance(Quat(Eigen::AngleAxisd(Truth(t_ns, "slew_rad"), Vec3::UnitZ()))),
      1e-6);
  for (const auto& [child, transform] : to) EXPECT_EQ(transform.t_ns, t_ns) << child;
  // The rig's camera: 30 degrees down.
  auto fixed = TransformsOf(messages_.at("rt/tf_static"));
  const Transform camera = fixed.at("red/camera");
  EXPECT_EQ(camera.parent, "red/upper");
  EXPECT_LT((camera.p - Vec3(0.8, 0.3, 1.8)).norm(), 1e-9);
  EXPECT_LT((camera.q * Vec3::UnitX() - Vec3(std::sqrt(0.75), 0, -0.5)).norm(), 1e-9);
  const Transform optical = fixed.at("red/camera_optical");
  EXPECT_EQ(optical.parent, "red/camera");
  EXPECT_EQ(optical.p.norm(), 0);
  EXPECT_LT((optical.q * Vec3::UnitZ() - Vec3::UnitX()).norm(), 1e-9);
  EXPECT_LT((optical.q * Vec3::UnitX() + Vec3::UnitY()).norm(), 1e-9);
  EXPECT_EQ(fixed.at("red/imu_boom").parent, "red/boom");
  EXPECT_LT((fixed.at("red/imu_boom").p - Vec3(1, 0, 0.3)).norm(), 1e-9);
}

TEST_F(DrivenRun, ImuIsTheRecordedOneWithTheVarianceOfItsDataSheet) {
  CdrReader imu(Of("imu_boom"));
  const ImuSample sample = At(recording_->LoadImu("red/imu_boom"), imu.Time());
  imu.Text();
  imu.Array<4>();
  imu.Array<9>();
  EXPECT_LT((ReadVec3(&imu) - sample.w_WS_S_radps).norm(), 1e-12);
  // xsens_mti_670.yaml at 100 Hz: 0.007 deg/s/sqrt(Hz) is 0.07 deg/s, 60 ug/sqrt(Hz) is 600 ug.
  const double gyro = std::pow(0.07 * kDeg, 2), accel = std::pow(600e-6 * 9.80665, 2);
  EXPECT_NEAR(imu.Array<9>()[0], gyro, 0.01 * gyro);
  EXPECT_LT((ReadVec3(&imu) - sample.f_S_mps2).norm(), 1e-12);
  EXPECT_NEAR(imu.Array<9>()[4], accel, 0.01 * accel);
  EXPECT_LT(sample.w_WS_S_radps.y(), -0.05) << "the boom rises";
}

TEST_F(DrivenRun, FixIsTheRecordedOneWithItsCovariance) {
  CdrReader fix(Of("gps_left/fix"));
  const GnssSample sample = At(recording_->LoadGnss("red/gnss_left"), fix.Time());
  fix.Text();
  EXPECT_EQ(sample.fix, GnssFix::kRtkFixed);
  EXPECT_EQ(fix.Get<std::int8_t>(), 2);
  EXPECT_EQ(fix.Get<std::uint16_t>(), 1);
  EXPECT_THAT(fix.Array<3>(), ElementsAre(sample.lat_deg, sample.lon_deg, sample.alt_m));
  const Vec3& v = sample.variance_enu_m2;
  EXPECT_GT(v.z(), v.x());
  EXPECT_THAT(fix.Array<9>(), ElementsAre(v.x(), 0, 0, 0, v.y(), 0, 0, 0, v.z()));
  EXPECT_EQ(fix.Get<std::uint8_t>(), 2);
}

TEST_F(DrivenRun, EncodersAreTheRecordedOnes) {
  CdrReader encoders(Of("encoders"));
  const EncoderRecording recording = recording_->LoadEncoder("red/encoders");
  const EncoderSample sample = At(recording.samples, encoders.Time());
  encoders.Text();
  const auto names = encoders.Get<std::vector<std::string>>();
  ASSERT_EQ(names.size(), recording.axes.size());
  for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(names[i], recording.axes[i].name);
  EXPECT_EQ(encoders.Get<std::vector<double>>(), sample.q_rad);
  EXPECT_EQ(encoders.Get<std::vector<double>>(), sample.qd_radps);
  EXPECT_THAT(encoders.Get<std::vector<double>>(), ElementsAre());
}

/// The bytes of an image message, and its time.
std::pair<TimeNs, std::vector<std::uint8_t>> PixelsOf(const Payload& payload) {
  CdrReader image(payload);
  const TimeNs t_ns = image.Time();
  image.Text();
  image.U32();
  image.U32();
  image.Text();
  EXPECT_EQ(image.Get<std::uint8_t>(), 0) << "little-endian";
  image.U32();
  return {t_ns, image.Get<std::vector<std::uint8_t>>()};
}

template <typename T>
std::vector<T> As(const std::vector<std::uint8_t>& bytes) {
  std::vector<T> values(bytes.size() / sizeof(T));
  std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

TEST_F(DrivenRun, PicturesAreTheRecordedOnes) {
  const auto [colour_ns, colour] = PixelsOf(Of("camera/image_raw"));
  EXPECT_EQ(colour, recording_->LoadFrame("red/camera", colour_ns).rgb.data);
  const auto [semantic_ns, semantic] = PixelsOf(Of("camera/semantic/image_raw"));
  EXPECT_EQ(semantic, recording_->LoadFrame("red/camera", semantic_ns).semantic.data);
  const auto [instance_ns, instance] = PixelsOf(Of("camera/instance/image_raw"));
  EXPECT_EQ(As<std::uint16_t>(instance),
            recording_->LoadFrame("red/camera", instance_ns).instance.data);
}

TEST_F(DrivenRun, DepthIsTheRecordedOneAndNanWhereThereIsNone) {
  const auto [t_ns, bytes] = PixelsOf(Of("camera/depth/image_raw"));
  const auto depth_m = As<float>(bytes);
  const std::vector<float> recorded_m = recording_->LoadFrame("red/camera", t_ns).depth_m.data;
  ASSERT_EQ(depth_m.size(), recorded_m.size());
  int measured = 0;
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    if (recorded_m[i] == 0) {
      EXPECT_TRUE(std::isnan(depth_m[i]));
    } else {
      EXPECT_NEAR(depth_m[i], recorded_m[i], 0.00051) << "files have whole millimetres";
      ++measured;
    }
  }
  EXPECT_GT(measured, 1000);
}

TEST_F(DrivenRun, CameraInfoHasTheFocalLengthOfItsFieldOfView) {
  for (const std::string below : {"camera/camera_info", "camera/depth/camera_info"}) {
    CdrReader info(Of(below));
    info.Time();
    EXPECT_EQ(info.Text(), "red/camera_optical");
    EXPECT_EQ(info.U32(), 48u);
    EXPECT_EQ(info.U32(), 64u);
    info.Text();
    EXPECT_THAT(info.Get<std::vector<double>>(), ElementsAre(0, 0, 0, 0, 0));
    // realsense_d435i.yaml: 54.5 degrees across 64 pixels, whose middle is at 31.5.
    const auto f_px = testing::DoubleNear(32 / std::tan(54.5 / 2 * kDeg), 1e-6);
    EXPECT_THAT(info.Array<9>(), ElementsAre(f_px, 0, 31.5, 0, f_px, 23.5, 0, 0, 1));
  }
}

TEST_F(DrivenRun, PointsAreTheRecordedOnesWithRingAndTime) {
  CdrReader cloud(Of("lidar/points"));
  const LidarScan scan = recording_->LoadScan("red/lidar", cloud.Time());
  cloud.Text();
  cloud.U32();
  ASSERT_EQ(cloud.U32(), scan.points.size());
  std::map<std::string, std::uint32_t> offset;
  for (std::uint32_t n = cloud.U32(); n > 0; --n) {
    const std::string name = cloud.Text();
    offset[name] = cloud.U32();
    cloud.Get<std::uint8_t>();
    EXPECT_EQ(cloud.U32(), 1u);
  }
  cloud.Get<bool>();
  const std::uint32_t step = cloud.U32();
  cloud.U32();
  const auto bytes = cloud.Get<std::vector<std::uint8_t>>();
  ASSERT_EQ(bytes.size(), step * scan.points.size());
  std::set<std::uint16_t> rings;
  float last_s = 0;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const auto value = [&](const std::string& name, auto zero) {
      std::memcpy(&zero, &bytes[step * i + offset.at(name)], sizeof zero);
      return zero;
    };
    const LidarPoint& point = scan.points[i];
    ASSERT_EQ(value("x", 0.0f), point.x_m);
    ASSERT_EQ(value("y", 0.0f), point.y_m);
    ASSERT_EQ(value("z", 0.0f), point.z_m);
    ASSERT_EQ(value("intensity", 0.0f), point.intensity);
    ASSERT_EQ(value("ring", std::uint16_t{}), point.ring);
    ASSERT_EQ(value("label", std::uint8_t{}), point.label);
    ASSERT_EQ(value("instance", std::uint16_t{}), point.instance);
    ASSERT_NEAR(value("time", 0.0f), 1e-9 * point.time_offset_ns, 1e-8);
    rings.insert(point.ring);
    last_s = std::max(last_s, value("time", 0.0f));
  }
  EXPECT_GT(rings.size(), 8u) << "of 16 beams those that meet the ground";
  EXPECT_GT(last_s, 0.05) << "of a revolution of 0.1 s";
  EXPECT_LT(last_s, 0.1);
}

}  // namespace
}  // namespace tera
