#include "blind/mujoco/plant/shoes.h"

#include <algorithm>
#include <cmath>

namespace tera::blind::mujoco {
namespace {

// Natural frequencies of the whole machine on its shoes, and their share of critical damping: hard
// ground, on which a machine heaves at 14 Hz.
constexpr double kHeave_radps = 90, kHeaveDamping = 0.4;
constexpr double kShear_radps = 70, kShearDamping = 0.3;
constexpr double kCreep_mps = 0.05;  ///< below which resistances fade
constexpr double kShoesGravity_mps2 = 9.8071;

}  // namespace

Shoes::Shoes(const MachineNumbers& numbers, const PlantForm& form, const Ground& ground,
             double mass_kg)
    : ground_(ground),
      form_(form.shoes),
      contact_m_(numbers.contact_m * form.shoes.length),
      weight_n_(mass_kg * kShoesGravity_mps2),
      packs_(form.packs) {
  const double share_kg = mass_kg / (2 * kShoes);
  carry_npm_ = share_kg * kHeave_radps * kHeave_radps;
  carry_nspm_ = 2 * kHeaveDamping * share_kg * kHeave_radps;
  bristle_npm_ = share_kg * kShear_radps * kShear_radps;
  bristle_nspm_ = 2 * kShearDamping * share_kg * kShear_radps;
  for (std::size_t i = 0; i < 2; ++i) {
    radius_m_[i] = numbers.radius_m * form.sprocket[static_cast<Eigen::Index>(i)];
    sides_[i].y_m = (i == 0 ? 0.5 : -0.5) * numbers.gauge_m * form_.gauge;
    sides_[i].relaxation_m = form_.relaxation_m / form_.soft.at(i);
  }
}

double Shoes::Radius_m(std::size_t side) const {
  const double packed = packs_[static_cast<Eigen::Index>(side)];
  return radius_m_[side] * (1 + packed * (1 - std::exp(-sides_[side].way_m / kPacks_m)));
}

Vec3 Shoes::Drag_n(const Vec3& ahead, const Vec3& v_mps) const {
  const double travel_mps = v_mps.dot(ahead);
  const double drag = travel_mps > 0 ? form_.drag_ahead : form_.drag_back;
  return -weight_n_ * drag * std::tanh(travel_mps / kCreep_mps) * ahead;
}

void Shoes::PushShoe(const Mat3& R_WB, const Vec3& p_WB_m, const Vec3& v_mps, const Vec3& w_radps,
                     std::size_t k, Side* side, Vec3* force_n, Vec3* torque_nm) const {
  const double x_m = contact_m_ * ((static_cast<double>(k) + 0.5) / kShoes - 0.5);
  const Vec3 arm_m = R_WB * Vec3(x_m, side->y_m, 0);
  const Vec3 place_m = p_WB_m + arm_m, own_mps = v_mps + w_radps.cross(arm_m);
  const Vec3 up = ground_.Normal(place_m.x(), place_m.y());
  const double depth_m = (ground_.Height_m(place_m.x(), place_m.y()) - place_m.z()) * up.z();
  const double load_n = std::max(0.0, carry_npm_ * depth_m - carry_nspm_ * own_mps.dot(up));
  const Vec3 ahead = (R_WB.col(0) - up * up.dot(R_WB.col(0))).normalized();
  const Vec3 across = up.cross(ahead);
  const double passing_1ps = std::abs(side->speed_mps) / side->relaxation_m;
  const auto hold = [&](double slide_mps, double grip, double* bristle_m) {
    const double most_n = grip * load_n;
    const double bends_mps = slide_mps - passing_1ps * *bristle_m;
    *bristle_m += kStep_s * bends_mps;
    *bristle_m = std::clamp(*bristle_m, -most_n / bristle_npm_, most_n / bristle_npm_);
    return -std::clamp(bristle_npm_ * *bristle_m + bristle_nspm_ * bends_mps, -most_n, most_n);
  };
  Bristle& bristle = side->bristles[k];
  const double travel_mps = own_mps.dot(ahead);
  const double slides_mps = travel_mps - side->speed_mps * (1 - form_.mud_slip);
  const double along_n = hold(slides_mps, form_.grip_along, &bristle.along_m);
  const double across_n = hold(own_mps.dot(across), form_.grip_across, &bristle.across_m);
  side->thrust_n += along_n;
  const double drag_n = form_.rolling * load_n * std::tanh(travel_mps / kCreep_mps);
  const Vec3 force = load_n * up + (along_n - drag_n) * ahead + across_n * across;
  *force_n += force;
  *torque_nm += arm_m.cross(force);
}

void Shoes::Push(const Model& model, mjData* data) {
  const mjModel* m = model.model.get();
  const Mat3 R_WB =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(data->xmat + 9 * model.base);
  const Vec3 p_WB_m = Eigen::Map<const Vec3>(data->xpos + 3 * model.base);
  const Vec3 v_mps = Eigen::Map<const Vec3>(data->qvel);
  const Vec3 w_radps = R_WB * Eigen::Map<const Vec3>(data->qvel + 3);
  Vec3 force_n = Vec3::Zero(), torque_nm = Vec3::Zero();
  for (std::size_t i = 0; i < 2; ++i) {
    Side& side = sides_[i];
    const int dof = m->jnt_dofadr[model.joint[i]];
    const double radius_m = Radius_m(i);
    side.speed_mps = radius_m * data->qvel[dof];
    side.way_m += kStep_s * std::abs(side.speed_mps);
    side.thrust_n = 0;
    for (std::size_t k = 0; k < kShoes; ++k) {
      PushShoe(R_WB, p_WB_m, v_mps, w_radps, k, &side, &force_n, &torque_nm);
    }
    data->qfrc_applied[dof] -= side.thrust_n * radius_m;
  }
  force_n += Drag_n(R_WB.col(0), v_mps);
  mj_applyFT(m, data, force_n.data(), torque_nm.data(), p_WB_m.data(), model.base,
             data->qfrc_applied);
}

}  // namespace tera::blind::mujoco
