#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "dataset/export/export.h"
#include "dataset/format/recording.h"
#include "dataset/format/sample_recording.h"
#include "dataset/import/bag_bytes.h"
#include "dataset/import/import_csv.h"

/// Bags of ROS messages by a mapping.

namespace tera {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;
namespace fs = std::filesystem;

/// A mapping of `file` by `keys`, and its import.
class BagImport : public ::testing::Test {
 protected:
  ImportReport Import(const std::string& file, const std::string& keys,
                      const ImportOptions& options = {}) {
    WriteWholeFile(scratch_.path() / "mapping.yaml",
                   "name: logged\nmachine: digger\nfile: " + file + "\n" + keys);
    fs::remove_all(Out());
    return ImportCsv(scratch_.path() / "mapping.yaml", Out(), options);
  }
  void Log(const std::string& bytes) { WriteWholeFile(scratch_.path() / "log.mcap", bytes); }
  ImportReport ImportLog(const std::string& keys, const ImportOptions& options = {}) {
    return Import("log.mcap", keys, options);
  }
  std::vector<std::vector<double>> Rows() const {
    return Recording(Out()).LoadTable("digger/t.csv").rows;
  }
  void ExpectFault(const std::string& keys, const std::vector<std::string>& parts) {
    try {
      ImportLog(keys);
      ADD_FAILURE() << "no fault: " << keys;
    } catch (const InputError& fault) {
      for (const std::string& part : parts) EXPECT_THAT(fault.what(), HasSubstr(part));
    }
    EXPECT_FALSE(fs::exists(Out()));
    EXPECT_FALSE(fs::exists(Out().string() + ".incomplete"));
  }
  fs::path Out() const { return scratch_.path() / "out"; }

  ScratchDirectory scratch_;
};

/// A table of one column.
std::string Table(const std::string& field, const std::string& more = "") {
  return "tables: [{name: t, topic: /t, columns: {v: {column: \"" + field + "\", unit: '1'}}" +
         more + "}]\n";
}

// --- Data of TERA's own exporter.

struct Container {
  const char* name;
  ExportFormat format;
  BagStorage storage;
  BagCompression compression;
  const char* file;
};

class RoundTrip : public BagImport, public ::testing::WithParamInterface<Container> {};

constexpr char kAllTopics[] =
    "origin: {lat_deg: 46.78, lon_deg: -71.27, height_m: 90.5}\n"
    "imus: [{name: imu, topic: /digger/imu}]\n"
    "gnss: [{name: gnss, topic: /digger/gps/fix}]\n"
    "encoders: [{name: joints, topic: /digger/joints, joints: [{name: boom}, {name: stick, "
    "prismatic: true}]}]\n"
    "tables: [{name: commands, topic: /digger/levers, columns: {boom: {column: 'position[boom]', "
    "unit: '1'}, arm: {column: 'position[1]', unit: '1'}}}]\n"
    "pose: {topic: /digger/odom}\n";

TEST_P(RoundTrip, GivesTheRecordingsNumbers) {
  const Container& container = GetParam();
  WriteWholeSample(scratch_.path() / "run", {});
  Export(scratch_.path() / "run", scratch_.path() / "bag",
         {.format = container.format,
          .storage = container.storage,
          .compression = container.compression});
  Import(std::string("bag/") + container.file, kAllTopics);
  const Recording recording(Out());
  const auto imu = recording.LoadImu("digger/imu");
  const auto gnss = recording.LoadGnss("digger/gnss");
  const EncoderRecording joints = recording.LoadEncoder("digger/joints");
  const PoseRecording pose = recording.LoadPose("truth/digger/pose.csv");
  const TableRecording commands = recording.LoadTable("digger/commands.csv");
  ASSERT_EQ(imu.size(), 6u);
  ASSERT_EQ(gnss.size(), 6u);
  ASSERT_EQ(joints.samples.size(), 6u);
  ASSERT_EQ(pose.poses.size(), 6u);
  EXPECT_EQ(joints.axes[1], (EncoderAxis{"stick", true}));
  for (int k = 0; k < kSampleFrames; ++k) {
    const auto i = static_cast<std::size_t>(k);
    EXPECT_EQ(imu[i].t_ns, SampleImu(k).t_ns);
    EXPECT_EQ(imu[i].w_WS_S_radps, SampleImu(k).w_WS_S_radps);
    EXPECT_EQ(imu[i].f_S_mps2, SampleImu(k).f_S_mps2);
    EXPECT_NEAR(gnss[i].lat_deg, SampleGnss(k).lat_deg, 1e-13);
    EXPECT_NEAR(gnss[i].lon_deg, SampleGnss(k).lon_deg, 1e-13);
    EXPECT_EQ(gnss[i].alt_m, SampleGnss(k).alt_m);
    EXPECT_EQ(gnss[i].fix, GnssFix::kRtkFloat);  // 0.17 m is too large for a fixed solution
    EXPECT_EQ(gnss[i].variance_enu_m2, SampleGnss(k).variance_enu_m2);
    EXPECT_EQ(joints.samples[i].q_rad, SampleEncoder(k).q_rad);
    EXPECT_EQ(joints.samples[i].qd_radps, SampleEncoder(k).qd_radps);
    EXPECT_TRUE(pose.poses[i].X_WB.isApprox(SamplePose(k).X_WB, 1e-12));
    EXPECT_EQ(commands.rows[i], (std::vector<double>{0.5, -1.0}));
  }
}

INSTANTIATE_TEST_SUITE_P(
    OfBags, RoundTrip,
    ::testing::Values(Container{"zstd", ExportFormat::kRosbag2, BagStorage::kMcap,
                                BagCompression::kZstd, "bag_0.mcap"},
                      Container{"lz4", ExportFormat::kRosbag2, BagStorage::kMcap,
                                BagCompression::kLz4, "bag_0.mcap"},
                      Container{"none", ExportFormat::kRosbag2, BagStorage::kMcap,
                                BagCompression::kNone, "metadata.yaml"},
                      Container{"sqlite3", ExportFormat::kRosbag2, BagStorage::kSqlite3,
                                BagCompression::kNone, "metadata.yaml"},
                      Container{"ros1", ExportFormat::kBag, BagStorage::kMcap,
                                BagCompression::kNone, "bag.bag"}),
    [](const auto& info) { return std::string(info.param.name); });

// --- Messages by hand.

constexpr char kMine[] =
    "# A type of ours.\nstd_msgs/Header header\nuint8 KIND=3  # not a field\nstring NAME=a#b\n"
    "int16 small -7\nstring<=5 text \"five\"\nfloat32[3] triple\nPart[] parts\nbool[<=4] flags\n"
    "uint64 big\n"
    "================================================================================\n"
    "MSG: mine_msgs/Part\nfloat64 value\nbyte b\n"
    "================================================================================\n"
    "MSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n";

std::string Mine(std::int32_t seconds, double value) {
  return Cdr()
      .Header(seconds, 250'000'000)
      .Add(std::int16_t{-12})
      .Text("abc")
      .Add(1.5f)
      .Add(2.5f)
      .Add(3.5f)
      .Add(std::uint32_t{2})
      .Add(value)
      .Add(std::uint8_t{1})
      .Add(value + 1)
      .Add(std::uint8_t{2})
      .Add(std::uint32_t{1})
      .Add(std::uint8_t{1})
      .Add(std::uint64_t{1} << 40)
      .bytes();
}

SmallMcap MineBag() { return SmallMcap("mine_msgs/msg/Mine", kMine); }

TEST_F(BagImport, FieldsAreFoundByTheDefinitionThatTheBagCarries) {
  Log(MineBag().Message(5, Mine(1, 10)).Message(6, Mine(2, 20)).bytes());
  ImportLog(
      "tables: [{name: t, topic: /t, columns: {a: {column: small, unit: '1'}, b: {column: "
      "'triple[2]', unit: cm}, c: {column: 'parts[1].value', unit: '1'}, d: {column: 'flags[0]', "
      "unit: '1'}, e: {column: big, unit: '1'}, f: {column: 'parts[0].b', unit: '1'}}}]\n");
  const TableRecording table = Recording(Out()).LoadTable("digger/t.csv");
  EXPECT_EQ(table.t_ns, (std::vector<TimeNs>{1'250'000'000, 2'250'000'000}));
  EXPECT_EQ(table.rows[0], (std::vector<double>{-12, 0.035, 11, 1, 1099511627776.0, 1}));
  EXPECT_EQ(table.rows[1][2], 21);
}

// Files in another order than their names, the first with another number for the topic. The
// mapping's `file` is the folder.
TEST_F(BagImport, AFolderOfSeveralFilesIsReadInTheOrderOfItsMetadata) {
  const fs::path bag = scratch_.path() / "run4";
  fs::create_directory(bag);
  WriteWholeFile(bag / "run4_1.mcap", MineBag().Message(5, Mine(1, 10)).bytes());
  WriteWholeFile(bag / "run4_0.mcap", SmallMcap("std_msgs/msg/Float64", "float64 data\n").bytes());
  WriteWholeFile(bag / "run4_2.mcap",
                 MineBag().Message(6, Mine(2, 20)).Message(7, Mine(3, 30)).bytes());
  const std::string metadata =
      "rosbag2_bagfile_information:\n  version: 5\n  storage_identifier: mcap\n"
      "  relative_file_paths:\n    - run4_1.mcap\n    - run4_2.mcap\n";
  WriteWholeFile(bag / "metadata.yaml", metadata);
  for (const char* file : {"run4", "run4/metadata.yaml"}) {
    Import(file, Table("parts[0].value"));
    EXPECT_EQ(Rows(), (std::vector<std::vector<double>>{{10}, {20}, {30}})) << file;
  }
  fs::remove(bag / "run4_2.mcap");
  EXPECT_THAT([&] { Import("run4", Table("parts[0].value")); },
              ThrowsMessage<InputError>(HasSubstr("run4_2.mcap")));
  fs::remove(bag / "metadata.yaml");
  EXPECT_THAT([&] { Import("run4", Table("parts[0].value")); },
              ThrowsMessage<InputError>(HasSubstr("run4")));
}

TEST_F(BagImport, TimesAreOfTheHeaderOrOfTheRecorderAndExact) {
  // 1.7e9 s of an epoch and one nanosecond exceed the precision of a double in seconds.
  const std::uint64_t log_ns = 1'700'000'000'000'000'001;
  Log(MineBag().Message(log_ns, Mine(3, 0)).Message(log_ns + 7, Mine(4, 0)).bytes());
  ImportLog("zero: start\n" + Table("small", ", time: {column: log_time}"));
  EXPECT_EQ(Recording(Out()).LoadTable("digger/t.csv").t_ns, (std::vector<TimeNs>{0, 7}));
  ImportLog(Table("small", ", time: {column: header.stamp, offset: -3}"));
  EXPECT_EQ(Recording(Out()).LoadTable("digger/t.csv").t_ns,
            (std::vector<TimeNs>{250'000'000, 1'250'000'000}));
}

TEST_F(BagImport, ARuleLeavesOutMessagesWithoutAnElement) {
  const std::string short_one = Cdr()
                                    .Header(3, 0)
                                    .Add(std::int16_t{0})
                                    .Text("")
                                    .Add(0.f)
                                    .Add(0.f)
                                    .Add(0.f)
                                    .Add(std::uint32_t{0})
                                    .Add(std::uint32_t{0})
                                    .Add(std::uint64_t{0})
                                    .bytes();
  Log(MineBag().Message(1, Mine(1, 5)).Message(2, short_one).bytes());
  ImportLog(Table("parts[1].value", ", valid_if: [{column: 'parts[1].value', present: true}]"));
  EXPECT_EQ(Rows(), (std::vector<std::vector<double>>{{6}}));
  ExpectFault(Table("parts[1].value"), {"log.mcap: /t message 2", "field 'parts[1].value'",
                                        "no such element", "present: true"});
}

TEST_F(BagImport, PathsThatLeadNowhereAreToldOf) {
  Log(MineBag().Message(1, Mine(1, 5)).bytes());
  const std::string place = "log.mcap: topic /t (mine_msgs/Mine): ";
  ExpectFault(Table("smal"), {place, "no field 'smal' (did you mean 'small'?)"});
  ExpectFault(Table("triple[3]"), {place, "'triple' of mine_msgs/Mine has 3 elements"});
  ExpectFault(Table("triple"), {place, "need one of them in brackets"});
  ExpectFault(Table("small[0]"), {place, "no elements"});
  ExpectFault(Table("text"), {place, "'text' is string, need a number"});
  ExpectFault(Table("parts[0]"), {place, "'parts[0]' is mine_msgs/Part"});
  ExpectFault(Table("small.x"), {place, "'small.x' is int16"});
  ExpectFault(Table("triple[boom]"), {place, "no names of its elements"});
  ExpectFault(Table("triple[1"), {place, "lacks its ']'"});
  ExpectFault("tables: [{name: t, topic: /tt, columns: {v: {column: small, unit: '1'}}}]\n",
              {"mapping.yaml:4:", "tables[0].topic", "no topic '/tt'", "it has /t"});
  ExpectFault("tables: [{name: t, columns: {v: {column: small, unit: '1'}}}]\n",
              {"tables[0]", "topic", "need one of the bag's topics"});
  ExpectFault("imus: [{name: i, topic: /t}]\n",
              {"imus[0].topic", "has the type mine_msgs/Mine; need sensor_msgs/Imu"});
  Log(SmallMcap("sensor_msgs/msg/NavSatFix", "").bytes());
  ExpectFault("imus: [{name: i, topic: /t}]\n", {"has the type sensor_msgs/NavSatFix; need"});
  ExpectFault("pose: {topic: /t}\n",
              {"has the type sensor_msgs/NavSatFix; need nav_msgs/Odometry"});
}

TEST_F(BagImport, MessagesThatAreNotAsTheirDefinitionAreToldOfOrLeftOut) {
  std::string cut = Mine(2, 0), longer = Mine(3, 0) + std::string(8, '\0');
  cut.resize(cut.size() - 9);
  std::string endless = Mine(4, 0);
  endless.replace(20, 4, "\xff\xff\xff\x7f");  // the length of `text`
  for (const std::string& bad : {cut, longer, endless, std::string("\x00\x07\x00\x00", 4)}) {
    Log(MineBag().Message(1, Mine(1, 5)).Message(2, bad).Message(3, Mine(9, 7)).bytes());
    ExpectFault(Table("small"), {"log.mcap: /t message 2: it ", "--skip-bad-rows"});
    const ImportReport report = ImportLog(Table("small"), {.skips_bad_rows = true});
    EXPECT_EQ(report.channels[0].rows, 2);
    EXPECT_EQ(report.channels[0].left_out, 1);
    EXPECT_THAT(report.channels[0].first_fault, HasSubstr("message 2"));
  }
}

TEST_F(BagImport, AClockThatJumpsBackIsToldOf) {
  Log(MineBag().Message(1, Mine(5, 0)).Message(2, Mine(3, 0)).Message(3, Mine(6, 0)).bytes());
  ExpectFault(Table("small"), {"log.mcap: /t message 2: field 'header.stamp'", "3250000000 ns",
                               "need a later time"});
  EXPECT_EQ(ImportLog(Table("small"), {.skips_bad_rows = true}).channels[0].rows, 2);
}

TEST_F(BagImport, DefinitionsThatCannotBeReadAreToldOf) {
  const auto expect = [&](const SmallMcap& bag, const std::string& finding) {
    Log(bag.bytes());
    ExpectFault(Table("a"), {"log.mcap: topic /t (", finding});
  };
  expect(SmallMcap("m/A", "A a\n"), "contains m/A in itself");
  expect(SmallMcap("m/A", "B b\n=====\nMSG: m/B\nA[] a\n"), "contains m/A in itself");
  expect(SmallMcap("m/A", "B b\n"), "definition of m/B");
  expect(SmallMcap("m/A", "int32\n"), "has the line 'int32'");
  expect(SmallMcap("m/A", "int32[x] a\n"), "'int32[x]', which is not a type");
  expect(SmallMcap("m/A", "x", "ros2idl"), "written as 'ros2idl', need ros2msg");
  expect(SmallMcap("m/A", "int32 a\n", "ros2msg", "json"), "encoded as 'json'");
  std::string deep = "T0 t\n";
  for (int k = 0; k < 100; ++k) {
    deep += "=====\nMSG: m/T" + std::to_string(k) + "\nT" + std::to_string(k + 1) + " t\n";
  }
  expect(SmallMcap("m/A", deep), "nested deeper than 64");
}

TEST_F(BagImport, ArraysThatMultiplyAreNotCountedOut) {
  // A handful of bytes declares 2^32 times 2^32 elements.
  Log(SmallMcap("m/A",
                "int32 a\nB[4000000000] b\n=====\nMSG: m/B\nC[4000000000] c\n=====\nMSG: "
                "m/C\nfloat64 v\n")
          .Message(1, Cdr().Add(std::int32_t{1}).Add(1.0).bytes())
          .bytes());
  ExpectFault(Table("a"), {"/t message 1: ", "declares 4000000000 elements"});
  // Messages without fields take no bytes in ROS 1.
  Log(SmallMcap("m/A", "int32 a\nB[] b\n=====\nMSG: m/B\n", "ros1msg", "ros1")
          .Message(1, Packed().Add(std::int32_t{4}).Add(0xffffffffu).bytes())
          .bytes());
  ImportLog(Table("a"));
  EXPECT_EQ(Rows(), (std::vector<std::vector<double>>{{4}}));
}

TEST_F(BagImport, BigEndianMessagesAreRead) {
  const std::string bytes("\x00\x00\x00\x00\x00\x00\x01\x02\x3f\xc0\x00\x00", 12);
  Log(SmallMcap("m/A", "int32 a\nfloat32 b\n").Message(1, bytes).bytes());
  ImportLog(Table("b"));
  EXPECT_EQ(Rows(), (std::vector<std::vector<double>>{{1.5}}));
}

}  // namespace
}  // namespace tera
