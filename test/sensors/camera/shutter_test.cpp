#include "sensors/camera/shutter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"

namespace tera {
namespace {

constexpr int kRows = 121;

TEST(Exposures, EveryRowsLightIsWhole) {
  for (const double readout_s : {0.0, 0.004, 0.03}) {
    for (const bool blurred : {true, false}) {
      for (const int pictures : {1, 3, 15}) {
        const Exposures exposures({.readout_s = readout_s, .motion_blur = blurred}, 0.01, kRows,
                                  pictures);
        for (int row = 0; row < kRows; ++row) {
          double sum = 0;
          for (int i = 0; i < pictures; ++i) sum += exposures.Share(row, i);
          EXPECT_NEAR(sum, 1, 1e-12) << row;
        }
      }
    }
  }
}

// The mean time of a row's light is the middle of its exposure, to half a slot.
TEST(Exposures, ARowsLightIsOfItsOwnTime) {
  const Exposures exposures({.readout_s = 0.03}, 0.012, kRows, 21);  // slots of 2 ms
  for (int row = 0; row < kRows; ++row) {
    double mean_s = 0;
    for (int i = 0; i < 21; ++i) {
      mean_s += exposures.Share(row, i) * ToSeconds(exposures.Instant_ns(i));
    }
    const double expected_s = 0.03 * (row - 60) / 120;
    EXPECT_NEAR(mean_s, expected_s, 0.001) << row;
    EXPECT_NEAR(ToSeconds(exposures.Instant_ns(exposures.MiddleOf(row))), expected_s, 0.00101);
  }
  EXPECT_EQ(exposures.Share(0, 20), 0);
  EXPECT_EQ(exposures.Share(120, 0), 0);
}

TEST(Exposures, AreAsManyAsTheMotionAsksForAndNoMore) {
  const ShutterModel shutter{.step_px = 0.5, .most_pictures = 12};
  EXPECT_EQ(Exposures::PicturesFor(shutter, 0), 1);
  EXPECT_EQ(Exposures::PicturesFor(shutter, 0.4), 1);
  EXPECT_EQ(Exposures::PicturesFor(shutter, 1.1), 3);
  EXPECT_EQ(Exposures::PicturesFor(shutter, 1.9), 5);
  EXPECT_EQ(Exposures::PicturesFor(shutter, 1e12), 11);
}

TEST(Exposures, ReachFromTheFirstRowsOpeningToTheLastRowsClosing) {
  EXPECT_DOUBLE_EQ(Exposures::Reach_s({.readout_s = 0.03}, 0.01), 0.02);
  EXPECT_DOUBLE_EQ(Exposures::Reach_s({.readout_s = 0.03, .motion_blur = false}, 0.01), 0.015);
}

}  // namespace
}  // namespace tera
