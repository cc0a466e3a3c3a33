#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "diagnose/null/null_recording.h"

namespace tera {
namespace {

// A few of the recordings that `false_alarms` runs hundreds of (docs/reference/diagnose.md).
TEST(FalseAlarms, AreNoneInAFewRecordingsOfNothing) {
  const MachineModel model = RaisedTb235();
  std::size_t judged = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const NullOutcome outcome = DiagnoseNull(model, 90, seed);
    EXPECT_TRUE(outcome.alarms.empty()) << fmt::format("{}", fmt::join(outcome.alarms, "; "));
    judged += outcome.judged;
  }
  EXPECT_GE(judged, 9u) << "hardly anything was asked";
}

TEST(FalseAlarms, SimulationOfASeedIsRepeatableAndMoves) {
  const MachineModel model = RaisedTb235();
  const NullRecording a = SimulateNull(model, 5, 7), b = SimulateNull(model, 5, 7);
  ASSERT_EQ(a.encoders.recording.samples.size(), b.encoders.recording.samples.size());
  EXPECT_EQ(a.encoders.recording.samples.back().qd_radps,
            b.encoders.recording.samples.back().qd_radps);
  EXPECT_NE(a.encoders.recording.samples.back().q_rad, a.encoders.recording.samples.front().q_rad);
}

}  // namespace
}  // namespace tera
