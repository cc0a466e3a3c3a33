#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "soil_fixture.h"

namespace tera {
namespace {

using namespace testing_soil;

// 100 cycles take minutes; the environment's TERA_DIG_CYCLES sets another number than the
// usual one.
int Cycles() {
  const char* given = std::getenv("TERA_DIG_CYCLES");
  return given ? std::atoi(given) : 8;
}

/// A bucket, a blade and a track on links of their own.
GroundTools Tools() {
  GroundTools tools;
  tools.shovels = {CompactBucket(), CompactBlade()};
  tools.shovels[1].link = 1;
  tools.gears = {FlatTrack(0, 1.6, 0.3, 8)};
  tools.gears[0].link = 2;
  return tools;
}

TEST(DiggingCycles, DigDumpPushAndDriveLoseNoMass) {
  auto soil = MakeSite(
      "size_m: [16, 16]\nsoils: [dirt, wet_sand, gravel]\nrelief: {amplitude_m: 0.03}\n"
      "layers:\n  - {soil: dirt, from_m: 0, to_m: 0.15}\n"
      "  - {soil: wet_sand, from_m: 0.15, to_m: 0.5}\n  - {soil: gravel, from_m: 0.5}\n");
  const int machine = soil->AddMachine(Tools());
  double worst = 0, most_carried_kg = 0, most_in_air_kg = 0;
  for (int cycle = 0; cycle < Cycles(); ++cycle) {
    // Each digs elsewhere on a ring of 4 m, deeper every time round; the blade pushes and the track
    // drives across pile and trench of the one before.
    const double yaw_rad = 2 * kPi * (cycle % 12) / 12;
    const BucketPath dig = DigCycle(0.12 + 0.02 * (cycle % 12), -0.08 * (cycle / 12), yaw_rad);
    const double z_m = 0.22 - 0.08 * (cycle / 12);
    const BucketPath push({{0, {-3.0, 1.0, z_m}, 0}, {9.5, {1.0, 2.0, z_m}, 0}}, yaw_rad);
    const BucketPath drive({{0, {-3.0, 2.5, 0.02}, 0}, {9.5, {2.5, 2.5, -0.03}, 0}}, yaw_rad);
    const int steps = static_cast<int>(std::lround(dig.end_s() / kStep_s));
    for (int k = 0; k < steps; ++k) {
      const double t_s = k * kStep_s;
      const std::vector<BodyState> links = {dig.At(t_s), push.At(t_s), drive.At(t_s)};
      GroundToolsMotion motion;
      motion.links = &links;
      motion.gear_rate_radps = {drive.At(t_s).v_WB_mps.norm() / 0.25 * 1.2};
      soil->Act(machine, motion, kStep_s);
      soil->Flow(kStep_s);
      if (k % 250 != 0) continue;
      const MassLedger ledger = soil->ledger();
      most_carried_kg = std::max(most_carried_kg, ledger.carried_kg);
      most_in_air_kg = std::max(most_in_air_kg, ledger.grains_kg);
      if (ledger.shifted_kg > 1) {
        worst = std::max(worst, std::abs(ledger.total_kg()) / ledger.shifted_kg);
      }
    }
  }
  RecordProperty("worst_share_of_shifted", fmt::format("{:.2g}", worst));
  EXPECT_LT(worst, 1e-9);
  EXPECT_GT(most_carried_kg, 80);
  EXPECT_GT(most_in_air_kg, 1);
  const MassLedger ledger = soil->ledger();
  EXPECT_GT(ledger.shifted_kg, 100 * Cycles());
  RecordProperty("shifted_kg", fmt::format("{:.0f}", ledger.shifted_kg));
  EXPECT_EQ(ledger.outside_kg, 0);
}

}  // namespace
}  // namespace tera
