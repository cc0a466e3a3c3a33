#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/faults.h"
#include "dataset/files/tiny_disk.h"
#include "dataset/format/sample_recording.h"

namespace tera {
namespace {

using enum FaultKind;
namespace fs = std::filesystem;

TEST(DatasetWriter, RefusesADirectoryThatIsNotEmpty) {
  ScratchDirectory scratch;
  WriteWholeFile(scratch.path() / "diary.txt", "mine");
  EXPECT_THAT([&] { DatasetWriter(scratch.path(), SampleInfo(), {}); },
              ThrowsFault(kUnwritable, scratch.path().string()));
  EXPECT_EQ(ReadWholeFile(scratch.path() / "diary.txt"), "mine");
}

TEST(DatasetWriter, FillsAnEmptyDirectoryEvenWithASlashAtTheEnd) {
  ScratchDirectory scratch;
  fs::create_directory(scratch.path() / "run");
  WriteWholeSample((scratch.path() / "run").string() + "/", {});
  EXPECT_TRUE(fs::exists(scratch.path() / "run/dataset.yaml"));
}

TEST(DatasetWriter, RefusesAnIncompleteRecordingUnlessToldToResume) {
  ScratchDirectory scratch;
  { const DatasetWriter writer(scratch.path() / "run", SampleInfo(), {}); }
  EXPECT_THAT([&] { DatasetWriter(scratch.path() / "run", SampleInfo(), {}); },
              ThrowsFault(kUnwritable, "run.incomplete"));
}

TEST(DatasetWriter, RefusesAPlaceWhereItCannotWrite) {
  ScratchDirectory scratch;
  WriteWholeFile(scratch.path() / "file", "not a folder");
  for (const fs::path& place :
       {scratch.path() / "file" / "run", fs::path("/proc/tera_cannot_write_here")}) {
    EXPECT_THAT([&] { DatasetWriter(place, SampleInfo(), {}); },
                ThrowsFault(kUnwritable, place.filename().string() + ".incomplete"));
  }
  EXPECT_EQ(AllFiles(scratch.path()).size(), 1u);
}

TEST(DatasetWriter, FullDiskStopsTheRunWithOneMessageFromTheWorkers) {
  ScratchDirectory scratch;
  const TinyDisk disk(scratch.path() / "disk", "256k");
  ASSERT_TRUE(disk.mounted()) << "needs root, or the right to make user namespaces";
  DatasetWriter writer(scratch.path() / "disk/run", SampleInfo(), {});
  const ChannelId lidar = writer.AddChannel(LidarChannel("m/lidar", ""));
  const auto fill = [&] {
    for (int k = 0; k < 1000; ++k) writer.Write(lidar, SampleScan(k, 2000));
    writer.Finish();
  };
  EXPECT_THAT(fill, ThrowsFault(kUnwritable));
  EXPECT_FALSE(fs::exists(scratch.path() / "disk/run"));
  EXPECT_TRUE(fs::exists(scratch.path() / "disk/run.incomplete/INCOMPLETE.txt"));
}

TEST(DatasetWriter, RefusesNamesThatNoFileCanHave) {
  ScratchDirectory scratch;
  fs::create_symlink("loop", scratch.path() / "loop");
  EXPECT_THAT([&] { DatasetWriter(scratch.path() / std::string(300, 'x'), SampleInfo(), {}); },
              ThrowsFault(kUnwritable));
  EXPECT_THAT([&] { DatasetWriter(scratch.path() / "loop/run", SampleInfo(), {}); },
              ThrowsFault(kUnwritable));
}

}  // namespace
}  // namespace tera
