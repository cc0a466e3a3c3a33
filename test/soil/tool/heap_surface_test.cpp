#include "soil/tool/heap_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "soil/soil_fixture.h"

namespace tera {
namespace {

using namespace testing_soil;

constexpr double kCell_m = 0.025, kRepose_rad = 37 * kDeg;

double Smooth(double, double) { return 0; }
/// Lumps of 2 cm.
double Lumps(double along_m, double across_m) {
  return 0.01 * (1 + std::sin(50 * along_m) * std::cos(60 * across_m));
}

/// The bucket of config/machines/excavator20t.yaml.
Shovel LargeBucket() {
  Shovel bucket;
  bucket.name = "bucket";
  bucket.profile_B_m = {{1.45, 0.0},  {1.37, 0.19}, {1.18, 0.44}, {0.89, 0.615},
                        {0.55, 0.66}, {0.28, 0.55}, {0.17, 0.32}, {0.17, -0.05}};
  bucket.width_m = 1.045;
  bucket.capacity_m3 = 0.56;
  bucket.teeth = 5;
  bucket.tooth_length_m = 0.24;
  return bucket;
}

/// Up when the level shovel is pitched and rolled.
Vec3 Tilted(const Shovel& shovel, double pitch_rad, double roll_rad) {
  return RotationFromRpy(0, pitch_rad, 0) * RotationFromRpy(roll_rad, 0, 0) *
         ShovelShape(shovel).LevelUp_B();
}

/// Upright columns of 4 mm between a surface and the lowest point of a shovel's shell. Their first
/// two axes are level, in the profile's plane and along B's y axis.
class Columns4mm {
 public:
  Columns4mm(const Shovel& shovel, const Vec3& up_B) : shovel_(shovel) {
    const Vec2 up = Vec2(up_B.x(), up_B.z()).normalized();
    R_LB_ << up.y(), 0, -up.x(), 0, 1, 0, up.x(), 0, up.y();
  }
  double VolumeUnder_m3(const HeapSurface& surface) const {
    constexpr double kColumn_m = 0.004;
    double volume_m3 = 0;
    for (const auto& t : surface.triangles) {
      const Vec3 a = R_LB_ * surface.p_B_m[t[0]], b = R_LB_ * surface.p_B_m[t[1]],
                 c = R_LB_ * surface.p_B_m[t[2]];
      const Vec3 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
      const Vec3 n = (b - a).cross(c - a);
      EXPECT_GE(n.z(), 0) << "a triangle faces down";
      for (double x = std::ceil(low.x() / kColumn_m) * kColumn_m; x < high.x(); x += kColumn_m) {
        for (double y = std::ceil(low.y() / kColumn_m) * kColumn_m; y < high.y(); y += kColumn_m) {
          if (!IsIn(Vec2(x, y), a.head<2>(), b.head<2>(), c.head<2>())) continue;
          const double top_m = a.z() - (n.x() * (x - a.x()) + n.y() * (y - a.y())) / n.z();
          volume_m3 += (top_m - Floor_m(x)) * kColumn_m * kColumn_m;
        }
      }
    }
    return volume_m3;
  }

 private:
  static bool IsIn(const Vec2& p, const Vec2& a, const Vec2& b, const Vec2& c) {
    const auto left = [&](const Vec2& from, const Vec2& to) {
      return (to.x() - from.x()) * (p.y() - from.y()) - (to.y() - from.y()) * (p.x() - from.x());
    };
    return left(a, b) >= 0 && left(b, c) >= 0 && left(c, a) >= 0;
  }
  double Floor_m(double x_m) const {
    double floor_m = 1e9;
    for (std::size_t k = 0; k + 1 < shovel_.profile_B_m.size(); ++k) {
      const auto level = [&](const Vec2& p) { return Vec3(R_LB_ * Vec3(p.x(), 0, p.y())); };
      const Vec3 a = level(shovel_.profile_B_m[k]), b = level(shovel_.profile_B_m[k + 1]);
      if ((a.x() - x_m) * (b.x() - x_m) > 0 || a.x() == b.x()) continue;
      floor_m = std::min(floor_m, a.z() + (b.z() - a.z()) * (x_m - a.x()) / (b.x() - a.x()));
    }
    return floor_m;
  }

  Shovel shovel_;
  Mat3 R_LB_;
};

TEST(HeapSurface, HasTheCarriedVolumeBetweenItAndTheShellOfTwoMachines) {
  for (const Shovel& shovel : {CompactBucket(), LargeBucket()}) {
    const Vec3 up_B = ShovelShape(shovel).LevelUp_B();
    for (const double fill : {0.05, 0.1, 0.25, 0.5, 0.75, 1.0, 1.2}) {
      const double carried_m3 = fill * shovel.capacity_m3;
      const HeapSurface surface = MakeHeapSurface(
          ShovelShape(shovel), {carried_m3, up_B, up_B, kRepose_rad}, kCell_m, Lumps);
      EXPECT_NEAR(Columns4mm(shovel, up_B).VolumeUnder_m3(surface) / carried_m3, 1, 0.02)
          << shovel.width_m << " " << fill;
    }
  }
}

TEST(HeapSurface, HasTheCarriedVolumeWhenTheShovelIsTiltedTheWayItLies) {
  const Shovel shovel = CompactBucket();
  for (const double pitch_deg : {-30.0, -12.0, 20.0}) {
    for (const double roll_deg : {-15.0, 0.0, 8.0}) {
      const Vec3 up_B = Tilted(shovel, pitch_deg * kDeg, roll_deg * kDeg);
      const HeapSurface surface =
          MakeHeapSurface(ShovelShape(shovel), {0.04, up_B, up_B, kRepose_rad}, kCell_m, Lumps);
      EXPECT_NEAR(Columns4mm(shovel, up_B).VolumeUnder_m3(surface) / 0.04, 1, 0.02)
          << pitch_deg << " " << roll_deg;
    }
  }
}

/// How far a point stands beyond the walls of a shovel, up to its mouth and over it.
double Beyond_m(const Shovel& shovel, const Vec3& p_B) {
  const std::vector<Vec2>& wall = shovel.profile_B_m;
  double beyond_m = std::abs(p_B.y()) - 0.5 * shovel.width_m;
  for (std::size_t k = 0; k + 1 < wall.size(); ++k) {  // the profile is convex
    const Vec2 d = (wall[k + 1] - wall[k]).normalized();
    const Vec2 to = Vec2(p_B.x(), p_B.z()) - wall[k];
    beyond_m = std::max(beyond_m, to.x() * d.y() - to.y() * d.x());
  }
  return beyond_m;
}

TEST(HeapSurface, StaysWithinTheWallsAndRisesOverTheRimAtMostAtRepose) {
  for (const Shovel& shovel : {CompactBucket(), LargeBucket()}) {
    const ShovelShape shape(shovel);
    for (const auto& [fill, roll_deg] : {std::pair{0.3, 10.0}, {1.0, 6.0}, {1.2, 0.0}}) {
      const Vec3 up_B = Tilted(shovel, 0, roll_deg * kDeg);
      const HeapSurface surface = MakeHeapSurface(
          shape, {fill * shovel.capacity_m3, up_B, up_B, kRepose_rad}, kCell_m, Lumps);
      ASSERT_GT(surface.triangles.size(), 100u);
      const Vec2 edge = shape.held_B().front(), top = shape.held_B().back();
      for (const Vec3& p_B : surface.p_B_m) {
        EXPECT_LT(Beyond_m(shovel, p_B), 1e-6) << fill << ": " << p_B.transpose();
        for (const double s : {0.0, 0.2, 0.4, 0.6, 0.8, 1.0}) {  // along the four parts of the rim
          const double y_m = (s - 0.5) * shovel.width_m;
          const Vec2 side = top + s * (edge - top);
          for (const Vec3& rim_B : {Vec3(edge.x(), y_m, edge.y()), Vec3(top.x(), y_m, top.y()),
                                    Vec3(side.x(), -0.5 * shovel.width_m, side.y()),
                                    Vec3(side.x(), 0.5 * shovel.width_m, side.y())}) {
            const Vec3 rise_B = p_B - rim_B;
            const double rise_m = rise_B.dot(up_B), level_m = (rise_B - rise_m * up_B).norm();
            EXPECT_LT(rise_m, std::tan(kRepose_rad) * level_m + 0.003) << fill;
          }
        }
      }
    }
  }
}

/// However far its surface has turned with the bucket.
TEST(HeapSurface, LiesWhereTheSoilModuleHasItsCentreOfMass) {
  const Shovel shovel = CompactBucket();
  const ShovelShape shape(shovel);
  for (const auto& [pitch_deg, turned_deg] : {std::pair{-25.0, 0.0},
                                              {-25.0, -25.0},
                                              {0.0, 0.0},
                                              {0.0, 30.0},
                                              {15.0, 0.0},
                                              {15.0, -20.0}}) {
    const Vec3 up_B = Tilted(shovel, pitch_deg * kDeg, 0);
    const Vec3 lies_B = Tilted(shovel, (pitch_deg + turned_deg) * kDeg, 0);
    for (const double volume_m3 : {0.02, 0.05, 0.08}) {
      const HeapSurface surface =
          MakeHeapSurface(shape, {volume_m3, up_B, lies_B, kRepose_rad}, kCell_m, Smooth);
      Vec3 moment_B = Vec3::Zero();
      double sum = 0;
      for (const auto& t : surface.triangles) {
        Vec3 top_B = Vec3::Zero(), floor_B = Vec3::Zero();
        for (const std::uint32_t k : t) {
          top_B += surface.p_B_m[k] / 3, floor_B += surface.floor_B_m[k] / 3;
        }
        const Vec3 n_B = (surface.p_B_m[t[1]] - surface.p_B_m[t[0]])
                             .cross(surface.p_B_m[t[2]] - surface.p_B_m[t[0]]);
        const double share = n_B.dot(up_B) * (top_B - floor_B).norm();
        moment_B += share * 0.5 * (top_B + floor_B), sum += share;
      }
      EXPECT_NEAR(0.5 * sum / volume_m3, 1, 0.02) << pitch_deg << " " << turned_deg;
      const Vec3 truth_B = shape.HoldFor(up_B, kRepose_rad, volume_m3, lies_B).com_B_m;
      EXPECT_LT((moment_B / sum - truth_B).norm(), 0.02)
          << pitch_deg << " " << turned_deg << " " << volume_m3;
    }
  }
}

TEST(HeapSurface, SlopesAgainstGravityAreThoseOfAGentleMound) {
  const Shovel shovel = CompactBucket();
  const Vec3 up_B = Tilted(shovel, -20 * kDeg, 12 * kDeg);
  const HeapSurface surface =
      MakeHeapSurface(ShovelShape(shovel), {0.03, up_B, up_B, kRepose_rad}, kCell_m, Smooth);
  ASSERT_GT(surface.triangles.size(), 100u);
  for (const auto& t : surface.triangles) {
    const Vec3 n_B = (surface.p_B_m[t[1]] - surface.p_B_m[t[0]])
                         .cross(surface.p_B_m[t[2]] - surface.p_B_m[t[0]]);
    if (n_B.norm() < 1e-8) continue;
    EXPECT_GT(n_B.normalized().dot(up_B), std::cos(kRepose_rad));
  }
}

TEST(HeapSurface, IsNothingWhenTheShovelIsEmpty) {
  const ShovelShape shape(CompactBucket());
  EXPECT_TRUE(MakeHeapSurface(shape, {0, Vec3::UnitZ(), Vec3::UnitZ(), kRepose_rad}, kCell_m, Lumps)
                  .triangles.empty());
}

TEST(HeapSurface, KeepsItsVolumeWithinTheWallsWhileAShovelEmptiesUpsideDown) {
  const Shovel shovel = CompactBucket();
  for (const double pitch_deg : {80.0, 130.0, 180.0, -100.0}) {
    const Vec3 up_B = Tilted(shovel, pitch_deg * kDeg, 0);
    const HeapSurface surface =
        MakeHeapSurface(ShovelShape(shovel), {0.05, up_B, up_B, kRepose_rad}, kCell_m, Lumps);
    ASSERT_GT(surface.triangles.size(), 50u) << pitch_deg;
    for (const Vec3& p_B : surface.p_B_m) EXPECT_LT(Beyond_m(shovel, p_B), 1e-6) << pitch_deg;
  }
}

}  // namespace
}  // namespace tera
