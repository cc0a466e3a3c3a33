#include "soil/tool/shovel_walls.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/units.h"
#include "soil/tool/contact_probe.h"
#include "soil/tool/cut_soil.h"
#include "soil/tool/layered_cut.h"

namespace tera {
namespace {

constexpr double kWallElasticTravel_m = 0.006;  ///< travel over which the force builds up
constexpr double kBesideWall_m = 0.075;         ///< distance at which the ground is sampled
/// horizontal part of the normal below which a wall pushes nothing
constexpr double kLeastUpright = 0.3;
constexpr double kSteep = 0.35;            ///< backs that face further down rest on the ground
constexpr double kSlowestWall_mps = 1e-4;  ///< slower walls keep their elastic travel
constexpr int kStrips = 4;                 ///< strips of a wall
constexpr int kRimPieces = 4;              ///< pieces of each edge of the mouth

/// Removes the part of a force that would accelerate its point along its motion.
Vec3 Opposing(const Vec3& force_W_n, const Vec3& v_W_mps) {
  const double power_w = force_W_n.dot(v_W_mps), v2 = v_W_mps.squaredNorm();
  if (power_w <= 0 || v2 <= kSlowestWall_mps * kSlowestWall_mps) return force_W_n;
  return force_W_n - power_w / v2 * v_W_mps;
}

/// The ground beside a point of the shovel.
struct Beside {
  double depth_m;  ///< depth of the point below that ground
  double x_m, y_m;

  Beside(const Vec3& p_W, const Vec3& outward_W, const Columns& ground)
      : x_m(p_W.x() + ContactProbeDistance_m(kBesideWall_m, ground.cell_m()) * outward_W.x()),
        y_m(p_W.y() + ContactProbeDistance_m(kBesideWall_m, ground.cell_m()) * outward_W.y()) {
    depth_m = ground.HeightAt(x_m, y_m) - p_W.z();
  }
  CutSoil SoilAbove(double z_m, const std::vector<SoilType>& soils, Columns* ground) const {
    const int i = std::clamp(ground->NearestI(x_m), 0, ground->nx() - 1);
    const int j = std::clamp(ground->NearestJ(y_m), 0, ground->ny() - 1);
    return tera::SoilAbove(ground->Touch(i, j), z_m, *ground, soils);
  }
};

/// Input for a strip of a wall. Cohesion and other soil properties are filled in later.
CuttingInput PlateOf(double width_m, double rake_rad, double speed_mps) {
  CuttingInput in;
  in.width_m = width_m;
  in.rake_rad = rake_rad;
  in.speed_mps = std::max(0.0, speed_mps);
  in.flank_share = 1.0 / kStrips;
  return in;
}

}  // namespace

ShovelWalls::ShovelWalls(const Shovel& shovel, const std::vector<SoilType>& soils)
    : shovel_(shovel), piercing_(soils, shovel.edge_thickness_m) {}

/// Vertical strips of equal width across the cross-section.
std::vector<ShovelWalls::Strip> ShovelWalls::SideStrips(const ShovelShape& shape, const Vec3& up_B,
                                                        double y_B) const {
  const ShovelShape::LevelExtent extent = shape.ExtentAcross(up_B);
  const std::vector<Vec2>& outline = shovel_.profile_B_m;
  const double width_m = (extent.to_m - extent.from_m) / kStrips;
  std::vector<Strip> strips;
  for (int s = 0; s < kStrips; ++s) {
    const double at_m = extent.from_m + (s + 0.5) * width_m;
    double low_m = std::numeric_limits<double>::infinity(), high_m = -low_m;
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const Vec2 &a = outline[k], &b = outline[(k + 1) % outline.size()];
      const double from_a = at_m - a.dot(extent.right), to_b = b.dot(extent.right) - at_m;
      if (from_a * to_b < 0 || from_a + to_b == 0) continue;
      const double z_m = (a + from_a / (from_a + to_b) * (b - a)).dot(extent.up);
      low_m = std::min(low_m, z_m);
      high_m = std::max(high_m, z_m);
    }
    if (high_m <= low_m) continue;
    const Vec2 low = at_m * extent.right + low_m * extent.up;
    const Vec2 high = at_m * extent.right + high_m * extent.up;
    strips.push_back({Vec3(low.x(), y_B, low.y()), Vec3(high.x(), y_B, high.y()), width_m});
  }
  return strips;
}

/// Strips across the width, from the lowest to the highest point of the parts of the back that face
/// sideways.
std::vector<ShovelWalls::Strip> ShovelWalls::BackStrips(const ShovelShape& shape,
                                                        const Vec3& up_B) const {
  const Vec2 up = Vec2(up_B.x(), up_B.z());
  const Vec2 back(-shape.mouth_normal_B().x(), -shape.mouth_normal_B().z());
  const Vec2 level_back = back - back.dot(up) * up;
  Vec2 low = Vec2::Zero(), high = Vec2::Zero();
  bool is_steep = false;
  const auto take = [&](const Vec2& p) {
    if (!is_steep || p.dot(up) < low.dot(up)) low = p;
    if (!is_steep || p.dot(up) > high.dot(up)) high = p;
    is_steep = true;
  };
  for (std::size_t k = 0; k + 1 < shape.segments().size(); ++k) {
    const ShovelShape::Segment& segment = shape.segments()[k];
    if (segment.outward.dot(up) < -kSteep || segment.outward.dot(level_back) <= 0) continue;
    take(segment.a);
    take(segment.b);
  }
  std::vector<Strip> strips;
  for (int s = 0; s < kStrips && is_steep; ++s) {
    const double y_B = ((s + 0.5) / kStrips - 0.5) * shovel_.width_m;
    strips.push_back(
        {Vec3(low.x(), y_B, low.y()), Vec3(high.x(), y_B, high.y()), shovel_.width_m / kStrips});
  }
  return strips;
}

void ShovelWalls::Push(const std::vector<Strip>& strips, const Vec3& normal_B,
                       const BodyState& body, double dt_s, const std::vector<SoilType>& soils,
                       double* travel_m, Columns* ground, Wrench* wrench) const {
  const Vec3 n_W = body.X_WB.linear() * normal_B;
  const double level = n_W.head<2>().norm();
  if (strips.empty() || level < kLeastUpright) {
    *travel_m = 0;
    return;
  }
  const Vec3 out_W(n_W.x() / level, n_W.y() / level, 0);
  const Vec3 v_W = PointVelocity(body, 0.5 * (strips.front().low_B + strips.back().high_B));
  const double out_mps = v_W.dot(out_W);
  const double length_m = strips.front().width_m * static_cast<double>(strips.size());
  const double stays = std::max(0.0, 1 - (v_W - out_mps * out_W).norm() * dt_s / length_m);
  *travel_m = std::clamp(stays * *travel_m + out_mps * dt_s, 0.0, kWallElasticTravel_m);
  if (*travel_m == 0) return;
  // Angle from horizontal ahead to the wall; the wall leans back by the rise of its normal.
  const double rake_rad = std::atan2(level, n_W.z());
  double deepest_m = 0;
  for (const Strip& strip : strips) {
    const Vec3 low_W = body.X_WB * strip.low_B, high_W = body.X_WB * strip.high_B;
    const Beside beside(low_W, out_W, *ground);
    deepest_m = std::max(deepest_m, beside.depth_m);
    if (beside.depth_m <= 0) continue;
    const double height_m = high_W.z() - low_W.z();
    const Vec3 p_B =  // passive pressure acts at the lower third
        strip.low_B + std::min(1.0, beside.depth_m / height_m) / 3 * (strip.high_B - strip.low_B);
    const Vec3 v_strip_W = PointVelocity(body, p_B);
    const CuttingInput plate = PlateOf(strip.width_m, rake_rad, v_strip_W.dot(out_W));
    const double beside_m = ContactProbeDistance_m(kBesideWall_m, ground->cell_m());
    const auto push_down_to = [&](double up_m) {
      const Vec3 p_W = low_W + up_m * Vec3::UnitZ();
      const GroundAhead ahead = LookAhead(p_W, beside_m, out_W, *ground);
      if (ahead.depth_m() <= 0) return CuttingForce{};
      const CutSoil soil = beside.SoilAbove(p_W.z(), soils, ground);
      return CutLayersAhead(plate, ahead, soil, {.blade_m = height_m});
    };
    const CuttingForce all = push_down_to(0);
    const CuttingForce above = beside.depth_m > height_m ? push_down_to(height_m) : CuttingForce{};
    // Stronger soil above does not reduce the force below it.
    if (all.draft_n <= above.draft_n) continue;
    const Vec3 force_W_n = -(all.draft_n - above.draft_n) * out_W -
                           (all.vertical_n - above.vertical_n) * Vec3::UnitZ();
    wrench->AddForceAt(*travel_m / kWallElasticTravel_m * Opposing(force_W_n, v_strip_W),
                       body.X_WB * p_B, body.X_WB.translation());
  }
  if (deepest_m <= 0) *travel_m = 0;
}

void ShovelWalls::PierceWithRim(const ShovelShape& shape, const BodyState& body, double dt_s,
                                const std::vector<SoilType>& soils, Columns* ground,
                                Wrench* wrench) {
  const Mat3& R_WB = body.X_WB.linear();
  const Vec3 mouth_W = R_WB * shape.mouth_normal_B();
  const Vec3 edge_B = shape.edge_B(), chord_B = shape.top_edge_B() - edge_B;
  const Vec3 v_W = PointVelocity(body, edge_B + 0.5 * chord_B);
  rim_m_ = std::clamp(rim_m_ + v_W.dot(mouth_W) * dt_s, 0.0, kWallElasticTravel_m);
  if (rim_m_ == 0) return;
  double deepest_m = 0;
  const auto pierce = [&](const Vec3& p_B, const Vec3& outward_B, double length_m) {
    const Vec3 p_W = body.X_WB * p_B;
    const Beside beside(p_W, R_WB * outward_B, *ground);
    deepest_m = std::max(deepest_m, beside.depth_m);
    if (beside.depth_m <= 0) return;
    const double force_n =
        rim_m_ / kWallElasticTravel_m * length_m * shovel_.edge_thickness_m *
        piercing_.Pressure_pa(beside.SoilAbove(p_W.z(), soils, ground), beside.depth_m);
    wrench->AddForceAt(Opposing(-force_n * mouth_W, PointVelocity(body, p_B)), p_W,
                       body.X_WB.translation());
  };
  for (int k = 0; k < kRimPieces; ++k) {
    const double at = (k + 0.5) / kRimPieces;
    for (const double side : {-1.0, 1.0}) {
      pierce(edge_B + at * chord_B + side * 0.5 * shovel_.width_m * Vec3::UnitY(),
             side * Vec3::UnitY(), chord_B.norm() / kRimPieces);
    }
    pierce(shape.top_edge_B() + (at - 0.5) * shovel_.width_m * Vec3::UnitY(), chord_B.normalized(),
           shovel_.width_m / kRimPieces);
  }
  if (deepest_m <= 0) rim_m_ = 0;
}

Wrench ShovelWalls::Act(const ShovelShape& shape, const BodyState& body, double dt_s,
                        const std::vector<SoilType>& soils, Columns* ground) {
  Wrench wrench;
  const Vec3 up_B = body.X_WB.linear().transpose() * Vec3::UnitZ();
  const double half_m = 0.5 * shovel_.width_m;
  Push(SideStrips(shape, up_B, half_m), Vec3::UnitY(), body, dt_s, soils, &left_m_, ground,
       &wrench);
  Push(SideStrips(shape, up_B, -half_m), -Vec3::UnitY(), body, dt_s, soils, &right_m_, ground,
       &wrench);
  Push(BackStrips(shape, up_B), -shape.mouth_normal_B(), body, dt_s, soils, &back_m_, ground,
       &wrench);
  if (shovel_.capacity_m3 > 0) PierceWithRim(shape, body, dt_s, soils, ground, &wrench);
  return wrench;
}

}  // namespace tera
