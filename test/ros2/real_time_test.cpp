#include <gtest/gtest.h>

#include <vector>

#include "ros2/pace.h"

// Simulated time against a wall clock that the test itself advances: nothing here waits.

namespace tera {
namespace {

using namespace std::chrono_literals;
using Moment = ros::RealTime::Moment;

const Moment kStart = Moment() + 1000s;  // any
constexpr TimeNs kStart_ns = 7'000'000'000;
constexpr TimeNs kTick_ns = 10'000'000;

ros::RealTime Started() {
  ros::RealTime time;
  time.Restart(kStart_ns, kStart);
  return time;
}

TEST(RealTime, GoesByAsOnTheWallWhereTheSimulationIsFaster) {
  ros::RealTime time = Started();
  Moment now = kStart;
  for (int tick = 1; tick <= 500; ++tick) {
    now += 1ms;  // the tick's computing time
    const Moment due = time.Due(kStart_ns + tick * kTick_ns, now);
    EXPECT_EQ(due, kStart + tick * 10ms);
    now = due;
  }
}

TEST(RealTime, WaitsOnItsWall) {
  Moment now = kStart;
  std::vector<Moment> waited;
  ros::RealTime time({.now = [&] { return now; },
                      .sleep_until = [&](Moment moment) { waited.push_back(moment); }});
  time.WaitFor(30'000'000);  // counted from when it was made
  now += 5s;
  time.Restart(kStart_ns);
  time.WaitFor(kStart_ns + kTick_ns);
  EXPECT_EQ(waited, (std::vector<Moment>{kStart + 30ms, kStart + 5s + 10ms}));
}

TEST(RealTime, OfTimeLostATenthOfASecondIsCaughtUpWith) {
  ros::RealTime time = Started();
  // 90 ms late: no wait until the simulation has caught up.
  const Moment late = kStart + 10ms + 90ms;
  for (int tick = 1; tick <= 20; ++tick) {
    EXPECT_EQ(time.Due(kStart_ns + tick * kTick_ns, late), kStart + tick * 10ms);
  }
}

TEST(RealTime, OfMoreTimeLostNothingIsCaughtUpWith) {
  ros::RealTime time = Started();
  const Moment late = kStart + 10ms + 101ms;
  EXPECT_EQ(time.Due(kStart_ns + kTick_ns, late), late);
  EXPECT_EQ(time.Due(kStart_ns + 2 * kTick_ns, late), late + 10ms);
  EXPECT_EQ(time.Due(kStart_ns + 200 * kTick_ns, late + 1s), late + 1990ms);
}

TEST(RealTime, IsSlowerThanTheWallWhereTheSimulationIs) {
  ros::RealTime time = Started();
  Moment now = kStart;
  for (int tick = 1; tick <= 100; ++tick) {
    now += 200ms;
    EXPECT_LE(time.Due(kStart_ns + tick * kTick_ns, now), now);  // never waits
  }
}

}  // namespace
}  // namespace tera
