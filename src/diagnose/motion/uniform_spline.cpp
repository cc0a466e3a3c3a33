#include "diagnose/motion/uniform_spline.h"

#include <algorithm>
#include <cmath>

namespace tera {

SplineWeights UniformSpline::At(double t_s) const {
  SplineWeights weights;
  weights.first = std::clamp(static_cast<int>(std::floor(t_s / step_s)), 0, coefficients - 4);
  const double u = t_s / step_s - weights.first, v = 1 - u, h = step_s;
  auto& w = weights.by_derivative;
  w.row(0) << v * v * v, 4 - 3 * u * u * (2 - u), 4 - 3 * v * v * (2 - v), u * u * u, 0;
  w.row(0) /= 6;
  w.row(1) << -v * v, u * (3 * u - 4), v * (4 - 3 * v), u * u, 0;
  w.row(1) /= 2 * h;
  w.row(2) << v, 3 * u - 2, 3 * v - 2, u, 0;
  w.row(2) /= h * h;
  w.row(3) << -1, 3, -3, 1, 0;
  w.row(3) /= h * h * h;
  return weights;
}

SplineWeights UniformSpline::MeanOver(double from_s, double to_s) const {
  const double length_s = to_s - from_s;
  const SplineWeights middle = At((from_s + to_s) / 2);
  if (length_s <= 0 || length_s > step_s) return middle;
  const SplineWeights begin = At(from_s), end = At(to_s);
  // A span of one step that touches three intervals by rounding.
  if (end.first > begin.first + 1) return middle;
  SplineWeights mean;
  mean.first = begin.first;
  const auto add = [&](const SplineWeights& part, int from_row, int to_row, double factor) {
    const int shift = part.first - mean.first;
    mean.by_derivative.row(to_row).segment(shift, 4) +=
        factor * part.by_derivative.row(from_row).head(4);
  };
  add(begin, 0, 0, 1.0 / 6);
  add(middle, 0, 0, 4.0 / 6);
  add(end, 0, 0, 1.0 / 6);
  for (int k = 0; k < 3; ++k) {
    add(begin, k, k + 1, -1 / length_s);
    add(end, k, k + 1, 1 / length_s);
  }
  return mean;
}

}  // namespace tera
