#include "sim/events/held_events.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace tera
