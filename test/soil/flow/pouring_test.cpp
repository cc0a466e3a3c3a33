#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "soil/soil_fixture.h"
#include "soil/tool/shovel_shape.h"

/// Soil that leaves a bucket: the place where it leaves, and the pile that it makes.

namespace tera {
namespace {

using namespace testing_soil;

/// Volume under a plane that rises from the lower lip into the bucket at `slope_rad`, by clipping
/// the section at it; of sections that nowhere reach the mouth.
double UnderSlopeFromLip_m3(const Shovel& shovel, const Pose& X_WB, double slope_rad) {
  const ShovelShape shape(shovel);
  std::vector<Vec2> section;  // level and upwards
  for (const Vec2& p : shape.held_B()) {
    const Vec3 p_W = X_WB.linear() * Vec3(p.x(), 0, p.y());
    section.emplace_back(p_W.x(), p_W.z());
  }
  const auto area_m2 = [](const std::vector<Vec2>& polygon) {
    double twice_m2 = 0;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Vec2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
      twice_m2 += a.x() * b.y() - a.y() * b.x();
    }
    return 0.5 * std::abs(twice_m2);
  };
  const Vec2 lip = section.front(), inwards = section.back() - lip;
  const auto above_m = [&](const Vec2& p) {
    return p.y() - lip.y() -
           std::tan(slope_rad) * std::copysign(1, inwards.x()) * (p.x() - lip.x());
  };
  std::vector<Vec2> below;
  for (std::size_t k = 0; k < section.size(); ++k) {
    const Vec2 &a = section[k], &b = section[(k + 1) % section.size()];
    const double at_a_m = above_m(a), at_b_m = above_m(b);
    if (at_a_m <= 1e-12) below.push_back(a);
    if ((at_a_m < -1e-12 && at_b_m > 1e-12) || (at_a_m > 1e-12 && at_b_m < -1e-12)) {
      below.push_back(a + at_a_m / (at_a_m - at_b_m) * (b - a));
    }
  }
  return shovel.capacity_m3 * area_m2(below) / area_m2(section);
}

/// A bucket is filled, curled, and opened by 2.5 deg a second.
TEST(Pouring, ABucketsLoadTurnsWithItUpToReposeThenLiesAtReposeAndLeavesOverTheLip) {
  const double repose_rad = 37 * kDeg;  // config/soils/dirt.yaml
  auto soil = MakeGround("soil: dirt\n");
  const int machine = AddCompactBucket(soil.get());
  const BucketPath path({{0.0, {0.3, 0, 1.30}, 80 * kDeg},
                         {1.0, {0.3, 0, 0.60}, 85 * kDeg},
                         {2.5, {-0.5, 0, 0.58}, 105 * kDeg},
                         {3.5, {-0.7, 0, 0.65}, 165 * kDeg},
                         {5.0, {-0.7, 0, 2.00}, 182 * kDeg},
                         {6.0, {-0.7, 0, 2.00}, 182 * kDeg},
                         {46.0, {-0.7, 0, 2.00}, 82 * kDeg}});
  double lay_still_rad = 0, slid_rad = 0, last_rad = 182 * kDeg;
  Vec3 lay_B = Vec3::Zero(), com_B = Vec3::Zero();
  RunBucket(soil.get(), machine, path,
            [&](double t_s, const BodyState& body, const SoilReaction& r) {
              const SoilReaction::Load& load = r.shovel_load[0];
              if (t_s < 6 || load.mass_kg == 0) return;
              const Mat3& R_WB = body.X_WB.linear();
              const double pitch_rad = (182 - 2.5 * (t_s - 6)) * kDeg;
              const double leans_rad = std::acos((R_WB * load.surface_up_B).z());
              ASSERT_LT(leans_rad, repose_rad + 0.2 * kDeg) << t_s;
              if (leans_rad < repose_rad - 0.5 * kDeg) {
                if (!lay_B.isZero()) {
                  ASSERT_LT((load.surface_up_B - lay_B).norm(), 1e-9) << t_s;
                  ASSERT_LT((load.com_B_m - com_B).norm(), 0.002) << t_s;
                }
                lay_still_rad += last_rad - pitch_rad;
                lay_B = load.surface_up_B, com_B = load.com_B_m;
              } else {
                slid_rad += last_rad - pitch_rad;
              }
              last_rad = pitch_rad;
              // The mouth falls towards the edge more steeply than repose, and the load still fills
              // it.
              if (pitch_rad > 125 * kDeg || pitch_rad < 107 * kDeg) return;
              const double held_m3 = UnderSlopeFromLip_m3(CompactBucket(), body.X_WB, repose_rad);
              EXPECT_NEAR(load.volume_m3, held_m3, 0.03 * 0.11) << pitch_rad / kDeg;
            });
  EXPECT_GT(lay_still_rad, 20 * kDeg);
  EXPECT_GT(slid_rad, 5 * kDeg);
  EXPECT_NEAR(soil->ledger().total_kg(), 0, 1e-9);
}

TEST(Pouring, WhatSpillsOverTheCuttingEdgeLeavesBetweenTheTeeth) {
  // Three teeth of 0.12 m on 0.6 m, the outer ones flush: gaps from 0.06 to 0.18 m on both sides of
  // the middle.
  GroundTools tools;
  tools.shovels = {CompactBucket()};
  tools.shovels[0].teeth = 3;
  tools.shovels[0].tooth_width_m = 0.12;
  auto soil = MakeGround("soil: dirt\n");
  const int machine = soil->AddMachine(tools);
  std::map<int, int> clods;  // left and right
  std::vector<bool> seen(1 << 16, false);
  RunBucket(soil.get(), machine, DigCycle(0.25, 0, 0.3),
            [&](double t_s, const BodyState& body, const SoilReaction&) {
              for (const TerrainSurface::Grain& grain : soil->surface().grains()) {
                if (seen[grain.number]) continue;
                seen[grain.number] = true;
                const Vec3 p_B = body.X_WB.inverse() * grain.p_W_m.cast<double>();
                if (t_s < 6.2 || p_B.norm() > 1.2) continue;  // not of the dump
                EXPECT_GT(std::abs(p_B.y()), 0.06 - 0.005);
                EXPECT_LT(std::abs(p_B.y()), 0.18 + 0.005);
                ++clods[p_B.y() > 0 ? 1 : -1];
              }
            });
  EXPECT_GT(clods[1], 200);  // of a thousand of a tenth of a litre
  EXPECT_GT(clods[-1], 200);
}

/// Digs with the compact bucket in eight places, at y from -3.5 to 3.5 m and x about 0. Each time
/// it opens within five seconds, with its edge at rest.
BucketPath EightBucketsOver(const Vec3& edge_W_m) {
  const Vec3 edge_B(CompactBucket().profile_B_m[0].x(), 0, 0);
  const auto edge_there = [&](double t_s, double pitch_rad) {
    return BucketPlace{t_s, edge_W_m - RotationFromRpy(0, pitch_rad, 0) * edge_B, pitch_rad};
  };
  std::vector<BucketPlace> places;
  for (int k = 0; k < 8; ++k) {
    const double start_s = 15 * k, y_m = k - 3.5;
    for (const BucketPlace& place : {BucketPlace{0, {0.8, y_m, 1.5}, 80 * kDeg},
                                     {1, {0.8, y_m, 0.6}, 85 * kDeg},
                                     {2.5, {-0.5, y_m, 0.58}, 105 * kDeg},
                                     {3.5, {-0.7, y_m, 0.65}, 165 * kDeg},
                                     {4.5, {-0.7, y_m, 1.6}, 182 * kDeg}}) {
      places.push_back(place);
      places.back().t_s += start_s;
    }
    for (int step = 0; step <= 30; ++step) {
      places.push_back(edge_there(start_s + 7 + step / 6.0, (182 - 5.4 * step) * kDeg));
    }
    places.push_back(edge_there(start_s + 13, 20 * kDeg));
  }
  places.push_back(edge_there(15 * 8, 20 * kDeg));
  return BucketPath(places);
}

/// Slope angle of a straight line fitted to heights between 20 % and 80 % of the top, over a sector
/// of 8 deg about an azimuth.
double FlankAngle_deg(const TerrainSurface& ground, const Vec2& from_W_m, double top_m,
                      double azimuth_rad) {
  double n = 0, sr = 0, sz = 0, srr = 0, srz = 0;
  for (const double beside_deg : {-4, -2, 0, 2, 4}) {
    const double a = azimuth_rad + beside_deg * kDeg;
    for (double r = 0; r < 3; r += 0.01) {
      const double z =
          ground.HeightAt(from_W_m.x() + r * std::cos(a), from_W_m.y() + r * std::sin(a));
      if (z > 0.2 * top_m && z < 0.8 * top_m) n += 1, sr += r, sz += z, srr += r * r, srz += r * z;
    }
  }
  return std::atan(-(n * srz - sr * sz) / (n * srr - sr * sr)) / kDeg;
}

class PileOfABucket : public testing::TestWithParam<std::tuple<std::string, double>> {};

TEST_P(PileOfABucket, StandsAtReposeAlongAxesAndDiagonals) {
  const auto [name, cell_m] = GetParam();
  const double repose_deg = name == "sand" ? 33 : 37;  // config/soils
  auto soil = MakeGround("size_m: [14, 12]\nsoil: " + name + "\ncell_m: " + std::to_string(cell_m));
  GroundTools tools;
  tools.shovels = {CompactBucket()};
  const int machine = soil->AddMachine(tools);
  const Vec2 spot_W_m(4.0, 0.02);
  RunBucket(soil.get(), machine, EightBucketsOver({spot_W_m.x(), spot_W_m.y(), 1.3}),
            [](double, const BodyState&, const SoilReaction&) {});
  EXPECT_EQ(soil->ledger().grains_kg, 0);  // all at rest
  const TerrainSurface& ground = soil->surface();
  double top_m = 0;
  for (double x = 3; x < 5; x += 0.02) top_m = std::max(top_m, ground.HeightAt(x, spot_W_m.y()));
  EXPECT_GT(top_m, 0.55);          // flanks of ten columns of 10 cm
  Vec2 middle_W_m = Vec2::Zero();  // of the soil above half the height
  int above = 0;
  for (double x = 2; x < 6; x += 0.02) {
    for (double y = -2; y < 2; y += 0.02) {
      if (ground.HeightAt(x, y) > 0.5 * top_m) middle_W_m += Vec2(x, y), ++above;
    }
  }
  middle_W_m /= above;
  for (int k = 0; k < 8; ++k) {
    // The pile's crest is as long as the lip is wide.
    const double side_m = k == 0 || k == 4 ? 0.0 : k < 4 ? 0.25 : -0.25;
    EXPECT_NEAR(FlankAngle_deg(ground, middle_W_m + Vec2(0, side_m), top_m, k * 45 * kDeg),
                repose_deg, 1.0)
        << "azimuth " << 45 * k << " deg, " << top_m << " m high at " << middle_W_m.transpose();
  }
}

INSTANTIATE_TEST_SUITE_P(Soils, PileOfABucket,
                         testing::Combine(testing::Values("sand", "dirt"),
                                          testing::Values(0.05, 0.10)),
                         [](const auto& info) {
                           return std::get<0>(info.param) +
                                  (std::get<1>(info.param) < 0.07 ? "At5Cm" : "At10Cm");
                         });

}  // namespace
}  // namespace tera
