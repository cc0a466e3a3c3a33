#include "dataset/export/export.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>

#include "core/faults.h"
#include "dataset/export/frames_recording.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/sample_recording.h"

namespace tera {
namespace {

using enum FaultKind;
using testing::HasSubstr;
using testing::StartsWith;
namespace fs = std::filesystem;

class ExportTest : public testing::Test {
 protected:
  ExportTest() {
    DatasetWriter writer(recording(), SampleInfo(), {});
    WriteSample(&writer, kSampleFrames);
    writer.Finish();
  }
  fs::path recording() const { return scratch_.path() / "run"; }
  fs::path out() const { return scratch_.path() / "out"; }

  ExportReport To(ExportFormat format, std::optional<TimeNs> start_utc_ns = std::nullopt) {
    return Export(recording(), out(), {.format = format, .start_utc_ns = start_utc_ns});
  }
  /// The fault of an export, which leaves no file behind.
  std::vector<InputFault> FaultOf(const ExportOptions& options, const fs::path& out) {
    const auto entries = [&] {
      std::size_t count = 0;
      for ([[maybe_unused]] const auto& e : fs::recursive_directory_iterator(scratch_.path())) {
        ++count;
      }
      return count;
    };
    const std::size_t before = entries();
    try {
      Export(recording(), out, options);
    } catch (const InputError& e) {
      EXPECT_EQ(entries(), before);
      return e.faults();
    }
    return {};
  }
  std::vector<InputFault> FaultOf(ExportFormat format) {
    return FaultOf({.format = format}, out());
  }
  /// Replaces `from` by `to` in a file of the recording.
  void Edit(const std::string& file, const std::string& from, const std::string& to) {
    std::string text = ReadWholeFile(recording() / file);
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << text;
    WriteWholeFile(recording() / file, text.replace(at, from.size(), to));
  }
  std::vector<std::string> LinesOf(const fs::path& file) const {
    std::ifstream stream(out() / file);
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
  }

  ScratchDirectory scratch_;
};

// Five frames of each sensor, many of them in progress at a time.
TEST_F(ExportTest, IsTheSameBytesWithAnyNumberOfThreads) {
  fs::remove_all(recording());
  WriteFramesRecording(recording());
  for (const ExportFormatName& format : kExportFormats) {
    if (!IsBag(format.format) && !GoesOnByFrames(format.format) &&
        format.format != ExportFormat::kPcd && format.format != ExportFormat::kLas) {
      continue;  // not of frames
    }
    std::map<std::string, std::string> by_one;
    for (const int threads : {1, 2, 7}) {
      ExportOptions options = {.format = format.format, .threads = threads};
      options.joint_trees = Tree;
      Export(recording(), out(), options);
      if (threads == 1) by_one = AllFiles(out());
      EXPECT_EQ(AllFiles(out()), by_one) << format.name << " " << threads;
      fs::remove_all(out());
    }
    EXPECT_FALSE(by_one.empty());
  }
}

TEST_F(ExportTest, APlaceThatIsTakenIsLeftAsItIs) {
  fs::create_directory(out());
  WriteWholeFile(out() / "diary.txt", "mine");
  EXPECT_THAT(FaultOf(ExportFormat::kTum), HasFault(kUnwritable, "out"));
  EXPECT_THAT(FaultOf({.format = ExportFormat::kTum}, recording() / "exported"),
              HasFault(kUnwritable));
  EXPECT_THAT(FaultOf({.format = ExportFormat::kTum}, scratch_.path() / ".."),
              HasFault(kUnwritable));
}

TEST_F(ExportTest, WhatARunThatWasStoppedHasLeftIsNotTouched) {
  fs::create_directory(scratch_.path() / "out.incomplete");
  WriteWholeFile(scratch_.path() / "out.incomplete/half.tum", "1 2");
  EXPECT_THAT(FaultOf(ExportFormat::kTum), HasFault(kUnwritable, "out.incomplete"));
}

TEST_F(ExportTest, ARecordingWithoutWhatTheFormatNeedsIsRefused) {
  Edit("dataset.yaml", "  - {path: \"digger/gnss\", type: gnss}\n", "");
  EXPECT_THAT(FaultOf(ExportFormat::kNmea), HasFault(kMissing, "run"));
}

TEST_F(ExportTest, APathThatLeadsOutOfTheRecordingIsRefused) {
  Edit("dataset.yaml", "truth/digger/pose.csv", "truth/../../digger/pose.csv");
  EXPECT_THAT(FaultOf(ExportFormat::kTum), HasFault(kMalformed, "dataset.yaml"));
}

TEST_F(ExportTest, AChannelThatIsThereTwiceIsRefused) {
  Edit("dataset.yaml", "digger/imu", "digger/joints");
  EXPECT_THAT(FaultOf(ExportFormat::kTum), HasFault(kRepeated));
}

TEST_F(ExportTest, ABrokenRowIsNamedAndNothingIsLeft) {
  Edit("truth/digger/pose.csv", "\n100000000,", "\n-1,");
  EXPECT_THAT(FaultOf(ExportFormat::kTum), HasFault(kMalformed, "truth/digger/pose.csv:3"));
}

TEST_F(ExportTest, AQuaternionThatIsNoneIsNamedWithItsOwnLine) {
  std::string rows = "t_ns,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,0,0,1,0,0,0\n1,0,0,0,0.5,0,0,0\n";
  WriteWholeFile(recording() / "truth/digger/pose.csv", rows + "2,0,0,0,1,0,0,0\n");
  EXPECT_THAT(FaultOf(ExportFormat::kTum), HasFault(kMalformed, "truth/digger/pose.csv:3"));
}

TEST_F(ExportTest, AFixThatIsNoneAndAPlaceThatCannotBeAreNamed) {
  Edit("digger/gnss/data.csv", ",5,", ",7,");
  EXPECT_THAT(FaultOf(ExportFormat::kPos), HasFault(kMalformed, "gnss/data.csv:2"));
  Edit("digger/gnss/data.csv", ",7,", ",5,");
  Edit("digger/gnss/data.csv", "46.78", "96.78");
  EXPECT_THAT(FaultOf(ExportFormat::kPos), HasFault(kMalformed, "gnss/data.csv:2"));
}

TEST_F(ExportTest, TumHasSecondsPositionAndQuaternionWithWLast) {
  const ExportReport report = To(ExportFormat::kTum);
  EXPECT_EQ(report.records, kSampleFrames);
  EXPECT_EQ(report.files, 1);
  const auto lines = LinesOf("digger.tum");
  ASSERT_EQ(lines.size(), 1u + kSampleFrames);
  EXPECT_EQ(lines[0], "# timestamp tx ty tz qx qy qz qw");
  double t_s, x, y, z, qx, qy, qz, qw;
  ASSERT_EQ(std::sscanf(lines[3].c_str(), "%lf %lf %lf %lf %lf %lf %lf %lf", &t_s, &x, &y, &z, &qx,
                        &qy, &qz, &qw),
            8);
  EXPECT_THAT(lines[3], StartsWith("0.200000000 1.2 2 -0.5 "));
  const Pose X_WB = MakePose(Vec3(1.2, 2, -0.5), 0.1, -0.2, 3.0);
  EXPECT_TRUE(Quat(qw, qx, qy, qz).toRotationMatrix().isApprox(X_WB.linear(), 1e-12));
  EXPECT_GE(qw, 0);
}

TEST_F(ExportTest, MessagesThatAreToldAreThoseOfTheBag) {
  const ExportReport report = To(ExportFormat::kRosbag2);
  const std::string metadata = ReadWholeFile(out() / "metadata.yaml");
  const std::string topics = metadata.substr(0, metadata.find("compression_format"));
  std::int64_t in_topics = 0;
  const std::string key = "\n      message_count: ";
  for (std::size_t at = 0; (at = topics.find(key, at)) != std::string::npos; ++at) {
    in_topics += std::stoll(topics.substr(at + key.size()));
  }
  EXPECT_EQ(report.messages, in_topics) << metadata;
  EXPECT_THAT(metadata, HasSubstr(fmt::format("\n  message_count: {}\n", report.messages)));
  EXPECT_NE(report.messages, report.records);
}

TEST_F(ExportTest, APictureThatIsNotThereIsTold) {
  fs::remove(recording() / "digger/front/rgb/200000000.png");
  fs::remove(recording() / "digger/front/depth/300000000.png");
  for (const BagImages images : {BagImages::kRaw, BagImages::kCompressed}) {
    const ExportReport report =
        Export(recording(), out(), {.format = ExportFormat::kBag, .images = images});
    EXPECT_EQ(report.absent.count, 2);
    EXPECT_EQ(report.absent.first, recording() / "digger/front/rgb/200000000.png");
    fs::remove_all(out());
  }
}

TEST_F(ExportTest, ADamagedPictureIsNotPutIntoABag) {
  const fs::path picture = recording() / "digger/front/rgb/200000000.png";
  const std::string whole = ReadWholeFile(picture);
  std::string flipped = whole, longer = whole + "x";
  flipped[whole.size() / 2] ^= 1;
  for (const std::string& bytes :
       {flipped, longer, whole.substr(0, whole.size() - 1), whole.substr(8), std::string()}) {
    WriteWholeFile(picture, bytes);
    EXPECT_THAT(
        FaultOf({.format = ExportFormat::kRosbag2, .images = BagImages::kCompressed}, out()),
        HasFault(kMalformed, "rgb/200000000.png"));
  }
}

TEST_F(ExportTest, AStartMovesAllTimes) {
  To(ExportFormat::kTum, 1'714'564'800 * kNsPerSecond);
  EXPECT_THAT(LinesOf("digger.tum").at(2), StartsWith("1714564800.100000000 "));
}

TEST_F(ExportTest, EurocHasNanosecondsVelocitiesAndInertialUnits) {
  To(ExportFormat::kEuroc);
  const auto poses = LinesOf("digger/state_groundtruth_estimate0/data.csv");
  ASSERT_EQ(poses.size(), 1u + kSampleFrames);
  EXPECT_THAT(poses[0], StartsWith("#timestamp [ns],p_RS_R_x [m],"));
  EXPECT_THAT(poses[2], StartsWith("100000000,1.1,2,-0.5,"));
  EXPECT_THAT(poses[2], testing::EndsWith(",1,0,0.25"));
  const auto imu = LinesOf("digger/imu/data.csv");
  ASSERT_EQ(imu.size(), 1u + kSampleFrames);
  EXPECT_EQ(imu[4].substr(0, imu[4].find("-0.33")), "300000000,0.30000000000000004,");
  EXPECT_THAT(imu[4], testing::EndsWith(",0.02,-0.3,9.80665"));
}

TEST_F(ExportTest, PosHasRtklibsColumnsAndQualities) {
  To(ExportFormat::kPos);
  const auto lines = LinesOf("digger/gnss.pos");
  ASSERT_EQ(lines.size(), 4u + kSampleFrames);
  EXPECT_THAT(lines[3], StartsWith("%  UTC                  latitude(deg) longitude(deg)"));
  // Float is 2 there; north 0.1414 m, east 0.1 m, up 0.2236 m.
  EXPECT_THAT(lines[4],
              StartsWith("2024/01/01 00:00:00.000   46.780000123  -71.270000000    91.2500   2   0 "
                         "  0.1414   0.1000   0.2236 "));
  EXPECT_THAT(lines[5], StartsWith("2024/01/01 00:00:00.100 "));
}

// 1 700 000 003 s after 1970 are 2023-11-14 22:13:23 UTC; GPS time is 18 s ahead of it.
TEST_F(ExportTest, FormatsWithDatesTakeThatOfTheEpoch) {
  const std::string text = ReadWholeFile(recording() / "dataset.yaml");
  const auto first_line = [&](const std::string& clock) {
    WriteWholeFile(
        recording() / "dataset.yaml",
        text + "epoch: {since_1970_ns: \"1700000003000000000\", clock: " + clock + "}\n");
    fs::remove_all(out());
    To(ExportFormat::kPos);
    return LinesOf("digger/gnss.pos")[4];
  };
  EXPECT_THAT(first_line("utc"), StartsWith("2023/11/14 22:13:23.000 "));
  EXPECT_THAT(first_line("gps"), StartsWith("2023/11/14 22:13:05.000 "));
}

TEST_F(ExportTest, NmeaHasASentenceOfEachKindForEachFix) {
  To(ExportFormat::kNmea);
  std::map<std::string, int> sentences;
  for (const std::string& line : LinesOf("digger/gnss.nmea")) ++sentences[line.substr(0, 6)];
  EXPECT_EQ(sentences,
            (std::map<std::string, int>{
                {"$GNGGA", kSampleFrames}, {"$GNRMC", kSampleFrames}, {"$GNGST", kSampleFrames}}));
}

}  // namespace
}  // namespace tera
