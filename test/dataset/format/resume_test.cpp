#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <fstream>

#include "core/faults.h"
#include "dataset/format/sample_recording.h"

namespace tera {
namespace {

using enum FaultKind;
using testing::HasSubstr;
namespace fs = std::filesystem;

WriterOptions Resume() {
  WriterOptions options;
  options.resume = true;
  return options;
}

TEST(DatasetWriter, ASecondWriterOfTheSameRecordingIsRefusedWhileTheFirstRuns) {
  ScratchDirectory scratch;
  const fs::path folder = scratch.path() / "run";
  {
    DatasetWriter first(folder, SampleInfo(), {});
    EXPECT_THAT([&] { DatasetWriter second(folder, SampleInfo(), Resume()); },
                ThrowsFault(kUnwritable, "run.incomplete"));
    EXPECT_THAT([&] { DatasetWriter second(folder, SampleInfo(), {}); },
                ThrowsFault(kUnwritable, "run.incomplete"));
  }
  EXPECT_NO_THROW(DatasetWriter(folder, SampleInfo(), Resume()).Discard());
}

TEST(DatasetWriter, AWholeRecordingIsNotNamedWhileItsWriterHoldsIt) {
  ScratchDirectory scratch;
  const fs::path folder = scratch.path() / "run";
  DatasetWriter first(folder, SampleInfo(), {});
  std::ofstream(first.incomplete_directory() / "dataset.yaml") << "all is written";
  EXPECT_THAT([&] { DatasetWriter::FinishWhole(folder, SampleInfo()); },
              ThrowsFault(kUnwritable, "run.incomplete"));
  EXPECT_FALSE(fs::exists(folder));
}

TEST(DatasetWriter, WritesTheSameBytesWithOneAndFourThreads) {
  ScratchDirectory scratch;
  WriterOptions options;
  options.threads = 1;
  WriteWholeSample(scratch.path() / "one", options);
  options.threads = 4;
  options.queue_length = 2;
  WriteWholeSample(scratch.path() / "four", options);
  EXPECT_EQ(AllFiles(scratch.path() / "one"), AllFiles(scratch.path() / "four"));
}

TEST(DatasetWriter, LeavesNothingButTheRecordingBehind) {
  ScratchDirectory scratch;
  WriteWholeSample(scratch.path() / "run", {});
  EXPECT_FALSE(fs::exists(scratch.path() / "run.incomplete"));
  for (const auto& [name, bytes] : AllFiles(scratch.path() / "run")) {
    EXPECT_THAT(name, testing::Not(HasSubstr("INCOMPLETE")));
    EXPECT_THAT(name, testing::Not(HasSubstr(".part")));
  }
}

TEST(DatasetWriter, CountsFramesAndBytes) {
  ScratchDirectory scratch;
  DatasetWriter writer(scratch.path() / "run", SampleInfo(), {});
  WriteSample(&writer, 3);
  writer.Finish();
  EXPECT_EQ(writer.frames_written(), 6);  // 3 of the camera, 3 of the lidar
  EXPECT_GT(writer.bytes_written(), 0);
}

TEST(DatasetWriter, StoppedRunIsMarkedAndResumesToTheSameBytes) {
  ScratchDirectory scratch;
  WriteWholeSample(scratch.path() / "whole", {});
  {
    DatasetWriter writer(scratch.path() / "run", SampleInfo(), {});
    WriteSample(&writer, 3);
  }
  EXPECT_FALSE(fs::exists(scratch.path() / "run"));
  EXPECT_THAT(ReadWholeFile(scratch.path() / "run.incomplete/INCOMPLETE.txt"),
              HasSubstr("--resume"));
  WriteWholeSample(scratch.path() / "run", Resume());
  EXPECT_EQ(AllFiles(scratch.path() / "whole"), AllFiles(scratch.path() / "run"));
}

TEST(DatasetWriter, KilledProcessResumesToTheSameBytes) {
  ScratchDirectory scratch;
  WriteWholeSample(scratch.path() / "whole", {});
  const pid_t child = fork();
  if (child == 0) {
    DatasetWriter writer(scratch.path() / "run", SampleInfo(), {});
    WriteSample(&writer, 4);
    raise(SIGKILL);  // with frames still in the queue, perhaps half a file on the disk
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  WriteWholeSample(scratch.path() / "run", Resume());
  EXPECT_EQ(AllFiles(scratch.path() / "whole"), AllFiles(scratch.path() / "run"));
}

TEST(DatasetWriter, ResumeKeepsWholeFramesAndWritesDamagedOnesAgain) {
  ScratchDirectory scratch;
  {
    DatasetWriter writer(scratch.path() / "run", SampleInfo(), {});
    WriteSample(&writer, 3);
    while (writer.frames_written() < 6) usleep(1000);
  }
  WriteWholeFile(scratch.path() / "run.incomplete/digger/front/depth/100000000.png", "");
  DatasetWriter writer(scratch.path() / "run", SampleInfo(), Resume());
  const ChannelId camera = writer.AddChannel(CameraChannel("digger/front", ""));
  EXPECT_FALSE(writer.NeedsFrame(camera, 0, 0));
  EXPECT_TRUE(writer.NeedsFrame(camera, 100'000'000, 100'000'000));
  EXPECT_FALSE(writer.NeedsFrame(camera, 200'000'000, 200'000'000));
  EXPECT_TRUE(writer.NeedsFrame(camera, 300'000'000, 300'000'000));
}

TEST(DatasetWriter, IgnoresALogLineThatTheKilledRunDidNotEnd) {
  ScratchDirectory scratch;
  {
    DatasetWriter writer(scratch.path() / "run", SampleInfo(), {});
    WriteSample(&writer, 1);
    while (writer.frames_written() < 2) usleep(1000);
  }
  std::ofstream(scratch.path() / "run.incomplete/INCOMPLETE.frames", std::ios::app)
      << "digger/front\t100000000\t12";
  DatasetWriter writer(scratch.path() / "run", SampleInfo(), Resume());
  const ChannelId camera = writer.AddChannel(CameraChannel("digger/front", ""));
  EXPECT_FALSE(writer.NeedsFrame(camera, 0, 0));
  EXPECT_TRUE(writer.NeedsFrame(camera, 100'000'000, 100'000'000));
}

TEST(DatasetWriter, WillNotResumeAnotherScenarioOrSeed) {
  ScratchDirectory scratch;
  { const DatasetWriter writer(scratch.path() / "run", SampleInfo(), {}); }
  DatasetInfo other_seed = SampleInfo();
  other_seed.seed = 8;
  EXPECT_THAT([&] { DatasetWriter(scratch.path() / "run", other_seed, Resume()); },
              ThrowsFault(kInconsistent, "run.incomplete/INCOMPLETE.txt"));
  DatasetInfo other_scenario = SampleInfo();
  other_scenario.resolved_scenario_yaml += "duration_s: 3\n";
  EXPECT_THAT([&] { DatasetWriter(scratch.path() / "run", other_scenario, Resume()); },
              ThrowsFault(kInconsistent, "scenario.yaml"));
}

TEST(DatasetWriter, ARecordingThatLacksOnlyItsNameGetsIt) {
  // A kill between the last file and the rename leaves some, all or none of the run's notes.
  for (const bool with_note : {false, true}) {
    ScratchDirectory scratch;
    WriteWholeSample(scratch.path() / "whole", {});
    fs::copy(scratch.path() / "whole", scratch.path() / "run.incomplete",
             fs::copy_options::recursive);
    if (with_note) {
      { const DatasetWriter writer(scratch.path() / "other", SampleInfo(), {}); }
      fs::rename(scratch.path() / "other.incomplete/INCOMPLETE.txt",
                 scratch.path() / "run.incomplete/INCOMPLETE.txt");
    }
    EXPECT_TRUE(DatasetWriter::FinishWhole(scratch.path() / "run", SampleInfo()));
    EXPECT_EQ(AllFiles(scratch.path() / "whole"), AllFiles(scratch.path() / "run"));
    EXPECT_FALSE(fs::exists(scratch.path() / "run.incomplete"));
  }
}

TEST(DatasetWriter, ARecordingOfAnotherScenarioIsNotNamed) {
  ScratchDirectory scratch;
  WriteWholeSample(scratch.path() / "run.incomplete", {});
  DatasetInfo other = SampleInfo();
  other.resolved_scenario_yaml += "duration_s: 3\n";
  EXPECT_THAT([&] { DatasetWriter::FinishWhole(scratch.path() / "run", other); },
              ThrowsFault(kInconsistent, "scenario.yaml"));
}

TEST(DatasetWriter, ARecordingThatIsNotWholeIsNotNamed) {
  ScratchDirectory scratch;
  {
    DatasetWriter writer(scratch.path() / "run", SampleInfo(), {});
    WriteSample(&writer, 3);
  }
  EXPECT_FALSE(DatasetWriter::FinishWhole(scratch.path() / "run", SampleInfo()));
  EXPECT_FALSE(DatasetWriter::FinishWhole(scratch.path() / "other", SampleInfo()));
  EXPECT_FALSE(fs::exists(scratch.path() / "run"));
}

TEST(DatasetWriter, ResumesARunThatHadNotBegun) {
  ScratchDirectory scratch;
  WriteWholeSample(scratch.path() / "run", Resume());
  EXPECT_TRUE(fs::exists(scratch.path() / "run/dataset.yaml"));
}

}  // namespace
}  // namespace tera
