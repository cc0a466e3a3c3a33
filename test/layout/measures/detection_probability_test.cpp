#include "layout/measures/detection_probability.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "layout/measures/people.h"
#include "layout/sight/hull.h"
#include "layout/yard.h"

namespace tera {
namespace {

constexpr int kSectors = PersonRange::kSectors;

TEST(ProbabilityOfAtLeast, IsPoissons) {
  // One or more: 1 - e^-m.
  EXPECT_NEAR(ProbabilityOfAtLeast(1, 0.7), 1 - std::exp(-0.7), 1e-12);
  // Five or more of five: all except the terms of zero to four.
  EXPECT_NEAR(ProbabilityOfAtLeast(5, 5),
              1 - std::exp(-5.0) * (1 + 5 + 25.0 / 2 + 125.0 / 6 + 625.0 / 24), 1e-12);
  // By tables of chi squared, 5 % and 95 % of 10 degrees of freedom: P(N >= 5) = P(chi2 <= 2 m).
  EXPECT_NEAR(ProbabilityOfAtLeast(5, 0.5 * 3.940), 0.05, 1e-4);
  EXPECT_NEAR(ProbabilityOfAtLeast(5, 0.5 * 18.307), 0.95, 1e-4);
}

TEST(ProbabilityOfAtLeast, IsNothingOfNothingAndAllOfMany) {
  EXPECT_EQ(ProbabilityOfAtLeast(1, 0), 0);
  EXPECT_LT(ProbabilityOfAtLeast(5, 1e-3), 1e-14);
  EXPECT_NEAR(ProbabilityOfAtLeast(5, 1e5), 1, 1e-12);
}

const Figure& Of(const std::vector<Figure>& figures, const std::string& rest) {
  return FigureOf(figures, "person/standing/probability_within_12m" + rest);
}

PersonPlace At(int sector, int step) {
  PersonPlace place;
  place.sector = sector;
  place.step = step;
  return place;
}

TEST(DetectionProbability, IsTheMeanOverPlacesOfEachQuarterAndOfAll) {
  // With one point or more, 1 - e^-ln 2 = 0.5 and 1 - e^-ln 4 = 0.75.
  DetectionProbability probability("standing", 1, 14);
  const double half = std::log(2.0), more = std::log(4.0);
  // Ahead at 1 and 2 m; to the left at 12 m; behind beyond 12 m, which only the map covers.
  probability.Add({At(0, 0), At(0, 1), At(18, 11), At(36, 12)}, {half, more, 0, more});
  const std::vector<Figure> figures = probability.Figures();
  ASSERT_EQ(figures.size(), 5u);
  EXPECT_NEAR(Of(figures, "").at.at(0), (0.5 + 0.75 + 0) / 3, 1e-12);
  EXPECT_NEAR(Of(figures, "_ahead").at.at(0), (0.5 + 0.75) / 2, 1e-12);
  EXPECT_EQ(Of(figures, "_left").at.at(0), 0);
  EXPECT_EQ(Of(figures, "_behind").at.at(0), 0);
  EXPECT_EQ(Of(figures, "_right").at.at(0), 0);
  for (const Figure& figure : figures) EXPECT_TRUE(IsMoreBetter(figure.id.measure));
}

TEST(DetectionProbability, OfAPlaceHasItsMeanAndItsWorstMoment) {
  DetectionProbability probability("standing", 1, 14);
  probability.Add({At(3, 13), At(4, 0)}, {std::log(2.0), 0});
  probability.Add({At(3, 13)}, {std::log(4.0)});
  const std::vector<PolarMap> maps = probability.Maps();
  ASSERT_EQ(maps.size(), 2u);
  EXPECT_EQ(NameOf(maps[0].id), "person/standing/probability");
  EXPECT_EQ(NameOf(maps[1].id), "person/standing/probability_worst");
  for (const PolarMap& map : maps) {
    EXPECT_EQ(map.sectors, kSectors);
    EXPECT_EQ(map.rings, 14);
    ASSERT_EQ(map.value.size(), std::size_t(14 * kSectors));
    EXPECT_EQ(map.value[4 * 14], 0);       // the person was there once, without any point
    EXPECT_LT(map.value[5 * 14 + 13], 0);  // was never tried
  }
  EXPECT_NEAR(maps[0].value[3 * 14 + 13], 0.625, 1e-12);
  EXPECT_NEAR(maps[1].value[3 * 14 + 13], 0.5, 1e-12);
}

// Around a machine.

TestBox Nothing() { return {Vec3(0, 0, -0.5), Vec3(0.01, 0.01, -0.4)}; }

/// Level with the middle of a person, above the machine's base.
Viewer EvenLidar(const Yard& yard, double per_sr) {
  return ViewerOf(ViewField::Samples::kPoints, per_sr, yard.X_WH() * MakePose(Vec3(0, 0, 0.875)));
}

/// Probability for a standing person ahead, at the farthest tested distance.
double Ahead(const Yard& yard, const std::vector<Viewer>& viewers, double farthest_m,
             int cluster_points = 5) {
  PersonStudy study;
  study.farthest_m = farthest_m;
  study.cluster_points = cluster_points;
  PersonRange range({"standing", Vec3(0.3, 0.5, 1.75)}, study, 0.2);
  range.Add(yard.X_WH(), HullRadii_m(yard.X_WH(), 0, kSectors, yard.sighting()), LayoutOf(viewers),
            yard.sighting(), yard.ground());
  const std::vector<PolarMap> maps = range.Maps();
  const PolarMap& map = *std::find_if(maps.begin(), maps.end(), [](const PolarMap& one) {
    return one.id == FigureId{Measure::kProbabilityMap, "standing"};
  });
  return map.value.at(static_cast<std::size_t>(map.rings - 1));
}

/// Points per steradian with `points` on a person who fills half of a front of 0.5 m by 1.75 m, 20
/// m from the hull.
double PerSr(const Yard& yard, double points) {
  const double hull_m = HullRadii_m(yard.X_WH(), 0, kSectors, yard.sighting()).front();
  const double front_m = hull_m + 20 - 0.15;
  return points * front_m * front_m / (0.5 * 0.5 * 1.75);
}

TEST(DetectionProbability, IsThatOfTheSolidAngleThatSheFills) {
  // The solid angle of the front is its area over the squared distance to 0.2 %. The probability of
  // five or more, with five expected, changes by 5 e^-5 5^4 / 4! = 0.88 times the share.
  const Yard yard(Nothing());
  EXPECT_NEAR(Ahead(yard, {EvenLidar(yard, PerSr(yard, 5))}, 20), 0.559507, 0.002);
  EXPECT_NEAR(Ahead(yard, {EvenLidar(yard, PerSr(yard, 0.7))}, 20, 1), 1 - std::exp(-0.7), 0.002);
}

TEST(DetectionProbability, ComesOfThePointsOfAllLidarsTogether) {
  const Yard yard(Nothing());
  const double both = Ahead(yard, {EvenLidar(yard, 1000), EvenLidar(yard, 1500)}, 20);
  EXPECT_NEAR(both, Ahead(yard, {EvenLidar(yard, 2500)}, 20), 1e-9);
  EXPECT_GT(both, Ahead(yard, {EvenLidar(yard, 1500)}, 20) + 0.05);
}

TEST(DetectionProbability, CamerasAddNothing) {
  const Yard yard(Nothing());
  Viewer camera = EvenLidar(yard, 1e6);
  camera.field.samples = ViewField::Samples::kPixels;
  EXPECT_EQ(Ahead(yard, {camera}, 20), 0);
  EXPECT_EQ(Ahead(yard, {EvenLidar(yard, 2000), camera}, 20),
            Ahead(yard, {EvenLidar(yard, 2000)}, 20));
}

TEST(DetectionProbability, IsNothingBeyondTheReachOfTheLidar) {
  const Yard yard(Nothing());
  Viewer lidar = EvenLidar(yard, 1e6);
  lidar.field.reach_m = [](double) { return 15.0; };
  EXPECT_NEAR(Ahead(yard, {lidar}, 13), 1, 1e-9);
  EXPECT_EQ(Ahead(yard, {lidar}, 20), 0);
}

TEST(DetectionProbability, IsLessWhereMorePointsMakeACluster) {
  // Ten or more of five: 1 - e^-5 sum of 5^i / i! to 9 = 0.031828.
  const Yard yard(Nothing());
  EXPECT_NEAR(Ahead(yard, {EvenLidar(yard, PerSr(yard, 5))}, 20, 10), 0.031828, 0.001);
}

}  // namespace
}  // namespace tera
