#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/other_program.h"
#include "core/error.h"
#include "dataset/format/recording.h"
#include "dataset/format/sample_recording.h"
#include "dataset/import/bag/bag_source.h"
#include "dataset/import/import_csv.h"
#include "dataset/import/suggest/suggest.h"

/// Bags written by foreign programs: test/app/judges/write_*.

namespace tera {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

class ForeignBag : public ::testing::Test {
 protected:
  /// Whether the program wrote the log.
  bool Write(const std::string& program, const std::string& file, const std::string& form) {
    log_ = scratch_.path() / file;
    return OutputOf(program + " '" + log_.string() + "' " + form + " 2>/dev/null").has_value();
  }
  bool WriteByPython(const std::string& script, const std::string& file, const std::string& form) {
    return Write("/usr/bin/python3 " TERA_SOURCE_DIR "/test/app/judges/" + script, file, form);
  }
  Recording Import(const std::string& keys) {
    WriteWholeFile(scratch_.path() / "mapping.yaml", "name: logged\nmachine: digger\nfile: " +
                                                         log_.filename().string() + "\n" + keys);
    fs::remove_all(scratch_.path() / "out");
    report_ = ImportCsv(scratch_.path() / "mapping.yaml", scratch_.path() / "out");
    return Recording(scratch_.path() / "out");
  }

  ScratchDirectory scratch_;
  fs::path log_;
  ImportReport report_;
};

TEST_F(ForeignBag, OfRosbagIsReadInEachCompression) {
  for (const std::string compression : {"none", "lz4", "bz2"}) {
    if (!WriteByPython("write_ros1_bag.py", "log.bag", compression)) {
      GTEST_SKIP() << "needs python3-rosbag";
    }
    const Recording recording = Import(
        "zero: start\nimus: [{name: imu, topic: /imu}]\n"
        "encoders: [{name: joints, topic: /joints}]\n");
    const auto imu = recording.LoadImu("digger/imu");
    ASSERT_EQ(imu.size(), 200u) << compression;
    EXPECT_EQ(report_.zero_ns, 1'700'000'000 * kNsPerSecond);  // of the header, not the recorder
    EXPECT_EQ(imu[150].t_ns, 1'500'000'000);
    EXPECT_EQ(imu[150].w_WS_S_radps, Vec3(1.5, -1.5, 0.5));
    EXPECT_EQ(imu[150].f_S_mps2, Vec3(0, 0.25, 9.81));
    const EncoderRecording joints = recording.LoadEncoder("digger/joints");
    ASSERT_EQ(joints.samples.size(), 20u);
    EXPECT_EQ(joints.axes, (std::vector<EncoderAxis>{{"boom"}, {"arm"}}));
    EXPECT_EQ(joints.samples[5].q_rad, (std::vector<double>{5, -5}));
    // No velocities: 1 rad in 0.1 s.
    EXPECT_NEAR(joints.samples[5].qd_radps[1], -10, 1e-9);
  }
}

TEST_F(ForeignBag, OfRosbag2InSqliteNeedsNoDefinitionOfStandardTypes) {
  for (const std::string compression : {"none", "zstd"}) {
    if (!WriteByPython("write_rosbag2.py", "log_" + compression + ".db3", compression)) {
      GTEST_SKIP() << "needs python3 and zstd";
    }
    const Recording recording = Import(
        "origin: {lat_deg: 46.78, lon_deg: -71.27, height_m: 91}\n"
        "gnss: [{name: gnss, topic: /fix, columns: {var_u: {constant: 9}, var_e: {column: "
        "'position_covariance[0]', unit: m2}}}]\n");
    const auto gnss = recording.LoadGnss("digger/gnss");
    ASSERT_EQ(gnss.size(), 4u);
    EXPECT_EQ(gnss[0].t_ns, 10'000'000'500);
    EXPECT_EQ(gnss[0].fix, GnssFix::kNone);
    EXPECT_EQ(gnss[1].fix, GnssFix::kSingle);
    EXPECT_EQ(gnss[2].fix, GnssFix::kDifferential);
    EXPECT_EQ(gnss[3].fix, GnssFix::kRtkFixed);
    EXPECT_EQ(gnss[2].variance_enu_m2, Vec3(1, 1, 9));
    EXPECT_NEAR(gnss[3].lat_deg, 46.781, 1e-12);
    try {
      Import("tables: [{name: t, topic: /picture, columns: {v: {column: height, unit: '1'}}}]\n");
      FAIL();
    } catch (const InputError& fault) {
      EXPECT_THAT(fault.what(), HasSubstr("topic /picture (their_msgs/Picture): neither the bag "
                                          "nor TERA has a definition"));
    }
  }
}

/// Fault of an import of `file`.
std::string FaultOfTopic(const fs::path& folder, const std::string& file,
                         const ImportOptions& options = {}) {
  WriteWholeFile(folder / "mapping.yaml",
                 "name: logged\nmachine: digger\nfile: " + file +
                     "\norigin: {lat_deg: 46.78, lon_deg: -71.27, height_m: 91}\n"
                     "gnss: [{name: gnss, topic: /fix, columns: {var_e: {constant: 1}, var_n: "
                     "{constant: 1}, var_u: {constant: 9}}}]\n");
  fs::remove_all(folder / "out");
  try {
    ImportCsv(folder / "mapping.yaml", folder / "out", options);
  } catch (const InputError& fault) {
    EXPECT_FALSE(fs::exists(folder / "out"));
    return fault.what();
  }
  return "no fault";
}

// As rosbag2 writes them with compression_mode FILE.
TEST_F(ForeignBag, CompressedAsAWholeByZstdIsRead) {
  if (!WriteByPython("write_rosbag2.py", "log.db3", "none") || !HasProgram("zstd")) {
    GTEST_SKIP() << "needs python3 and zstd";
  }
  const fs::path folder = scratch_.path(), packed = folder / "log.db3.zstd";
  const auto pack = [&](const fs::path& file, const fs::path& to) {
    return OutputOf("zstd -q -f '" + file.string() + "' -o '" + to.string() + "'").has_value();
  };
  ASSERT_TRUE(pack(log_, packed));
  fs::rename(log_, folder / "other.db3");
  WriteWholeFile(folder / "metadata.yaml",
                 "rosbag2_bagfile_information:\n  compression_format: zstd\n  compression_mode: "
                 "FILE\n  relative_file_paths: [log.db3.zstd]\n");
  for (const char* file : {"log.db3.zstd", "metadata.yaml", "./"}) {
    EXPECT_EQ(FaultOfTopic(folder, file), "no fault");
    EXPECT_EQ(Recording(folder / "out").LoadGnss("digger/gnss").size(), 4u) << file;
  }
  // The bytes decide, independent of the name.
  for (const char* file : {"log.db3.zst", "log.zst", "recording"}) {
    fs::copy(packed, folder / file);
    EXPECT_EQ(FaultOfTopic(folder, file), "no fault") << file;
    EXPECT_EQ(Recording(folder / "out").LoadGnss("digger/gnss").size(), 4u) << file;
    EXPECT_THAT(SuggestMapping(folder / file), HasSubstr("topic: \"/fix\"")) << file;
  }
  const std::string bytes = ReadWholeFile(packed);
  WriteWholeFile(packed, bytes.substr(0, bytes.size() / 2));
  EXPECT_THAT(FaultOfTopic(folder, "log.db3.zstd"),
              testing::AllOf(HasSubstr("log.db3.zstd: ends within its zstd frame"),
                             HasSubstr("copy the file again")));
  WriteWholeFile(packed, bytes.substr(0, 8) + std::string(60, 'x'));
  EXPECT_THAT(FaultOfTopic(folder, "log.db3.zstd"), HasSubstr("cannot be unpacked by zstd"));
  // A bomb: zeros to more than a thousand times its size.
  ASSERT_TRUE(
      OutputOf("head -c 100000000 /dev/zero | zstd -q -f -19 -o '" + packed.string() + "'"));
  EXPECT_THAT(FaultOfTopic(folder, "log.db3.zstd"), HasSubstr("which is no plausible bag"));
  // A packed file is reported by its own name, not by that of its unpacked copy.
  WriteWholeFile(folder / "text", "t,x\n0,1\n");
  ASSERT_TRUE(pack(folder / "text", packed));
  EXPECT_THAT(FaultOfTopic(folder, "log.db3.zstd"), HasSubstr("log.db3.zstd: is not a bag"));
}

// A long recording split by rosbag2, which each channel reads again.
TEST_F(ForeignBag, InSeveralFilesEachCompressedIsUnpackedOnce) {
  if (!WriteByPython("write_rosbag2.py", "log.db3", "none") || !HasProgram("zstd")) {
    GTEST_SKIP() << "needs python3 and zstd";
  }
  const fs::path folder = scratch_.path();
  // As left by a recorder with a write-ahead log next to the file.
  ASSERT_TRUE(
      OutputOf("/usr/bin/python3 -c \"import sqlite3, sys; "
               "sqlite3.connect(sys.argv[1]).execute('PRAGMA journal_mode=WAL')\" '" +
               log_.string() + "'"));
  for (const char* part : {"run_0.db3.zstd", "run_1.db3.zstd"}) {
    ASSERT_TRUE(
        OutputOf("zstd -q -f '" + log_.string() + "' -o '" + (folder / part).string() + "'"));
  }
  WriteWholeFile(folder / "metadata.yaml",
                 "rosbag2_bagfile_information:\n  relative_file_paths: [run_0.db3.zstd, "
                 "run_1.db3.zstd]\n");
  log_ = folder / "metadata.yaml";
  class Counts : public BagVisitor {
   public:
    Wish Wants(const BagTopic&) override { return Wish::kTake; }
    bool Take(std::size_t, const BagMessage&) override { return ++messages > 0; }
    int messages = 0;
  };
  UnpackedFiles unpacked;
  Counts first, again;
  ReadBag(log_, &unpacked, &first, /*to_the_damage=*/false);
  for (const char* part : {"run_0.db3.zstd", "run_1.db3.zstd"}) {
    WriteWholeFile(folder / part, ReadWholeFile(folder / part).substr(0, 20));
  }
  ReadBag(log_, &unpacked, &again, /*to_the_damage=*/false);
  EXPECT_GT(first.messages, 0);
  EXPECT_EQ(again.messages, first.messages);
}

TEST_F(ForeignBag, OfTheLibraryOfMcapIsRead) {
  const std::string modules = TERA_NODE_MODULES;
  for (const std::string form : {"chunked", "plain"}) {
    if (!fs::is_directory(modules + "/@mcap/core") ||
        !Write("node " TERA_SOURCE_DIR "/test/app/judges/write_mcap.mjs '" + modules + "'",
               "log.mcap", form)) {
      GTEST_SKIP() << "needs node and the npm packages that test/app/judges/write_mcap.mjs names: "
                      "npm install them, and cmake -D TERA_NODE_MODULES=FOLDER/node_modules";
    }
    const PoseRecording pose = Import("pose: {topic: /pose}\n").LoadPose("truth/digger/pose.csv");
    ASSERT_EQ(pose.poses.size(), 50u) << form;
    EXPECT_EQ(pose.poses[31].t_ns, 3'100'000'000);
    EXPECT_EQ(pose.poses[31].X_WB.translation(), Vec3(31, 15.5, -1));
    // cos = 0.8^2 - 0.6^2, sin = 2 * 0.6 * 0.8.
    EXPECT_NEAR(pose.poses[31].X_WB.linear()(0, 0), 0.28, 1e-12);
    EXPECT_NEAR(pose.poses[31].X_WB.linear()(1, 0), 0.96, 1e-12);
  }
}

}  // namespace
}  // namespace tera
