#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "app/other_program.h"
#include "app/refused.h"
#include "core/faults.h"
#include "core/motion.h"
#include "core/units.h"
#include "dataset/format/recording.h"

// `tera export` from a user's view, with its formats read by independent programs.

namespace tera {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;
namespace fs = std::filesystem;

/// An excavator that holds its boom up, with two receivers, an inertial unit on the boom, a small
/// lidar, and the poses of all.
constexpr const char* kExcavator = R"(name: small
seed: 5
duration_s: 0.3
site: {lat_deg: 46.78, lon_deg: -71.27, height_m: 90}
terrain: {size_m: [14, 14], cell_m: 0.1, soil: dirt}
record: {poses_hz: 50}
machines:
  - name: digger
    machine: tera:config/machines/tb235.yaml
    start: {xy_m: [0, 0], yaw_deg: 30, joints_deg: {boom: 40, arm: -95, bucket: -20}}
    operator: {type: idle}
    rig: {sensors: [
      {name: imu_boom, preset: tera:config/sensors/xsens_mti_670.yaml, link: boom, xyz_m: [1, 0, 0.5], rpy_deg: [0, 10, 20], rate_hz: 100},
      {name: gnss_left, preset: tera:config/sensors/rtk_f9p.yaml, link: upper, xyz_m: [-0.9, 0.5, 1.2]},
      {name: gnss_right, preset: tera:config/sensors/rtk_f9p.yaml, link: upper, xyz_m: [-0.9, -0.5, 1.2]},
      {name: lidar, preset: tera:config/sensors/vlp16.yaml, link: upper, xyz_m: [0, 0, 2], columns: 128}]}
)";

class ExportCommand : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    scratch_ = std::make_unique<ScratchDirectory>();
    WriteWholeFile(scratch_->path() / "small.yaml", kExcavator);
    const Outcome made = RunTera({"generate", "small.yaml", "--out", "run"}, {scratch_->path()});
    ASSERT_EQ(made.status, 0) << made.err;
  }
  static void TearDownTestSuite() { scratch_.reset(); }

  static void Exported(const Arguments& to, const std::string& out) {
    Arguments arguments = {"export", "run", "--out", out, "--to"};
    arguments.insert(arguments.end(), to.begin(), to.end());
    const Outcome outcome = RunTera(arguments, {scratch_->path()});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.out, StartsWith(out + ": "));
    EXPECT_THAT(outcome.out, HasSubstr(" records in "));
  }
  static fs::path Path(const std::string& file) { return scratch_->path() / file; }

  static std::unique_ptr<ScratchDirectory> scratch_;
};
std::unique_ptr<ScratchDirectory> ExportCommand::scratch_;

TEST_F(ExportCommand, WhatCannotBeExportedIsRefused) {
  const auto refused = [&](Arguments arguments,
                           const testing::Matcher<const std::string&>& message) {
    arguments.insert(arguments.begin(), "export");
    ExpectRefused(*scratch_, arguments, message);
  };
  refused({"nothing", "--to", "tum", "--out", "x"}, TellsOf("nothing"));
  refused({"run", "--to", "tum", "--out", "run"}, TellsOf("run"));
  refused({"run", "--to", "tum", "--out", "run/x"}, HasSubstr("is inside the recording run"));
  refused({"run", "--to", "tum", "--out", "x", "--storage", "mcap"}, TellsOf("--storage"));
  refused({"run", "--to", "rosbag2", "--storage", "sqlite3", "--compression", "lz4", "--out", "x"},
          TellsOf("--compression"));
  // A VLP-16 of 128 columns, and no unit.
  refused({"run", "--to", "pcap", "--out", "x"},
          AllOf(HasSubstr("sensor.yaml: model"), HasSubstr("need 1808 at 10 Hz")));
  const Outcome format = RunTera({"export", "run", "--to", "bagel", "--out", "x"}, {Path("")});
  EXPECT_EQ(format.status, 2);
  EXPECT_THAT(format.err, AllOf(TellsOf("--to"), HasSubstr("rosbag2")));
  for (const char* time :
       {"yesterday", "2023-02-29T00:00:00Z", "2026-05-01T24:00:00Z", "1815-01-01T00:00:00Z"}) {
    const Outcome outcome =
        RunTera({"export", "run", "--to", "tum", "--out", "x", "--start-utc", time}, {Path("")});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.err, StartsWith("--start-utc: '" + std::string(time) + "'; need a date"));
  }
}

// gpsd's decoder reads each sentence, checks its sum, and gives degrees and metres.
TEST_F(ExportCommand, GpsdReadsTheReceivers) {
  if (!HasProgram("gpsdecode")) GTEST_SKIP() << "needs gpsdecode, of the package gpsd-clients";
  Exported({"nmea", "--start-utc", "2024-05-01T12:00:00Z"}, "nmea");
  const auto output = OutputOf("gpsdecode < " + Path("nmea/digger/gnss_left.nmea").string());
  ASSERT_TRUE(output);
  const std::vector<GnssSample> samples = Recording(Path("run")).LoadGnss("digger/gnss_left");
  std::size_t fixes = 0, headings = 0;
  std::istringstream lines(*output);
  for (std::string line; std::getline(lines, line);) {
    // The heading from gpsdecode 3.22 is invalid JSON: a comma is doubled, another missing.
    const std::string heading = "\"heading\":";
    if (const std::size_t at = line.find(heading); at != std::string::npos) {
      // The machine looks 30 deg to the left of east: 60 deg to the right of north. Receivers 1 m
      // apart with an accuracy of 1 cm give that to about a degree.
      EXPECT_NEAR(std::stod(line.substr(at + heading.size())), 60, 5);
      ++headings;
      continue;
    }
    const json report = json::parse(line);
    if (report.value("class", "") != "TPV" || !report.contains("lat")) continue;
    const std::string time = report.value("time", "");
    const auto sample = std::find_if(samples.begin(), samples.end(), [&](const GnssSample& s) {
      return time == fmt::format("2024-05-01T12:00:{:06.3f}Z", ToSeconds(s.t_ns));
    });
    ASSERT_NE(sample, samples.end()) << time;
    EXPECT_NEAR(report["lat"].get<double>(), sample->lat_deg, 1e-8);
    EXPECT_NEAR(report["lon"].get<double>(), sample->lon_deg, 1e-8);
    EXPECT_NEAR(report["altHAE"].get<double>(), sample->alt_m, 1e-3);
    ++fixes;
  }
  // It reports a fix when the next one begins.
  EXPECT_GE(fixes, samples.size() - 2);
  EXPECT_GE(headings, samples.size() - 2);
}

// RTKLIB turns a solution into a map of Google Earth, with the same coordinates.
TEST_F(ExportCommand, RtklibReadsTheSolution) {
  if (!HasProgram("pos2kml")) GTEST_SKIP() << "needs pos2kml, of the package rtklib";
  Exported({"pos"}, "pos");
  ASSERT_TRUE(OutputOf("cd " + Path("pos/digger").string() + " && pos2kml gnss_left.pos 2>&1"));
  const std::string kml = ReadWholeFile(Path("pos/digger/gnss_left.kml"));
  const GnssSample first = Recording(Path("run")).LoadGnss("digger/gnss_left").front();
  EXPECT_THAT(kml, HasSubstr(fmt::format("{:.9f},{:.9f}", first.lon_deg, first.lat_deg)));
}

/// The bag at `file` as the programs of test/app/judges/read_bag.mjs read it.
std::optional<json> BagAt(const fs::path& file) {
  const std::string modules = TERA_NODE_MODULES;
  const auto text = OutputOf("node " TERA_SOURCE_DIR "/test/app/judges/read_bag.mjs '" + modules +
                             "' '" + file.string() + "'");
  if (!text) return std::nullopt;
  return json::parse(*text);
}

#define SKIP_WITHOUT_NODE()                                                                     \
  if (!HasProgram("node") || !fs::is_directory(TERA_NODE_MODULES "/@mcap/core")) {              \
    GTEST_SKIP() << "needs node and the npm packages that test/app/judges/read_bag.mjs names: " \
                    "npm install them, and cmake -D TERA_NODE_MODULES=FOLDER/node_modules";     \
  }

std::size_t RowsOf(const fs::path& csv) {
  std::ifstream stream(csv);
  std::size_t lines = 0;
  for (std::string line; std::getline(stream, line);) ++lines;
  return lines - 1;
}

/// Topics, types and numbers of messages that every storage must have.
void ExpectTopics(const json& bag, const fs::path& run) {
  const std::map<std::string, std::pair<std::string, std::string>> expected = {
      {"/digger/imu_boom", {"sensor_msgs/msg/Imu", "digger/imu_boom/data.csv"}},
      {"/digger/gps_left/fix", {"sensor_msgs/msg/NavSatFix", "digger/gnss_left/data.csv"}},
      {"/digger/lidar/points", {"sensor_msgs/msg/PointCloud2", "digger/lidar/data.csv"}},
      {"/digger/levers", {"sensor_msgs/msg/JointState", "digger/commands.csv"}},
      {"/digger/odom", {"nav_msgs/msg/Odometry", "truth/digger/pose.csv"}},
      {"/digger/joint_states", {"sensor_msgs/msg/JointState", "truth/digger/joints.csv"}},
      {"/digger/cylinders", {"sensor_msgs/msg/JointState", "truth/digger/hydraulics.csv"}},
      {"/digger/bucket_mass", {"std_msgs/msg/Float64", "truth/digger/joints.csv"}},
      {"/digger/ee_pose", {"geometry_msgs/msg/PoseStamped", "truth/digger/joints.csv"}},
      {"/digger/delta_can", {"tera_msgs/msg/DeltaCAN", "digger/commands.csv"}},
      {"/truth/digger/links/boom",
       {"geometry_msgs/msg/PoseStamped", "truth/digger/links/boom.csv"}}};
  for (const auto& [topic, content] : expected) {
    ASSERT_TRUE(bag["topics"].contains(topic)) << topic;
    EXPECT_EQ(bag["topics"][topic]["type"], content.first) << topic;
    EXPECT_EQ(bag["topics"][topic]["count"], RowsOf(run / content.second)) << topic;
  }
}

Vec3 VectorOf(const json& v) {
  return Vec3(v["x"].get<double>(), v["y"].get<double>(), v["z"].get<double>());
}

Pose PoseOf(const json& translation, const json& rotation) {
  return MakePose(VectorOf(translation),
                  Quat(rotation["w"].get<double>(), rotation["x"].get<double>(),
                       rotation["y"].get<double>(), rotation["z"].get<double>())
                      .normalized()
                      .toRotationMatrix());
}

/// The pose of a frame in `map` by a bag's first transforms.
Pose PlaceOf(std::string frame, const json& bag) {
  Pose X_WF = Pose::Identity();
  for (int step = 0; frame != "map" && step < 20; ++step) {
    bool found = false;
    for (const char* topic : {"/tf_static", "/tf"}) {
      for (const char* which : {"first", "second"}) {
        if (!bag["topics"][topic].contains(which)) continue;
        for (const json& t : bag["topics"][topic][which]["message"]["transforms"]) {
          if (found || t["child_frame_id"] != frame) continue;
          X_WF = PoseOf(t["transform"]["translation"], t["transform"]["rotation"]) * X_WF;
          frame = t["header"]["frame_id"];
          found = true;
        }
      }
    }
    EXPECT_TRUE(found) << "nothing leads to " << frame;
  }
  return X_WF;
}

TEST_F(ExportCommand, McapIsReadByItsOwnLibrary) {
  SKIP_WITHOUT_NODE();
  for (const char* compression : {"zstd", "lz4", "none"}) {
    const std::string out = std::string("bag_") + compression;
    Exported({"rosbag2", "--compression", compression}, out);
    EXPECT_TRUE(fs::exists(Path(out + "/metadata.yaml")));
    const auto bag = BagAt(Path(out + "/" + out + "_0.mcap"));
    ASSERT_TRUE(bag) << compression;
    EXPECT_EQ((*bag)["profile"], "ros2");
    EXPECT_EQ((*bag)["compression"], std::string(compression) == "none" ? "" : compression);
    ExpectTopics(*bag, Path("run"));
    for (const json& channel : (*bag)["channels"]) {
      EXPECT_EQ(channel["encoding"], "cdr");
      EXPECT_THAT(channel["qos"].get<std::string>(), StartsWith("- history: 1\n  depth: "));
    }
  }
}

TEST_F(ExportCommand, MessagesHoldWhatTheDatasetHolds) {
  SKIP_WITHOUT_NODE();
  Exported({"rosbag2"}, "bag");
  const auto bag = BagAt(Path("bag/bag_0.mcap"));
  ASSERT_TRUE(bag);
  const Recording recording(Path("run"));
  const ImuSample imu = recording.LoadImu("digger/imu_boom").back();
  const json& sent = (*bag)["topics"]["/digger/imu_boom"]["last"]["message"];
  EXPECT_EQ(VectorOf(sent["angular_velocity"]), imu.w_WS_S_radps);
  EXPECT_EQ(VectorOf(sent["linear_acceleration"]), imu.f_S_mps2);
  EXPECT_EQ(sent["orientation_covariance"][0], -1);
  EXPECT_EQ(sent["header"]["frame_id"], "digger/imu_boom");
  EXPECT_EQ(sent["header"]["stamp"]["nanosec"], imu.t_ns);
  const std::string scan_ns = std::to_string(recording.FrameTimes("digger/lidar").front());
  const LidarScan scan = recording.LoadScan("digger/lidar", std::stoll(scan_ns));
  const json& cloud = (*bag)["topics"]["/digger/lidar/points"]["first"];
  EXPECT_EQ(cloud["message"]["width"], scan.points.size());
  EXPECT_EQ(cloud["message"]["data"]["length"], scan.points.size() * 28);
  // A scan of 10 Hz is there when its last ray is.
  EXPECT_EQ(cloud["time"], std::to_string(std::stoll(scan_ns) + 100'000'000));
}

TEST_F(ExportCommand, Ros1BagIsReadByAnotherLibrary) {
  SKIP_WITHOUT_NODE();
  Exported({"bag"}, "one");
  auto bag = BagAt(Path("one/one.bag"));
  ASSERT_TRUE(bag);
  for (auto& [topic, content] : (*bag)["topics"].items()) {
    std::string type = content["type"];
    content["type"] = type.insert(type.find('/'), "/msg");  // as ROS 2 names it
  }
  ExpectTopics(*bag, Path("run"));
  const ImuSample imu = Recording(Path("run")).LoadImu("digger/imu_boom").back();
  const json& sent = (*bag)["topics"]["/digger/imu_boom"]["last"]["message"];
  EXPECT_EQ(VectorOf(sent["linear_acceleration"]), imu.f_S_mps2);
  EXPECT_EQ(sent["header"]["stamp"]["nsec"], imu.t_ns);
}

// Ground that rises at 5 deg towards 30 deg north of east: 14 x 10 m, with columns at the borders
// too. A grid map begins in the north-east and ends in the south-west.
TEST_F(ExportCommand, GroundIsAGridMapInTheWorld) {
  SKIP_WITHOUT_NODE();
  WriteWholeFile(Path("slope.yaml"), R"(name: slope
seed: 5
duration_s: 0.3
site: {lat_deg: 46.78, lon_deg: -71.27, height_m: 90}
terrain: {size_m: [14, 10], cell_m: 0.1, soil: dirt, relief: {slope_deg: 5, slope_direction_deg: 30}}
record: {terrain: [height, change, soil_class], pixel_m: 0.1, every_s: 0.2}
machines:
  - {name: digger, machine: tera:config/machines/tb235.yaml, operator: {type: idle}}
)");
  const Outcome made = RunTera({"generate", "slope.yaml", "--out", "slope"}, {Path("")});
  ASSERT_EQ(made.status, 0) << made.err;
  const double height_m = std::tan(5 * kDeg) * (7 * std::cos(30 * kDeg) + 5 * std::sin(30 * kDeg));
  const auto ones = [](const json& layer) { return layer["data"]["length"].get<int>(); };
  for (const Arguments& to : {Arguments{"rosbag2"}, Arguments{"bag"}}) {
    Arguments arguments = {"export", "slope", "--out", "ground_" + to[0], "--to", to[0]};
    const Outcome outcome = RunTera(arguments, {Path("")});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const bool ros1 = to[0] == "bag";
    const auto bag =
        BagAt(Path(ros1 ? "ground_bag/ground_bag.bag" : "ground_rosbag2/ground_rosbag2_0.mcap"));
    ASSERT_TRUE(bag);
    const json& ground = (*bag)["topics"]["/truth/terrain"];
    EXPECT_EQ(ground["type"], ros1 ? "grid_map_msgs/GridMap" : "grid_map_msgs/msg/GridMap");
    EXPECT_EQ(ground["count"], 3);
    EXPECT_EQ(ground["second"]["time"], "200000000");
    EXPECT_EQ(ground["last"]["time"], "300000000");
    const json& map = ground["first"]["message"];
    const json& header = ros1 ? map["info"]["header"] : map["header"];
    EXPECT_EQ(header["frame_id"], "map");
    EXPECT_NEAR(map["info"]["length_x"].get<double>(), 14.1, 1e-9);
    EXPECT_NEAR(map["info"]["length_y"].get<double>(), 10.1, 1e-9);
    EXPECT_NEAR(VectorOf(map["info"]["pose"]["position"]).norm(), 0, 1e-9);
    EXPECT_EQ(map["layers"], json({"elevation", "soil_class"}));
    EXPECT_EQ(ground["last"]["message"]["layers"], json({"change", "elevation", "soil_class"}));
    const json& elevation = map["data"][0];
    EXPECT_EQ(ones(elevation), 141 * 101);
    EXPECT_EQ(elevation["layout"]["dim"][0]["label"], "column_index");
    EXPECT_EQ(elevation["layout"]["dim"][0]["size"], 101);
    EXPECT_EQ(elevation["layout"]["dim"][1]["size"], 141);
    EXPECT_NEAR(elevation["data"]["first"].get<double>(), height_m, 1e-4);
    EXPECT_NEAR(elevation["data"]["last"].get<double>(), -height_m, 1e-4);
  }
}

// The joints and mounts that lead to the inertial unit, against the pose that was recorded.
TEST_F(ExportCommand, TransformsLeadToWhereTheSensorTrulyIs) {
  SKIP_WITHOUT_NODE();
  Exported({"rosbag2", "--storage", "sqlite3"}, "bag3");
  const auto bag = BagAt(Path("bag3/bag3_0.db3"));
  ASSERT_TRUE(bag);
  ExpectTopics(*bag, Path("run"));
  const Pose truth =
      Recording(Path("run")).LoadPose("truth/digger/sensors/imu_boom.csv").poses.front().X_WB;
  const Pose told = PlaceOf("digger/imu_boom", *bag);
  EXPECT_TRUE(told.isApprox(truth, 1e-3)) << told.matrix() << "\n\n" << truth.matrix();
}

/// A column of a recorded table in its last row.
double LastOf(const TableRecording& table, const std::string& column) {
  const auto found = std::find(table.columns.begin(), table.columns.end(), column);
  EXPECT_NE(found, table.columns.end()) << column;
  return table.rows.back().at(static_cast<std::size_t>(found - table.columns.begin()));
}

// A machine with driven boom, slew and one track, read back in both kinds of bags: its levers by
// their fields, and the bucket's edge by the angles and the pins of tb235.yaml.
TEST_F(ExportCommand, TheExcavatorsOwnMessagesAreItsLeversAndItsBucketsEdge) {
  SKIP_WITHOUT_NODE();
  WriteWholeFile(Path("levers.csv"),
                 "t_s,slew,boom,left_track\n0,0.5,0.75,-0.25\n0.3,0.5,0.75,-0.25\n");
  WriteWholeFile(Path("driven.yaml"), R"(name: driven
duration_s: 0.3
settle_s: 0.1
terrain: {size_m: [14, 14], cell_m: 0.2, soil: asphalt}
machines:
  - name: digger
    machine: tera:config/machines/tb235.yaml
    start: {joints_deg: {boom: 40, arm: -95, bucket: -20, swing: 10}}
    operator: {type: lever_replay, csv: levers.csv, time_column: t_s}
    rig: {sensors: []}
)");
  const Outcome made = RunTera({"generate", "driven.yaml", "--out", "driven"}, {Path("")});
  ASSERT_EQ(made.status, 0) << made.err;
  const Recording recording(Path("driven"));
  const TableRecording joints = recording.LoadTable("truth/digger/joints.csv");
  const auto q = [&](const std::string& joint) { return LastOf(joints, joint + "_rad"); };
  const double boom = q("boom"), arm = boom + q("arm"), bucket = arm + q("bucket") - 45 * kDeg;
  const Vec3 edge_m(0.18 + 2.5 * std::cos(boom) + 1.545 * std::cos(arm) + 0.78 * std::cos(bucket),
                    0,
                    0.86 + 2.5 * std::sin(boom) + 1.545 * std::sin(arm) + 0.78 * std::sin(bucket));
  const Quat slewed(Eigen::AngleAxisd(q("slew"), Vec3::UnitZ()));
  const Quat swung(Eigen::AngleAxisd(q("swing"), Vec3::UnitZ()));
  const Vec3 expected_m = slewed * (Vec3(0.62, 0, 0) + swung * edge_m);
  for (const std::string to : {"rosbag2", "bag"}) {
    const Outcome outcome =
        RunTera({"export", "driven", "--to", to, "--out", "own_" + to}, {Path("")});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto bag =
        BagAt(Path(to == "bag" ? "own_bag/own_bag.bag" : "own_rosbag2/own_rosbag2_0.mcap"));
    ASSERT_TRUE(bag) << to;
    const json& pose = (*bag)["topics"]["/digger/ee_pose"]["last"]["message"];
    EXPECT_EQ(pose["header"]["frame_id"], "digger/undercarriage");
    EXPECT_LT((VectorOf(pose["pose"]["position"]) - expected_m).norm(), 1e-5);
    const json& levers = (*bag)["topics"]["/digger/delta_can"]["last"]["message"];
    EXPECT_EQ(levers["slew"], 0.5);
    EXPECT_EQ(levers["boom"], 0.75);
    EXPECT_EQ(levers["left_travel"], -0.25);
    EXPECT_EQ(levers["right_travel"], 0);
    EXPECT_EQ(levers["enable"], true);
    EXPECT_EQ(levers["hydraulic_lock"], false);
  }
}

}  // namespace
}  // namespace tera
