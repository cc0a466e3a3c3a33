#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "soil/soil_fixture.h"

namespace tera {
namespace {

using namespace testing_soil;

constexpr int kCycles = 34;                          ///< on each site
constexpr double kLongStep_s = 0.005, kHaste = 2.5;  ///< so that a cycle takes 760 steps

/// A bucket, a blade and a track on links of their own.
GroundTools Tools() {
  GroundTools tools;
  tools.shovels = {CompactBucket(), CompactBlade()};
  tools.shovels[1].link = 1;
  tools.gears = {FlatTrack(0, 1.6, 0.3, 8)};
  tools.gears[0].link = 2;
  return tools;
}

/// Where a truck stands: beside the pit while the bucket dumps, else 3 m behind. It faces -x, and
/// stands elsewhere under the bucket each time, so that its bed fills evenly.
Pose TruckPose(double t_s, int cycle, double yaw_rad) {
  const double near = std::clamp(std::min(t_s - 3.5, 9.5 - t_s), 0.0, 1.0);  // drives for 1 s
  const Vec3 p_m(-0.7 + 0.5 * (cycle % 5 - 2), 2.5 + 3.0 * (1 - near), 0.0);
  return MakePose(RotationFromRpy(0, 0, yaw_rad) * p_m, 0, 0, yaw_rad + kPi);
}

/// Three soils over each other. Returns the ledger's worst moment, as a share of the shifted mass.
double WorstOfDigging(const std::string& upper, const std::string& middle,
                      const std::string& lower) {
  auto soil = MakeGround(
      fmt::format("size_m: [16, 16]\ncell_m: 0.1\nsoils: [{0}, {1}, {2}]\n"
                  "relief: {{amplitude_m: 0.03}}\n"
                  "layers:\n  - {{soil: {0}, from_m: 0, to_m: 0.1}}\n"
                  "  - {{soil: {1}, from_m: 0.1, to_m: 0.2}}\n  - {{soil: {2}, from_m: 0.2}}\n",
                  upper, middle, lower));
  const int machine = soil->AddMachine(Tools());
  const int bed = soil->AddBed({Vec3(0, 0, 0.2), Vec2(3.2, 1.6), 0.6});
  double worst = 0, most_carried_kg = 0, most_in_air_kg = 0;
  for (int cycle = 0; cycle < kCycles; ++cycle) {
    // Each digs elsewhere on a ring of 4 m, deeper every time round. Blade and track cross the pile
    // and trench of the one before. Every other bucket goes into the truck.
    const double yaw_rad = 2 * kPi * (cycle % 12) / 12;
    const BucketPath dig = DigCycle(0.12 + 0.02 * (cycle % 12), -0.04 * (cycle / 12), yaw_rad);
    const double z_m = 0.22 - 0.04 * (cycle / 12);
    const BucketPath push({{0, {-3.0, 1.0, z_m}, 0}, {9.5, {1.0, 2.0, z_m}, 0}}, yaw_rad);
    const BucketPath drive({{0, {-3.0, 2.5, 0.02}, 0}, {9.5, {2.5, 2.5, -0.03}, 0}}, yaw_rad);
    const int steps = static_cast<int>(std::lround(dig.end_s() / kHaste / kLongStep_s));
    for (int k = 0; k < steps; ++k) {
      const double t_s = kHaste * k * kLongStep_s;
      std::vector<BodyState> links = {dig.At(t_s), push.At(t_s), drive.At(t_s)};
      for (BodyState& link : links) {
        link.v_WB_mps *= kHaste;
        link.w_WB_radps *= kHaste;
      }
      if (cycle % 2 == 0) soil->MoveBed(bed, TruckPose(t_s, cycle / 2, yaw_rad), false);
      GroundToolsMotion motion;
      motion.links = &links;
      motion.gear_rate_radps = {links[2].v_WB_mps.norm() / 0.25 * 1.2};
      soil->Act(machine, motion, kLongStep_s);
      soil->Flow(kLongStep_s);
      if (k % 50 != 0) continue;
      const MassLedger ledger = soil->ledger();
      most_carried_kg = std::max(most_carried_kg, ledger.carried_kg);
      most_in_air_kg = std::max(most_in_air_kg, ledger.grains_kg);
      if (ledger.shifted_kg > 1) {
        worst = std::max(worst, std::abs(ledger.total_kg()) / ledger.shifted_kg);
      }
    }
  }
  const MassLedger ledger = soil->ledger();
  EXPECT_GT(most_carried_kg, 80);
  EXPECT_GT(most_in_air_kg, 1);
  EXPECT_GT(ledger.shifted_kg, 50 * kCycles);
  EXPECT_GT(ledger.beds_kg, 10 * kCycles);
  EXPECT_NEAR(soil->bed_load(bed).mass_kg / ledger.beds_kg, 1, 1e-9);
  EXPECT_EQ(ledger.outside_kg, 0);
  return worst;
}

TEST(DiggingCycles, AHundredDigsDumpsIntoATruckAndBesideItPushesAndDrivesLoseNoMass) {
  for (const auto& [upper, middle, lower] :
       std::vector<std::array<const char*, 3>>{{"dirt", "wet_sand", "gravel"},
                                               {"loose", "loose_sand", "sand"},
                                               {"clay", "hard_loam", "stiff_clay"}}) {
    SCOPED_TRACE(upper);
    const double worst = WorstOfDigging(upper, middle, lower);
    RecordProperty(fmt::format("worst_share_from_{}_to_{}", upper, lower),
                   fmt::format("{:.2g}", worst));
    EXPECT_LT(worst, 1e-12);
  }
}

}  // namespace
}  // namespace tera
