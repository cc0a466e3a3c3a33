#include "sim/events/held_events.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace tera {
namespace {

const EventSubject kBlade{"m", "blade", "cone"};

TEST(HeldEvents, GoOnOverShortPausesAndEndWhenTheyWereLastHeld) {
  HeldEvents events({.kind = EventKind::kContact, .pause_ns = 200});
  EXPECT_TRUE(events.Hold(kBlade, 100, 100, 5));
  events.Close(300);
  EXPECT_FALSE(events.Hold(kBlade, 300, 300, 9));
  EXPECT_FALSE(events.Hold(kBlade, 310, 310, 7));
  events.Close(511);
  EXPECT_TRUE(events.Hold(kBlade, 511, 511, 1));
  const std::vector<RecordedEvent> expected = {
      {100, 310, EventKind::kContact, "m", "blade", "cone", 9},
      {511, 511, EventKind::kContact, "m", "blade", "cone", 1}};
  EXPECT_EQ(events.All(), expected);
}

TEST(HeldEvents, KeepTheLeastAndDropTheShort) {
  HeldEvents events({.kind = EventKind::kPersonNear, .keeps_least = true, .least_ns = 50});
  events.Hold(kBlade, 0, 10, 3);
  events.Close(11);
  events.Hold(kBlade, 100, 120, 4);
  events.Hold(kBlade, 120, 160, 2);
  ASSERT_EQ(events.All().size(), 1u);
  EXPECT_EQ(events.All()[0].begin_ns, 100);
  EXPECT_EQ(events.All()[0].value, 2);
}

/// Events of at least 100 with pauses of at most 200, held in these intervals of time, in steps of
/// 10.
std::vector<RecordedEvent> HeldIn(const std::vector<std::pair<TimeNs, TimeNs>>& intervals) {
  HeldEvents events({.kind = EventKind::kTip, .pause_ns = 200, .least_ns = 100});
  for (TimeNs t_ns = 0; t_ns < 2000; t_ns += 10) {
    for (const auto& [begin_ns, end_ns] : intervals) {
      if (begin_ns <= t_ns && t_ns <= end_ns) events.Hold(kBlade, t_ns, t_ns, 1);
    }
    events.Close(t_ns);
  }
  return events.All();
}

TEST(HeldEvents, ShortStretchesDoNotAddUpToAnEvent) {
  EXPECT_TRUE(HeldIn({{100, 100}, {250, 250}}).empty());
  EXPECT_TRUE(HeldIn({{100, 190}, {210, 300}, {320, 410}}).empty());
}

TEST(HeldEvents, OnlyLongStretchesBridgeAPause) {
  const RecordedEvent whole{100, 500, EventKind::kTip, "m", "blade", "cone", 1};
  EXPECT_EQ(HeldIn({{100, 200}, {400, 500}}), std::vector{whole});
  EXPECT_EQ(HeldIn({{100, 200}, {410, 510}}).size(), 2u);
  EXPECT_EQ(HeldIn({{50, 50}, {100, 500}, {600, 600}}), std::vector{whole});
}

}  // namespace
}  // namespace tera
