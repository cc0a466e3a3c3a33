#include "soil/track/rim.h"

#include <algorithm>
#include <cmath>

namespace tera {
namespace {

constexpr double kSame = 1e-6;  ///< rounding tolerance of positions in m and of directions

double AngleOf_rad(const ContactPatch& patch) {
  return std::atan2(patch.outward_B.x(), -patch.outward_B.z());
}

}  // namespace

Rim::Point Rim::At(double angle_rad, double across_m, const Pose& X_WB) const {
  const double s = std::sin(angle_rad), c = std::cos(angle_rad);
  const Vec3 n_B(s, 0, -c);
  return {X_WB * (axle_B_m + radius_m * n_B + across_m * Vec3::UnitY()), X_WB.linear() * n_B,
          X_WB.linear() * Vec3(-c, 0, -s), X_WB.linear().col(1)};
}

/// The lower intersection of a vertical line with the cylinder.
std::optional<Rim::Over> Rim::Above(const Vec2& p_W_m, const Pose& X_WB) const {
  const Mat3 R_WB = X_WB.linear();
  const Vec3 left_W = R_WB.col(1), axle_W_m = X_WB * axle_B_m;
  const Vec3 e_W(p_W_m.x() - axle_W_m.x(), p_W_m.y() - axle_W_m.y(), 0);
  const double e_left = e_W.dot(left_W), lean = left_W.z();
  const double a = 1 - lean * lean;
  if (a < kSame) return std::nullopt;  // it lies on its side
  const double b = lean * e_left;
  const double d = b * b - a * (e_W.squaredNorm() - e_left * e_left - radius_m * radius_m);
  if (d <= 0) return std::nullopt;
  const Vec3 q_W = e_W + (b - std::sqrt(d)) / a * Vec3::UnitZ();
  const double across_m = q_W.dot(left_W);
  const double angle_rad = std::atan2(q_W.dot(R_WB.col(0)), -q_W.dot(R_WB.col(2)));
  if (std::abs(across_m) > 0.5 * width_m || angle_rad < first_rad || angle_rad > last_rad) {
    return std::nullopt;
  }
  return Over{axle_W_m.z() + q_W.z(), angle_rad, across_m};
}

GearRims FindRims(const RunningGear& gear) {
  const auto& patches = gear.patches;
  GearRims found{{}, std::vector<bool>(patches.size())};
  for (std::size_t first = 0, last = 0; first + 1 < patches.size(); first = last + 1) {
    const ContactPatch &a = patches[first], &b = patches[first + 1];
    last = first;
    const Vec3 turn = b.outward_B - a.outward_B;
    if (turn.norm() < kSame) continue;
    const double radius_m = (b.p_B_m - a.p_B_m).dot(turn) / turn.squaredNorm();
    const Vec3 axle_B_m = a.p_B_m - radius_m * a.outward_B;
    while (last + 1 < patches.size()) {
      const ContactPatch& next = patches[last + 1];
      if ((next.p_B_m - radius_m * next.outward_B - axle_B_m).norm() > kSame) break;
      ++last;
    }
    const auto [low, high] = std::minmax({AngleOf_rad(a), AngleOf_rad(patches[last])});
    if (low * high >= 0) continue;
    const double half_rad = 0.5 * a.length_m / radius_m;
    found.rims.push_back({axle_B_m, radius_m, a.width_m, low - half_rad, high + half_rad});
    std::fill(found.has_patch.begin() + static_cast<std::ptrdiff_t>(first),
              found.has_patch.begin() + static_cast<std::ptrdiff_t>(last) + 1, true);
  }
  return found;
}

}  // namespace tera
