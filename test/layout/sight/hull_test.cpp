#include "layout/sight/hull.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "layout/looked_at_site.h"

namespace tera {
namespace {

/// Distance of a rectangle's border from the origin in a direction.
double ToBorder_m(const Vec2& low_m, const Vec2& high_m, double azimuth_rad) {
  const Vec2 d(std::cos(azimuth_rad), std::sin(azimuth_rad));
  double least = 1e9;
  for (int axis = 0; axis < 2; ++axis) {
    if (d[axis] > 1e-12) least = std::min(least, high_m[axis] / d[axis]);
    if (d[axis] < -1e-12) least = std::min(least, low_m[axis] / d[axis]);
  }
  return least;
}

void ExpectHull(const std::vector<PartInH>& parts, const Vec2& low_m, const Vec2& high_m) {
  const LookedAtSite site({.parts = parts});
  for (const int sectors : {4, 36}) {
    const std::vector<double> radii_m = HullRadii_m(X_WH(), 0, sectors, site.sighting());
    ASSERT_EQ(radii_m.size(), static_cast<std::size_t>(sectors));
    for (int k = 0; k < sectors; ++k) {
      EXPECT_NEAR(radii_m[k], ToBorder_m(low_m, high_m, 2 * kPi * k / sectors), 0.01)
          << k << " of " << sectors;
    }
  }
}

TEST(HullRadii, OfABoxAreTheDistancesToItsSides) {
  ExpectHull({{"undercarriage", {-1, -0.7, 0.1}, {2, 1.3, 1.1}}}, {-1, -0.7}, {2, 1.3});
}

TEST(HullRadii, EveryPartThatDrivesOrTurnsCounts) {
  for (const std::string label : {"undercarriage", "track", "blade", "upper_structure"}) {
    ExpectHull({{"undercarriage", {-0.5, -0.5, 0.1}, {0.5, 0.5, 1}},
                {label, {-1, -0.7, 0.3}, {2, 1.3, 0.6}}},
               {-1, -0.7}, {2, 1.3});
  }
}

TEST(HullRadii, WhatWorksDoesNotCount) {
  for (const std::string label : {"boom", "arm", "bucket"}) {
    ExpectHull(
        {{"undercarriage", {-0.8, -0.5, 0.1}, {0.5, 0.6, 1}}, {label, {-3, -4, 0.3}, {5, 4, 0.6}}},
        {-0.8, -0.5}, {0.5, 0.6});
  }
}

TEST(HullRadii, WhatIsAboveAPersonDoesNotCount) {
  ExpectHull({{"undercarriage", {-0.8, -0.5, 0.1}, {0.5, 0.6, 1}},
              {"upper_structure", {-3, -4, 2.4}, {5, 4, 3}}},
             {-0.8, -0.5}, {0.5, 0.6});
}

TEST(HullRadii, AThinPartAtAnyHeightOfAPersonCounts) {
  // A deck of 6 cm; a person of 1.75 m stands against it.
  for (const double z_m : {0.2, 0.55, 0.93, 1.31, 1.6}) {
    ExpectHull({{"undercarriage", {-0.5, -0.5, 0.05}, {0.5, 0.5, 0.1}},
                {"upper_structure", {-1, -0.7, z_m}, {2, 1.3, z_m + 0.06}}},
               {-1, -0.7}, {2, 1.3});
  }
}

TEST(HullRadii, OfAMachineThatNobodySeesIsZero) {
  const LookedAtSite site({});
  for (const double radius_m : HullRadii_m(X_WH(), 0, 36, site.sighting())) EXPECT_EQ(radius_m, 0);
}

}  // namespace
}  // namespace tera
