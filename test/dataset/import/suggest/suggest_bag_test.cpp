#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/faults.h"
#include "core/units.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/recording.h"
#include "dataset/format/sample_recording.h"
#include "dataset/import/bag_bytes.h"
#include "dataset/import/import_csv.h"
#include "dataset/import/suggest/suggest.h"

/// Bags as written by drivers of real machines. Every suggestion is imported.

namespace tera {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;
namespace fs = std::filesystem;

constexpr std::int64_t kEpoch_s = 1'700'000'000, kStep_ns = 10'000'000;
constexpr std::int64_t kFirst_ns = kEpoch_s * 1'000'000'000;

struct StampOf {
  std::int32_t s = 0;
  std::uint32_t ns = 0;
};
StampOf StampAt(int k) {
  return {static_cast<std::int32_t>(kEpoch_s), static_cast<std::uint32_t>(k * kStep_ns)};
}
std::int64_t LogAt(int k) { return kFirst_ns + 2'000'000 + k * kStep_ns; }

const std::vector<double> kNine(9, 0.0);

Cdr ImuMessage(StampOf stamp, double wx = 0.1) {
  return Cdr()
      .Header(stamp.s, stamp.ns)
      .Numbers({0, 0, 0, 1})
      .Numbers(kNine)
      .Numbers({wx, 0.2, 0.3})
      .Numbers(kNine)
      .Numbers({0.5, 0.25, 9.8})
      .Numbers(kNine);
}
Cdr FixMessage(StampOf stamp, std::int8_t status, double lat_deg, double variance_m2,
               std::uint8_t covariance_type) {
  std::vector<double> covariance(9, 0.0);
  covariance[0] = covariance[4] = covariance[8] = variance_m2;
  return Cdr()
      .Header(stamp.s, stamp.ns)
      .Add(status)
      .Add(std::uint16_t{1})
      .Numbers({lat_deg, lat_deg == 0 ? 0.0 : -71.25, lat_deg == 0 ? 0.0 : 90.0})
      .Numbers(covariance)
      .Add(covariance_type);
}
Cdr JointsMessage(StampOf stamp, const std::vector<std::string>& names,
                  const std::vector<double>& positions, const std::vector<double>& velocities) {
  Cdr message;
  message.Header(stamp.s, stamp.ns).Add(static_cast<std::uint32_t>(names.size()));
  for (const std::string& name : names) message.Text(name);
  return message.Sequence(positions).Sequence(velocities).Sequence({});
}
/// The turn about z by twice the angle whose cosine is 0.8 and whose sine is 0.6.
const std::vector<double> kTurned = {0, 0, 0.6, 0.8};
Cdr PoseMessage(StampOf stamp, double x_m, const std::vector<double>& turn = kTurned) {
  return Cdr().Header(stamp.s, stamp.ns, "map").Numbers({x_m, 2, 3}).Numbers(turn);
}

class SuggestBag : public ::testing::Test {
 protected:
  void Write(const TopicsMcap& bag) { WriteWholeFile(scratch_.path() / "log.mcap", bag.bytes()); }
  /// The recording of the written bag, by its suggestion.
  Recording Suggested() {
    yaml_ = SuggestMapping(scratch_.path() / "log.mcap");
    return Imported(yaml_);
  }
  Recording Imported(const std::string& yaml) {
    WriteWholeFile(scratch_.path() / "mapping.yaml", yaml);
    fs::remove_all(scratch_.path() / "out");
    try {
      report_ = ImportCsv(scratch_.path() / "mapping.yaml", scratch_.path() / "out");
    } catch (const InputError& fault) {
      ADD_FAILURE() << fault.what() << "\n" << yaml;
      throw;
    }
    return Recording(scratch_.path() / "out");
  }
  std::string FaultOf(const std::string& keys) {
    WriteWholeFile(scratch_.path() / "mapping.yaml",
                   "name: n\nmachine: machine\nzero: start\nfile: log.mcap\n" + keys);
    try {
      ImportCsv(scratch_.path() / "mapping.yaml", "", {.checks_only = true});
    } catch (const InputError& fault) {
      return fault.what();
    }
    return "no fault";
  }
  ScratchDirectory scratch_;
  std::string yaml_;
  ImportReport report_;
};

constexpr char kImuName[] = "sensor_msgs/msg/Imu", kFixName[] = "sensor_msgs/msg/NavSatFix",
               kJointsName[] = "sensor_msgs/msg/JointState",
               kPoseName[] = "geometry_msgs/msg/PoseStamped", kTfName[] = "tf2_msgs/msg/TFMessage",
               kFloatName[] = "std_msgs/msg/Float32";

TEST_F(SuggestBag, StampsThatNobodyFilledAreThoseOfTheRecorder) {
  for (const StampOf stamp : {StampOf{0, 0}, StampOf{17, 5}}) {  // 0, or the same in all
    TopicsMcap bag;
    for (int k = 0; k < 4; ++k) bag.Message("/imu", kImuName, LogAt(k), ImuMessage(stamp));
    Write(bag);
    const auto imu = Suggested().LoadImu("machine/imu");
    ASSERT_EQ(imu.size(), 4u);
    EXPECT_EQ(imu[3].t_ns, 3 * kStep_ns);
    EXPECT_EQ(report_.zero_ns, LogAt(0));
    EXPECT_THAT(yaml_, HasSubstr("    time: {column: log_time}   # guessed: "));
  }
  EXPECT_THAT(yaml_, HasSubstr("3 of 4 of their own repeat the one before"));
}

TEST_F(SuggestBag, StampsThatRepeatNowAndThenAreLeftOutAndTold) {
  TopicsMcap bag;
  for (int k = 0; k < 8; ++k) {
    bag.Message("/imu", kImuName, LogAt(k), ImuMessage(StampAt(k == 5 ? 4 : k), k));
  }
  Write(bag);
  const auto imu = Suggested().LoadImu("machine/imu");
  ASSERT_EQ(imu.size(), 7u);
  EXPECT_EQ(imu[5].w_WS_S_radps.x(), 6);
  EXPECT_EQ(report_.zero_ns, kFirst_ns);
  EXPECT_THAT(yaml_, HasSubstr("valid_if: [{column: header.stamp, changes: true}]   # guessed: 1 "
                               "of 8 times repeat the one before"));
}

TEST_F(SuggestBag, StampsThatGoBackOrStartUnfilledAreNoTimes) {
  TopicsMcap back, late;
  for (int k = 0; k < 6; ++k) {
    back.Message("/imu", kImuName, LogAt(k), ImuMessage(StampAt(k == 3 ? 0 : k)));
    late.Message("/imu", kImuName, LogAt(k), ImuMessage(k < 2 ? StampOf{} : StampAt(k)));
  }
  Write(back);
  EXPECT_EQ(Suggested().LoadImu("machine/imu").size(), 6u);
  EXPECT_THAT(yaml_,
              HasSubstr("time: {column: log_time}   # guessed: 1 of 6 of their own go back"));
  Write(late);
  EXPECT_EQ(Suggested().LoadImu("machine/imu").size(), 4u);
  EXPECT_THAT(yaml_, HasSubstr("{column: header.stamp, above: 0}"));
}

TEST_F(SuggestBag, StampsOfAnotherClockAreThoseOfTheRecorderWhereOthersHaveHis) {
  TopicsMcap both, alone;
  for (int k = 0; k < 4; ++k) {
    const StampOf since_boot{5, static_cast<std::uint32_t>(k * kStep_ns)};
    both.Message("/imu", kImuName, LogAt(k), ImuMessage(since_boot));
    both.Message("/joints", kJointsName, LogAt(k), JointsMessage(StampAt(k), {"boom"}, {0.1}, {}));
    alone.Message("/imu", kImuName, LogAt(k), ImuMessage(since_boot));
  }
  Write(both);
  EXPECT_EQ(Suggested().LoadImu("machine/imu")[1].t_ns, 12'000'000);  // 2 ms after the joints
  EXPECT_THAT(yaml_, HasSubstr("from another clock"));
  Write(alone);
  EXPECT_EQ(Suggested().LoadImu("machine/imu").size(), 4u);
  EXPECT_THAT(yaml_, Not(HasSubstr("time:")));
}

TEST_F(SuggestBag, AClockThatBeginsAtZeroIsFilled) {
  TopicsMcap bag;
  for (int k = 0; k < 3; ++k) {
    const StampOf stamp{0, static_cast<std::uint32_t>(k * kStep_ns)};
    bag.Message("/imu", kImuName, k * kStep_ns, ImuMessage(stamp));
  }
  Write(bag);
  EXPECT_EQ(Suggested().LoadImu("machine/imu").size(), 3u);
  EXPECT_THAT(yaml_, Not(HasSubstr("valid_if")));
}

TEST_F(SuggestBag, WithoutAnyTimeThatGoesOnRowsAreCounted) {
  TopicsMcap bag;
  for (int k = 0; k < 4; ++k) bag.Message("/imu", kImuName, kFirst_ns, ImuMessage({}));
  Write(bag);
  EXPECT_EQ(Suggested().LoadImu("machine/imu").size(), 4u);
  EXPECT_THAT(yaml_, HasSubstr("time: {interval: 0.01, unit: s, offset: 1700000000"));
}

TEST_F(SuggestBag, UnknownVariancesAreConstantsToFillIn) {
  TopicsMcap bag;
  bag.Message("/fix", kFixName, LogAt(0), FixMessage(StampAt(0), -1, 0, 0, 0));
  for (int k = 1; k < 4; ++k) {
    bag.Message("/fix", kFixName, LogAt(k), FixMessage(StampAt(k), 0, 46.75 + 1e-6 * k, 0, 0));
  }
  Write(bag);
  const auto fixes = Suggested().LoadGnss("machine/fix");
  ASSERT_EQ(fixes.size(), 4u);
  EXPECT_EQ(fixes[0].fix, GnssFix::kNone);
  EXPECT_EQ(fixes[1].variance_enu_m2, Vec3(4, 4, 9));
  EXPECT_NEAR(fixes[1].enu_m.norm(), 0, 1e-3);  // the origin is the first fix, not the previous row
  EXPECT_THAT(yaml_, HasSubstr("var_e: {constant: 4}   # guessed: 3 messages do not know it"));
}

TEST_F(SuggestBag, FixesAtZeroZeroAreLeftOut) {
  TopicsMcap bag;
  for (int k = 0; k < 4; ++k) {
    bag.Message("/fix", kFixName, LogAt(k), FixMessage(StampAt(k), 0, k < 1 ? 0 : -46.75, 1, 2));
  }
  Write(bag);
  const auto fixes = Suggested().LoadGnss("machine/fix");
  ASSERT_EQ(fixes.size(), 3u);
  EXPECT_NEAR(fixes[0].lat_deg, -46.75, 1e-12);
  EXPECT_THAT(yaml_, HasSubstr("{column: latitude, below: 0}"));
}

TEST_F(SuggestBag, JointsOfSeveralPublishersAreChannelsOfTheirOwn) {
  TopicsMcap bag;
  for (int k = 0; k < 6; ++k) {
    const bool is_cab = k % 2 == 0;
    bag.Message("/joint_states", kJointsName, LogAt(k),
                is_cab ? JointsMessage(StampAt(k), {"upper/slew"}, {0.1 * k}, {0.5})
                       : JointsMessage(StampAt(k), {"boom", "arm"}, {0.1 * k, -0.2}, {}));
  }
  Write(bag);
  const Recording recording = Suggested();
  const auto first = recording.LoadEncoder("machine/joint_states");
  const auto second = recording.LoadEncoder("machine/joint_states_2");
  const auto& cab = first.axes.size() == 1 ? first : second;
  const auto& arm = first.axes.size() == 1 ? second : first;
  EXPECT_EQ(cab.axes, (std::vector<EncoderAxis>{{"upper_slew"}}));
  EXPECT_EQ(arm.axes, (std::vector<EncoderAxis>{{"boom"}, {"arm"}}));
  ASSERT_EQ(arm.samples.size(), 3u);
  EXPECT_EQ(arm.samples[1].t_ns, 3 * kStep_ns);
  EXPECT_NEAR(arm.samples[1].q_rad[0], 0.3, 1e-12);
}

TEST_F(SuggestBag, TheMachinesPoseStandsBeforeThoseOfItsPartsAndOfGoals) {
  TopicsMcap bag;
  for (int k = 0; k < 3; ++k) {
    for (const char* part : {"/goal_pose", "/digger/ee_pose", "/camera_pose"}) {
      bag.Message(part, kPoseName, LogAt(k), PoseMessage(StampAt(k), 50));
    }
    bag.Message("/digger/pose", kPoseName, LogAt(k), PoseMessage(StampAt(k), k));
  }
  Write(bag);
  const Recording recording = Suggested();
  EXPECT_EQ(recording.LoadPose("truth/machine/pose.csv").poses[2].X_WB.translation(),
            Vec3(2, 2, 3));
  EXPECT_EQ(recording.LoadTable("machine/digger_ee_pose.csv").rows[0][0], 50);
  EXPECT_THAT(yaml_, HasSubstr("/goal_pose (geometry_msgs/PoseStamped): 3 messages, 100 Hz; the "
                               "pose is that of /digger/pose"));
}

TEST_F(SuggestBag, OrientationsThatNobodyFilledAreNoTurn) {
  TopicsMcap bag;
  for (int k = 0; k < 3; ++k) {
    bag.Message("/pose", kPoseName, LogAt(k), PoseMessage(StampAt(k), k, {0, 0, 0, 0}));
  }
  Write(bag);
  const auto poses = Suggested().LoadPose("truth/machine/pose.csv").poses;
  EXPECT_TRUE(poses[1].X_WB.isApprox(Pose(Eigen::Translation3d(1, 2, 3)), 1e-12));
  EXPECT_THAT(yaml_, HasSubstr("the orientation is empty"));
}

// --- Transforms

Cdr TransformsMessage(int k) {
  Cdr message;
  message.Add(std::uint32_t{2});
  message.Header(StampAt(k).s, StampAt(k).ns, "base_link")
      .Text("boom")
      .Numbers({9, 9, 9, 0, 0, 0, 1});
  message.Header(StampAt(k).s, StampAt(k).ns + 500, "/odom")
      .Text("/base_link")
      .Numbers({1.0 * k, 2, 3});
  return message.Numbers(kTurned);
}
Cdr MapMessage(int k) {
  Cdr message;
  message.Add(std::uint32_t{1});
  return message.Header(StampAt(k).s, StampAt(k).ns, "map")
      .Text("odom")
      .Numbers({5, 5, 5, 0, 0, 0, 1});
}

TEST_F(SuggestBag, APairOfFramesOfTransformsIsThePose) {
  TopicsMcap bag;
  for (int k = 0; k < 4; ++k) {
    bag.Message("/tf", kTfName, LogAt(k), k == 2 ? MapMessage(k) : TransformsMessage(k));
  }
  Write(bag);
  const auto poses = Suggested().LoadPose("truth/machine/pose.csv").poses;
  ASSERT_EQ(poses.size(), 3u);
  EXPECT_EQ(poses[2].t_ns, 3 * kStep_ns);
  EXPECT_EQ(poses[2].X_WB.translation(), Vec3(3, 2, 3));
  EXPECT_NEAR(poses[2].X_WB.linear()(0, 0), 0.28, 1e-12);  // 0.8^2 - 0.6^2
  EXPECT_NEAR(poses[2].X_WB.linear()(1, 0), 0.96, 1e-12);  // 2 * 0.6 * 0.8
  EXPECT_EQ(report_.zero_ns, kFirst_ns + 500);             // of the transform, not of the recorder
  EXPECT_THAT(yaml_, AllOf(HasSubstr("parent: odom   # guessed: seen are base_link>boom 3, "
                                     "map>odom 1, odom>base_link 3"),
                           HasSubstr("child: base_link\n")));
}

TEST_F(SuggestBag, TransformsNeedTheirFrames) {
  Write(TopicsMcap().Message("/tf", kTfName, LogAt(0), TransformsMessage(0)));
  EXPECT_THAT(FaultOf("pose: {topic: /tf}\n"),
              AllOf(HasSubstr("has the type tf2_msgs/TFMessage, which holds many transforms"),
                    HasSubstr("it has base_link>boom, odom>base_link")));
  EXPECT_THAT(FaultOf("pose: {topic: /tf, parent: odom, child: base}\n"),
              HasSubstr("/tf has no transform odom>base; it has base_link>boom, odom>base_link"));
  EXPECT_EQ(FaultOf("pose: {topic: /tf, parent: /base_link, child: boom}\n"), "no fault");
}

// --- A topic a number

TEST_F(SuggestBag, TopicsOfOneNumberAreLeversAnglesOrTablesByTheirNames) {
  TopicsMcap bag;
  const auto number = [&](const char* topic, int k, float value) {
    bag.Message(topic, kFloatName, LogAt(k), Cdr().Add(value));
  };
  for (int k = 0; k < 6; ++k) {
    if (k % 2 == 0) number("/cmd/boom", k, 0.25f * static_cast<float>(k));
    if (k % 2 == 1) number("/leftTrack/command", k, -0.5f);
    number("/boom/angle_deg", k, 30.0f);
    number("/bucket_mass", k, 120.0f);
    number("/arm/pressure", k, 7.0f);
  }
  Write(bag);
  const Recording recording = Suggested();
  const TableRecording levers = recording.LoadTable("machine/commands.csv");
  EXPECT_THAT(levers.columns, ElementsAre("boom", "left_track"));
  // Once both have been sent: at each time of either, the other's last value.
  EXPECT_THAT(levers.t_ns,
              ElementsAre(kStep_ns, 2 * kStep_ns, 3 * kStep_ns, 4 * kStep_ns, 5 * kStep_ns));
  EXPECT_EQ(levers.rows[0], (std::vector<double>{0, -0.5}));
  EXPECT_EQ(levers.rows[2], (std::vector<double>{0.5, -0.5}));
  EXPECT_EQ(levers.rows[4], (std::vector<double>{1, -0.5}));
  EXPECT_NEAR(recording.LoadEncoder("machine/boom_angle_deg").samples[0].q_rad[0], 30 * kDeg, 1e-9);
  EXPECT_EQ(recording.LoadTable("machine/bucket_mass.csv").columns.front(), "mass_kg");
  EXPECT_EQ(recording.LoadTable("machine/arm_pressure.csv").rows[0][0], 7);
}

TEST_F(SuggestBag, AnglesThatBeginAnewGoOn) {
  TopicsMcap bag;
  // 15 deg per message, from 180 deg on, as 0 to 2 pi and 0 to 360.
  for (int k = 0; k < 30; ++k) {
    const double angle_deg = (180 + 15 * k) % 360;
    bag.Message("/joint_states", kJointsName, LogAt(k),
                JointsMessage(StampAt(k), {"slew", "boom"}, {angle_deg * kDeg, 0.5}, {}));
    bag.Message("/upper/slew_angle", kFloatName, LogAt(k),
                Cdr().Add(static_cast<float>(angle_deg)));
  }
  Write(bag);
  const Recording recording = Suggested();
  for (const char* channel : {"machine/joint_states", "machine/upper_slew_angle"}) {
    const auto samples = recording.LoadEncoder(channel).samples;
    ASSERT_EQ(samples.size(), 30u);
    EXPECT_NEAR(samples[29].q_rad[0] - samples[0].q_rad[0], 29 * 15 * kDeg, 1e-5) << channel;
  }
}

TEST_F(SuggestBag, RatesOfAUnitInDegreesAreKnownByGravityAndThoseOfNumbersAreAskedFor) {
  TopicsMcap bag;
  // A boom that pitches by 20 deg there and back in 8 s, at 20 Hz.
  for (int k = 0; k < 400; ++k) {
    const double w = 2 * kPi / 8, t_s = 0.05 * k, pitch_rad = 20 * kDeg * std::sin(w * t_s);
    const StampOf stamp{static_cast<std::int32_t>(kEpoch_s + k / 20),
                        static_cast<std::uint32_t>(k % 20 * 50'000'000)};
    bag.Message("/imu", kImuName, kFirst_ns + k * 50'000'000LL,
                Cdr()
                    .Header(stamp.s, stamp.ns)
                    .Numbers({0, 0, 0, 1})
                    .Numbers(kNine)
                    .Numbers({0, 20 * w * std::cos(w * t_s), 0})
                    .Numbers(kNine)
                    .Numbers({-9.81 * std::sin(pitch_rad), 0, 9.81 * std::cos(pitch_rad)})
                    .Numbers(kNine));
  }
  Write(bag);
  EXPECT_NEAR(Suggested().LoadImu("machine/imu").at(0).w_WS_S_radps.y(), 20 * kDeg * 2 * kPi / 8,
              1e-6);
  TopicsMcap numbers;
  for (int k = 0; k < 9; ++k) {
    numbers.Message("/boom/velocity", kFloatName, LogAt(k), Cdr().Add(5.f + k));
  }
  Write(numbers);
  WriteWholeFile(scratch_.path() / "mapping.yaml", SuggestMapping(scratch_.path() / "log.mcap"));
  EXPECT_THAT([&] { ImportCsv(scratch_.path() / "mapping.yaml", "", {.checks_only = true}); },
              ThrowsFault(FaultKind::kNoSuchName, "joints[0].rate.unit"));
}

TEST_F(SuggestBag, LeversOfDeltaCanAreCommands) {
  TopicsMcap bag;
  for (int k = 0; k < 3; ++k) {
    Cdr message;
    message.Header(StampAt(k).s, StampAt(k).ns);
    for (const float lever : {0.f, 0.5f, 0.f, -0.25f, 1.f, -1.f, 0.f, 0.f}) message.Add(lever);
    message.Add(std::uint8_t{1}).Add(std::uint8_t{0}).Add(std::uint8_t{1}).Add(std::uint32_t{0});
    bag.Message("/digger/delta_can", "tera_msgs/msg/DeltaCAN", LogAt(k), message);
  }
  Write(bag);
  const TableRecording levers = Suggested().LoadTable("machine/commands.csv");
  EXPECT_THAT(levers.columns, ElementsAre("boom", "bucket", "left_track", "right_track"));
  EXPECT_EQ(levers.rows[1], (std::vector<double>{0.5, -0.25, 1, -1}));
  EXPECT_THAT(yaml_, HasSubstr("# always 0, slew: "));
}

// --- Topics without import

TEST_F(SuggestBag, CamerasAreEntriesWithTheCameraInfoBesideThem) {
  TopicsMcap bag;
  Cdr grey;  // 2 x 1 px
  grey.Header(1, 0).Add(std::uint32_t{1}).Add(std::uint32_t{2}).Text("mono8");
  grey.Add(std::uint8_t{0}).Add(std::uint32_t{2}).Add(std::uint32_t{2}).Add('a').Add('b');
  Cdr packed;
  packed.Header(1, 0).Text("compressedDepth").Add(std::uint32_t{0});
  bag.Message("/front/image_raw", "sensor_msgs/msg/Image", LogAt(0), grey);
  bag.Message("/front/camera_info", "sensor_msgs/msg/CameraInfo", LogAt(0), Cdr());
  bag.Message("/front/image_rect", "sensor_msgs/msg/Image", LogAt(1), grey);
  bag.Message("/rear/image", "sensor_msgs/msg/Image", LogAt(2), grey);
  bag.Message("/rear/depth/compressedDepth", "sensor_msgs/msg/CompressedImage", LogAt(3), packed);
  Write(bag);
  const std::string yaml = SuggestMapping(scratch_.path() / "log.mcap");
  EXPECT_THAT(yaml, HasSubstr("cameras:\n  - {name: front_image_raw, topic: "
                              "\"/front/image_raw\", info: \"/front/camera_info\"}\n"));
  EXPECT_THAT(yaml, HasSubstr("info: \"/front/camera_info\", rectified: true}   # guessed"));
  EXPECT_THAT(yaml, HasSubstr("topic: \"/rear/image\", uncalibrated: true}   # guessed"));
  EXPECT_THAT(yaml, HasSubstr("need the raw depth topic"));
}

TEST_F(SuggestBag, LidarsAreEntriesThatSayWhatTheyNeed) {
  TopicsMcap bag;
  bag.Message("/roof/points", "sensor_msgs/msg/PointCloud2", LogAt(0), Cdr());
  bag.Message("/front/packets", "velodyne_msgs/msg/VelodyneScan", LogAt(1), Cdr());
  bag.Message("/left/packets", "pandar_msgs/msg/PandarScan", LogAt(2), Cdr());
  bag.Message("/ouster/packets", "ouster_sensor_msgs/msg/PacketMsg", LogAt(3), Cdr());
  Write(bag);
  const std::string yaml = SuggestMapping(scratch_.path() / "log.mcap");
  EXPECT_THAT(yaml, HasSubstr("lidars:\n  - {name: roof_points, topic: \"/roof/points\"}\n"));
  EXPECT_THAT(yaml,
              HasSubstr("  - {name: front_packets, topic: \"/front/packets\", unit: unknown}"));
  EXPECT_THAT(yaml, HasSubstr("  - {name: left_packets, topic: \"/left/packets\", unit: qt64}"));
  EXPECT_THAT(
      yaml, HasSubstr("  - {name: ouster_packets, topic: \"/ouster/packets\", metadata: unknown}"));
}

TEST_F(SuggestBag, WhatStandsInThePlaceOfABagIsToldByItsBytes) {
  const auto suggest = [&] { SuggestMapping(scratch_.path() / "log.mcap"); };
  WriteWholeFile(scratch_.path() / "log.mcap",
                 "version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 990\n");
  EXPECT_THAT(suggest,
              ThrowsMessage<InputError>(AllOf(HasSubstr("log.mcap: is a pointer of Git LFS"),
                                              HasSubstr("git lfs pull"))));
  EXPECT_THAT(FaultOf("imus: [{name: imu, topic: /imu}]\n"), HasSubstr("git lfs pull"));
  WriteWholeFile(scratch_.path() / "log.mcap", std::string("\x1f\x8b\x08\x00", 4));
  EXPECT_THAT(suggest, ThrowsMessage<InputError>(HasSubstr("gunzip ")));
  WriteWholeFile(scratch_.path() / "log.mcap", std::string("PK\x03\x04\x14\x00", 6));
  EXPECT_THAT(suggest, ThrowsMessage<InputError>(HasSubstr("unzip ")));
}

TEST_F(SuggestBag, BagsWithoutAnIndexAreToldWithTheCommandThatMendsThem) {
  WriteWholeFile(scratch_.path() / "log.mcap", SmallMcap("std_msgs/msg/Float64", "float64 data\n")
                                                   .Message(1, Cdr().Add(1.0).bytes())
                                                   .WithoutEnd());
  EXPECT_THAT(FaultOf("tables: [{name: t, topic: /t, columns: {v: {column: data, unit: '1'}}}]\n"),
              AllOf(HasSubstr("ends without its footer and index"),
                    HasSubstr("mcap recover " + (scratch_.path() / "log.mcap").string())));
  fs::create_directory(scratch_.path() / "run");
  WriteWholeFile(scratch_.path() / "run/run_0.db3", "SQLite format 3");
  EXPECT_THAT([&] { SuggestMapping(scratch_.path() / "run"); },
              ThrowsMessage<InputError>(
                  AllOf(HasSubstr("holds run_0.db3 of a rosbag2 and no metadata.yaml"),
                        HasSubstr("ros2 bag reindex " + (scratch_.path() / "run").string()))));
  // The beginning of a ROS 1 bag after its recorder was stopped: no index, no chunk yet.
  const auto field = [](const std::string& text) { return Packed().Text(text).bytes(); };
  const std::string head =
      field(std::string("op=\x03", 4)) + field("index_pos=" + std::string(8, '\0')) +
      field("conn_count=" + std::string(4, '\0')) + field("chunk_count=" + std::string(4, '\0'));
  WriteWholeFile(scratch_.path() / "log.mcap",
                 "#ROSBAG V2.0\n" + Packed().Text(head).Text(std::string(10, ' ')).bytes());
  EXPECT_THAT([&] { SuggestMapping(scratch_.path() / "log.mcap"); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("was not closed and has no index"),
                                              HasSubstr("rosbag reindex "))));
}

}  // namespace
}  // namespace tera
