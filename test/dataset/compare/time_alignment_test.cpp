#include "dataset/compare/time_alignment.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dataset/compare/compare.h"
#include "dataset/format/sample_recording.h"
#include "dataset/import/import_csv.h"

namespace tera {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
namespace fs = std::filesystem;

constexpr TimeNs kSummer_ns = 1'700'000'000 * kNsPerSecond;

/// A recording with a table of 2 s, in which `x` is the time by the epoch of kSummer_ns.
Recording Written(const fs::path& folder, const std::optional<RecordingEpoch>& epoch,
                  bool simulated = false) {
  DatasetInfo info = SampleInfo();
  info.simulated = simulated;
  info.epoch = epoch;
  DatasetWriter writer(folder, info, {});
  const ChannelId table = writer.AddChannel(TableChannel("digger/t.csv", {"x_s"}));
  for (TimeNs t_ns = 0; t_ns <= 2 * kNsPerSecond; t_ns += kNsPerSecond / 10) {
    const TimeNs late_ns = epoch ? epoch->since_1970_ns - kSummer_ns : 0;
    writer.Write(table, RowSample{t_ns, t_ns, {ToSeconds(t_ns + late_ns)}});
  }
  writer.Finish();
  return Recording(folder);
}

class TimeAlignmentTest : public testing::Test {
 protected:
  Recording With(const std::string& name, TimeNs late_ns, ClockScale clock) const {
    return Written(scratch_.path() / name, RecordingEpoch{kSummer_ns + late_ns, clock});
  }
  Recording Without(const std::string& name, bool simulated = false) const {
    return Written(scratch_.path() / name, std::nullopt, simulated);
  }
  ScratchDirectory scratch_;
};

TEST_F(TimeAlignmentTest, AnEpochComesBackExactlyFromItsFile) {
  for (const ClockScale clock : {ClockScale::kUtc, ClockScale::kGps, ClockScale::kUnknown}) {
    const RecordingEpoch epoch{kSummer_ns + 1, clock};  // beyond the resolution of a double
    fs::remove_all(scratch_.path() / "run");
    EXPECT_EQ(Written(scratch_.path() / "run", epoch).info().epoch, epoch);
  }
  EXPECT_FALSE(Without("none").info().epoch);
}

TEST_F(TimeAlignmentTest, TimesAreLaidBesideEachOtherByTheEpochs) {
  const Recording a = With("a", 0, ClockScale::kUtc),
                  b = With("b", 1'000'000'001, ClockScale::kUtc);
  const TimeAlignment times = AlignTimes(a, b);
  EXPECT_EQ(times.shift_ns, 1'000'000'001);
  EXPECT_EQ(AlignTimes(b, a).shift_ns, -1'000'000'001);
  EXPECT_EQ(times.told,
            "by the epochs of both, of UTC; that of the second is 1.000000001 s after the first's");
  const auto both = TimeInCommon(a, b);
  ASSERT_TRUE(both);
  EXPECT_EQ(both->first_ns, 1'000'000'001);
  EXPECT_EQ(both->last_ns, 2 * kNsPerSecond);
}

// IERS Bulletin C 53: GPS time is 18 s ahead of UTC since 2017.
TEST_F(TimeAlignmentTest, GpsTimeAndUtcAreLeapSecondsApart) {
  const Recording utc = With("utc", 0, ClockScale::kUtc);
  const Recording gps = With("gps", 18 * kNsPerSecond, ClockScale::kGps);
  EXPECT_EQ(AlignTimes(utc, gps).shift_ns, 0);
  EXPECT_THAT(AlignTimes(utc, gps).told, HasSubstr("with the leap seconds"));
  const Recording other = With("other", 19 * kNsPerSecond, ClockScale::kUnknown);
  EXPECT_EQ(AlignTimes(gps, other).shift_ns, kNsPerSecond);
  EXPECT_THAT(AlignTimes(gps, other).told, HasSubstr("because a time scale is unknown"));
}

TEST_F(TimeAlignmentTest, WhatIsNotKnownIsTold) {
  const Recording with = With("with", 0, ClockScale::kUtc), without = Without("without");
  EXPECT_EQ(AlignTimes(without, with).shift_ns, 0);
  EXPECT_THAT(AlignTimes(without, with).told, HasSubstr("without has none"));
  EXPECT_THAT(AlignTimes(without, without).told, HasSubstr("neither has an epoch"));
  EXPECT_THAT(AlignTimes(Without("simulated", true), without).told,
              HasSubstr("neither has an epoch"));
  const Recording run = Without("run", true);
  EXPECT_THAT(AlignTimes(run, run).told, IsEmpty());  // both count from their start
}

TEST_F(TimeAlignmentTest, DrivesOfDifferentDaysAreComparedFromTheirOwnZeros) {
  const Recording a = With("a", 0, ClockScale::kUtc);
  const Recording b = With("b", 3 * 86'400 * kNsPerSecond, ClockScale::kUtc);
  EXPECT_EQ(AlignTimes(a, b).shift_ns, 0);
  EXPECT_THAT(AlignTimes(a, b).told,
              HasSubstr("3 days apart, so the recordings have no common time"));
  EXPECT_FALSE(TimeInCommon(a, b));
}

TEST_F(TimeAlignmentTest, CompareInterpolatesAtTheTimesThatTheEpochsSay) {
  With("a", 0, ClockScale::kUtc);
  With("b", 730'000'000, ClockScale::kUtc);
  const Comparison c = Compare(scratch_.path() / "a", scratch_.path() / "b");
  ASSERT_EQ(c.machines.at(0).channels.size(), 1u);
  EXPECT_NEAR(c.machines[0].channels[0].rmse, 0, 1e-9);
  EXPECT_EQ(c.machines[0].channels[0].count, 13u);  // of 0.8 to 2.0 s
  EXPECT_THAT(ComparisonTable(c), HasSubstr("times:     by the epochs of both"));
}

/// One motion in TUM's form, the second file from 3 s after the start of the first.
void WriteMotion(const fs::path& folder, const std::string& name, int first_s,
                 const std::string& more) {
  std::string text;
  for (int k = 10 * first_s; k <= 100; ++k) {
    const double t_s = 0.1 * k;
    text += fmt::format("17000000{:02}.{}00000001 {:.9f} {:.9f} 0 0 0 0 1\n", k / 10, k % 10,
                        2 * std::sin(t_s), std::cos(t_s));
  }
  WriteWholeFile(folder / (name + ".txt"), text);
  WriteWholeFile(folder / (name + ".yaml"),
                 "name: m\nmachine: m\nfile: " + name + ".txt\ncsv: {header: false}\n" + more +
                     "time: {column: \"1\", unit: s}\nzero: start\npose:\n  columns:\n"
                     "    x: {column: \"2\", unit: m}\n    y: {column: \"3\", unit: m}\n"
                     "    z: {column: \"4\", unit: m}\n    qx: {column: \"5\", unit: '1'}\n"
                     "    qy: {column: \"6\", unit: '1'}\n    qz: {column: \"7\", unit: '1'}\n"
                     "    qw: {column: \"8\", unit: '1'}\n");
}

TEST_F(TimeAlignmentTest, OneMotionInTwoFilesThatBeginAtOtherTimesIsTheSameAfterTheImport) {
  WriteMotion(scratch_.path(), "truth", 0, "");
  WriteMotion(scratch_.path(), "slam", 3, "epoch: {clock: gps}\n");
  const ImportReport truth = ImportCsv(scratch_.path() / "truth.yaml", scratch_.path() / "truth");
  EXPECT_EQ(truth.epoch, (RecordingEpoch{kSummer_ns + 1, ClockScale::kUnknown}));
  const ImportReport slam = ImportCsv(scratch_.path() / "slam.yaml", scratch_.path() / "slam");
  EXPECT_EQ(slam.epoch, (RecordingEpoch{kSummer_ns + 3 * kNsPerSecond + 1, ClockScale::kGps}));
  const Comparison c = Compare(scratch_.path() / "truth", scratch_.path() / "slam");
  EXPECT_NEAR(c.machines.at(0).tracks.at(0).unaligned.ape_translation_m.max, 0, 1e-9);
  EXPECT_EQ(c.machines[0].tracks[0].unaligned.ape.size(), 71u);
}

TEST_F(TimeAlignmentTest, FilesWithAZeroOfTheirOwnHaveTheEpochThatTheMappingSays) {
  WriteWholeFile(scratch_.path() / "log.csv", "t,x\n2.5,1\n3.5,2\n");
  const auto import = [&](const std::string& keys) {
    WriteWholeFile(scratch_.path() / "m.yaml",
                   "name: m\nmachine: m\nfile: log.csv\ntime: {column: t, unit: s}\n" + keys +
                       "tables: [{name: x, columns: {x: {column: x, unit: m}}}]\n");
    fs::remove_all(scratch_.path() / "out");
    ImportCsv(scratch_.path() / "m.yaml", scratch_.path() / "out");
    return Recording(scratch_.path() / "out").info().epoch;
  };
  EXPECT_FALSE(import("zero: start\n"));
  EXPECT_FALSE(import(""));
  const std::string epoch = "epoch: {since_1970_ns: \"1700000000000000000\", clock: utc}\n";
  EXPECT_EQ(import(epoch), (RecordingEpoch{kSummer_ns, ClockScale::kUtc}));
  EXPECT_EQ(import("zero: start\n" + epoch),
            (RecordingEpoch{kSummer_ns + 2'500'000'000, ClockScale::kUtc}));
}

}  // namespace
}  // namespace tera
