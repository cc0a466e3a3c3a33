#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <vector>

#include "soil_fixture.h"

/// What leaves a bucket, and where.

namespace tera {
namespace {

using namespace testing_soil;

TEST(Pouring, WhatSpillsOverTheCuttingEdgeLeavesBetweenTheTeeth) {
  // Three teeth of 0.12 m on 0.6 m, the outer ones flush: gaps from 0.06 to 0.18 m on both sides of
  // the middle.
  GroundTools tools;
  tools.shovels = {CompactBucket()};
  tools.shovels[0].teeth = 3;
  tools.shovels[0].tooth_width_m = 0.12;
  auto soil = MakeSite("soil: dirt\n");
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

}  // namespace
}  // namespace tera
