#include <cmath>

#include "dataset/import/suggest/suggested_table.h"

// Times that restart: counters that overflow, and restarted loggers.

namespace tera {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// A boom that rises by 0.1 deg per row, in 100 rows.
std::string Boom(const std::string& time, const std::function<std::string(int k)>& at) {
  std::string log = time + ",boom_deg\n";
  for (int k = 0; k < 100; ++k) log += fmt::format("{},{:.1f}\n", at(k), 20 + 0.1 * k);
  return log;
}

TEST_F(SuggestedTable, CountersThatOverflowGoOn) {
  constexpr std::uint64_t k32 = std::uint64_t{1} << 32;
  for (const auto& [name, step] :
       {std::pair{"time_us", 20000}, {"t_ms", 20}, {"time_ns", 20000000}}) {
    const EncoderRecording joints = Joints(Boom(name, [step = step](int k) {
      return std::to_string(
          (k32 - 30 * static_cast<std::uint64_t>(step) + 7 + static_cast<std::uint64_t>(k * step)) %
          k32);
    }));
    ASSERT_EQ(joints.samples.size(), 100u) << name;
    EXPECT_EQ(joints.samples.back().t_ns - joints.samples.front().t_ns, 99 * 20'000'000) << name;
    EXPECT_NEAR(joints.samples[50].qd_radps[0], 5 * kDeg, 1e-6) << name;
  }
  // Microseconds that were divided, and seconds of the week.
  const EncoderRecording joints = Joints(Boom("time_s", [](int k) {
    return fmt::format("{:.6f}", std::fmod(4294 + 0.02 * k, 4294.967296));
  }));
  EXPECT_NEAR(ToSeconds(joints.samples.back().t_ns - joints.samples.front().t_ns), 1.98, 1e-6);
  Joints(Boom("tow_s",
              [](int k) { return fmt::format("{:.2f}", std::fmod(604799 + 0.02 * k, 604800)); }));
  EXPECT_THAT(yaml_, HasSubstr("wraps_at: 604800}"));
}

TEST_F(SuggestedTable, ACounterOfTheSizeOfAnEpochIsNone) {
  const EncoderRecording joints =
      Joints(Boom("time_us", [](int k) { return std::to_string(1'200'000'000 + 20'000 * k); }));
  EXPECT_EQ(joints.samples[1].t_ns - joints.samples[0].t_ns, 20'000'000);
}

TEST_F(SuggestedTable, ALoggerThatWasStartedAnewIsToldAndTheLongerPartIsTaken) {
  for (const int start : {40, 80}) {
    const EncoderRecording joints = Joints(Boom("time_s", [start](int k) {
      return fmt::format("{:.2f}", 0.02 * (k < start ? k : k - start));
    }));
    const bool is_late = start > 50;
    ASSERT_EQ(joints.samples.size(), is_late ? 80u : 60u);
    EXPECT_NEAR(joints.samples[0].q_rad[0], (is_late ? 20 : 24) * kDeg, 1e-9);
    EXPECT_THAT(yaml_, HasSubstr(fmt::format("# line {} goes back by", start + 2)));
  }
}

TEST_F(SuggestedTable, DigitsOfATimeOfDayAreNoSeconds) {
  const std::string log = Boom("utc", [](int k) {
    return k < 50 ? fmt::format("224659.{:02}", 2 * k) : fmt::format("224700.{:02}", 2 * (k - 50));
  });
  EXPECT_THAT(Refusal(log), HasFault(FaultKind::kNoSuchName, "time.unit"));
  const std::string unknown = "{column: utc, unit: unknown}";
  yaml_.replace(yaml_.find(unknown), unknown.size(), "{clock: utc}\nzero: start");
  const EncoderRecording joints = Import().LoadEncoder("machine/joints");
  EXPECT_EQ(joints.samples.back().t_ns, 99 * 20'000'000);
}

TEST_F(SuggestedTable, AClockThatWasSetBackPartsAFile) {
  const EncoderRecording joints = Joints(Boom("time", [](int k) {
    return k < 60 ? fmt::format("2026-10-25 02:59:{:02}", k)
                  : fmt::format("2026-10-25 02:00:{:02}", k - 60);
  }));
  EXPECT_EQ(joints.samples.size(), 60u);
}

TEST_F(SuggestedTable, OneRowThatGoesBackIsNoNewStart) {
  Suggest(Boom("time_s", [](int k) { return fmt::format("{:.2f}", k == 50 ? 0.01 : 0.02 * k); }));
  EXPECT_THAT(yaml_, Not(HasSubstr("last_line")));
  EXPECT_THAT(yaml_, HasSubstr("# line 52 is earlier than the previous row"));
}

}  // namespace
}  // namespace tera
