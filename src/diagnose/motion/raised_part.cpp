#include "diagnose/motion/raised_part.h"

#include <algorithm>
#include <array>

#include "diagnose/motion/link_motion.h"

namespace tera {

Eigen::Vector2d RaisedPart::At(const Eigen::VectorXd& numbers) const {
  std::array<double, kMostJointsOfChain> q{};
  for (std::size_t s = 0; s < chain.steps.size(); ++s) {
    q[s] = numbers[kBaseNumbers + chain.steps[s].place];
  }
  const Vec3 tip_B = PointInBase<double>(chain, direction_L, q.data()),
             foot_B = PointInBase<double>(chain, Vec3::Zero(), q.data());
  const Vec3 direction_W =
      RotationOfRpy<double>(Vec3(numbers.segment<3>(kRoll))) * (tip_B - foot_B).normalized();
  const double level = direction_W.head<2>().norm();
  if (level <= 0) return Eigen::Vector2d::Zero();
  return std::max(0.0, direction_W.z()) / level * direction_W.head<2>();
}

Eigen::Matrix<double, 3, 4> ByReflection(const Eigen::Vector2d& raised) {
  const double c = raised.x(), s = raised.y();
  Eigen::Matrix<double, 3, 4> by_number;
  by_number << c, s, 0, 0,  //
      s, -c, 0, 0,          //
      0, 0, c, s;
  return by_number;
}

}  // namespace tera
