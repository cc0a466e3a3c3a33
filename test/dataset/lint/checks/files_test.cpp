#include <gmock/gmock.h>

#include "core/faults.h"
#include "dataset/lint/healthy_recording.h"

// dataset.* and files.*: each broken by itself.

namespace tera {
namespace {

using enum FaultKind;
using testing::HasSubstr;
namespace fs = std::filesystem;

class FileRules : public LintTest {};

TEST_F(FileRules, AChannelThatIsListedTwice) {
  Edit("dataset.yaml", "channels:\n",
       "channels:\n  - {path: \"digger/commands.csv\", type: table}\n");
  EXPECT_THAT(Only("dataset.paths", "digger/commands.csv").places[0].message,
              HasSubstr("listed twice"));
}

TEST_F(FileRules, AChannelOutsideOfTheDataset) {
  fs::copy(run() / "digger/commands.csv", run().parent_path() / "other.csv");
  Edit("dataset.yaml", "channels:\n", "channels:\n  - {path: \"../other.csv\", type: table}\n");
  Only("dataset.paths", "../other.csv");
}

TEST_F(FileRules, InstancesThatContradictEachOther) {
  Edit("dataset.yaml", "{id: 1, name: \"truck\", class: truck}",
       "{id: 1, name: \"truck\", class: truck, parent: 7}");
  Edit("dataset.yaml", "class: vehicle}\n",
       "class: vehicle}\n  - {id: 8, name: \"hut\", class: castle}\n"
       "  - {id: 8, name: \"hut2\", class: structure}\n");
  const LintReport report = Linted();
  ASSERT_EQ(report.findings[0].rule->id, "dataset.instances");
  EXPECT_EQ(report.findings[0].count, 3);  // parent, class, id
}

TEST_F(FileRules, AnEpochInMilliseconds) {
  Edit("dataset.yaml", "\"1700000000000000000\"", "\"1700000000000\"");
  EXPECT_THAT(Only("dataset.epoch", "").places[0].message, testing::HasSubstr("1700 s after"));
}

TEST_F(FileRules, AnEpochThatIsNoNumberIsRefusedWithItsPlace) {
  Edit("dataset.yaml", "\"1700000000000000000\"", "\"1.7e18\"");
  EXPECT_THAT([&] { Linted(); }, ThrowsFault(kInconsistent, "epoch.since_1970_ns"));
}

TEST_F(FileRules, AMissingChannel) {
  fs::remove(run() / "digger/commands.csv");
  Only("files.missing", "digger/commands.csv");
}

TEST_F(FileRules, AMissingPicture) {
  fs::remove(run() / "digger/front/rgb/400000000.png");
  const LintFinding finding = Only("files.missing", "digger/front");
  EXPECT_EQ(finding.places[0].line, 4);
  EXPECT_THAT(finding.places[0].message, HasSubstr("digger/front/rgb/400000000.png"));
}

TEST_F(FileRules, AMissingScan) {
  fs::remove(run() / "digger/lidar/scans/0.pcd");
  Only("files.missing", "digger/lidar");
}

TEST_F(FileRules, APictureThatNoRowNames) {
  fs::copy(run() / "digger/front/rgb/0.png", run() / "digger/front/rgb/7.png");
  EXPECT_EQ(Only("files.extra", "digger/front").places[0].file, "digger/front/rgb/7.png");
}

TEST_F(FileRules, AFileAndAFolderThatNobodyKnows) {
  Put("digger/imu/data.csv.part", "half");
  fs::create_directories(run() / "digger/old_camera/rgb");
  Put("digger/old_camera/rgb/0.png", "");
  const LintFinding finding = Only("files.unknown", "");
  EXPECT_EQ(finding.count, 2);
}

TEST_F(FileRules, WhatOtherCommandsWriteIsKnown) {
  Put("overview.png", "");
  Put("overview.mp4", "");
  Put("truth/terrain/height_200000000.tif", "");
  EXPECT_TRUE(Found().empty());
}

TEST_F(FileRules, ASheetThatIsMissingOrOfAnotherType) {
  Edit("digger/joints/sensor.yaml", "type: encoder", "type: imu");
  Only("files.sheet", "digger/joints");
  fs::remove(run() / "digger/joints/sensor.yaml");
  Only("files.sheet", "digger/joints");
}

TEST_F(FileRules, HashesAreHeldOnceTheyAreWritten) {
  // Frames of 11 x 8 pictures with boxes and 21 scans, 5 sensors of two files, 3 tables, 1 of
  // events, and 2 descriptions.
  EXPECT_EQ(WriteFrameHashes(run()), 88 + 21 + 10 + 3 + 1 + 2);
  EXPECT_TRUE(Found().empty());
  // sha256sum reads the list, which has its format.
  const std::string check = "cd '" + run().string() + "' && sha256sum -c --quiet frames.sha256";
  EXPECT_EQ(std::system(check.c_str()), 0);
}

TEST_F(FileRules, AFileThatChangedAfterItsHash) {
  WriteFrameHashes(run());
  std::string text = ReadWholeFile(run() / "digger/commands.csv");
  text.replace(text.rfind("0.5"), 3, "0.4");
  Put("digger/commands.csv", text);
  EXPECT_EQ(Only("files.hash", "").places[0].file, "digger/commands.csv");
}

TEST_F(FileRules, AListOfHashesThatIsNoneOrLacksAFile) {
  WriteFrameHashes(run());
  std::string text = ReadWholeFile(run() / "frames.sha256");
  text.replace(0, text.find('\n'), "gone");  // dataset.yaml's line
  Put("frames.sha256", text);
  const LintFinding finding = Only("files.hash", "");
  ASSERT_EQ(finding.count, 2);
  EXPECT_EQ(finding.places[0].line, 1);
  EXPECT_EQ(finding.places[1].file, "dataset.yaml");
}

}  // namespace
}  // namespace tera
