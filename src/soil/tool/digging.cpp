#include "soil/tool/digging.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/units.h"
#include "soil/columns/soil_type.h"
#include "soil/tool/contact_probe.h"

namespace tera {
namespace {

// Constants of the shell on the ground.
constexpr double kElasticDepth_m = 0.01;  ///< indentation at which the bearing pressure is reached
constexpr double kShellWidth_m = 0.10;    ///< width of the loaded strip for the bearing pressure
constexpr double kLeastDownward = 0.35;  ///< a shell that faces down less than this carries nothing
constexpr double kFaceDownward = 0.7;    ///< the same for the face of a blade
/// share of critical damping, for the mass that the pressure supports
constexpr double kShellDampingRatio = 0.2;
constexpr double kSlideSpeed_mps = 0.10;  ///< shell friction is proportional to speed below it
constexpr double kBeside_m = 0.1;  ///< distance at which the ground beside the shovel is sampled
constexpr double kNear_m = 0.3;    ///< a shovel within this height above the ground blocks flow
// Constants of the carried soil.
constexpr double kSpillTime_s = 0.25;   ///< time constant at which excess soil leaves
constexpr double kStuckClod_m = 0.025;  ///< thickest layer that sticks to the shell (an estimate)
constexpr double kBeforeLip_m = 0.1;  ///< distance at which the ground before the mouth is sampled
constexpr double kShut_m = 0.05;      ///< ground this far above the lip shuts the mouth
constexpr double kMouthDown = -0.7;   ///< z component below which a mouth faces down
constexpr double kGravityTime_s = 0.2;  ///< time constant of the smoothing of apparent gravity
constexpr double kMostGravity_mps2 = 3 * kStandardGravity_mps2;  ///< greater values are impacts
constexpr double kLeastSine = 1e-4;  ///< least sine of an angle that has a direction

constexpr double kBeyond_m = 1e-9;  ///< margin around the shovel's outline

double Clamp01(double x) { return std::clamp(x, 0.0, 1.0); }

}  // namespace

Vec2 Digging::Level(const Vec3& v_W) {
  const Vec2 level = v_W.head<2>();
  return level.norm() > kLeastSpeed_mps ? Vec2(level.normalized()) : Vec2(Vec2::UnitX());
}

Digging::Digging(const Shovel& shovel, std::vector<SoilType> soils)
    : shovel_(shovel),
      shape_(shovel),
      edge_(shovel, soils),
      walls_(shovel, soils),
      soils_(std::move(soils)) {
  for (SoilType soil : soils_) {
    heaped_m3_ = std::max(heaped_m3_,
                          shape_.HoldFor(shape_.LevelUp_B(), soil.repose_angle_rad, 0).volume_m3);
    bearing_.push_back(BearingOf(soil));
    soil.cohesion_pa = 0;
    bearing_loose_.push_back(BearingOf(soil));
  }
}

Digging::Bearing Digging::BearingOf(const SoilType& soil) const {
  const double at_surface_pa = BearingPressure_pa(soil, kShellWidth_m, 0);
  return {at_surface_pa, BearingPressure_pa(soil, kShellWidth_m, 1) - at_surface_pa};
}

/// Vector in B's x-z plane by which the shell extends to its back: one horizontal cell against the
/// mouth's direction. It keeps soil from slipping between two columns.
Vec2 Digging::ShellThickness_B(const BodyState& body, double cell_m) const {
  Vec3 behind_W = -(body.X_WB.linear() * shape_.mouth_normal_B());
  behind_W.z() = 0;
  const Vec3 behind_B = body.X_WB.linear().transpose() * behind_W;
  const Vec2 in_section(behind_B.x(), behind_B.z());
  return cell_m / std::max(in_section.norm(), kLeastSpeed_mps) * behind_W.norm() * in_section;
}

/// Sets the mask to the rectangle of columns around the shovel, all marked kOutside.
void Digging::FrameMask(const BodyState& body, double behind_m, const Columns& ground) {
  const double half_m = 0.5 * shovel_.width_m;
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Vec2& p : shovel_.profile_B_m) {
    for (const double y : {-half_m, half_m}) {
      const Vec3 p_W = body.X_WB * Vec3(p.x(), y, p.y());
      low = low.cwiseMin(p_W);
      high = high.cwiseMax(p_W);
    }
  }
  lowest_m_ = low.z();
  highest_m_ = high.z();
  std::swap(mask_, mask_before_);
  mask_.i0 = std::max(0, ground.NearestI(low.x() - behind_m));
  mask_.j0 = std::max(0, ground.NearestJ(low.y() - behind_m));
  mask_.i1 = std::min(ground.nx() - 1, ground.NearestI(high.x() + behind_m));
  mask_.j1 = std::min(ground.ny() - 1, ground.NearestJ(high.y() + behind_m));
  mask_.part.assign(static_cast<std::size_t>(std::max(0, mask_.i1 - mask_.i0 + 1)) *
                        std::max(0, mask_.j1 - mask_.j0 + 1),
                    kOutside);
}

/// Crossing of a vertical line with the shell, for lines that miss the inside of the shovel.
std::optional<ShovelShape::Crossing> Digging::CrossingOfShell(const ShovelShape::Upright& line,
                                                              const Vec2& behind_B) const {
  const auto low_m = shape_.LowestOfShell(line, behind_B);
  if (!low_m) return std::nullopt;
  return ShovelShape::Crossing{.low_m = *low_m,
                               .high_m = *low_m,
                               .through_mouth = true,
                               .low_normal_B = shape_.mouth_normal_B()};
}

/// Finds the columns in which the shovel or its shell stands and blocks them. The footprint lists
/// those whose soil overlaps the shovel or the path of its edge in this step.
void Digging::FindFootprint(const BodyState& body, double dt_s, Columns* ground) {
  const std::vector<ColumnId> before = std::exchange(blocked_, {});
  footprint_.clear();
  const Vec2 behind_B = ShellThickness_B(body, ground->cell_m());
  const Vec3 v_B = body.X_WB.linear().transpose() * PointVelocity(body, shape_.edge_B());
  const Vec2 came_B = -dt_s * Vec2(v_B.x(), v_B.z());
  FrameMask(body, behind_B.norm(), *ground);
  const bool is_far =
      ground->IsAllBelow({mask_.i0, mask_.j0, mask_.i1, mask_.j1}, lowest_m_ - kNear_m);
  const ShovelShape::Uprights uprights(shape_, body.X_WB);
  const ShovelShape::LevelExtent extent = shape_.ExtentAcross(body.X_WB.linear().row(2));
  const double beyond_m =
      kBeyond_m + std::abs(behind_B.dot(extent.right)) + std::abs(came_B.dot(extent.right));
  for (int j = mask_.j0; j <= mask_.j1 && !is_far; ++j) {
    for (int i = mask_.i0; i <= mask_.i1; ++i) {
      ColumnId k = ground->IdAt(i, j);
      const double top_m = k != Columns::kNone ? ground->skin(k).top_m : ground->TopAt(i, j);
      if (top_m + kNear_m <= lowest_m_) continue;
      const ShovelShape::Upright line = uprights.At(ground->x_m(i), ground->y_m(j));
      const double at_m = Vec2(line.o_B.x(), line.o_B.z()).dot(extent.right);
      if (line.is_beside() || at_m < extent.from_m - beyond_m || at_m > extent.to_m + beyond_m) {
        continue;
      }
      auto crossing = shape_.VerticalCrossing(line);
      const Part part = crossing ? kInside : kInShell;
      if (!crossing) crossing = CrossingOfShell(line, behind_B);
      if (!crossing) continue;
      mask_.part[mask_.Index(i, j)] = part;
      const auto cut_m = shape_.HeightOfPassedEdge(line, came_B);
      crossing->low_m = std::min(crossing->low_m, cut_m.value_or(crossing->low_m));
      if (k == Columns::kNone) k = ground->Touch(i, j);
      ground->Block(k, crossing->low_m);
      blocked_.push_back(k);
      const bool sweeps = part == kInside || mask_before_.At(i, j) == kInside;
      if (sweeps && top_m > crossing->low_m) footprint_.push_back({i, j, *crossing});
    }
  }
  for (const ColumnId k : before) {
    const auto [i, j] = ground->PlaceOf(k);
    if (!InFootprint(i, j)) ground->Unblock(k);
  }
}

/// Mean height of the ground on the lowest of the four sides. The ground yields to that side.
double Digging::LowestBeside_m(const BodyState& body, const Columns& ground) const {
  // positions along a side, over its length
  constexpr std::array<double, 3> kAt = {-0.4, 0.0, 0.4};
  const Vec3 up_B = body.X_WB.linear().transpose() * Vec3::UnitZ();
  const ShovelShape::LevelExtent extent = shape_.ExtentAcross(up_B);
  const double off_m = ContactProbeDistance_m(kBeside_m, ground.cell_m());
  const double half_x = 0.5 * (extent.to_m - extent.from_m), half_y = 0.5 * shovel_.width_m;
  const auto surface_m = [&](double x, double y) {  // x and y from the middle of the shovel
    const Vec2 p = (extent.from_m + half_x + x) * extent.right;
    const Vec3 p_W = body.X_WB * Vec3(p.x(), y, p.y());
    return ground.HeightAt(p_W.x(), p_W.y());
  };
  double lowest_m = std::numeric_limits<double>::infinity();
  for (const double side : {-1.0, 1.0}) {
    double across_m = 0, along_m = 0;
    for (const double at : kAt) {
      across_m += surface_m(side * (half_x + off_m), at * 2 * half_y) / kAt.size();
      along_m += surface_m(at * 2 * half_x, side * (half_y + off_m)) / kAt.size();
    }
    lowest_m = std::min({lowest_m, across_m, along_m});
  }
  return lowest_m;
}

/// True if the shell rests on the ground in a column. The column then keeps `keep_m` of soil above
/// the shell's lowest point.
bool Digging::PressShell(const BodyState& body, const Swept& swept, double dt_s, bool may_enter,
                         Columns* ground, double* keep_m, Wrench* wrench) const {
  const Vec3 n_W = body.X_WB.linear() * swept.crossing.low_normal_B;
  // Until the face of a blade lies on the ground, only the edge force acts on it.
  const bool is_face = swept.crossing.through_mouth && shovel_.capacity_m3 <= 0;
  if (n_W.z() >= -(is_face ? kFaceDownward : kLeastDownward)) return false;
  const ColumnId k = ground->Touch(swept.i, swept.j);
  const double overlap_m = ground->at(k).top_m - swept.crossing.low_m;
  const Vec3 p_W(ground->x_m(swept.i), ground->y_m(swept.j), swept.crossing.low_m);
  const Vec3 v_W = body.v_WB_mps + body.w_WB_radps.cross(p_W - body.X_WB.translation());
  // Advance of the shell into the column in this step. With a larger overlap, the shell has met the
  // soil from ahead and does not rest on it.
  const double v_in_mps = v_W.dot(n_W);
  const double advance_m = std::max(0.0, v_in_mps) / -n_W.z() * dt_s;
  const bool comes_from_ahead = may_enter || v_in_mps < 0;
  if (comes_from_ahead && overlap_m > kElasticDepth_m + 2 * advance_m) return false;
  *keep_m = std::min(overlap_m, kElasticDepth_m);
  const std::uint8_t soil = ground->soil_at(k);
  const double bearing_pa = (ground->at(k).is_loose() ? bearing_loose_ : bearing_)[soil].At_pa(
      std::max(0.0, beside_m_ - swept.crossing.low_m));
  const double elastic_pa = bearing_pa * *keep_m / kElasticDepth_m;
  const double damping =
      2 * kShellDampingRatio *
      std::sqrt(bearing_pa / kElasticDepth_m * elastic_pa / kStandardGravity_mps2);
  const double pressure_pa =
      elastic_pa + std::clamp(damping * v_in_mps, -elastic_pa, 0.5 * elastic_pa);
  const double normal_n = pressure_pa * ground->area_m2() / -n_W.z();
  const Vec3 slide_W = v_W - v_in_mps * n_W;
  const bool on_soil = swept.crossing.through_mouth && shovel_.capacity_m3 > 0;
  const double friction_rad =
      on_soil ? soils_[soil].friction_angle_rad : soils_[soil].soil_tool_friction_rad;
  const Vec3 friction_W =
      -std::tan(friction_rad) * normal_n * slide_W / std::max(slide_W.norm(), kSlideSpeed_mps);
  wrench->AddForceAt(-normal_n * n_W + friction_W, p_W, body.X_WB.translation());
  return true;
}

void Digging::CutFootprint(const BodyState& body, double dt_s, Columns* ground, Wrench* wrench) {
  const Vec3 mouth_W = body.X_WB.linear() * shape_.mouth_normal_B();
  const bool carries = shovel_.capacity_m3 > 0;
  double room_m3 = heaped_m3_ - carried_.volume_m3();
  if (!footprint_.empty()) beside_m_ = LowestBeside_m(body, *ground);
  for (const Swept& swept : footprint_) {
    const ColumnId k = ground->Touch(swept.i, swept.j);
    const Vec3 p_W(ground->x_m(swept.i), ground->y_m(swept.j), swept.crossing.low_m);
    const Vec3 v_W = body.v_WB_mps + body.w_WB_radps.cross(p_W - body.X_WB.translation());
    const bool open = carries && swept.crossing.through_mouth;
    const bool enters = carries && (open || v_W.dot(mouth_W) > 0);
    double keep_m = 0;
    const bool is_full = open && room_m3 <= 0;
    const bool bears = (!open || is_full) &&
                       PressShell(body, swept, dt_s, enters && !is_full, ground, &keep_m, wrench);
    if (ground->at(k).top_m - swept.crossing.low_m <= keep_m) continue;
    const bool takes_in = enters && !bears && room_m3 > 0;
    if (carries && !takes_in && MovesAlong(v_W)) LetPassOver(swept, v_W, ground);
    SpoilMix cut;
    ground->Cut(k, swept.crossing.low_m + keep_m, &cut);
    if (takes_in) {
      room_m3 -= cut.volume_m3();
      carried_.Add(cut);
    } else {
      PutOutside(body, swept, WayOut(body, p_W, v_W), &cut, ground);
    }
  }
}

/// Low-pass filter of apparent gravity at the edge, with impacts limited.
void Digging::FilterApparentGravity(const BodyState& body, double dt_s) {
  const Vec3 r_W = body.X_WB.linear() * shape_.edge_B();
  const Vec3& w = body.w_WB_radps;
  Vec3 up_W = body.a_WB_mps2 + body.alpha_WB_radps2.cross(r_W) + w.cross(w.cross(r_W)) +
              kStandardGravity_mps2 * Vec3::UnitZ();
  up_W *= std::min(1.0, kMostGravity_mps2 / std::max(up_W.norm(), kLeastSpeed_mps));
  up_W_mps2_ += Clamp01(dt_s / kGravityTime_s) * (up_W - up_W_mps2_);
}

/// True if ground in front of the mouth holds the soil in. A mouth that faces down rests on the
/// ground.
bool Digging::IsShut(const BodyState& body, const Columns& ground) const {
  const Vec3 mouth_W = body.X_WB.linear() * shape_.mouth_normal_B();
  const Vec3 edge_W = body.X_WB * shape_.edge_B(), top_W = body.X_WB * shape_.top_edge_B();
  if (mouth_W.z() < kMouthDown) {
    const Vec3 middle_W = 0.5 * (edge_W + top_W);
    return ground.HeightAt(middle_W.x(), middle_W.y()) > middle_W.z() - kShut_m;
  }
  const Vec3& lip_W = edge_W.z() < top_W.z() ? edge_W : top_W;
  const Vec2 before_lip =
      lip_W.head<2>() + ContactProbeDistance_m(kBeforeLip_m, ground.cell_m()) * Level(mouth_W);
  return ground.HeightAt(before_lip.x(), before_lip.y()) > lip_W.z() + kShut_m;
}

ShovelShape::Hold Digging::HoldOf(const Vec3& up_B) const {
  if (carried_.empty()) return {};
  return shape_.HoldFor(up_B, soils_[carried_.main_soil()].repose_angle_rad, carried_.volume_m3(),
                        surface_up_B_);
}

/// Volume that stays in the shovel; `heap_m3` is the part that gravity and repose hold.
double Digging::Holds_m3(double heap_m3) const {
  const SoilType& soil = soils_[carried_.main_soil()];
  const double weight_npm3 = kStandardGravity_mps2 * carried_.mass_kg() / carried_.volume_m3();
  // Dug clods do not stick together: only those at the shell adhere.
  const double layer_m =
      std::min(std::min(soil.adhesion_pa, soil.cohesion_pa) / weight_npm3, kStuckClod_m);
  const double touched = Clamp01(fullest_m3_ / shovel_.capacity_m3);
  return std::max(heap_m3, std::min(layer_m * shape_.inside_m2() * touched, shovel_.capacity_m3));
}

/// Turns the surface of the load. It turns with the shovel until it reaches repose, then slides.
/// Incoming soil lies level.
void Digging::Settle(const Vec3& up_B) {
  const double carried_m3 = carried_.volume_m3();
  if (carried_.empty()) return;
  const double came = Clamp01((carried_m3 - lies_m3_) / carried_m3);
  surface_up_B_ = ((1 - came) * surface_up_B_ + came * up_B).normalized();
  const double repose_rad = soils_[carried_.main_soil()].repose_angle_rad;
  if (surface_up_B_.dot(up_B) >= std::cos(repose_rad)) return;
  const Vec3 down_B = surface_up_B_ - surface_up_B_.dot(up_B) * up_B;
  surface_up_B_ =
      down_B.norm() > kLeastSine
          ? Vec3(std::cos(repose_rad) * up_B + std::sin(repose_rad) * down_B.normalized())
          : up_B;
}

/// Soil falls through the gaps between the teeth in turn. The outer teeth are flush with the side
/// walls.
Digging::Gap Digging::NextGap(bool over_the_edge) {
  const double half_m = 0.5 * shovel_.width_m;
  if (!over_the_edge || shovel_.teeth < 2) return {-half_m, half_m};
  const int gaps = shovel_.teeth - 1;
  const double pitch_m = (shovel_.width_m - shovel_.tooth_width_m) / gaps;
  const double tooth_m = -half_m + pitch_m * static_cast<double>(spilt_++ % gaps);
  return {tooth_m + shovel_.tooth_width_m, tooth_m + pitch_m};
}

void Digging::Spill(const BodyState& body, const Vec3& up_B, double heap_m3, double dt_s,
                    Columns* ground, Grains* grains) {
  const double carried_m3 = carried_.volume_m3();
  fullest_m3_ = carried_.empty() ? 0 : std::max(fullest_m3_, carried_m3);
  if (carried_.empty()) return;
  const Mat3& R_WB = body.X_WB.linear();
  const Vec3 lip_B = shape_.LowerLip_B(up_B);
  const double holds_m3 = IsShut(body, *ground) ? carried_m3 : Holds_m3(heap_m3);
  const double excess_m3 = carried_m3 - holds_m3;
  if (excess_m3 <= 0) {
    spilling_m3_ = 0;
    return;
  }
  // Soil leaves in whole clods; the last clod leaves at once.
  spilling_m3_ += excess_m3 * Clamp01(dt_s / kSpillTime_s);
  const double clod_m3 = grains->clod_m3();
  if (spilling_m3_ < clod_m3 && carried_m3 > clod_m3) return;
  const bool last = carried_m3 - spilling_m3_ < clod_m3 && holds_m3 < clod_m3;
  const double leaves_m3 = last ? carried_m3 : std::min(spilling_m3_, excess_m3);
  spilling_m3_ = 0;
  // One cell beyond the lip.
  const Vec2 out = Level(R_WB * shape_.mouth_normal_B());
  const Vec3 out_W = ground->cell_m() * Vec3(out.x(), out.y(), 0);
  const Gap gap = NextGap(shape_.IsOverEdge(up_B));
  grains->Pour(carried_.Take(last ? 1.0 : leaves_m3 / carried_m3),
               body.X_WB * Vec3(lip_B.x(), gap.from_m, lip_B.z()) + out_W,
               body.X_WB * Vec3(lip_B.x(), gap.to_m, lip_B.z()) + out_W, PointVelocity(body, lip_B),
               ground);
}

Digging::Result Digging::Act(const BodyState& body, double dt_s, Columns* ground, Grains* grains) {
  Result result;
  FilterApparentGravity(body, dt_s);
  FindFootprint(body, dt_s, ground);
  result.wrench =
      edge_.Act(shape_, body, {carried_.mass_kg(), carried_.volume_m3(), carried_.main_soil()},
                dt_s, soils_, ground);
  if (footprint_.empty()) {
    walls_.Release();
  } else {
    const Wrench walls = walls_.Act(shape_, body, dt_s, soils_, ground);
    result.wrench.force_W_n += walls.force_W_n;
    result.wrench.torque_W_nm += walls.torque_W_nm;
  }
  CutFootprint(body, dt_s, ground, &result.wrench);
  const Vec3 up_B = (body.X_WB.linear().transpose() * up_W_mps2_).normalized();
  Settle(up_B);
  ShovelShape::Hold heap = HoldOf(up_B);
  const double before_m3 = carried_.volume_m3();
  Spill(body, up_B, heap.volume_m3, dt_s, ground, grains);
  lies_m3_ = carried_.volume_m3();
  if (carried_.volume_m3() != before_m3) heap = HoldOf(up_B);
  result.load.soil_kg.resize(soils_.size());
  if (!carried_.empty()) {
    result.load.mass_kg = carried_.mass_kg();
    result.load.volume_m3 = carried_.volume_m3();
    result.load.com_B_m = heap.com_B_m;
    result.load.surface_up_B = surface_up_B_;
    for (const Spoil& part : carried_.parts()) result.load.soil_kg[part.soil] = part.mass_kg;
  }
  return result;
}

}  // namespace tera
