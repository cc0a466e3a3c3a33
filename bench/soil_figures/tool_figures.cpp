#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "soil/soil_fixture.h"
#include "soil_figures/figures.h"

namespace tera::bench {
namespace {

using namespace testing_soil;

/// Forces and load of a shovel on a prescribed path over level ground.
struct Led {
  std::unique_ptr<Soil> soil;
  using Each = std::function<void(double t_s, const BodyState& body, const SoilReaction& reaction)>;

  Led(const Shovel& shovel, const std::string& soil_name, std::uint64_t seed,
      const BucketPath& path, const Each& each)
      : soil(MakeGround("size_m: [12, 6]\nsoil: " + soil_name, seed)) {
    GroundTools tools;
    tools.shovels = {shovel};
    RunBucket(soil.get(), soil->AddMachine(tools), path, each);
  }
};

/// Draft over the last quarter of `run_m` at 0.5 m/s, the edge `depth_m` deep.
double Draft_n(const Shovel& shovel, double edge_z_B_m, double depth_m, double run_m,
               double pitch_rad, std::uint64_t seed) {
  const double z_m = -depth_m - edge_z_B_m, end_s = run_m / 0.5;
  double sum_n = 0;
  int count = 0;
  const BucketPath path(
      {{0, {-run_m / 2, 0.013, z_m}, pitch_rad}, {end_s, {run_m / 2, 0.013, z_m}, pitch_rad}});
  Led(shovel, "dirt", seed, path, [&](double t_s, const BodyState&, const SoilReaction& reaction) {
    if (t_s < 0.75 * end_s) return;
    sum_n -= reaction.link_wrench[0].force_W_n.x();
    ++count;
  });
  return sum_n / count;
}

/// The compact excavator's blade, and a plate of 0.3 m x 0.6 m at a rake of 60 deg.
Figures Drafts(std::uint64_t seed) {
  Shovel plate;
  plate.profile_B_m = {{0, 0}, {0, 0.6}, {0.06, 0.6}};
  plate.width_m = 0.3;
  return {{"blade_draft_n", Draft_n(CompactBlade(), -0.30, 0.08, 2, 0, seed)},
          {"plate_draft_n", Draft_n(plate, 0, 0.2, 2, -30 * kDeg, seed)}};
}

/// The bucket dragged on, its mouth upright and 0.2 m deep, until it is full by a tenth more than
/// struck.
Figures FullBucket(std::uint64_t seed) {
  double before_n = 0, full_n = 0;
  const BucketPath path({{0, {0.5, 0, 0.58}, 90 * kDeg}, {2, {-0.5, 0, 0.58}, 90 * kDeg}});
  Led(CompactBucket(), "dirt", seed, path,
      [&](double t_s, const BodyState&, const SoilReaction& reaction) {
        if (t_s < 0.1) return;
        const double fill = reaction.shovel_load[0].volume_m3 / CompactBucket().capacity_m3;
        const double draft_n = reaction.link_wrench[0].force_W_n.x();
        if (fill < 0.8) before_n = draft_n;
        if (fill < 1.1) full_n = std::max(full_n, draft_n);
      });
  return {{"bucket_draft_n", before_n}, {"full_bucket_draft_n", full_n}};
}

/// A dig 0.15 m deep: work over what fills the bucket, as undisturbed volume, and that volume.
Figures Dig(const std::string& soil_name, std::uint64_t seed) {
  constexpr double kZ_m = 0.78 - 0.15;  // of the pin
  double work_j = 0, load_kg = 0;
  const BucketPath path({{0.0, {0.3, 0, kZ_m + 0.3}, 80 * kDeg},
                         {0.6, {0.3, 0, kZ_m}, 85 * kDeg},
                         {2.5, {-0.5, 0, kZ_m - 0.02}, 105 * kDeg},
                         {3.5, {-0.7, 0, kZ_m + 0.05}, 165 * kDeg}});
  Led(CompactBucket(), soil_name, seed, path,
      [&](double, const BodyState& body, const SoilReaction& reaction) {
        const Wrench& wrench = reaction.link_wrench[0];
        work_j -= kStep_s *
                  (wrench.force_W_n.dot(body.v_WB_mps) + wrench.torque_W_nm.dot(body.w_WB_radps));
        load_kg = reaction.shovel_load[0].mass_kg;
      });
  const double filled_m3 = load_kg / Shipped(soil_name).bank_density_kgpm3;
  return {{"dig_energy_" + soil_name + "_kpa", 1e-3 * work_j / filled_m3},
          {"dig_filled_" + soil_name + "_l", 1e3 * filled_m3}};
}

/// Clay left in a bucket after dumping, and the penetration of the bucket, lying on its shell,
/// under 15 kN.
Figures StuckAndPressed(std::uint64_t seed) {
  double left_kg = 0;
  Led(CompactBucket(), "clay", seed, DigCycle(),
      [&](double, const BodyState&, const SoilReaction& reaction) {
        left_kg = reaction.shovel_load[0].mass_kg;
      });
  constexpr double kMass_kg = 1500, kShell_m = 0.42;
  const auto soil = MakeGround("soil: dirt\nsize_m: [6, 6]\n", seed);
  GroundTools tools;
  tools.shovels = {CompactBucket()};
  const int machine = soil->AddMachine(tools);
  std::vector<BodyState> links(1);
  links[0].X_WB = MakePose(Vec3(0.1, 0.2, kShell_m + 0.01), 0, kPi, 0.4);
  GroundToolsMotion motion;
  motion.links = &links;
  for (int k = 0; k < 1000; ++k) {
    const SoilReaction reaction = soil->Act(machine, motion, kStep_s);
    links[0].v_WB_mps.z() +=
        kStep_s * (reaction.link_wrench[0].force_W_n.z() / kMass_kg - kStandardGravity_mps2);
    links[0].X_WB.translation() += kStep_s * links[0].v_WB_mps;
  }
  return {{"stuck_clay_kg", left_kg},
          {"shell_sinkage_mm", 1e3 * (kShell_m - links[0].X_WB.translation().z())}};
}

}  // namespace

Figures ToolFigures(std::uint64_t seed) {
  Figures all;
  for (const Figures& some : {Drafts(seed), FullBucket(seed), Dig("dirt", seed), Dig("sand", seed),
                              StuckAndPressed(seed)}) {
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

}  // namespace tera::bench
