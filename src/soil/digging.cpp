#include "soil/digging.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/units.h"
#include "soil/earthmoving.h"
#include "soil/soil_type.h"

namespace tera {
namespace {

// Shell on the ground.
constexpr double kElasticDepth_m = 0.01;    ///< indentation at which the shell's bearing is reached
constexpr double kShellWidth_m = 0.10;      ///< width of the loaded strip for the bearing pressure
constexpr double kLeastDownward = 0.35;     ///< parts of the shell facing further up carry nothing
constexpr double kShellDampingRatio = 0.2;  ///< of critical for the mass that the pressure carries
constexpr double kSlideSpeed_mps = 0.10;    ///< shell friction is proportional to speed below it
constexpr double kNear_m = 0.3;             ///< a shovel this close to the ground holds soil back
// Edge.
constexpr double kElasticTravel_m = 0.006;  ///< travel over which the edge's force builds up
constexpr double kLookAhead_m = 0.30;       ///< over which the ground's slope ahead is measured
constexpr double kNearAhead_cells = 1.5;    ///< where the depth is measured: past the cut itself
constexpr double kLeastLevelMouth = 0.1;    ///< a mouth that looks more up or down than this
constexpr double kLeastLevel = 1e-6;        ///< no direction below it
constexpr double kSteepestSlope_rad = 25 * kDeg;
constexpr double kEdgeThickness_m = 0.012;
constexpr double kToothWidth_m = 0.06, kToothThickness_m = 0.02;
constexpr double kFullPierceDepth_m = 0.5, kPierceAtSurface = 0.1;
constexpr double kLeastSpeed_mps = 1e-4;  ///< slower edges keep their elastic travel
// Carried soil.
constexpr double kSpillTime_s = 0.25;   ///< time constant at which what cannot stay leaves
constexpr double kBeforeLip_cells = 2;  ///< where the ground before the mouth is looked at
constexpr double kShut_m = 0.05;        ///< ground this far above the lip shuts the mouth
constexpr double kMouthDown = -0.7;     ///< z of a mouth that no ground can shut

double Clamp01(double x) { return std::clamp(x, 0.0, 1.0); }

/// Resistance of the ground to being pierced at a depth; none above it.
double PiercePressure_pa(const SoilType& soil, double depth_m) {
  if (depth_m <= 0) return 0;
  return BearingPressure_pa(soil, kEdgeThickness_m, kFullPierceDepth_m) *
         (kPierceAtSurface + (1 - kPierceAtSurface) * std::min(1.0, depth_m / kFullPierceDepth_m));
}

}  // namespace

Digging::Digging(const Shovel& shovel, std::vector<SoilType> soils)
    : shovel_(shovel), shape_(shovel), soils_(std::move(soils)) {}

bool Digging::InFootprint(int i, int j) const {
  if (i < i0_ || i > i1_ || j < j0_ || j > j1_) return false;
  return mask_[static_cast<std::size_t>(j - j0_) * (i1_ - i0_ + 1) + (i - i0_)] != 0;
}

/// Columns in which the shovel stands, and among them those whose soil it overlaps.
void Digging::FindFootprint(const BodyState& body, Columns* ground) {
  const std::vector<ColumnId> before = std::exchange(blocked_, {});
  footprint_.clear();
  i1_ = i0_ - 1;
  const double half_m = 0.5 * shovel_.width_m;
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Vec2& p : shovel_.profile_B_m) {
    for (const double y : {-half_m, half_m}) {
      const Vec3 p_W = body.X_WB * Vec3(p.x(), y, p.y());
      low = low.cwiseMin(p_W);
      high = high.cwiseMax(p_W);
    }
  }
  i0_ = std::max(0, ground->NearestI(low.x()));
  j0_ = std::max(0, ground->NearestJ(low.y()));
  i1_ = std::min(ground->nx() - 1, ground->NearestI(high.x()));
  j1_ = std::min(ground->ny() - 1, ground->NearestJ(high.y()));
  mask_.assign(static_cast<std::size_t>(std::max(0, i1_ - i0_ + 1)) * std::max(0, j1_ - j0_ + 1),
               0);
  for (int j = j0_; j <= j1_; ++j) {
    for (int i = i0_; i <= i1_; ++i) {
      const double top_m = ground->TopAt(i, j);
      if (top_m + kNear_m <= low.z()) continue;
      const auto crossing = shape_.VerticalCrossing(body.X_WB, ground->x_m(i), ground->y_m(j));
      if (!crossing) continue;
      mask_[static_cast<std::size_t>(j - j0_) * (i1_ - i0_ + 1) + (i - i0_)] = 1;
      const ColumnId k = ground->Touch(i, j);
      ground->Block(k, crossing->low_m);
      blocked_.push_back(k);
      if (top_m > crossing->low_m) footprint_.push_back({i, j, *crossing});
    }
  }
  for (const ColumnId k : before) {
    const auto [i, j] = ground->PlaceOf(k);
    if (!InFootprint(i, j)) ground->Unblock(k);
  }
}

/// Puts soil on the first column outside the footprint in `direction`.
void Digging::PutOutside(int i, int j, const Vec2& direction, const SpoilMix& spoil,
                         Columns* ground) const {
  constexpr double kStep = 0.7;  // in columns: skips none
  double x = i, y = j;
  while (InFootprint(static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y)))) {
    x += kStep * direction.x();
    y += kStep * direction.y();
  }
  ground->DepositAt(static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y)), spoil);
}

void Digging::CutFootprint(const BodyState& body, double dt_s, Columns* ground, Wrench* wrench) {
  const Mat3& R_WB = body.X_WB.linear();
  const Vec3 mouth_W = R_WB * shape_.mouth_normal_B();
  const bool carries = shovel_.capacity_m3 > 0;
  for (const Swept& swept : footprint_) {
    const ColumnId k = ground->Touch(swept.i, swept.j);
    const SoilType& soil = soils_[ground->soil_at(k)];
    const double top_m = ground->at(k).top_m;
    const double overlap_m = top_m - swept.crossing.low_m;
    const Vec3 p_W(ground->x_m(swept.i), ground->y_m(swept.j), swept.crossing.low_m);
    const Vec3 v_W = body.v_WB_mps + body.w_WB_radps.cross(p_W - body.X_WB.translation());
    const Vec3 n_W = R_WB * swept.crossing.low_normal_B;
    const bool open = carries && swept.crossing.through_mouth;
    const bool bears = !open && n_W.z() < -kLeastDownward;
    const bool mouth_first = carries && (open || v_W.dot(mouth_W) > 0);

    // The shell's own advance into the column, and what it may indent elastically.
    const double v_in_mps = v_W.dot(n_W);
    const double advance_m = bears ? std::max(0.0, v_in_mps) / -n_W.z() * dt_s : 0.0;
    const bool shell_contact =
        bears && (!mouth_first || overlap_m <= kElasticDepth_m + 2 * advance_m);
    double keep_m = 0;
    if (shell_contact) {
      keep_m = std::min(overlap_m, kElasticDepth_m);
      const double bearing_pa = BearingPressure_pa(soil, kShellWidth_m, 0);
      const double elastic_pa = bearing_pa * keep_m / kElasticDepth_m;
      const double damping =
          2 * kShellDampingRatio *
          std::sqrt(bearing_pa / kElasticDepth_m * elastic_pa / kStandardGravity_mps2);
      const double pressure_pa =
          elastic_pa + std::clamp(damping * v_in_mps, -elastic_pa, 0.5 * elastic_pa);
      const double normal_n = pressure_pa * ground->area_m2() / -n_W.z();
      const Vec3 slide_W = v_W - v_in_mps * n_W;
      const Vec3 friction_W = -std::tan(soil.soil_tool_friction_rad) * normal_n * slide_W /
                              std::max(slide_W.norm(), kSlideSpeed_mps);
      wrench->AddForceAt(-normal_n * n_W + friction_W, p_W, body.X_WB.translation());
    }
    if (overlap_m <= keep_m) continue;
    SpoilMix cut;
    ground->Cut(k, swept.crossing.low_m + keep_m, &cut);
    if (mouth_first && !shell_contact) {
      carried_.Add(cut);
      continue;
    }
    Vec2 direction = v_W.head<2>();
    if (direction.norm() < 0.5 * std::abs(v_W.z()) || direction.norm() < kLeastSpeed_mps) {
      // Pressed down: to the nearer side of the shovel.
      const Vec3 side_W =
          R_WB.col(1) *
          ((R_WB.transpose() * (p_W - body.X_WB.translation())).y() >= 0 ? 1.0 : -1.0);
      direction = side_W.head<2>();
      if (direction.norm() < kLeastSpeed_mps) direction = Vec2::UnitX();
    }
    PutOutside(swept.i, swept.j, direction.normalized(), cut, ground);
  }
}

void Digging::Spill(const BodyState& body, double dt_s, Columns* ground, Grains* grains) {
  if (carried_.empty()) return;
  const Vec3 up_B = body.X_WB.linear().transpose().col(2);
  const double repose_rad = ground->soils()[carried_.main_soil()].repose_angle_rad;
  const Vec3 lip_B = shape_.LowerLip_B(up_B);
  const Vec3 mouth_W = body.X_WB.linear() * shape_.mouth_normal_B();
  const Vec2 mouth = mouth_W.head<2>();
  const Vec2 out = mouth.norm() > kLeastSpeed_mps ? Vec2(mouth.normalized()) : Vec2::UnitX();
  const double carried_m3 = carried_.volume_m3();
  double holds_m3 = shape_.HoldFor(up_B, repose_rad, carried_m3).volume_m3;
  // Ground that stands before the mouth keeps soil in.
  const Vec3 lip_W = body.X_WB * lip_B;
  const Vec2 before_lip = lip_W.head<2>() + kBeforeLip_cells * ground->cell_m() * out;
  if (mouth_W.z() > kMouthDown &&
      ground->HeightAt(before_lip.x(), before_lip.y()) > lip_W.z() + kShut_m) {
    holds_m3 = std::max(holds_m3, shovel_.capacity_m3);
  }
  const double excess_m3 = carried_m3 - holds_m3;
  if (excess_m3 <= 0) {
    spilling_m3_ = 0;
    return;
  }
  // In whole clods, and the last of it at once.
  spilling_m3_ += excess_m3 * Clamp01(dt_s / kSpillTime_s);
  const double clod_m3 = grains->clod_m3();
  if (spilling_m3_ < clod_m3 && carried_m3 > clod_m3) return;
  const bool last = carried_m3 - spilling_m3_ < clod_m3 && holds_m3 < clod_m3;
  const double leaves_m3 = last ? carried_m3 : std::min(spilling_m3_, excess_m3);
  spilling_m3_ = 0;
  // Just beyond the lip, anywhere over the shovel's width.
  const Vec3 out_W = ground->cell_m() * Vec3(out.x(), out.y(), 0);
  const double half_m = 0.5 * shovel_.width_m;
  grains->Pour(carried_.Take(last ? 1.0 : leaves_m3 / carried_m3),
               body.X_WB * Vec3(lip_B.x(), -half_m, lip_B.z()) + out_W,
               body.X_WB * Vec3(lip_B.x(), half_m, lip_B.z()) + out_W, PointVelocity(body, lip_B),
               ground);
}

/// A part of the edge's width, and the ground that it cuts.
struct Digging::Strip {
  Vec3 p_W;
  double depth_m, slope_rad;
  const SoilType* soil;
};

/// Horizontal direction in which the edge cuts: along the ground in the plane of the cross-section,
/// mouth first. Nothing where that plane lies level.
std::optional<Vec3> Digging::CutDirection(const Mat3& R_WB) const {
  const auto level = [](const Vec3& v) { return Vec3(v - v.z() * Vec3::UnitZ()); };
  Vec3 travel_W = level(R_WB * shape_.mouth_normal_B());
  if (travel_W.norm() < kLeastLevelMouth) travel_W = level(R_WB * shape_.edge_direction_B());
  if (travel_W.norm() < kLeastLevel) return std::nullopt;
  return travel_W.normalized();
}

std::array<Digging::Strip, Digging::kStrips> Digging::Strips(const BodyState& body,
                                                             const Vec3& travel_W,
                                                             const Columns& ground) const {
  std::array<Strip, kStrips> strips;
  const double near_m = kNearAhead_cells * ground.cell_m();
  for (int s = 0; s < kStrips; ++s) {
    const double y_m = ((s + 0.5) / kStrips - 0.5) * shovel_.width_m;
    Strip& strip = strips[s];
    strip.p_W = body.X_WB * (shape_.edge_B() + Vec3(0, y_m, 0));
    const Vec2 near = (strip.p_W + near_m * travel_W).head<2>();
    const Vec2 far = (strip.p_W + kLookAhead_m * travel_W).head<2>();
    const double z_near = ground.HeightAt(near.x(), near.y());
    const double z_far = ground.HeightAt(far.x(), far.y());
    strip.slope_rad = std::clamp(std::atan2(z_far - z_near, kLookAhead_m - near_m),
                                 -kSteepestSlope_rad, kSteepestSlope_rad);
    strip.depth_m = std::clamp(z_near - strip.p_W.z(), 0.0, shape_.radius_m());
    const int i = std::clamp(ground.NearestI(near.x()), 0, ground.nx() - 1);
    const int j = std::clamp(ground.NearestJ(near.y()), 0, ground.ny() - 1);
    strip.soil = &soils_[ground.SoilAt(i, j)];
  }
  return strips;
}

/// Force of the ground that a strip cuts, when it has failed. `floor_W` points from the edge up the
/// floor.
Vec3 Digging::CuttingForceOn(const Strip& strip, const Vec3& travel_W, const Vec3& floor_W,
                             double speed_mps) const {
  const SoilType& soil = *strip.soil;
  // Rake in the ground's own slope.
  const Vec3 along_W =
      std::cos(strip.slope_rad) * travel_W + std::sin(strip.slope_rad) * Vec3::UnitZ();
  const Vec3 up_W =
      std::cos(strip.slope_rad) * Vec3::UnitZ() - std::sin(strip.slope_rad) * travel_W;
  CuttingInput in;
  in.width_m = shovel_.width_m / kStrips;
  in.depth_m = strip.depth_m * std::cos(strip.slope_rad);
  in.rake_rad = std::atan2(floor_W.dot(up_W), -floor_W.dot(along_W));
  in.density_kgpm3 = soil.bank_density_kgpm3;
  in.friction_rad = soil.friction_angle_rad;
  in.tool_friction_rad = soil.soil_tool_friction_rad;
  in.cohesion_pa = soil.cohesion_pa;
  in.adhesion_pa = soil.adhesion_pa;
  in.speed_mps = std::max(0.0, speed_mps);
  in.flank_share = 1.0 / kStrips;
  if (in.rake_rad < 0) in.rake_rad = 0;
  CuttingForce cut = Cut(in);
  if (shovel_.capacity_m3 > 0 && cut.wedge_length_m > 0) {
    // Carried soil rests on the wedge with the share of its length that lies over it.
    const double load_npm = carried_.mass_kg() * kStandardGravity_mps2 / shovel_.width_m;
    in.surcharge_pa = load_npm / std::max(cut.wedge_length_m, shape_.radius_m());
    cut = Cut(in);
  }
  return -(cut.draft_n * along_W + cut.vertical_n * up_W);
}

/// Resistance of a strip's ground to being pierced along the floor.
double Digging::PiercingForceOn_n(const Strip& strip, double sine_down) const {
  // The profile ends at the tips of the teeth, where there are any; the edge stands behind them.
  const double edge_area_m2 = shovel_.width_m * kEdgeThickness_m;
  const double tooth_area_m2 = shovel_.teeth * kToothWidth_m * kToothThickness_m;
  const double edge_behind_m =
      shovel_.teeth > 0 ? shovel_.tooth_length_m * std::max(0.0, sine_down) : 0.0;
  return (tooth_area_m2 * PiercePressure_pa(*strip.soil, strip.depth_m) +
          edge_area_m2 * PiercePressure_pa(*strip.soil, strip.depth_m - edge_behind_m)) /
         kStrips;
}

Wrench Digging::EdgeForce(const BodyState& body, double dt_s, const Columns& ground) {
  Wrench wrench;
  const Mat3& R_WB = body.X_WB.linear();
  const std::optional<Vec3> travel_W = CutDirection(R_WB);
  if (!travel_W) return wrench;
  const std::array<Strip, kStrips> strips = Strips(body, *travel_W, ground);
  if (std::none_of(strips.begin(), strips.end(), [](const Strip& s) { return s.depth_m > 0; })) {
    cut_travel_m_ = pierce_travel_m_ = 0;
    return wrench;
  }
  const Vec3 v_W = PointVelocity(body, shape_.edge_B());
  const Vec3 cut_dir_W = R_WB * shape_.edge_direction_B();
  const double v_cut_mps = v_W.dot(*travel_W), v_pierce_mps = v_W.dot(cut_dir_W);
  cut_travel_m_ = std::clamp(cut_travel_m_ + v_cut_mps * dt_s, 0.0, kElasticTravel_m);
  pierce_travel_m_ = std::clamp(pierce_travel_m_ + v_pierce_mps * dt_s, 0.0, kElasticTravel_m);
  const double cut_share = cut_travel_m_ / kElasticTravel_m;
  const double pierce_share = pierce_travel_m_ / kElasticTravel_m;
  for (const Strip& strip : strips) {
    if (strip.depth_m <= 0) continue;
    const Vec3 cut_W_n = cut_share * CuttingForceOn(strip, *travel_W, -cut_dir_W, v_cut_mps);
    const double pierce_n = pierce_share * PiercingForceOn_n(strip, -cut_dir_W.z());
    wrench.AddForceAt(cut_W_n - pierce_n * cut_dir_W, strip.p_W, body.X_WB.translation());
  }
  // The ground never drives the edge on.
  const double power_w = wrench.force_W_n.dot(v_W);
  const double v2 = v_W.squaredNorm();
  if (power_w > 0 && v2 > kLeastSpeed_mps * kLeastSpeed_mps) {
    const Vec3 excess_W = power_w / v2 * v_W;
    wrench.AddForceAt(-excess_W, body.X_WB * shape_.edge_B(), body.X_WB.translation());
  }
  return wrench;
}

Digging::Result Digging::Act(const BodyState& body, double dt_s, Columns* ground, Grains* grains) {
  Result result;
  FindFootprint(body, ground);
  result.wrench = EdgeForce(body, dt_s, *ground);
  CutFootprint(body, dt_s, ground, &result.wrench);
  Spill(body, dt_s, ground, grains);
  if (!carried_.empty()) {
    const Vec3 up_B = body.X_WB.linear().transpose().col(2);
    const double repose_rad = ground->soils()[carried_.main_soil()].repose_angle_rad;
    const double volume_m3 = carried_.volume_m3();
    result.load = {carried_.mass_kg(), shape_.HoldFor(up_B, repose_rad, volume_m3).com_B_m,
                   volume_m3};
  }
  return result;
}

}  // namespace tera
