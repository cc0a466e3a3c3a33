#include "sim/operators/dig_place.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

// A heap of 1 m whose top is 3.8 m to the left reaches 1.732 m out at 30 deg.
constexpr SpoilHeap kHeap = {90 * kDeg, 3.8, 1.0};

RadialCut CutAt(double azimuth_deg) { return {azimuth_deg * kDeg, 4.2, 1.6}; }

TEST(IsInHeap, WhereTheCutComesNearerThanTheHeapsFoot) {
  // Beside the top the cut passes at 3.8 sin a, which is 1.732 m for 27.1 deg.
  EXPECT_TRUE(IsInHeap(CutAt(90), kHeap));
  EXPECT_TRUE(IsInHeap(CutAt(90 - 27), kHeap));
  EXPECT_FALSE(IsInHeap(CutAt(90 - 27.3), kHeap));
  EXPECT_TRUE(IsInHeap(CutAt(90 + 27 - 360), kHeap));
  EXPECT_FALSE(IsInHeap(CutAt(90 + 27.3 - 360), kHeap));
  // On the other side of the axis nothing lies.
  EXPECT_FALSE(IsInHeap(CutAt(-90), kHeap));
}

TEST(IsInHeap, NotWhereItEndsBeforeTheFootOrNothingWasDumped) {
  // The heap's top is 1.8 m beyond the entry, which is more than its foot.
  EXPECT_FALSE(IsInHeap(CutAt(90), {90 * kDeg, 6.0, 1.0}));
  EXPECT_TRUE(IsInHeap(CutAt(90), {90 * kDeg, 5.9, 1.0}));
  EXPECT_FALSE(IsInHeap(CutAt(90), {90 * kDeg, 3.8, 0.0}));
  EXPECT_FALSE(IsInHeap(CutAt(90), {90 * kDeg, 3.8, -0.3}));
}

TEST(NextDigAzimuth, PassesOverTheHeap) {
  EXPECT_NEAR(NextDigAzimuth_rad(CutAt(0), -8 * kDeg, kHeap), -8 * kDeg, 1e-12);
  // From 56 by steps of 8 deg: 64 to 112 lie in it, 120 is free.
  EXPECT_NEAR(NextDigAzimuth_rad(CutAt(56), 8 * kDeg, kHeap), 120 * kDeg, 1e-12);
  EXPECT_NEAR(NextDigAzimuth_rad(CutAt(-240), -8 * kDeg, kHeap), -304 * kDeg, 1e-12);
}

TEST(NextDigAzimuth, OfNoStepOrAHeapAllRoundIsTheNext) {
  EXPECT_EQ(NextDigAzimuth_rad(CutAt(90), 0, kHeap), 90 * kDeg);
  EXPECT_NEAR(NextDigAzimuth_rad(CutAt(90), 8 * kDeg, {0, 1, 20}), 98 * kDeg, 1e-12);
}

}  // namespace
}  // namespace tera
