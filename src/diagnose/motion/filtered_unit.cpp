#include "diagnose/motion/filtered_unit.h"

#include <algorithm>
#include <cmath>

namespace tera {
namespace {

/// `steps` is the step divided by the time constant.
FilteredUnit::Rows LowPassOf(const FilteredUnit::Rows& x, double steps) {
  const double gone = -std::expm1(-steps), rising = 1 - gone / steps;
  FilteredUnit::Rows y = x;
  if (x.cols() > 1) y.col(0) -= (x.col(1) - x.col(0)) / steps;
  for (Eigen::Index k = 1; k < x.cols(); ++k) {
    y.col(k) =
        y.col(k - 1) + gone * (x.col(k - 1) - y.col(k - 1)) + rising * (x.col(k) - x.col(k - 1));
  }
  return y;
}

}  // namespace

FilteredUnit::FilteredUnit(double every_s, double time_constant_s, const Rows& moved,
                           const Rows& rests)
    : step_s(every_s) {
  const double steps = every_s / time_constant_s;
  value = LowPassOf(moved, steps);
  resting = LowPassOf(rests, steps);
  // The derivative s of y by T follows T s' = -y' - s.
  by_delay = (resting - rests) / time_constant_s;
  by_time_constant = LowPassOf(by_delay, steps);
}

Eigen::Matrix<double, 6, 1> FilteredUnit::MeanOver(const Rows& rows, double from_s,
                                                   double to_s) const {
  const auto at = [&](double t_s) -> Eigen::Matrix<double, 6, 1> {
    const double place = std::clamp(t_s / step_s, 0.0, static_cast<double>(rows.cols() - 1));
    const auto before = std::min(static_cast<Eigen::Index>(place), rows.cols() - 2);
    const double share = place - static_cast<double>(before);
    return (1 - share) * rows.col(before) + share * rows.col(before + 1);
  };
  return (at(from_s) + 4 * at(0.5 * (from_s + to_s)) + at(to_s)) / 6;
}

}  // namespace tera
