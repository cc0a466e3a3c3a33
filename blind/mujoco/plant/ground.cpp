#include "blind/mujoco/plant/ground.h"

#include <cmath>

namespace tera::blind::mujoco {

double Ground::Height_m(double x_m, double y_m) const {
  double z = slope.x() * x_m + slope.y() * y_m;
  if (!has_waves) return z;
  for (const Wave& w : waves)
    z += w.height_m * std::sin(w.x_radpm * x_m + w.y_radpm * y_m + w.phase_rad);
  return z;
}

Vec3 Ground::Normal(double x_m, double y_m) const {
  Vec3 normal(-slope.x(), -slope.y(), 1);
  if (has_waves) {
    for (const Wave& w : waves) {
      const double c = w.height_m * std::cos(w.x_radpm * x_m + w.y_radpm * y_m + w.phase_rad);
      normal.x() -= c * w.x_radpm;
      normal.y() -= c * w.y_radpm;
    }
  }
  return normal.normalized();
}

Quat Ground::AttitudeAt(double x_m, double y_m, double yaw_rad) const {
  const Vec3 up = Normal(x_m, y_m);
  Vec3 ahead(std::cos(yaw_rad), std::sin(yaw_rad), 0);
  ahead.z() = -(up.x() * ahead.x() + up.y() * ahead.y()) / up.z();  // heading kept, in the plane
  ahead.normalize();
  Mat3 R;
  R << ahead, up.cross(ahead), up;
  return Quat(R);
}

}  // namespace tera::blind::mujoco
