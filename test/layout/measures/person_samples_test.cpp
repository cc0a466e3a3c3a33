#include "layout/measures/person_samples.h"

#include <gtest/gtest.h>

#include "layout/sight/hull.h"
#include "layout/yard.h"

namespace tera {
namespace {

TestBox PersonSamplesNothing() { return {Vec3(0, 0, -0.5), Vec3(0.01, 0.01, -0.4)}; }
const Posture kPersonSamplesStanding{"standing", Vec3(0.3, 0.5, 1.75)};

TEST(PersonSamples, PatchesAreAllOfHerButHerSoles) {
  double area_m2 = 0;
  for (const BodyPatch& patch : PatchesOf(kPersonSamplesStanding)) {
    area_m2 += patch.area_m2;
    EXPECT_GT(patch.p_P_m.z(), 0);
    EXPECT_LE(patch.p_P_m.z(), 1.75);
    EXPECT_GT(patch.normal_P.dot(patch.p_P_m - Vec3(0, 0, 0.875)), 0);  // outwards
  }
  EXPECT_NEAR(area_m2, 2 * 0.3 * 1.75 + 2 * 0.5 * 1.75 + 0.3 * 0.5, 1e-9);
}

TEST(PersonSamples, AreThoseOfTheSolidAngleThatSheFills) {
  // From 20 m away, level with the person's middle: only the front, 0.5 m by 1.75 m, is visible.
  // Its solid angle is its area over the square of 20 m minus half the depth, within (1.75 / 2 /
  // 20)^2 = 0.2 %.
  const Yard yard(PersonSamplesNothing());
  const Pose X_WP = MakePose(Vec3(-12, 9, 0), 0, 0, 0.7);
  const Viewer viewer = ViewerOf(ViewField::Samples::kPixels, 1e5,
                                 X_WP * MakePose(Vec3(-20, 0, 0.875), 0.2, 0.1, -0.4));
  const double expected = 1e5 * 0.5 * 1.75 / (19.85 * 19.85);
  const auto samples =
      SamplesOnPersons(PatchesOf(kPersonSamplesStanding), {X_WP}, viewer, 0.2, yard.sighting());
  ASSERT_EQ(samples.size(), 1u);
  EXPECT_NEAR(samples[0], expected, 0.003 * expected);
}

TEST(PersonSamples, PlacesLieTheirDistanceFromTheMachinesSides) {
  const Yard yard(PersonSamplesNothing());
  const std::vector<double> hull_m = HullRadii_m(yard.X_WH(), 0, 36, yard.sighting());
  const auto places = PlacesAroundHull(yard.X_WH(), hull_m, {1, 4}, yard.sighting(), yard.ground());
  ASSERT_EQ(places.size(), 72u);
  // The base, 1.0 m long to the front, points 40 deg to the right of ahead.
  const Vec3 p_Base_m = yard.X_WBase().inverse() * places[2 * 32 + 1].X_WP.translation();
  EXPECT_NEAR(p_Base_m.x(), 1.0 + 4, 1e-3);
  EXPECT_NEAR(p_Base_m.y(), 0, 1e-3);
  EXPECT_EQ(places[2 * 32 + 1].step, 1);
  // The person faces the machine: P's x points away from it.
  EXPECT_NEAR(places[2 * 32].X_WP.linear().col(0).dot(yard.X_WBase().linear().col(0)), 1, 1e-9);
}

}  // namespace
}  // namespace tera
