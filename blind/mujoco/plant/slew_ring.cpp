#include "blind/mujoco/plant/slew_ring.h"

#include <cmath>

#include "core/random.h"

namespace tera::blind::mujoco {

double RingFriction(const mjModel& model, const mjData& data, int joint, double diameter_m) {
  using Column = Eigen::Map<const Vec3>;
  const int body = model.jnt_bodyid[joint];
  const Vec3 axis = Column(data.xaxis + 3 * joint);
  const Vec3 way_m = Column(data.subtree_com + 3 * body) - Column(data.xanchor + 3 * joint);
  const double aside_m = (way_m - axis * axis.dot(way_m)).norm();
  return (4.4 * aside_m + diameter_m) / (4.4 * diameter_m / 4 + diameter_m);
}

double HalfPlay_rad(double gap_rad, double worn, double worst_rad, double angle_rad) {
  return gap_rad / 2 * (1 + worn * std::cos(angle_rad - worst_rad));
}

}  // namespace tera::blind::mujoco
