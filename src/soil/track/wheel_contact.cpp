#include "soil/track/wheel_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/units.h"
#include "soil/track/terramechanics.h"

namespace tera {
namespace {

constexpr double kNodes_rad = 2 * kDeg;
/// least downward component of the normal of a face that touches
constexpr double kLeastDown = 0.05;
constexpr double kMostEntry_rad = 88 * kDeg;
constexpr double kSlowest_mps = 1e-6;

}  // namespace

/// A point of the rim in the ground.
struct WheelContact::Sample {
  double pen_m, sinkage_m;  ///< vertical depth of the rim
  double firmness;
  std::size_t soil;
  Vec3 moving_W_mps;
  bool hard;
};

/// A line across the rim at one angle.
struct WheelContact::Node {
  Rim::Point middle;
  double normal_n = 0, area_m2 = 0;
  /// position and velocity of the ground, times the normal force
  Vec3 moment_W = Vec3::Zero(), moving_W = Vec3::Zero();
  std::size_t soil = 0;
  double sinkage_m = 0;
};

double DepthBeside_m(const PushedFace& face, const Vec3& p_W_m, const Columns& ground) {
  const double depth_m = ground.HeightAt(p_W_m.x(), p_W_m.y()) - p_W_m.z();
  const ColumnId k = ground.IdAt(ground.NearestI(p_W_m.x()), ground.NearestJ(p_W_m.y()));
  return face.Depth_m(depth_m, k == Columns::kNone ? 0 : ground.skin(k).loose_m);
}

WheelContact::WheelContact(const Rim& rim, const RunningGear& gear, bool shears,
                           const std::vector<SoilType>& soils)
    : rim_(rim),
      grouser_m_(gear.grouser_m),
      climb_m_(ClimbHeight_m(gear)),
      shears_(shears),
      soils_(soils) {
  ContactPatch patch;
  patch.length_m = patch.width_m = std::min(rim.width_m, rim.radius_m);
  for (const SoilType& soil : soils) plates_.emplace_back(soil, patch);
  const double range_rad = rim.last_rad - rim.first_rad;
  const auto count = static_cast<std::size_t>(std::ceil(range_rad / kNodes_rad));
  step_rad_ = range_rad / static_cast<double>(count);
  j_m_.assign(count, Vec2::Zero());
}

std::size_t WheelContact::StripAt(double across_m) const {
  const double strips = static_cast<double>(entry_rad_.size());
  return static_cast<std::size_t>(
      std::clamp((across_m / rim_.width_m + 0.5) * strips, 0.0, strips - 1));
}

/// Lets the columns under the rim yield.
void WheelContact::PressRut(const BodyState& body, const LowObstacles& obstacles, Columns* ground,
                            Rut* rut) const {
  const Vec3 axle_W_m = body.X_WB * rim_.axle_B_m;
  const Vec3 ahead_W = body.X_WB.linear().col(0), left_W = body.X_WB.linear().col(1);
  const Vec3 reach = rim_.radius_m * ahead_W.cwiseAbs() + 0.5 * rim_.width_m * left_W.cwiseAbs();
  const int i0 = std::max(0, ground->NearestI(axle_W_m.x() - reach.x()));
  const int i1 = std::min(ground->nx() - 1, ground->NearestI(axle_W_m.x() + reach.x()));
  const int j0 = std::max(0, ground->NearestJ(axle_W_m.y() - reach.y()));
  const int j1 = std::min(ground->ny() - 1, ground->NearestJ(axle_W_m.y() + reach.y()));
  for (int j = j0; j <= j1; ++j) {
    for (int i = i0; i <= i1; ++i) {
      const double x_m = ground->x_m(i), y_m = ground->y_m(j);
      const auto rim = rim_.Above(Vec2(x_m, y_m), body.X_WB);
      if (!rim) continue;
      const double pen_m = ground->TopAt(i, j) - rim->z_m;
      if (pen_m <= 0) continue;
      const Rim::Point at = rim_.At(rim->angle_rad, rim->across_m, body.X_WB);
      if (-at.n_W.z() < kLeastDown) continue;
      const auto obstacle = obstacles.TopAt(x_m, y_m, climb_m_);
      if (obstacle && obstacle->z_m > ground->TopAt(i, j)) continue;
      const ColumnId k = ground->Touch(i, j);
      rut->Cover(k, rim->z_m, ground);
      Sink(k, *rim, -at.n_W.z(), left_W.head<2>(), ground, rut);
    }
  }
}

/// Lets a column yield to the rim above it. `down` is the downward component of the rim's normal.
void WheelContact::Sink(ColumnId k, const Rim::Over& rim, double down, const Vec2& left_W,
                        Columns* ground, Rut* rut) const {
  const Plate& plate = plates_[ground->soil_at(k)];
  const double entry_rad = entry_rad_[StripAt(rim.across_m)];
  const double share =
      rolling_.BearingShare(plate.soil(), grouser_m_, rim_.radius_m * (1 - std::cos(entry_rad)));
  const double pen_m = ground->skin(k).top_m - rim.z_m, pressed_m = ground->skin(k).pressed_m;
  const double bears =
      rolling_.ShareAt({side() * rim.angle_rad, 2 * rim.across_m / rim_.width_m, pressed_m, pen_m},
                       entry_rad, share);
  const double plastic_m = plate.PlasticSinkage_m(down, bears, pressed_m, pen_m);
  if (plastic_m <= 0) return;
  const double pressure_pa = static_cast<double>(ground->skin(k).firmness) *
                             plate.Pressure_pa(bears * (pressed_m + plastic_m));
  const auto [i, j] = ground->PlaceOf(k);
  const double out_m = 0.5 * rim_.width_m + ground->cell_m() - std::abs(rim.across_m);
  const Vec2 out_W = std::copysign(1.0, rim.across_m) * left_W.normalized();
  const Vec2 edge_W_m = Vec2(ground->x_m(i), ground->y_m(j)) + out_m * out_W;
  rut->Lower(k, {plastic_m, rim_.width_m, pressure_pa}, {edge_W_m, out_W, plate.heave_reach_m()},
             ground);
}

/// Angle at which the rim enters the ground. The height of the ground is taken one column ahead of
/// the foremost contact.
double WheelContact::FindEntry_rad(double front_rad, double across_m, const BodyState& body,
                                   const Columns& ground) const {
  const Rim::Point front = rim_.At(side() * front_rad, across_m, body.X_WB);
  const Vec3 up_W = body.X_WB.linear().col(2);
  const Vec3 axle_W_m = rim_.At(0, across_m, body.X_WB).p_W_m + rim_.radius_m * up_W;
  Vec3 q_W = front.p_W_m + side() * ground.cell_m() * body.X_WB.linear().col(0);
  q_W.z() = ground.HeightAt(q_W.x(), q_W.y());
  const double cosine = (axle_W_m - q_W).dot(up_W) / rim_.radius_m;
  return std::acos(std::clamp(cosine, std::cos(kMostEntry_rad), 1.0));
}

std::optional<WheelContact::Sample> WheelContact::SampleAt(const Rim::Point& at,
                                                           const Columns& ground,
                                                           const LowObstacles& obstacles) const {
  if (ground.IsWellAbove(at.p_W_m) && !obstacles.any()) return std::nullopt;
  const Columns::Sample sample = ground.SampleAt(at.p_W_m.x(), at.p_W_m.y());
  const auto obstacle = obstacles.TopAt(at.p_W_m.x(), at.p_W_m.y(), climb_m_);
  const bool hard = obstacle && obstacle->z_m > sample.top_m;
  const double pen_m = (hard ? obstacle->z_m : sample.top_m) - at.p_W_m.z();
  if (pen_m <= 0) return std::nullopt;
  return Sample{pen_m,
                pen_m + (hard ? 0 : sample.pressed_m),
                hard ? 1 : sample.firmness,
                hard ? soils_.size() - 1 : ground.SoilAt(sample),
                hard ? obstacle->v_W_mps : Vec3(Vec3::Zero()),
                hard};
}

/// Normal stress along a line across the rim.
WheelContact::Node WheelContact::Bear(double angle_rad, const BodyState& body,
                                      const Columns& ground, const LowObstacles& obstacles) {
  Node node{.middle = rim_.At(angle_rad, 0, body.X_WB)};
  const double down = -node.middle.n_W.z();
  if (down < kLeastDown) return node;
  const std::size_t strips = entry_rad_.size();
  const double strip_m = rim_.width_m / static_cast<double>(strips);
  const double area_m2 = rim_.radius_m * step_rad_ * strip_m;
  const Vec3 up_W = body.X_WB.linear().col(2), left_W = node.middle.across_W;
  const Vec3 into_W = up_W.dot(node.middle.n_W) * up_W;
  for (std::size_t b = 0; b < strips; ++b) {
    Rim::Point at = node.middle;
    const double across_m = (static_cast<double>(b) + 0.5) * strip_m - 0.5 * rim_.width_m;
    at.p_W_m += across_m * left_W;
    const auto sample = SampleAt(at, ground, obstacles);
    if (!sample) continue;
    front_rad_[b] = std::max(front_rad_[b], side() * angle_rad);
    const Plate& plate = plates_[sample->soil];
    double bears = 1;
    if (!sample->hard) {
      const double entry_rad = entry_rad_[b];
      const double share = rolling_.BearingShare(plate.soil(), grouser_m_,
                                                 rim_.radius_m * (1 - std::cos(entry_rad)));
      bears = rolling_.ShareAt({side() * angle_rad, 2 * across_m / rim_.width_m,
                                sample->sinkage_m - sample->pen_m, sample->pen_m},
                               entry_rad, share);
    }
    const Vec3 v_W = body.v_WB_mps + body.w_WB_radps.cross(at.p_W_m - body.X_WB.translation());
    const double damped_pa =
        sample->firmness *
        plate.DampedPressure_pa(down, sample->pen_m, bears * sample->sinkage_m, v_W.dot(into_W));
    node.normal_n += damped_pa * area_m2;
    node.moment_W += damped_pa * area_m2 * at.p_W_m;
    node.moving_W += damped_pa * area_m2 * sample->moving_W_mps;
    node.area_m2 += area_m2;
    node.soil = sample->soil;
    node.sinkage_m = std::max(node.sinkage_m, sample->sinkage_m);
  }
  return node;
}

/// Adds the forces at node `k` to the sum.
void WheelContact::Shear(std::size_t k, const Node& node, double shoe_mps, double dt_s,
                         const BodyState& body, const std::vector<Vec2>& before_m, GearSum* sum) {
  const Vec3 p_W_m = node.moment_W / node.normal_n, origin_W_m = body.X_WB.translation();
  const Vec3 v_W =
      body.v_WB_mps + body.w_WB_radps.cross(p_W_m - origin_W_m) - node.moving_W / node.normal_n;
  Vec3 force_W_n = -node.normal_n * node.middle.n_W;
  const ShearStrength strength = plates_[node.soil].Strength(node.normal_n, node.area_m2);
  if (shears_) {
    const double moved = std::min(1.0, std::abs(shoe_mps) * dt_s / (rim_.radius_m * step_rad_));
    const std::size_t from = shoe_mps >= 0 ? k + 1 : k - 1;  // wraps below the first node
    const Vec2 entering_m = from < before_m.size() ? before_m[from] : Vec2::Zero();
    Vec2& j_m = j_m_[k];
    j_m += moved * (entering_m - j_m);
    const Vec2 slip_mps(v_W.dot(node.middle.along_W) + shoe_mps, v_W.dot(node.middle.across_W));
    ShearFurther(strength.soil, slip_mps * dt_s, &j_m);
    const Vec2 shear_n =
        ShearForce_n(strength, Mobilised(strength.soil, j_m), j_m.norm(), slip_mps);
    force_W_n += shear_n.x() * node.middle.along_W + shear_n.y() * node.middle.across_W;
    sum->traction_n -= shear_n.x();
  }
  sum->wrench.AddForceAt(force_W_n, p_W_m, origin_W_m);
  sum->grip_n += strength.force_n();
  sum->sinkage_m = std::max(sum->sinkage_m, node.sinkage_m);
  sum->weight_n += node.normal_n;
  sum->forward_w += node.normal_n * v_W.dot(body.X_WB.linear().col(0));
  sum->contact_m += rim_.radius_m * step_rad_;
  aside_mps_ += node.normal_n * v_W.dot(body.X_WB.linear().col(1));  // divided by the weight later
}

/// Passive pressure on the side that is pushed into soil, from the exit of the lifted soil
/// downwards. On average, a point beside the wheel is pushed by half the way: by tan(slip angle)
/// times half the contact length. The pressure has the share sin(slip angle).
void WheelContact::PushAside(const BodyState& body, double dt_s, const Columns& ground,
                             GearSum* sum) {
  const double length_m = std::max(contact_m_, rim_.radius_m * step_rad_);
  if (pushed_m_ * aside_mps_ < 0) pushed_m_ = 0;
  pushed_m_ += aside_mps_ * dt_s;
  pushed_m_ /= 1 + 2 * std::abs(forward_mps_) * dt_s / length_m;
  if (std::abs(pushed_m_) < kSlowest_mps * dt_s || deepest_m_ <= 0) return;
  const double share = pushed_m_ / std::hypot(pushed_m_, 0.5 * length_m);
  const Vec3 left_W = body.X_WB.linear().col(1);
  for (std::size_t k = 0; k < j_m_.size(); ++k) {
    const double angle_rad = rim_.first_rad + (static_cast<double>(k) + 0.5) * step_rad_;
    const double side_m = std::copysign(0.5 * rim_.width_m, share);
    const Rim::Point at = rim_.At(angle_rad, side_m, body.X_WB);
    if (-at.n_W.z() < kLeastDown || ground.IsWellAbove(at.p_W_m)) continue;
    const Columns::Sample below = ground.SampleAt(at.p_W_m.x(), at.p_W_m.y());
    const PushedFace& face = plates_[ground.SoilAt(below)].face();
    const double out_m = ground.cell_m() + face.Wedge_m(deepest_m_);
    const Vec3 out_W = at.p_W_m + std::copysign(out_m, share) * left_W;
    const Vec3 foot_W_m(out_W.x(), out_W.y(), at.p_W_m.z());
    const double depth_m = DepthBeside_m(face, foot_W_m, ground);
    if (depth_m <= 0) continue;
    const double chord_m = rim_.radius_m * step_rad_ * -at.n_W.z();
    sum->wrench.AddForceAt(-share * chord_m * face.Resistance_npm(depth_m) * left_W, at.p_W_m,
                           body.X_WB.translation());
  }
}

GearSum WheelContact::Act(const BodyState& body, double shoe_mps, double dt_s,
                          const LowObstacles& obstacles, Columns* ground, Rut* rut) {
  const auto strips =
      static_cast<std::size_t>(std::max(1.0, std::ceil(rim_.width_m / ground->cell_m())));
  entry_rad_.resize(strips);
  front_rad_.assign(strips, -std::numeric_limits<double>::infinity());
  memory_.Advance(forward_mps_ * dt_s, aside_mps_ * dt_s, shoe_mps * dt_s, contact_m_);
  rolling_ = memory_.State();
  GearSum sum;
  if (shears_) PushAside(body, dt_s, *ground, &sum);
  PressRut(body, obstacles, ground, rut);
  const std::vector<Vec2> before_m = j_m_;
  aside_mps_ = 0;
  for (std::size_t k = 0; k < j_m_.size(); ++k) {
    const double angle_rad = rim_.first_rad + (static_cast<double>(k) + 0.5) * step_rad_;
    const Node node = Bear(angle_rad, body, *ground, obstacles);
    if (node.normal_n > 0) {
      Shear(k, node, shoe_mps, dt_s, body, before_m, &sum);
    } else {
      j_m_[k].setZero();
    }
  }
  for (std::size_t b = 0; b < strips; ++b) {
    const double across_m =
        ((static_cast<double>(b) + 0.5) / static_cast<double>(strips) - 0.5) * rim_.width_m;
    entry_rad_[b] =
        std::isfinite(front_rad_[b]) ? FindEntry_rad(front_rad_[b], across_m, body, *ground) : 0;
  }
  forward_mps_ = sum.weight_n > 0 ? sum.forward_w / sum.weight_n : 0;
  aside_mps_ = sum.weight_n > 0 ? aside_mps_ / sum.weight_n : 0;
  contact_m_ = sum.contact_m;
  deepest_m_ = sum.sinkage_m;
  return sum;
}

}  // namespace tera
