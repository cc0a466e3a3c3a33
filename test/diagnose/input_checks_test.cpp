#include "diagnose/input_checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/units.h"
#include "dataset/format/writer.h"
#include "diagnose/diagnose_recording.h"
#include "diagnose/statistics/series/simulated.h"
#include "own_folder.h"

namespace tera {
namespace {

/// 40 s at 50 Hz: a lever that alternates at 0.6 Hz, with a delayed measurement.
ReplayBlock ToAndFro(double late_s) {
  constexpr double kPeriod_s = 0.02;
  std::vector<double> expected, measured;
  for (int k = 0; k < 2000; ++k) {
    const auto rate = [](double t_s) { return std::sin(2 * kPi * 0.6 * t_s); };
    expected.push_back(rate(k * kPeriod_s));
    measured.push_back(rate(std::max(0.0, k * kPeriod_s - late_s)));
  }
  ReplayBlock block;
  block.channels = {
      {"m/encoders/boom_radps", "rad/s", MakeSeries(kPeriod_s, measured), {}, {}, {}}};
  block.replay = WholeReplay(
      [expected](const Structure&) { return std::vector<std::vector<double>>{expected}; });
  return block;
}

TEST(InputChecks, ARateThatIsHalfAStrokeLateDoesNotGoAgainstItsLever) {
  EXPECT_NO_THROW(CheckUnitsOf({"real", "m"}, {ToAndFro(0)}));
  // With a delay of half a stroke it initially moves the other way, and follows 0.83 s later.
  EXPECT_NO_THROW(CheckUnitsOf({"real", "m"}, {ToAndFro(0.83)}));
}

/// A recording of 10 s that begins `late_s` after the others.
Recording Begun(const std::string& name, double late_s, bool has_epoch = true) {
  DatasetInfo info{.scenario_name = name, .simulated = false};
  if (has_epoch) {
    info.epoch =
        RecordingEpoch{1'700'000'000 * kNsPerSecond + FromSeconds(late_s), ClockScale::kUtc};
  }
  DatasetWriter writer(OwnFolder() / name, info, {});
  const ChannelId levers = writer.AddChannel(TableChannel("digger/commands.csv", {"boom"}));
  for (int k = 0; k <= 10; ++k) {
    writer.Write(levers, RowSample{k * kNsPerSecond, k * kNsPerSecond, {0.1}});
  }
  writer.Finish();
  return Recording(OwnFolder() / name);
}

// The second begins 4 s after the first, so that they share 6 s; the third begins after its end.
TEST(InputChecks, RecordingsOfOneDriveDoNotJudgeEachOther) {
  const Recording first = Begun("first", 0), second = Begun("second", 4);
  EXPECT_THAT([&] { RequireOtherTime(first, second); },
              testing::ThrowsMessage<InputError>(
                  testing::AllOf(testing::HasSubstr("is of the same time as"),
                                 testing::HasSubstr("from 4.000 s to 10.000 s of that"),
                                 testing::HasSubstr("need recordings of different drives"))));
  EXPECT_NO_THROW(RequireOtherTime(first, Begun("third", 20)));
  EXPECT_NO_THROW(RequireOtherTime(first, Begun("fourth", 0, false)));
}

}  // namespace
}  // namespace tera
