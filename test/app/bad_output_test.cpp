#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/refused.h"
#include "core/faults.h"
#include "dataset/files/tiny_disk.h"

// Impossible places for a dataset, and pictures without OpenGL.

namespace tera {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;
namespace fs = std::filesystem;

constexpr char kNeedsTinyDisk[] = "needs root, or the right to make user namespaces";

class BadOutput : public testing::Test {
 protected:
  BadOutput() { WriteWholeFile(scratch_.path() / "small.yaml", SmallScenario()); }

  void ExpectOutRefused(const std::string& out,
                        const testing::Matcher<const std::string&>& message) {
    ExpectRefused(scratch_, {"generate", "small.yaml", "--out", out}, message);
  }

  ScratchDirectory scratch_;
};

TEST_F(BadOutput, ADirectoryThatIsNotEmptyIsRefused) {
  fs::create_directory(scratch_.path() / "run");
  WriteWholeFile(scratch_.path() / "run/diary.txt", "mine");
  ExpectOutRefused("run", TellsOf("run"));
  ExpectOutRefused("small.yaml", TellsOf("small.yaml"));
}

TEST_F(BadOutput, ANameThatIsNoneIsRefused) {
  for (const char* out : {"", ".", "..", "/"}) {
    ExpectOutRefused(out, HasSubstr("give the recording's folder a name"));
  }
}

TEST_F(BadOutput, ADirectoryThatMayNotBeWrittenIsRefused) {
  // Root may write to a folder of any mode, but not to a read-only disk.
  TinyDisk disk(scratch_.path() / "disk", "1m");
  ASSERT_TRUE(disk.mounted() && disk.MakeReadOnly("1m")) << kNeedsTinyDisk;
  ExpectOutRefused("disk/run", AllOf(StartsWith("disk/run"), HasSubstr("cannot be created: "),
                                     HasSubstr("Read-only file system"),
                                     HasSubstr("choose a folder that you may write to")));
}

TEST_F(BadOutput, APlaceForNoFoldersIsRefused) {
  ExpectOutRefused("/proc/tera/run", AllOf(HasSubstr("folder cannot be created: "),
                                           HasSubstr("choose a folder that you may write to")));
}

TEST_F(BadOutput, ANameThatNoFileCanHaveIsRefused) {
  ExpectOutRefused(std::string(300, 'x'), HasSubstr("File name too long"));
  fs::create_symlink("loop", scratch_.path() / "loop");
  ExpectOutRefused("loop/run", HasSubstr("symbolic links"));
}

TEST_F(BadOutput, ADiskThatIsFullBeforeTheRunIsLeftAsItWas) {
  const TinyDisk disk(scratch_.path() / "disk", "8k");
  ASSERT_TRUE(disk.mounted()) << kNeedsTinyDisk;
  ExpectOutRefused("disk/run", AllOf(StartsWith("disk/run"), HasSubstr("No space left on device"),
                                     HasSubstr("free space on that disk")));
}

TEST_F(BadOutput, ADiskThatFillsUpKeepsARunThatCanBeFinished) {
  TinyDisk disk(scratch_.path() / "disk", "512k");
  ASSERT_TRUE(disk.mounted()) << kNeedsTinyDisk;
  WriteWholeFile(scratch_.path() / "small.yaml",
                 Edited(SmallScenario(Edited(kLidar, "columns: 128", "columns: 512")),
                        "duration_s: 0.4", "duration_s: 3"));
  const Arguments on_disk = {"generate", "small.yaml", "--out", "disk/run"};
  const Outcome full = RunTera(on_disk, {scratch_.path()});
  EXPECT_EQ(full.status, 2);
  EXPECT_THAT(full.err, AllOf(HasSubstr("No space left on device; free space on that disk"),
                              HasSubstr("disk/run.incomplete"), HasSubstr("--resume")));
  EXPECT_FALSE(fs::exists(scratch_.path() / "disk/run"));

  ASSERT_TRUE(disk.Grow("64m"));
  Arguments resume = on_disk;
  resume.push_back("--resume");
  const Outcome resumed = RunTera(resume, {scratch_.path()});
  EXPECT_EQ(resumed.status, 0) << resumed.err;
  const Outcome whole = RunTera({"generate", "small.yaml", "--out", "whole"}, {scratch_.path()});
  EXPECT_EQ(whole.status, 0) << whole.err;
  EXPECT_TRUE(AllFiles(scratch_.path() / "disk/run") == AllFiles(scratch_.path() / "whole"));
}

// No OpenGL: a loader without drivers.

const std::map<std::string, std::string> kNoEgl = {{"__EGL_VENDOR_LIBRARY_DIRS", "/nonexistent"},
                                                   {"__EGL_VENDOR_LIBRARY_FILENAMES", ""}};

TEST(NoEgl, ACameraIsRefusedWithThePackagesToInstall) {
  const ScratchDirectory scratch;
  WriteWholeFile(scratch.path() / "small.yaml", SmallScenario(kCamera));
  const auto message = AllOf(StartsWith("no EGL platform gives an OpenGL 4.5 core context"),
                             HasSubstr("install Mesa's software renderer"));
  ExpectRefused(scratch, {"generate", "small.yaml", "--out", "run"}, message, kNoEgl);
  ExpectRefused(scratch, {"info"}, message, kNoEgl);
}

TEST(NoEgl, ADeviceThatIsNotThereIsRefused) {
  const ScratchDirectory scratch;
  WriteWholeFile(scratch.path() / "small.yaml", SmallScenario(kCamera));
  const auto message = AllOf(StartsWith("EGL device 99 asked for, but there "),
                             HasSubstr("give an index below that, or none"));
  ExpectRefused(scratch, {"generate", "small.yaml", "--out", "run", "--egl-device", "99"}, message);
  ExpectRefused(scratch, {"info", "--egl-device", "99"}, message);
}

TEST(NoEgl, ARigWithoutCamerasNeedsNone) {
  const ScratchDirectory scratch;
  WriteWholeFile(scratch.path() / "small.yaml", SmallScenario(kLidar));
  const Outcome outcome =
      RunTera({"generate", "small.yaml", "--out", "run"}, {scratch.path(), kNoEgl});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(fs::exists(scratch.path() / "run/rover1/lidar/data.csv"));
}

}  // namespace
}  // namespace tera
