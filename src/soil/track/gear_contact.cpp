#include "soil/track/gear_contact.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/check.h"
#include "core/units.h"
#include "soil/track/rim.h"
#include "soil/track/side_faces.h"
#include "soil/track/terramechanics.h"

namespace tera {
namespace {

constexpr double kLeastUpward = 0.05;  ///< patches that face further up touch no ground
constexpr double kMostUpward = 0.5;    ///< no patch faces further up in the machine's frame
/// Displacement over depth at which a pushed face mobilises 1 - 1/e of its passive pressure. At 6 %
/// it mobilises nearly all. (Clough and Duncan 1991: 1 % in dense sand, 4 % in loose.)
constexpr double kPassiveShare = 0.02;
constexpr double kInletShare = 0.1;      ///< length of the inlet of a patch, over the patch length
constexpr double kDragLength_m = 0.10;   ///< distance over which the drag pays the work on the rut
constexpr double kDragSpeed_mps = 0.05;  ///< below it the drag fades, so that the gear can rest
constexpr double kSlowestShoe_mps = 0.01;  ///< slower shoes have no slip ratio

/// Index of the patch that lies one patch length from patch k, along `direction` x travel; -1 for
/// none.
int Neighbour(const RunningGear& gear, std::size_t k, double direction) {
  const ContactPatch& patch = gear.patches[k];
  const Vec3 wanted = patch.p_B_m + direction * patch.length_m * patch.travel_B;
  int best = -1;
  double nearest_m = 0.6 * patch.length_m;  // a patch farther away is no neighbour
  for (std::size_t m = 0; m < gear.patches.size(); ++m) {
    const double d = (gear.patches[m].p_B_m - wanted).norm();
    if (SideFaces::IsOne(gear.patches[m]) != SideFaces::IsOne(patch)) continue;
    if (m != k && d < nearest_m) {
      nearest_m = d;
      best = static_cast<int>(m);
    }
  }
  return best;
}

/// Velocity of a patch relative to the soil at p_W. The soil yields in the direction half-way
/// between the normal of the patch and the machine's down. So a rolling raised nose causes no
/// shear.
Vec3 OverSoil_mps(const Footprint& foot, const BodyState& body, const Vec3& v_W) {
  const Vec3 yield_W = foot.n_W - body.X_WB.linear().col(2);
  return v_W - v_W.dot(foot.n_W) / yield_W.dot(foot.n_W) * yield_W;
}

/// Share of a patch that touches the ground. A shoe that faces down touches fully; a side face
/// touches in part.
double Touching(const ContactPatch& patch, const Footprint& foot) {
  if (SideFaces::IsOne(patch)) return SideFaces::Bearing(-foot.n_W.z());
  return foot.n_W.z() < -kLeastUpward ? 1 : 0;
}

/// The surface of an obstacle, with the values and sources of config/soils/asphalt.yaml.
SoilType HardSurface() {
  SoilType hard;
  hard.name = "obstacle";
  hard.bank_density_kgpm3 = hard.max_density_kgpm3 = 2400;
  hard.friction_angle_rad = hard.shear_friction_rad = 38.7 * kDeg;
  hard.young_modulus_pa = 2.0e6;
  hard.k_phi_npm_n2 = 1.0e9;
  hard.shear_modulus_m = 0.004;
  return hard;
}

/// The soils of the ground and, as the last one, the material of obstacles.
std::vector<SoilType> WithHardSurface(std::vector<SoilType> soils) {
  soils.push_back(HardSurface());
  return soils;
}

}  // namespace

/// Input of one step.
struct GearContact::Step {
  const BodyState& body;
  double shoe_mps, dt_s;
  double contact_m;                  ///< length of the ground under the gear at the last step
  const std::vector<Patch>& before;  ///< patches at the last step
  Columns* ground;
};

/// Reaction of the ground under one patch.
struct GearContact::Pressed {
  double normal_n = 0;
  double area_m2 = 0;
  double sinkage_m = 0;
  Vec3 moment_W = Vec3::Zero();  ///< sum of normal force times position, for the centre of pressure
  Vec3 moving_W = Vec3::Zero();  ///< sum of normal force times velocity of the obstacle below
  const Plate* plate = nullptr;

  ShearStrength Strength() const { return plate->Strength(normal_n, area_m2); }
};

GearContact::GearContact(const RunningGear& gear, bool shears, std::vector<SoilType> soils)
    : gear_(SideFaces::AddedTo(gear)),
      has_sides_(gear_.patches.size() > gear.patches.size()),
      shears_(shears),
      soils_(WithHardSurface(std::move(soils))),
      patches_(gear_.patches.size()),
      plates_(PlatesOf(gear_, soils_)),
      rut_(gear_, soils_) {
  const GearRims rims = FindRims(gear);
  for (const Rim& rim : rims.rims) wheels_.emplace_back(rim, gear, shears, soils_);
  for (std::size_t k = 0; k < patches_.size(); ++k) {
    patches_[k].is_on_wheel = k < rims.has_patch.size() && rims.has_patch[k];
    TERA_CHECK(gear_.patches[k].outward_B.z() < kMostUpward, gear_.name, k);
    patches_[k].upstream = Neighbour(gear_, k, -1);
    patches_[k].downstream = Neighbour(gear_, k, +1);
  }
}

/// Rows of points across a patch, about one cell apart at most.
const std::vector<GearContact::Row>& GearContact::RowsOf(std::size_t patch_index, double cell_m) {
  rows_.resize(gear_.patches.size());
  std::vector<Row>& rows = rows_[patch_index];
  if (!rows.empty()) return rows;
  const ContactPatch& patch = gear_.patches[patch_index];
  const int count = std::max(1, static_cast<int>(std::ceil(patch.length_m / cell_m)));
  for (int a = 0; a < count; ++a) {
    const double along_m = ((a + 0.5) / count - 0.5) * patch.length_m;
    rows.push_back({along_m, PressureShare(patch, along_m)});
  }
  return rows;
}

/// Pressure on a grid of points of a patch, about one cell apart at most. `touching` is the share
/// of the patch that touches.
GearContact::Pressed GearContact::Bear(std::size_t patch_index, const Footprint& foot,
                                       double touching, const BodyState& body,
                                       const Columns& ground, const LowObstacles& obstacles) {
  const ContactPatch& patch = gear_.patches[patch_index];
  Pressed result;
  const std::vector<Row>& rows = RowsOf(patch_index, ground.cell_m());
  const int n_across = std::max(1, static_cast<int>(std::ceil(patch.width_m / ground.cell_m())));
  const double area_m2 =
      touching * patch.length_m * patch.width_m / (static_cast<double>(rows.size()) * n_across);
  const double middle_m = SideFaces::IsOne(patch) ? SideFaces::Middle_m(patch, touching) : 0;
  // Velocity into the ground along the machine's vertical, or along the normal of a side face. It
  // varies linearly over the patch.
  const Vec3 up_W = SideFaces::IsOne(patch) ? foot.n_W : Vec3(body.X_WB.linear().col(2));
  const Vec3 into_W = up_W.dot(foot.n_W) * up_W;
  const Vec3 v_W = body.v_WB_mps + body.w_WB_radps.cross(foot.p_W_m - body.X_WB.translation());
  const double into_mps = v_W.dot(into_W);
  const double into_along_radps = body.w_WB_radps.cross(foot.along_W).dot(into_W);
  const double into_across_radps = body.w_WB_radps.cross(foot.across_W).dot(into_W);
  const double climb_m = ClimbHeight_m(gear_);
  for (const auto& [along_m, share] : rows) {
    for (int b = 0; b < n_across; ++b) {
      const double across_m = middle_m + ((b + 0.5) / n_across - 0.5) * touching * patch.width_m;
      const Vec3 q_W = foot.p_W_m + along_m * foot.along_W + across_m * foot.across_W;
      const Columns::Sample sample = ground.SampleAt(q_W.x(), q_W.y());
      const auto obstacle = obstacles.TopAt(q_W.x(), q_W.y(), climb_m);
      const bool hard = obstacle && obstacle->z_m > sample.top_m;
      const double pen_m = ((hard ? obstacle->z_m : sample.top_m) - q_W.z()) * -foot.n_W.z();
      if (pen_m <= 0) continue;
      const std::size_t soil = hard ? soils_.size() - 1 : ground.SoilAt(sample);
      const Plate& plate = plates_[patch_index * soils_.size() + soil];
      const double sinkage_m = pen_m + (hard ? 0 : sample.pressed_m);
      const double v_mps = into_mps + along_m * into_along_radps + across_m * into_across_radps;
      const double firmness = hard ? 1 : sample.firmness;
      const double damped_pa = firmness * plate.DampedPressure_pa(share, pen_m, sinkage_m, v_mps);
      result.normal_n += damped_pa * area_m2;
      result.moment_W += damped_pa * area_m2 * q_W;
      if (hard) result.moving_W += damped_pa * area_m2 * obstacle->v_W_mps;
      result.area_m2 += area_m2;
      result.plate = &plate;
      result.sinkage_m = std::max(result.sinkage_m, sinkage_m);
    }
  }
  return result;
}

Vec2 GearContact::Shear(std::size_t k, const Pressed& pressed, const Vec2& slip_mps,
                        const Step& step) {
  Patch& patch = patches_[k];
  const SoilType& soil = pressed.plate->soil();
  const int from = step.shoe_mps >= 0 ? patch.upstream : patch.downstream;
  const Vec2 j_upstream_m =
      from >= 0 && step.before[from].in_contact ? step.before[from].j_out_m : Vec2::Zero();
  const double length_m = gear_.patches[k].length_m;
  const auto advance = [&](Vec2* j_m, double over_m) {
    const double renewed = std::min(1.0, std::abs(step.shoe_mps) * step.dt_s / over_m);
    *j_m -= renewed * (*j_m - j_upstream_m);
    ShearFurther(soil, slip_mps * step.dt_s, j_m);
  };
  advance(&patch.j_in_m, kInletShare * length_m);
  advance(&patch.j_out_m, length_m);
  patch.in_contact = true;
  patch.shear_modulus_m = soil.shear_modulus_m;
  const Vec2 j_m = 0.5 * (patch.j_in_m + patch.j_out_m);
  // Mean over the patch from inlet to outlet, by Simpson's rule.
  const Vec2 share =
      (Mobilised(soil, patch.j_in_m) + 4 * Mobilised(soil, j_m) + Mobilised(soil, patch.j_out_m)) /
      6;
  return ShearForce_n(pressed.Strength(), share, j_m.norm(), slip_mps);
}

/// Lateral force on the side face of a patch that pushes into soil. The passive pressure acts from
/// the exit of the lifted soil downwards, also if the patch itself does not bear. On average, a
/// point beside the gear is pushed by half the displacement. A side that faces down bears by
/// itself.
double GearContact::PushAside_n(std::size_t k, const Footprint& foot, const Step& step) {
  const BodyState& body = step.body;
  const ContactPatch& shape = gear_.patches[k];
  double& pushed_m = patches_[k].pushed_m;
  const Vec3 v_W = body.v_WB_mps + body.w_WB_radps.cross(foot.p_W_m - body.X_WB.translation());
  const double across_mps = v_W.dot(foot.across_W);
  if (pushed_m * across_mps < 0) pushed_m = 0;
  pushed_m += across_mps * step.dt_s;
  pushed_m /= 1 + 2 * std::abs(forward_mps_) * step.dt_s / std::max(step.contact_m, shape.length_m);
  if (pushed_m == 0 || deepest_m_ <= 0) return 0;
  const auto [i, j] =
      std::pair(step.ground->NearestI(foot.p_W_m.x()), step.ground->NearestJ(foot.p_W_m.y()));
  const PushedFace& face = plates_[k * soils_.size() + step.ground->SoilAt(i, j)].face();
  const double out_m = 0.5 * shape.width_m + step.ground->cell_m() + face.Wedge_m(deepest_m_);
  const Vec3 out_W = foot.p_W_m + std::copysign(out_m, pushed_m) * foot.across_W;
  const double depth_m = DepthBeside_m(face, out_W, *step.ground);
  if (depth_m <= 0) return 0;
  const double share = -std::expm1(-std::abs(pushed_m) / (kPassiveShare * depth_m));
  const double steep = has_sides_ ? 1 - SideFaces::Bearing(std::abs(foot.across_W.z())) : 1;
  const double length_m = steep * shape.length_m * std::abs(foot.n_W.z());
  return -std::copysign(share * length_m * face.Resistance_npm(depth_m), pushed_m);
}

GearContact::Result GearContact::Act(const BodyState& body, double rate_radps, double dt_s,
                                     const LowObstacles& obstacles, Columns* ground) {
  const std::vector<Patch> before = patches_;
  const Step step{body, gear_.ShoeRadius_m() * rate_radps, dt_s, contact_m_, before, ground};
  GearSum sum;
  rut_.Begin(step.shoe_mps * dt_s, ground);
  for (WheelContact& wheel : wheels_) {
    sum.Add(wheel.Act(body, step.shoe_mps, dt_s, obstacles, ground, &rut_));
  }
  for (std::size_t k = 0; k < patches_.size(); ++k) {
    if (!patches_[k].is_on_wheel) ActOn(k, step, obstacles, &sum);
  }
  rut_.End(body, sum.weight_n, ground);
  forward_mps_ = sum.weight_n > 0 ? sum.forward_w / sum.weight_n : 0;
  contact_m_ = sum.contact_m;
  deepest_m_ = sum.sinkage_m;
  if (sum.weight_n <= 0) rut_work_j_ = 0;
  Result result{sum.wrench, sum.traction_n, sum.sinkage_m, 0, sum.grip_n};
  if (sum.weight_n > 0 && std::abs(step.shoe_mps) > kSlowestShoe_mps) {
    result.slip = std::clamp(1 - forward_mps_ / step.shoe_mps, -1.0, 1.0);
  }
  if (shears_) result.wrench.force_W_n += PayBack(body.v_WB_mps, dt_s);
  return result;
}

void GearContact::ActOn(std::size_t k, const Step& step, const LowObstacles& obstacles,
                        GearSum* sum) {
  const BodyState& body = step.body;
  const bool side = SideFaces::IsOne(gear_.patches[k]);
  const Footprint foot(gear_.patches[k], body.X_WB);
  Pressed pressed;
  if (const double touching = Touching(gear_.patches[k], foot); touching > 0) {
    if (shears_ && !side) {
      const Vec3 aside_W_n = PushAside_n(k, foot, step) * foot.across_W;
      sum->wrench.AddForceAt(aside_W_n, foot.p_W_m, body.X_WB.translation());
    }
    rut_work_j_ += rut_.Press(k, foot, touching, body, step.dt_s, obstacles, step.ground);
    pressed = Bear(k, foot, touching, body, *step.ground, obstacles);
  }
  if (pressed.normal_n > 0) {
    Carry(k, foot, pressed, step, sum);
  } else {
    const Vec3 v_W = body.v_WB_mps + body.w_WB_radps.cross(foot.p_W_m - body.X_WB.translation());
    patches_[k].Lift((v_W.head<2>().norm() + std::abs(step.shoe_mps)) * step.dt_s);
  }
}

/// Adds the forces of a patch in contact, and moves the soil that its shoes carry.
void GearContact::Carry(std::size_t k, const Footprint& foot, const Pressed& pressed,
                        const Step& step, GearSum* sum) {
  const BodyState& body = step.body;
  const ContactPatch& patch = gear_.patches[k];
  const Vec3 origin_W = body.X_WB.translation();
  const Vec3 p_W = pressed.moment_W / pressed.normal_n;
  const Vec3 v_W =
      body.v_WB_mps + body.w_WB_radps.cross(p_W - origin_W) - pressed.moving_W / pressed.normal_n;
  const bool side = SideFaces::IsOne(patch);
  if (!side) sum->contact_m += patch.length_m;
  Vec2 shear_n = Vec2::Zero();
  if (shears_) {
    const Vec3 over_soil_W = side ? v_W : OverSoil_mps(foot, body, v_W);
    const Vec2 slip_mps(over_soil_W.dot(foot.along_W) + step.shoe_mps,
                        over_soil_W.dot(foot.across_W));
    shear_n = Shear(k, pressed, slip_mps, step);
    if (step.contact_m > 0 && !side) {
      rut_.Slip(k, slip_mps.x() * step.dt_s, pressed.sinkage_m, step.contact_m, body, step.ground);
    }
  }
  sum->grip_n += pressed.Strength().force_n();
  sum->wrench.AddForceAt(
      -pressed.normal_n * foot.n_W + shear_n.x() * foot.along_W + shear_n.y() * foot.across_W, p_W,
      origin_W);
  sum->traction_n -= shear_n.x();
  if (!side) sum->sinkage_m = std::max(sum->sinkage_m, pressed.sinkage_m);
  sum->forward_w += pressed.normal_n * v_W.dot(body.X_WB.linear().col(0));
  sum->weight_n += pressed.normal_n;
}

/// Drag by which moving gear pays the work on its rut.
Vec3 GearContact::PayBack(const Vec3& v_WB_mps, double dt_s) {
  const Vec3 v_W(v_WB_mps.x(), v_WB_mps.y(), 0);
  const Vec3 drag_W_n = -rut_work_j_ / kDragLength_m * v_W / (v_W.norm() + kDragSpeed_mps);
  rut_work_j_ = std::max(0.0, rut_work_j_ + drag_W_n.dot(v_W) * dt_s);
  return drag_W_n;
}

}  // namespace tera
