#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "core/config/config.h"
#include "core/types/ground_tools.h"
#include "core/units.h"
#include "soil/columns/columns.h"
#include "soil/columns/soil_type.h"
#include "soil/site/site.h"
#include "soil/soil.h"

/// Sites, tools and motions that the soil's tests share.

namespace tera::testing_soil {

inline constexpr double kStep_s = 0.002;

/// A soil of config/soils.
inline SoilType Shipped(const std::string& name) {
  const Config config = Config::FromFile(*ShippedSoilFile(name));
  return ReadSoilType(config.root());
}

/// Dry sand of friction 30 deg, for which Rankine's passive coefficient is 3.
inline SoilType SandOf30Deg() {
  SoilType soil;
  soil.name = "sand";
  soil.bank_density_kgpm3 = 1500;
  soil.max_density_kgpm3 = 1800;
  soil.friction_angle_rad = 30 * kDeg;
  soil.repose_angle_rad = 33 * kDeg;
  return soil;
}

/// n x n columns of one soil, level at `z_m`, centred on W's origin.
inline Columns LevelColumns(const SoilType& soil, double cell_m, int n, double z_m = 0) {
  UndisturbedGround ground;
  ground.grid = {
      .origin_W_m = Vec2::Constant(-0.5 * cell_m * (n - 1)), .cell_m = cell_m, .nx = n, .ny = n};
  ground.base_cells = TerrainGrid::kTileCells;
  ground.base_height_m.assign(static_cast<std::size_t>(ground.base_nx()) * ground.base_ny(), z_m);
  ground.profiles.push_back(
      GroundProfile({{std::numeric_limits<double>::infinity(), 0, static_cast<float>(soil.moisture),
                      soil.bank_density_kgpm3}}));
  return Columns(std::move(ground), {soil});
}

inline Site SiteOf(const std::string& terrain_yaml, std::uint64_t seed = 7) {
  const Config config = Config::FromText(terrain_yaml, "site.yaml");
  Site site = Site::Read(config.root(), seed);
  config.Finish();
  return site;
}

inline std::unique_ptr<Soil> MakeGround(const std::string& terrain_yaml, std::uint64_t seed = 7) {
  return MakeSoil(SiteOf(terrain_yaml, seed), seed);
}

/// The bucket of config/machines/tb235.yaml.
inline Shovel CompactBucket() {
  Shovel bucket;
  bucket.name = "bucket";
  bucket.profile_B_m = {{0.78, 0.0},  {0.74, 0.12}, {0.64, 0.28}, {0.48, 0.40},
                        {0.30, 0.42}, {0.15, 0.33}, {0.09, 0.18}, {0.09, -0.03}};
  bucket.width_m = 0.60;
  bucket.capacity_m3 = 0.11;
  bucket.teeth = 6;
  bucket.tooth_length_m = 0.15;
  return bucket;
}

/// A machine with that bucket alone.
inline int AddCompactBucket(Soil* soil) {
  GroundTools tools;
  tools.shovels = {CompactBucket()};
  return soil->AddMachine(tools);
}

/// Its blade, in the blade's frame.
inline Shovel CompactBlade() {
  Shovel blade;
  blade.name = "blade";
  blade.profile_B_m = {{0.55, -0.30}, {0.50, -0.22}, {0.48, -0.10}, {0.50, 0.02}, {0.54, 0.08}};
  blade.width_m = 1.55;
  return blade;
}

/// Flat track bottom of `length_m` x `width_m` through the link's origin, in patches.
inline RunningGear FlatTrack(double y_m, double length_m, double width_m, int patches) {
  RunningGear gear;
  gear.name = "track";
  gear.drive_radius_m = 0.25;
  for (int k = 0; k < patches; ++k) {
    ContactPatch patch;
    patch.length_m = length_m / patches;
    patch.width_m = width_m;
    patch.p_B_m = Vec3(length_m * ((k + 0.5) / patches - 0.5), y_m, 0);
    gear.patches.push_back(patch);
  }
  return gear;
}

/// The same under road wheels `pitch_m` apart, as many before the link's origin as behind.
inline void PutRoadWheels(double pitch_m, RunningGear* gear) {
  for (ContactPatch& patch : gear->patches) {
    const double x_m = patch.p_B_m.x() - 0.5 * pitch_m;  // from one of the wheels
    patch.wheel_pitch_m = pitch_m;
    patch.past_wheel_m = pitch_m * std::round(x_m / pitch_m) - x_m;
  }
}

/// The same between noses that rise on circles of `radius_m`, as around sprocket and idler.
inline RunningGear NosedTrack(double y_m, double length_m, double width_m, int patches,
                              double radius_m) {
  RunningGear gear = FlatTrack(y_m, length_m, width_m, patches);
  for (const double end : {-1.0, 1.0}) {
    for (const double angle_rad : {10 * kDeg, 30 * kDeg, 50 * kDeg, 70 * kDeg}) {
      const double s = end * std::sin(angle_rad), c = std::cos(angle_rad);
      ContactPatch patch;
      patch.outward_B = Vec3(s, 0, -c);
      patch.travel_B = Vec3(-c, 0, -s);
      patch.p_B_m = Vec3(end * length_m / 2, y_m, radius_m) + radius_m * patch.outward_B;
      patch.length_m = radius_m * 20 * kDeg;
      patch.width_m = width_m;
      gear.patches.push_back(patch);
    }
  }
  return gear;
}

/// A place of the bucket: its pin in W and its pitch (Ry); yaw turns the whole about z.
struct BucketPlace {
  double t_s;
  Vec3 p_W_m;
  double pitch_rad;
};

/// Straight lines between places, with the velocities that belong to them.
class BucketPath {
 public:
  explicit BucketPath(std::vector<BucketPlace> places, double yaw_rad = 0)
      : places_(std::move(places)), yaw_rad_(yaw_rad) {}
  double end_s() const { return places_.back().t_s; }
  BodyState At(double t_s) const {
    std::size_t k = 0;
    while (k + 2 < places_.size() && places_[k + 1].t_s <= t_s) ++k;
    const BucketPlace &a = places_[k], &b = places_[k + 1];
    const double span_s = b.t_s - a.t_s;
    const double s = std::min(1.0, (t_s - a.t_s) / span_s);
    const Mat3 R_yaw = RotationFromRpy(0, 0, yaw_rad_);
    BodyState body;
    body.X_WB =
        MakePose(R_yaw * (a.p_W_m + s * (b.p_W_m - a.p_W_m)),
                 R_yaw * RotationFromRpy(0, a.pitch_rad + s * (b.pitch_rad - a.pitch_rad), 0));
    body.v_WB_mps = R_yaw * (b.p_W_m - a.p_W_m) / span_s;
    body.w_WB_radps = R_yaw * Vec3(0, (b.pitch_rad - a.pitch_rad) / span_s, 0);
    return body;
  }

 private:
  std::vector<BucketPlace> places_;
  double yaw_rad_;
};

/// Digs at about (-0.5, 0), lifts, carries 2.5 m to the left, dumps, returns. Level ground at
/// ground_z_m.
inline BucketPath DigCycle(double depth_m = 0.18, double ground_z_m = 0, double yaw_rad = 0) {
  const double tip_down = 0.78;  // from pin to edge
  const double z = ground_z_m + tip_down - depth_m;
  const auto deg = [](double d) { return d * kDeg; };
  return BucketPath({{0.0, {0.3, 0, z + 0.7}, deg(80)},
                     {1.0, {0.3, 0, z}, deg(85)},
                     {2.5, {-0.5, 0, z - 0.02}, deg(105)},
                     {3.5, {-0.7, 0, z + 0.05}, deg(165)},
                     {4.5, {-0.7, 0, z + 1.0}, deg(182)},
                     {6.0, {-0.7, 2.5, z + 1.0}, deg(182)},
                     {7.5, {-0.7, 2.5, z + 1.0}, deg(30)},
                     {8.5, {-0.7, 2.5, z + 1.0}, deg(30)},
                     {9.5, {0.3, 0, z + 0.7}, deg(80)}},
                    yaw_rad);
}

/// Runs a bucket along a path, with Act and Flow in each step; calls `each(t, body, reaction)`.
template <typename Each>
void RunBucket(Soil* soil, int machine, const BucketPath& path, Each each) {
  const int steps = static_cast<int>(std::lround(path.end_s() / kStep_s));
  for (int k = 0; k < steps; ++k) {
    const std::vector<BodyState> links = {path.At(k * kStep_s)};
    GroundToolsMotion motion;
    motion.links = &links;
    const SoilReaction reaction = soil->Act(machine, motion, kStep_s);
    soil->Flow(kStep_s);
    each(k * kStep_s, links[0], reaction);
  }
}

}  // namespace tera::testing_soil
