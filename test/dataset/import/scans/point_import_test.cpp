#include <cmath>

#include "dataset/files/checked_file.h"
#include "dataset/format/pcd.h"
#include "dataset/import/bag_bytes.h"
#include "dataset/import/scans/lidar_import.h"

// Points of bags and folders of scans, by hand.

namespace tera {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

constexpr std::uint8_t kUint8 = 2, kUint16 = 4, kUint32 = 6, kFloat32 = 7, kFloat64 = 8;

struct CloudField {
  std::string name;
  std::uint8_t datatype;
  std::uint32_t at;
};

/// sensor_msgs/PointCloud2 of one row.
Cdr CloudMessage(std::int32_t seconds, const std::vector<CloudField>& fields, std::uint32_t step,
                 const std::string& data) {
  Cdr message;
  const auto count = static_cast<std::uint32_t>(data.size() / step);
  message.Header(seconds, 0).Add(std::uint32_t{1}).Add(count);
  message.Add(static_cast<std::uint32_t>(fields.size()));
  for (const CloudField& field : fields) {
    message.Text(field.name).Add(field.at).Add(field.datatype).Add(std::uint32_t{1});
  }
  message.Add(std::uint8_t{0}).Add(step).Add(count * step);
  message.Add(static_cast<std::uint32_t>(data.size()));
  for (const char byte : data) message.Add(byte);
  return message.Add(std::uint8_t{1});
}

const std::vector<CloudField> kPlaces = {
    {"x", kFloat32, 0}, {"y", kFloat32, 4}, {"z", kFloat32, 8}};

std::string PlaceBytes(float x, float y, float z) { return Bytes(x) + Bytes(y) + Bytes(z); }

class PointTopic : public LidarImportTest {
 protected:
  /// A bag of one message at 100 s.
  void Bag(std::vector<CloudField> more, std::uint32_t step, const std::string& data) {
    more.insert(more.begin(), kPlaces.begin(), kPlaces.end());
    File("log.mcap", TopicsMcap()
                         .Message("/points", "sensor_msgs/msg/PointCloud2", 7,
                                  CloudMessage(100, more, step, data))
                         .bytes());
  }
  static constexpr const char* kTopic = "file: log.mcap, topic: /points";
};

TEST_F(PointTopic, TimesOfPointsAreOfTheUnitThatTheirTypeHas) {
  struct Case {
    const char* name;
    std::uint8_t datatype;
    std::string first, second;
    TimeNs start_ns;
  };
  const TimeNs stamp_ns = 100 * kNsPerSecond;
  const std::vector<Case> cases = {
      {"t", kUint32, Bytes(0U), Bytes(50'000'000U), stamp_ns},                // Ouster
      {"time", kFloat32, Bytes(-0.05F), Bytes(0.0F), stamp_ns - 50'000'000},  // Velodyne
      {"timestamp", kFloat64, Bytes(1.7e9), Bytes(1.7e9 + 0.05),
       17 * TimeNs{100'000'000'000'000'000}},  // Hesai
      {"timestamp", kFloat64, Bytes(1.7e18), Bytes(1.7e18 + 5e7),
       17 * TimeNs{100'000'000'000'000'000}},  // Livox
      {"offset_time", kUint32, Bytes(0U), Bytes(50'000'000U), stamp_ns}};
  for (const Case& one : cases) {
    const auto width = static_cast<std::uint32_t>(one.first.size());
    Bag({{one.name, one.datatype, 12}, {"ring", kUint16, 12 + width}}, 14 + width,
        PlaceBytes(3, 4, 0) + one.first + Bytes(std::uint16_t{5}) + PlaceBytes(0, 0, 1) +
            one.second + Bytes(std::uint16_t{6}));
    const ImportReport report = Import(kTopic, "zero: start\n");
    const LidarScan scan = Scans()[0];
    EXPECT_EQ(scan.t_ns, 0) << one.name;
    // A float of -0.05 is 0.7 ns more.
    EXPECT_NEAR(static_cast<double>(report.zero_ns - one.start_ns), 0, 1) << one.name;
    ASSERT_EQ(scan.points.size(), 2u) << one.name;
    ExpectPlace(scan.points[0], {3, 4, 0});
    EXPECT_EQ(scan.points[1].ring, 6);
    EXPECT_NEAR(scan.points[1].time_offset_ns, 50e6, 300) << one.name;
  }
}

TEST_F(PointTopic, TimesThatAreNoScansAreAskedFor) {
  // Microseconds in whole numbers, which look like nanoseconds: a scan of 50 us.
  Bag({{"t", kUint32, 12}}, 16,
      PlaceBytes(3, 4, 0) + Bytes(0U) + PlaceBytes(0, 0, 1) + Bytes(50'000U));
  ExpectFault(kTopic, FaultKind::kOutOfRange, "log.mcap: /points message 1");
  Import(std::string(kTopic) + ", time_unit: us");
  EXPECT_EQ(Scans()[0].points[1].time_offset_ns, 50'000'000u);
  // No point at all.
  Bag({}, 12, PlaceBytes(3, 4, 0) + PlaceBytes(0, 0, 1));
  ExpectFault(kTopic, FaultKind::kMissing, "log.mcap: /points message 1");
  ExpectFault(std::string(kTopic) + ", stamp: last", FaultKind::kMissing, "duration_s");
  ExpectFault(std::string(kTopic) + ", time_field: t", FaultKind::kMissing,
              "log.mcap: /points message 1");
  Import(std::string(kTopic) + ", stamp: first");
  EXPECT_EQ(Scans()[0].t_ns, 100 * kNsPerSecond);
  Import(std::string(kTopic) + ", stamp: last, duration_s: 0.1, time: {column: log_time}");
  EXPECT_EQ(Scans()[0].t_ns, 7 - 100'000'000);
}

TEST_F(PointTopic, WhatFullIntensityIsMustBeKnown) {
  Bag({{"intensity", kFloat32, 12}}, 16, PlaceBytes(3, 4, 0) + Bytes(51.0F));
  ExpectFault(std::string(kTopic) + ", stamp: first", FaultKind::kOutOfRange,
              "log.mcap: /points message 1");
  Import(std::string(kTopic) + ", stamp: first, full_intensity: 255");
  EXPECT_FLOAT_EQ(Scans()[0].points[0].intensity, 0.2F);
  Bag({{"reflectivity", kUint8, 12}}, 13, PlaceBytes(3, 4, 0) + Bytes(std::uint8_t{51}));
  Import(std::string(kTopic) + ", stamp: first");
  EXPECT_FLOAT_EQ(Scans()[0].points[0].intensity, 0.2F);
}

TEST_F(PointTopic, RaysWithoutAReturnLeaveNoPoint) {
  Bag({}, 12, PlaceBytes(std::nanf(""), 0, 0) + PlaceBytes(0, 0, 0) + PlaceBytes(1, 2, 3));
  const ImportReport report = Import(std::string(kTopic) + ", stamp: first");
  ASSERT_EQ(Scans()[0].points.size(), 1u);
  EXPECT_THAT(report.channels[0].remarks, Contains(HasSubstr("66.7 % of the rays")));
}

// Fields in the order of livox_ros_driver2/msg/CustomMsg and CustomPoint. CDR aligns each point to
// four bytes, so that the second begins a byte after the first has ended.
Cdr LivoxMessage(const std::string& frame, std::uint32_t declared) {
  Cdr message;
  message.Header(100, 0, frame).Add(std::uint64_t{100'000'000'000}).Add(std::uint32_t{2});
  for (int k = 0; k < 4; ++k) message.Add(std::uint8_t{0});
  message.Add(declared);
  message.Add(std::uint32_t{0}).Add(3.0F).Add(4.0F).Add(0.0F);
  message.Add(std::uint8_t{51}).Add(std::uint8_t{16}).Add(std::uint8_t{2});
  message.Add(std::uint32_t{99'995'000}).Add(0.0F).Add(0.0F).Add(-2.0F);
  return message.Add(std::uint8_t{255}).Add(std::uint8_t{0}).Add(std::uint8_t{3});
}

TEST_F(PointTopic, OfLivoxHasItsOwnMessage) {
  // Names of each length shift the fields behind them.
  for (const std::string frame : {"livox_frame", "l", "li", "liv", "livo"}) {
    File("log.mcap",
         TopicsMcap()
             .Message("/points", "livox_ros_driver2/msg/CustomMsg", 7, LivoxMessage(frame, 2))
             .bytes());
    const ImportReport report = Import(kTopic, "zero: start\n");
    EXPECT_EQ(report.zero_ns, 100 * kNsPerSecond);
    const LidarScan scan = Scans()[0];
    ASSERT_EQ(scan.points.size(), 2u) << frame;
    ExpectPlace(scan.points[0], {3, 4, 0});
    ExpectPlace(scan.points[1], {0, 0, -2});
    EXPECT_FLOAT_EQ(scan.points[0].intensity, 0.2F);
    EXPECT_EQ(scan.points[0].ring, 2);
    EXPECT_EQ(scan.points[1].ring, 3);
    EXPECT_EQ(scan.points[1].time_offset_ns, 99'995'000u);
  }
}

TEST_F(PointTopic, OfLivoxIsRefusedWhereItDeclaresMoreThanItHas) {
  for (const std::uint32_t declared : {3U, 4'000'000'000U}) {
    File("log.mcap",
         TopicsMcap()
             .Message("/points", "livox_ros_driver2/msg/CustomMsg", 7, LivoxMessage("l", declared))
             .bytes());
    ExpectFault(kTopic, FaultKind::kMalformed, "log.mcap: /points message 1");
  }
}

TEST_F(PointTopic, MessagesThatAreNoCloudsAreTold) {
  Cdr cut;
  cut.Header(100, 0).Add(std::uint32_t{1}).Add(std::uint32_t{500});
  File("log.mcap", TopicsMcap().Message("/points", "sensor_msgs/msg/PointCloud2", 7, cut).bytes());
  ExpectFault(std::string(kTopic) + ", stamp: first", FaultKind::kMalformed,
              "log.mcap: /points message 1");
  Bag({{"t", kUint32, 200}}, 12, PlaceBytes(3, 4, 0));
  ExpectFault(kTopic, FaultKind::kMalformed, "log.mcap: /points message 1");
  File("log.mcap", TopicsMcap()
                       .Message("/points", "sensor_msgs/msg/PointCloud2", 7,
                                CloudMessage(100, {{"x", kFloat32, 0}}, 4, Bytes(1.0F)))
                       .bytes());
  ExpectFault(kTopic, FaultKind::kMissing, "log.mcap: /points message 1");
  File("log.mcap", TopicsMcap().Message("/points", "std_msgs/msg/String", 7, Cdr()).bytes());
  ExpectFault(kTopic, FaultKind::kUnsupported, "topic");
}

// --- Folders.

TEST_F(LidarImportTest, AFolderOfKittisScansComesInByItsTimes) {
  MakeFolder(scratch_.path() / "scans");
  File("scans/0000000010.bin", PlaceBytes(0, 0, 5) + Bytes(0.75F));
  File("scans/0000000009.bin", PlaceBytes(1, 2, 3) + Bytes(0.25F));
  File("scans/timestamps.txt", "no scan");
  File("times.txt", "2011-09-26 13:02:25.951199337\n2011-09-26 13:02:26.054509756\n");
  Import("files: scans, times: times.txt, stamp: first", "zero: start\n");
  const auto scans = Scans();
  ASSERT_EQ(scans.size(), 2u);
  EXPECT_EQ(scans[1].t_ns, 103'310'419);
  ExpectPlace(scans[0].points[0], {1, 2, 3});
  EXPECT_FLOAT_EQ(scans[1].points[0].intensity, 0.75F);
  File("times.txt", "0.1\n");
  ExpectFault("files: scans, times: times.txt, stamp: first", FaultKind::kInconsistent, "times");
  ExpectFault("files: scans, stamp: first", FaultKind::kMissing, "times");
  File("times.txt", "0.2\n0.1\n");
  ExpectFault("files: scans, times: times.txt, stamp: first", FaultKind::kInconsistent,
              "scans/0000000010.bin");
  File("times.txt", "0.1\n0.2\n");
  File("scans/0000000010.bin", "odd");
  ExpectFault("files: scans, times: times.txt, stamp: first", FaultKind::kMalformed,
              "scans/0000000010.bin");
}

TEST_F(LidarImportTest, PcdScansHaveTheirTimesInTheirNames) {
  MakeFolder(scratch_.path() / "scans");
  const std::string head =
      "VERSION 0.7\nFIELDS x y z intensity\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\nWIDTH 1\n"
      "HEIGHT 1\nPOINTS 1\n";
  File("scans/1700000000.100000.pcd", head + "DATA binary\n" + PlaceBytes(1, 2, 3) + Bytes(0.5F));
  File("scans/1700000000.200000.pcd", head + "DATA ascii\n4 5 6 0.25\n");
  Import("files: scans, stamp: first", "zero: start\n");
  const auto scans = Scans();
  ASSERT_EQ(scans.size(), 2u);
  EXPECT_EQ(scans[1].t_ns, 100'000'000);
  ExpectPlace(scans[0].points[0], {1, 2, 3});
  ExpectPlace(scans[1].points[0], {4, 5, 6});
  EXPECT_EQ(Recording(Out()).info().epoch->since_1970_ns, 1'700'000'000'100'000'000);
  File("scans/1700000000.200000.pcd", head + "DATA binary\nshort");
  ExpectFault("files: scans, stamp: first", FaultKind::kMalformed, "scans/1700000000.200000.pcd");
  std::filesystem::remove_all(scratch_.path() / "scans");
  MakeFolder(scratch_.path() / "scans");
  ExpectFault("files: scans, stamp: first", FaultKind::kMissing, "files");
}

TEST_F(LidarImportTest, PlyScansComeInByTheirVertices) {
  MakeFolder(scratch_.path() / "scans");
  const auto head = [](const std::string& form) {
    return "ply\nformat " + form +
           " 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
           "property uchar reflectivity\nproperty ushort ring\nend_header\n";
  };
  File("scans/1700000000.1.ply", head("binary_little_endian") + PlaceBytes(1, 2, 3) +
                                     Bytes(std::uint8_t{51}) + Bytes(std::uint16_t{7}));
  // 4, 5 and 6 as floats, and ring 7, with the first byte first.
  File("scans/1700000000.2.ply",
       head("binary_big_endian") +
           std::string("\x40\x80\0\0\x40\xa0\0\0\x40\xc0\0\0\x33\0\x07", 15));
  Import("files: scans, stamp: first", "zero: start\n");
  const auto scans = Scans();
  ASSERT_EQ(scans.size(), 2u);
  ExpectPlace(scans[0].points[0], {1, 2, 3});
  ExpectPlace(scans[1].points[0], {4, 5, 6});
  for (const LidarScan& scan : scans) {
    EXPECT_FLOAT_EQ(scan.points[0].intensity, 0.2F);
    EXPECT_EQ(scan.points[0].ring, 7);
  }
  File("scans/1700000000.2.ply", head("ascii") + "4 5 6 51 7\n");
  Import("files: scans, stamp: first, full_intensity: 255", "zero: start\n");
  ExpectPlace(Scans()[1].points[0], {4, 5, 6});
  EXPECT_FLOAT_EQ(Scans()[1].points[0].intensity, 0.2F);
  File("scans/1700000000.2.ply", head("binary_little_endian") + "short");
  ExpectFault("files: scans, stamp: first", FaultKind::kMalformed, "scans/1700000000.2.ply");
}

TEST_F(LidarImportTest, PlyScansOfNoKnownFormatAreRefused) {
  MakeFolder(scratch_.path() / "scans");
  const std::string vertex = PlaceBytes(1, 2, 3);
  for (const char* line : {"format binary_middle_endian 1.0\n", "format\n", ""}) {
    File("scans/1700000000.1.ply", std::string("ply\n") + line +
                                       "element vertex 1\nproperty float x\nproperty float y\n"
                                       "property float z\nend_header\n" +
                                       vertex);
    ExpectFault("files: scans, stamp: first", FaultKind::kMalformed, "scans/1700000000.1.ply");
  }
}

TEST_F(LidarImportTest, OurOwnScansInAFolderComeBack) {
  MakeFolder(scratch_.path() / "scans");
  const LidarPoint point{
      .x_m = 1, .y_m = -2, .z_m = 3, .intensity = 0.5F, .time_offset_ns = 0, .ring = 9};
  LidarPoint later = point;
  later.time_offset_ns = 99'000'000;
  File("scans/1700000000000000000.pcd", EncodePcd({point, later}));
  Import("files: scans", "zero: start\n");
  const auto points = Scans()[0].points;
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0].ring, 9);
  EXPECT_EQ(points[1].time_offset_ns, 99'000'000u);
  EXPECT_FLOAT_EQ(points[1].intensity, 0.5F);
}

}  // namespace
}  // namespace tera
