#include "dataset/export/stopped_export.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "core/faults.h"
#include "dataset/export/export.h"
#include "dataset/export/frames_recording.h"
#include "dataset/export/webdataset/tar_writer.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/sample_recording.h"

// Exports stopped by a damaged file in the middle, and resumed after its repair.

namespace tera {
namespace {

using enum FaultKind;
using testing::HasSubstr;
namespace fs = std::filesystem;

class StoppedExport : public testing::Test {
 protected:
  StoppedExport() { WriteFramesRecording(run()); }
  fs::path run() const { return scratch_.path() / "run"; }
  fs::path out() const { return scratch_.path() / "out"; }
  fs::path half() const { return scratch_.path() / "out.incomplete"; }

  std::vector<InputFault> FaultOf(const ExportOptions& options) {
    try {
      Export(run(), out(), options);
    } catch (const InputError& e) {
      return e.faults();
    }
    return {};
  }
  /// A stopped export with these options that left this file.
  void LeaveHalf(const ExportOptions& options, const std::string& name) {
    fs::create_directories(half());
    WriteWholeFile(half() / "INCOMPLETE.export", ExportKey(Recording(run()), options));
    WriteWholeFile(half() / name, "half");
  }
  /// Stops an export at frame 2, resumes it, and counts the files that are not written again.
  int KeptOf(ExportOptions options, const std::string& damaged) {
    options.joint_trees = Tree;
    Export(run(), out(), options);
    const auto whole = AllFiles(out());
    fs::remove_all(out());

    options.resume = true;
    const std::string bytes = ReadWholeFile(run() / damaged);
    WriteWholeFile(run() / damaged, bytes.substr(0, bytes.size() / 2));
    EXPECT_THAT(FaultOf(options), HasFaultAt(damaged));
    EXPECT_FALSE(fs::exists(out()));
    ExportOptions without = options;
    without.resume = false;
    EXPECT_THAT(FaultOf(without), HasFault(kUnwritable, "out.incomplete"));

    const auto old = fs::file_time_type::clock::now() - std::chrono::hours(1);
    for (const auto& [name, content] : AllFiles(half())) fs::last_write_time(half() / name, old);
    // State after a kill: incomplete frames, and files under temporary names.
    for (const auto& [name, content] : whole) {
      if (fs::exists((half() / name).parent_path()) && !fs::exists(half() / name)) {
        WriteWholeFile(half() / name, "ha");
      }
    }
    WriteWholeFile(run() / damaged, bytes);
    Export(run(), out(), options);
    EXPECT_EQ(AllFiles(out()), whole);
    EXPECT_FALSE(fs::exists(half()));
    int kept = 0;
    for (const auto& [name, content] : whole) kept += fs::last_write_time(out() / name) == old;
    return kept;
  }

  ScratchDirectory scratch_;
};

constexpr const char* kPicture = "digger/front/rgb/250000000.png";
constexpr const char* kScan = "digger/lidar/scans/200000000.pcd";

// Two frames are complete: for each, picture and points in all three layouts that have them, calib
// and label_2 of object, oxts of raw, and depth.
TEST_F(StoppedExport, OfKittiGoesOnWithTheFramesThatAreWhole) {
  EXPECT_EQ(KeptOf({.format = ExportFormat::kKitti}, kPicture), 2 * (2 * 4 + 2 + 1 + 1));
}

TEST_F(StoppedExport, OfTracksHasTheLabelsOfAllFrames) {
  EXPECT_EQ(KeptOf({.format = ExportFormat::kKitti,
                    .kitti_layouts = {KittiLayout::kTracking, KittiLayout::kObject}},
                   kScan),
            2 * (2 * 2 + 2));
}

TEST_F(StoppedExport, OfSemanticKittiCountsTheLabelsOfAllScans) {
  EXPECT_EQ(KeptOf({.format = ExportFormat::kSemanticKitti}, kScan), 2 * 2);
}

TEST_F(StoppedExport, OfCocoNumbersAllImages) {
  EXPECT_EQ(KeptOf({.format = ExportFormat::kCoco}, kPicture), 2 * 2);
}

// Annotations come first, so the damaged file must be irrelevant to them: a picture. By then three
// scans and two pictures are complete; scans 0 and 2 belong to samples and have labels.
TEST_F(StoppedExport, OfNuscenesHasItsTablesOfAllFrames) {
  EXPECT_EQ(KeptOf({.format = ExportFormat::kNuscenes, .key_frames_hz = 5}, kPicture), 3 + 2 + 2);
}

// An archive is complete once the next sample arrives: for scans those before 2, for pictures that
// of 0.
TEST_F(StoppedExport, OfWebdatasetGoesOnWithTheArchivesThatAreWhole) {
  EXPECT_EQ(KeptOf({.format = ExportFormat::kWebdataset, .shard_bytes = 1}, kPicture), 2 + 1);
}

// The archive of scans comes first; its samples are named by their times.
TEST_F(StoppedExport, OfWebdatasetWritesAnewWhatHoldsNoSamples) {
  ExportOptions options = {.format = ExportFormat::kWebdataset};
  Export(run(), out(), options);
  const auto whole = AllFiles(out());
  fs::remove_all(out());
  const auto archive = std::ranges::find_if(
      whole, [](const auto& file) { return file.first.ends_with("-000000.tar"); });
  ASSERT_NE(archive, whole.end());
  LeaveHalf(options, archive->first);
  TarWriter tar(half() / archive->first);
  tar.Add("", "notes.of.mine", "");
  tar.Commit();
  options.resume = true;
  Export(run(), out(), options);
  for (const auto& [name, content] : whole) {
    EXPECT_TRUE(ReadWholeFile(out() / name) == content) << name;
  }
}

TEST_F(StoppedExport, OfOneFileBeginsAgain) {
  ExportOptions options = {.format = ExportFormat::kTum};
  LeaveHalf(options, "half.tum.part");
  EXPECT_THAT(FaultOf(options), HasFault(kUnwritable, "out.incomplete"));
  options.resume = true;
  Export(run(), out(), options);
  const auto files = AllFiles(out());
  ASSERT_EQ(files.size(), 1u);
  EXPECT_THAT(files.at("digger.tum"), HasSubstr("\n0.400000000 4 0 0 "));
}

TEST_F(StoppedExport, OfOtherOptionsOrAnotherDatasetIsLeftAsItIs) {
  ExportOptions options = {.format = ExportFormat::kCoco, .resume = true};
  LeaveHalf(options, "mine.png");
  options.start_utc_ns = 5;
  EXPECT_THAT(FaultOf(options), HasFault(kInconsistent, "out.incomplete"));
  options.start_utc_ns.reset();
  WriteWholeFile(run() / "digger/front/data.csv",
                 ReadWholeFile(run() / "digger/front/data.csv") + "900000000,900000000.png\n");
  EXPECT_THAT(FaultOf(options), HasFault(kInconsistent, "out.incomplete"));
  fs::remove(half() / "INCOMPLETE.export");
  EXPECT_THAT(FaultOf(options), HasFault(kUnwritable, "out.incomplete"));
  EXPECT_EQ(ReadWholeFile(half() / "mine.png"), "half");
}

TEST_F(StoppedExport, ThatHasNothingWholeLeavesNothing) {
  WriteWholeFile(run() / "digger/front/rgb/50000000.png", "half");
  const ExportOptions options = {.format = ExportFormat::kCoco, .resume = true};
  EXPECT_THAT(FaultOf(options), HasFaultAt("50000000.png"));
  EXPECT_FALSE(fs::exists(half()));
}

}  // namespace
}  // namespace tera
