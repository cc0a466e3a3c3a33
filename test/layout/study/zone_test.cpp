#include "layout/study/zone.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/faults.h"
#include "core/units.h"

namespace tera {
namespace {

using enum FaultKind;

Zone ZoneOf(const std::string& keys) {
  const Config config = Config::FromText("zone: {" + keys + "}", "study.yaml");
  Zone zone = ReadZone(config.root().Map("zone"));
  config.Finish();
  return zone;
}

void ExpectZoneRefused(const std::string& keys, const FaultsMatcher& fault) {
  EXPECT_THAT([&] { ZoneOf(keys); },
              testing::Throws<InputError>(testing::Property(&InputError::faults, fault)))
      << keys;
}

/// An L of two bars, 4 x 1 and 1 x 2, whose corner is on the left below.
constexpr char kConcave[] =
    "prism: {xy_m: [[0, 0], [4, 0], [4, 1], [1, 1], [1, 3], [0, 3]], low_m: -1, high_m: 1.5}";
bool IsInL(const Vec3& p) {
  const bool in_bars =
      p.x() >= 0 && p.y() >= 0 && ((p.x() <= 4 && p.y() <= 1) || (p.x() <= 1 && p.y() <= 3));
  return in_bars && p.z() >= -1 && p.z() <= 1.5;
}

TEST(ReadZone, RefusesWhatIsNoZone) {
  ExpectZoneRefused("box_m: [1, 2, 3]", HasFaultAt("name"));
  ExpectZoneRefused("name: a", HasFault(kInconsistent));
  ExpectZoneRefused("name: a, box_m: [1, 2, 3], cylinder: {radius_m: 1, height_m: 2}",
                    HasFault(kInconsistent));
  ExpectZoneRefused("name: a, box_m: [1, 2]", HasFaultAt("box_m"));
  ExpectZoneRefused("name: a, box_m: [1, -2, 3]", HasFaultAt("box_m"));
  ExpectZoneRefused("name: a, box_m: [1, 0, 3]", HasFaultAt("box_m"));
  ExpectZoneRefused("name: a, box_m: [1, .nan, 3]", HasFaultAt("box_m"));
  ExpectZoneRefused("name: a, box_m: [1, .inf, 3]", HasFaultAt("box_m"));
  ExpectZoneRefused("name: a, box_m: high", HasFaultAt("box_m"));
  ExpectZoneRefused("name: a, cylinder: {radius_m: 1}", HasFaultAt("height_m"));
  ExpectZoneRefused("name: a, cylinder: {radius_m: 0, height_m: 1}", HasFaultAt("radius_m"));
  ExpectZoneRefused("name: a, cylinder: {radius_m: 1, height_m: -1}", HasFaultAt("height_m"));
  ExpectZoneRefused("name: a, cylinder: {radius_m: 1, height_m: 1, colour: red}",
                    HasFaultAt("colour"));
  ExpectZoneRefused("name: a, box_m: [1, 1, 1], level: perhaps", HasFaultAt("level"));
  ExpectZoneRefused("name: a, box_m: [1, 1, 1], xyz_m: [1, 2]", HasFaultAt("xyz_m"));
  ExpectZoneRefused("name: a, box_m: [1, 1, 1], rpy_degs: [1, 2, 3]", HasFaultAt("rpy_degs"));
}

TEST(ReadZone, RefusesAPrismThatIsNone) {
  const auto prism = [](const std::string& keys) { return "name: a, prism: {" + keys + "}"; };
  const std::string square = "xy_m: [[0, 0], [1, 0], [1, 1], [0, 1]]";
  EXPECT_NO_THROW(ZoneOf(prism(square + ", high_m: 2")));
  ExpectZoneRefused(prism(square), HasFaultAt("high_m"));
  ExpectZoneRefused(prism(square + ", low_m: 2, high_m: 2"), HasFaultAt("high_m"));
  ExpectZoneRefused(prism(square + ", low_m: 3, high_m: 2"), HasFaultAt("high_m"));
  ExpectZoneRefused(prism("high_m: 2"), HasFaultAt("xy_m"));
  ExpectZoneRefused(prism("xy_m: [], high_m: 2"), HasFaultAt("xy_m"));
  ExpectZoneRefused(prism("xy_m: [[0, 0], [1, 0]], high_m: 2"), HasFaultAt("xy_m"));
  ExpectZoneRefused(prism("xy_m: [[0, 0], [1, 0], [1]], high_m: 2"), HasFaultAt("xy_m"));
  ExpectZoneRefused(prism("xy_m: [[0, 0], [1, 0], [x, 1]], high_m: 2"), HasFaultAt("xy_m"));
}

TEST(ReadZone, RefusesAPrismWithoutArea) {
  ExpectZoneRefused("name: a, prism: {xy_m: [[0, 0], [1, 1], [2, 2]], high_m: 2}",
                    HasFaultAt("xy_m"));
  ExpectZoneRefused("name: a, prism: {xy_m: [[0, 0], [0, 0], [0, 0]], high_m: 2}",
                    HasFaultAt("xy_m"));
}

TEST(ReadZone, RefusesAPrismThatIsASliver) {
  // Each place in it would need tests of a million cells around it.
  ExpectZoneRefused("name: a, prism: {xy_m: [[0, 0], [10, 10], [10, 10.00001]], high_m: 2}",
                    HasFaultAt("xy_m"));
}

TEST(ReadZone, RefusesAPrismWhoseOutlineCrossesItself) {
  // A bow tie: its halves have opposite orientations, so that its area is undefined.
  ExpectZoneRefused("name: a, prism: {xy_m: [[0, 0], [2, 2], [2, 0], [0, 1]], high_m: 2}",
                    HasFaultAt("xy_m"));
}

TEST(ReadZone, TakesEveryKey) {
  const Zone zone = ZoneOf(
      "name: behind, frame: upper, level: false, xyz_m: [1, 2, 3], rpy_deg: [10, 20, 30], "
      "box_m: [1, 2, 3]");
  EXPECT_EQ(zone.name, "behind");
  EXPECT_EQ(zone.frame, "upper");
  EXPECT_FALSE(zone.level);
  EXPECT_TRUE(zone.X_FZ.isApprox(MakePose({1, 2, 3}, 10 * kDeg, 20 * kDeg, 30 * kDeg)));
  EXPECT_EQ(std::get<ZoneBox>(zone.shape).size_m, Vec3(1, 2, 3));
  const Zone plain = ZoneOf("name: a, cylinder: {radius_m: 2, height_m: 3}");
  EXPECT_EQ(plain.frame, "W");
  EXPECT_TRUE(plain.level);
  EXPECT_EQ(std::get<ZoneCylinder>(plain.shape).radius_m, 2);
}

TEST(Zone, VolumesAreThoseOfGeometry) {
  const std::string turned = "name: a, xyz_m: [5, -3, 1], rpy_deg: [20, 50, 70], ";
  EXPECT_NEAR(Volume_m3(ZoneOf(turned + "box_m: [1, 2, 3.5]")), 7, 1e-12);
  EXPECT_NEAR(Volume_m3(ZoneOf(turned + "cylinder: {radius_m: 2, height_m: 3}")),
              12 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(Volume_m3(ZoneOf(turned + kConcave)), 6 * 2.5, 1e-12);
  // The same outline, clockwise.
  EXPECT_NEAR(Volume_m3(ZoneOf("name: a, prism: {xy_m: [[0, 3], [1, 3], [1, 1], [4, 1], [4, 0], "
                               "[0, 0]], low_m: -1, high_m: 1.5}")),
              6 * 2.5, 1e-12);
}

constexpr int kCounts[] = {10, 100, 2000, 6000};

TEST(PointsIn, LieInABoxAboutItsOrigin) {
  for (const int count : kCounts) {
    const auto points = PointsIn(ZoneOf("name: a, box_m: [8, 0.2, 3]"), count, 1);
    // The requested number of cells, except for rounding of the sides to whole cells.
    EXPECT_GE(points.size(), 0.5 * count) << count;
    EXPECT_LE(points.size(), 3.0 * count + 1) << count;
    for (const Vec3& p : points) {
      EXPECT_TRUE(std::abs(p.x()) <= 4 && std::abs(p.y()) <= 0.1 && std::abs(p.z()) <= 1.5);
    }
  }
}

TEST(PointsIn, LieInACylinderThatStandsOnItsOrigin) {
  for (const int count : kCounts) {
    const auto points = PointsIn(ZoneOf("name: a, cylinder: {radius_m: 2, height_m: 3}"), count, 1);
    EXPECT_GE(points.size(), 0.5 * count) << count;
    EXPECT_LE(points.size(), 3.0 * count + 3) << count;
    for (const Vec3& p : points) {
      EXPECT_TRUE(p.head<2>().norm() <= 2 && p.z() >= 0 && p.z() <= 3) << p.transpose();
    }
  }
}

TEST(PointsIn, LieInAConcavePrism) {
  for (const int count : kCounts) {
    const auto points = PointsIn(ZoneOf(std::string("name: a, ") + kConcave), count, 1);
    EXPECT_GE(points.size(), 0.5 * count) << count;
    for (const Vec3& p : points) EXPECT_TRUE(IsInL(p)) << p.transpose();
  }
}

TEST(PointsIn, ThereIsOneAtLeastOfTheFewestWhateverTheShape) {
  for (const std::string shape :
       {"box_m: [0.1, 30, 2]", "cylinder: {radius_m: 9, height_m: 0.01}", kConcave,
        // A sliver across its own bounding box.
        "prism: {xy_m: [[0, 0], [10, 10], [10, 10.4]], high_m: 1}"}) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      EXPECT_FALSE(PointsIn(ZoneOf("name: a, " + shape), 10, seed).empty()) << shape << seed;
    }
  }
}

TEST(PointsIn, OfAFlatZoneAreNotMore) {
  for (const std::string shape : {"box_m: [200, 200, 0.01]", "box_m: [0.01, 0.01, 200]",
                                  "cylinder: {radius_m: 100, height_m: 0.02}"}) {
    const auto points = PointsIn(ZoneOf("name: a, " + shape), 2000, 1);
    EXPECT_GT(points.size(), 1500u) << shape;
    EXPECT_LT(points.size(), 2500u) << shape;
  }
}

TEST(PointsIn, SpreadEvenly) {
  // The mean of n uniform points in a body misses its middle by its spread over sqrt(n), and a
  // share p its volume by sqrt(p (1 - p) / n), at 1 sigma. Points of cells do better.
  const auto expect_even = [](const std::string& shape, const Vec3& middle, const Vec3& spread,
                              double share, auto is_in_part) {
    const auto points = PointsIn(ZoneOf("name: a, " + shape), 6000, 4);
    const auto n = static_cast<double>(points.size());
    Vec3 sum = Vec3::Zero();
    double in_part = 0;
    for (const Vec3& p : points) {
      sum += p;
      in_part += is_in_part(p);
    }
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(sum[axis] / n, middle[axis], 4 * spread[axis] / std::sqrt(n)) << shape << axis;
    }
    EXPECT_NEAR(in_part / n, share, 4 * std::sqrt(share * (1 - share) / n)) << shape;
  };
  const double of_1 = 1 / std::sqrt(12.0);  // of a length of 1
  expect_even("box_m: [8, 2, 3]", Vec3::Zero(), of_1 * Vec3(8, 2, 3), 0.25,
              [](const Vec3& p) { return p.x() > 2; });
  // x of a disc of radius r has the standard deviation r / 2; within half of it lies a quarter.
  expect_even("cylinder: {radius_m: 2, height_m: 3}", {0, 0, 1.5}, {1, 1, 3 * of_1}, 0.25,
              [](const Vec3& p) { return p.head<2>().norm() < 1; });
  // Bars of 4 x 1 and 1 x 2 with middles (2, 0.5) and (0.5, 2).
  const Vec3 middle((4 * 2 + 2 * 0.5) / 6, (4 * 0.5 + 2 * 2) / 6, 0.25);
  expect_even(kConcave, middle, {1.5, 1, 2.5 * of_1}, 1.0 / 3,
              [](const Vec3& p) { return p.y() > 1; });
}

TEST(PointsIn, AShareIsCountedBetterThanAtRandom) {
  // Half of a cube on one side of an inclined plane, over seeds. For random points the share errs
  // by sqrt(0.25 / n). With one point in each of n cells, only those in the n^(2/3) cells on the
  // plane err, by at most sqrt(0.25 k n^(2/3)) / n with k of some 2.
  const Zone zone = ZoneOf("name: a, box_m: [2, 2, 2]");
  double squares = 0, n = 0;
  constexpr int kSeeds = 40;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const auto points = PointsIn(zone, 4096, seed);
    n = static_cast<double>(points.size());
    double above = 0;
    for (const Vec3& p : points) above += p.dot(Vec3(0.36, 0.48, 0.8)) > 0;
    squares += std::pow(above / n - 0.5, 2);
  }
  // The deviation of 40 draws is known within 5 / sqrt(80), 56 %, at 5 sigma.
  EXPECT_LT(std::sqrt(squares / kSeeds), 1.56 * std::sqrt(0.25 * 2 * std::pow(n, 2.0 / 3)) / n);
  EXPECT_LT(std::sqrt(squares / kSeeds), 0.6 * std::sqrt(0.25 / n));
}

TEST(PointsIn, AreTheSameForOneSeedAndOthersForAnother) {
  const Zone zone = ZoneOf(std::string("name: a, ") + kConcave);
  EXPECT_EQ(PointsIn(zone, 500, 3), PointsIn(zone, 500, 3));
  EXPECT_NE(PointsIn(zone, 500, 3), PointsIn(zone, 500, 4));
}

TEST(PointsIn, AreOfTheShapeAloneWhateverItsPose) {
  const std::string shape = "name: a, cylinder: {radius_m: 1, height_m: 2}";
  EXPECT_EQ(PointsIn(ZoneOf(shape), 300, 3),
            PointsIn(ZoneOf(shape + ", xyz_m: [1, 2, 3], rpy_deg: [10, 20, 30]"), 300, 3));
}

TEST(Levelled, StandsUprightAtThePlaceAndHeadingOfALink) {
  for (const double yaw : {-3.0, -1.2, 0.0, 0.4, 2.9}) {
    const Pose X_WB = MakePose({3, -4, 5}, 0.3, -0.4, yaw), level = Levelled(X_WB);
    EXPECT_TRUE(level.isApprox(MakePose({3, -4, 5}, 0, 0, yaw), 1e-12)) << yaw;
  }
}

TEST(Levelled, IsAPoseEvenWhereALinkLooksStraightUp) {
  const Pose level = Levelled(MakePose({1, 2, 3}, 0, -90 * kDeg, 0));
  EXPECT_TRUE(level.matrix().allFinite());
  EXPECT_TRUE(level.linear().isUnitary(1e-9));
  EXPECT_NEAR(level.linear().determinant(), 1, 1e-9);
  EXPECT_TRUE((level.linear() * Vec3::UnitZ()).isApprox(Vec3::UnitZ(), 1e-9));
}

}  // namespace
}  // namespace tera
