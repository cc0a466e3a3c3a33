#include "dataset/compare/compare.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "core/faults.h"
#include "dataset/format/png.h"
#include "dataset/format/sample_recording.h"
#include "dataset/overview/overview.h"

namespace tera {
namespace {

using enum FaultKind;
using testing::HasSubstr;
using testing::ThrowsMessage;
namespace fs = std::filesystem;

/// A machine that drives a circle; `shift_m` and `gyro_offset_radps` distinguish two recordings.
void WriteCircle(const fs::path& directory, const std::string& machine, double shift_m,
                 double gyro_offset_radps) {
  DatasetInfo info = SampleInfo();
  info.scenario_name = directory.filename();
  DatasetWriter writer(directory, info, {});
  const ChannelId imu = writer.AddChannel(ImuChannel(machine + "/imu", ""));
  const ChannelId joints = writer.AddChannel(EncoderChannel(machine + "/joints", "", {{"boom"}}));
  const ChannelId pose = writer.AddChannel(PoseChannel("truth/" + machine + "/pose.csv"));
  for (int k = 0; k <= 60; ++k) {
    const TimeNs t_ns = k * kSamplePeriod_ns;
    const double a = 0.1 * k;
    writer.Write(
        pose, RowOf(TruthPose{
                  t_ns, MakePose(Vec3(3 * std::cos(a), 3 * std::sin(a) + shift_m, 0), 0, 0, a)}));
    writer.Write(imu,
                 RowOf(ImuSample{t_ns, t_ns, Vec3(0, 0, 1 + gyro_offset_radps), Vec3(0, 3, 9.8)}));
    writer.Write(joints, RowOf(EncoderSample{t_ns, t_ns, {0.2 + (k % 2 ? 1 : -1) * shift_m}, {0}}));
  }
  writer.Finish();
}

/// A leaning link with two sensors of a kind known only from their own sensor.yaml; `offset_rad`
/// separates two recordings.
void WriteLeaning(const fs::path& directory, double offset_rad) {
  DatasetWriter writer(directory, SampleInfo(), {});
  for (const char* folder : {"husky/tilt_boom", "husky/tilt_arm"}) {
    const ChannelId tilt = writer.AddChannel({folder,
                                              "inclinometer",
                                              ChannelForm::kRows,
                                              "type: inclinometer\n",
                                              {"tilt_rad", "tilt_radps"}});
    for (int k = 0; k <= 20; ++k) {
      const TimeNs t_ns = k * kSamplePeriod_ns;
      writer.Write(tilt, RowSample{t_ns, t_ns, {0.1 * k + offset_rad, 1}});
    }
  }
  writer.Finish();
}

ChannelDifference Find(const MachineComparison& machine, const std::string& column) {
  const auto found = std::find_if(machine.channels.begin(), machine.channels.end(),
                                  [&](const ChannelDifference& d) { return d.column == column; });
  EXPECT_NE(found, machine.channels.end()) << column;
  return found == machine.channels.end() ? ChannelDifference{} : *found;
}

TEST(Compare, FindsShiftsOffsetsAndAlternatingErrors) {
  ScratchDirectory scratch;
  WriteCircle(scratch.path() / "real", "husky", 0, 0);
  WriteCircle(scratch.path() / "sim", "warthog", 0.5, 0.02);
  const Comparison c = Compare(scratch.path() / "real", scratch.path() / "sim");
  ASSERT_EQ(c.machines.size(), 1u);  // one machine each: those two
  const MachineComparison& m = c.machines[0];
  EXPECT_NEAR(m.tracks.at(0).unaligned.ape_translation_m.rmse, 0.5, 1e-9);
  EXPECT_NEAR(m.tracks.at(0).aligned_se2.ape_translation_m.rmse, 0, 1e-9);
  EXPECT_NEAR(m.tracks.at(0).aligned_se3.ape_translation_m.rmse, 0, 1e-9);
  EXPECT_NEAR(Find(m, "wz_radps").mean, 0.02, 1e-12);
  EXPECT_NEAR(Find(m, "wz_radps").rmse, 0.02, 1e-12);
  // 30 rows +0.5, 31 rows -0.5 against itself without: rmse 0.5, mean -0.5 / 61.
  EXPECT_NEAR(Find(m, "boom_rad").rmse, 0.5, 1e-12);
  EXPECT_NEAR(Find(m, "boom_rad").mean, -0.5 / 61, 1e-12);
  EXPECT_THAT(ComparisonTable(c), HasSubstr("husky and warthog"));
  EXPECT_THAT(ComparisonTable(c), HasSubstr("imu wz_radps"));
}

TEST(Compare, ComparesTheNumbersOfAnyKindOfSensor) {
  ScratchDirectory scratch;
  WriteLeaning(scratch.path() / "real", 0);
  WriteLeaning(scratch.path() / "sim", 0.03);
  const Comparison c = Compare(scratch.path() / "real", scratch.path() / "sim");
  ASSERT_EQ(c.machines.at(0).channels.size(), 4u);
  EXPECT_NEAR(Find(c.machines[0], "tilt_rad").mean, 0.03, 1e-12);
  EXPECT_NEAR(Find(c.machines[0], "tilt_radps").rmse, 0, 1e-12);
  EXPECT_THAT(ComparisonTable(c), HasSubstr("tilt_arm tilt_rad"));
}

TEST(Compare, NeedsAMachineInCommon) {
  ScratchDirectory scratch;
  WriteCircle(scratch.path() / "a", "one", 0, 0);
  {
    DatasetWriter writer(scratch.path() / "b", SampleInfo(), {});
    writer.AddChannel(ImuChannel("two/imu", ""));
    writer.AddChannel(ImuChannel("three/imu", ""));
    writer.Finish();
  }
  EXPECT_THAT([&] { Compare(scratch.path() / "a", scratch.path() / "b"); },
              ThrowsFault(kNoSuchName, "b"));
}

TEST(Compare, ComparesTheChannelsOfAMachineThatHasNoPoses) {
  ScratchDirectory scratch;
  WriteCircle(scratch.path() / "circle", "husky", 0, 0);
  {
    DatasetWriter writer(scratch.path() / "parked", SampleInfo(), {});
    const ChannelId imu = writer.AddChannel(ImuChannel("husky/imu", ""));
    writer.AddChannel(PoseChannel("truth/husky/pose.csv", false));
    for (const TimeNs t_ns : {0, 1'000'000'000}) {
      writer.Write(imu, RowOf(ImuSample{t_ns, t_ns, Vec3::Zero(), Vec3(0, 0, 9.8)}));
    }
    writer.Finish();
  }
  const Comparison c = Compare(scratch.path() / "circle", scratch.path() / "parked");
  EXPECT_THAT(c.machines.at(0).tracks, testing::IsEmpty());
  EXPECT_NEAR(Find(c.machines[0], "wz_radps").mean, -1, 1e-12);
  EXPECT_THAT(ComparisonTable(c), testing::Not(HasSubstr("APE")));
}

// As strangers name theirs.
TEST(Compare, KeepsTheDotsInNamesOfSensors) {
  ScratchDirectory scratch;
  for (const char* run : {"real", "sim"}) {
    DatasetWriter writer(scratch.path() / run, SampleInfo(), {});
    for (const char* name : {"husky/imu.left", "husky/imu.right"}) {
      const ChannelId imu = writer.AddChannel(ImuChannel(name, ""));
      writer.Write(imu, RowOf(ImuSample{0, 0, Vec3::Zero(), Vec3(0, 0, 9.8)}));
    }
    writer.Finish();
  }
  const std::string table =
      ComparisonTable(Compare(scratch.path() / "real", scratch.path() / "sim"));
  EXPECT_THAT(table, HasSubstr("imu.left wz_radps"));
  EXPECT_THAT(table, HasSubstr("imu.right wz_radps"));
}

TEST(PlotComparison, DrawsAPictureOfTheStatedSize) {
  ScratchDirectory scratch;
  WriteCircle(scratch.path() / "real", "husky", 0, 0);
  WriteCircle(scratch.path() / "sim's", "husky", 0.5, 0.02);
  const Comparison c = Compare(scratch.path() / "real", scratch.path() / "sim's");
  PlotComparison(c, scratch.path() / "plot it's.png");
  const auto plot = ReadRgbPng(scratch.path() / "plot it's.png");
  EXPECT_EQ(plot.width_px, 1500);
  const auto dark = std::count_if(plot.data.begin(), plot.data.end(), [](int v) { return v < 99; });
  EXPECT_GT(dark, 1000);
}

TEST(PlotComparison, SaysWhichPackageIsMissing) {
  ScratchDirectory scratch;
  WriteCircle(scratch.path() / "real", "husky", 0, 0);
  const Comparison c = Compare(scratch.path() / "real", scratch.path() / "real");
  const std::string path = std::getenv("PATH");
  setenv("PATH", scratch.path().c_str(), 1);
  EXPECT_THAT([&] { PlotComparison(c, scratch.path() / "plot.png"); },
              ThrowsMessage<InputError>(HasSubstr("gnuplot-nox")));
  setenv("PATH", path.c_str(), 1);
}

/// A log without levers: set-points of speed and of an angle; `offset_mps` distinguishes two logs.
void WriteSetPoints(const fs::path& directory, double offset_mps) {
  DatasetWriter writer(directory, SampleInfo(), {});
  const ChannelId set =
      writer.AddChannel(TableChannel("husky/setpoints.csv", {"forward_mps", "boom_rad"}));
  const ChannelId levers = writer.AddChannel(TableChannel("husky/commands.csv", {"boom"}));
  const ChannelId truth = writer.AddChannel(TableChannel("truth/husky/t.csv", {"a_m"}));
  for (int k = 0; k <= 20; ++k) {
    const TimeNs t_ns = k * kSamplePeriod_ns;
    writer.Write(set, RowSample{t_ns, t_ns, {0.1 * k + offset_mps, 0.5}});
    writer.Write(levers, RowSample{t_ns, t_ns, {offset_mps}});
    writer.Write(truth, RowSample{t_ns, t_ns, {offset_mps}});
  }
  writer.Finish();
}

TEST(Compare, SetsPointsOfTablesBesideEachOther) {
  ScratchDirectory scratch;
  WriteSetPoints(scratch.path() / "real", 0);
  WriteSetPoints(scratch.path() / "sim", 0.25);
  const Comparison c = Compare(scratch.path() / "real", scratch.path() / "sim");
  ASSERT_EQ(c.machines.size(), 1u);
  ASSERT_EQ(c.machines[0].channels.size(), 2u);  // without levers and truth
  EXPECT_NEAR(Find(c.machines[0], "forward_mps").mean, 0.25, 1e-12);
  EXPECT_NEAR(Find(c.machines[0], "boom_rad").rmse, 0, 1e-12);
  EXPECT_THAT(ComparisonTable(c), HasSubstr("setpoints forward_mps"));
}

// Trajectories, and of each of two tables a chart for each of its two units: the fifth chart begins
// a second row.
TEST(Overview, DrawsTablesThatAreNeitherLeversNorTruth) {
  ScratchDirectory scratch;
  WriteSetPoints(scratch.path() / "run", 0);
  const auto height_px = [&] {
    WriteOverview(scratch.path() / "run", scratch.path() / "o.png", scratch.path() / "o.mp4");
    return ReadRgbPng(scratch.path() / "o.png").height_px;
  };
  EXPECT_EQ(height_px(), 300);
  const fs::path file = scratch.path() / "run/dataset.yaml";
  std::string text = ReadWholeFile(file);
  const std::string key = "channels:\n";
  text.insert(text.find(key) + key.size(), "  - {path: husky/more.csv, type: table}\n");
  WriteWholeFile(file, text);
  fs::copy(scratch.path() / "run/husky/setpoints.csv", scratch.path() / "run/husky/more.csv");
  EXPECT_EQ(height_px(), 2 * 300);
}

TEST(Overview, HasARowForTheCameraTheLidarAndTheCurvesAndAFilm) {
  ScratchDirectory scratch;
  WriteWholeSample(scratch.path() / "run", {});
  WriteOverview(scratch.path() / "run", scratch.path() / "overview.png",
                scratch.path() / "overview.mp4");
  const auto sheet = ReadRgbPng(scratch.path() / "overview.png");
  EXPECT_EQ(sheet.width_px, 1600);
  EXPECT_EQ(sheet.height_px, 300 + 600 + 2 * 300);  // five charts take two rows
  EXPECT_FALSE(fs::exists(scratch.path() / "overview.png.charts.png"));
  const std::string film = ReadWholeFile(scratch.path() / "overview.mp4");
  EXPECT_EQ(film.substr(4, 4), "ftyp");
  EXPECT_THAT(film, HasSubstr("avc1"));
}

TEST(Overview, DrawsTheNumbersOfAnyKindOfSensorUnitByUnit) {
  ScratchDirectory scratch;
  WriteLeaning(scratch.path() / "run", 0);
  WriteOverview(scratch.path() / "run", scratch.path() / "overview.png",
                scratch.path() / "overview.mp4");
  // Trajectories, and two units of two sensors: the fifth chart begins a second row.
  EXPECT_EQ(ReadRgbPng(scratch.path() / "overview.png").height_px, 2 * 300);
}

TEST(Overview, OfARecordingWithoutCamerasHasNoFilm) {
  ScratchDirectory scratch;
  WriteCircle(scratch.path() / "run", "husky", 0, 0);
  WriteOverview(scratch.path() / "run", scratch.path() / "overview.png",
                scratch.path() / "overview.mp4");
  EXPECT_TRUE(fs::exists(scratch.path() / "overview.png"));
  EXPECT_FALSE(fs::exists(scratch.path() / "overview.mp4"));
}

}  // namespace
}  // namespace tera
