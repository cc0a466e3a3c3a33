#include "survey/points/coarse_steps.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace tera {
namespace {

constexpr double kFineStep_m = 0.02;

/// One coordinate of every `stride`-th point, sorted.
std::vector<double> Sorted(const PointCloud& cloud, int axis, std::size_t stride) {
  std::vector<double> values_m;
  for (std::size_t k = 0; k < cloud.p_m.size(); k += stride) {
    values_m.push_back(cloud.p_m[k][axis]);
  }
  std::sort(values_m.begin(), values_m.end());
  return values_m;
}

/// Least distance between two different values; 0 if all are equal.
double LeastDistance(const std::vector<double>& sorted_m) {
  constexpr double kSame_m = 1e-6;
  double least_m = 0;
  for (std::size_t k = 1; k < sorted_m.size(); ++k) {
    const double distance_m = sorted_m[k] - sorted_m[k - 1];
    if (distance_m > kSame_m && (least_m == 0 || distance_m < least_m)) least_m = distance_m;
  }
  return least_m;
}

/// Distance from a float to the next.
double FloatStep_m(double value_m) {
  const float size = std::abs(static_cast<float>(value_m));
  return std::nextafter(size, std::numeric_limits<float>::infinity()) - size;
}

/// True if all values are floats, apart from the rounding in the file.
bool AreFloats(const std::vector<double>& values_m, double rounded_m) {
  const double same_m = 1e-6 + 0.5 * rounded_m;
  return std::all_of(values_m.begin(), values_m.end(), [&](double value_m) {
    return std::abs(value_m - static_cast<float>(value_m)) <= same_m;
  });
}

/// True if there are more than three points per place in the plane, on average.
bool SharePlaces(const PointCloud& cloud) {
  constexpr std::size_t kShared = 3;
  std::vector<std::pair<double, double>> places_m;
  for (const Vec3& p : cloud.p_m) places_m.emplace_back(p.x(), p.y());
  std::sort(places_m.begin(), places_m.end());
  const auto end = std::unique(places_m.begin(), places_m.end());
  return cloud.p_m.size() > kShared * static_cast<std::size_t>(end - places_m.begin());
}

/// The coarser resolution of x and y, if both are in single precision or both have few digits.
std::optional<CoarseSteps> StepsOfDigits(const PointCloud& cloud) {
  constexpr double kLarge_m = 1e5;
  constexpr std::size_t kSample = 20'000;
  std::optional<CoarseSteps> single, few;
  bool are_single = true;
  for (int axis = 0; axis < 2; ++axis) {
    const std::vector<double> some_m = Sorted(cloud, axis, 1 + cloud.p_m.size() / kSample);
    const double size_m = std::max(std::abs(some_m.front()), std::abs(some_m.back()));
    const char name = "xy"[axis];
    const bool are_floats = AreFloats(some_m, cloud.step_m[axis]);
    double least_m = LeastDistance(some_m);
    if (size_m > kLarge_m && least_m > kFineStep_m && (!few || least_m > few->step_m)) {
      few = {name, least_m, ""};
    }
    // A sample of the points may miss the least distance, so all points are used.
    if (are_floats && least_m > FloatStep_m(size_m)) {
      least_m = LeastDistance(Sorted(cloud, axis, 1));
    }
    constexpr double kNear_m = 1e-4;  // floats closer than this result from any local coordinate
    are_single = are_single && are_floats && least_m <= std::max(kNear_m, FloatStep_m(size_m));
    if (!single || FloatStep_m(size_m) > single->step_m) single = {name, FloatStep_m(size_m), ""};
  }
  if (are_single && single->step_m > kFineStep_m) {
    single->cause =
        "its coordinates are too large for single precision; export it in double precision or with "
        "a local origin";
    return single;
  }
  if (!few || !SharePlaces(cloud)) return std::nullopt;
  few->cause = "its coordinates have too few digits; export it with more digits";
  return few;
}

}  // namespace

std::optional<CoarseSteps> FindCoarseSteps(const PointCloud& cloud) {
  int axis = 0;
  const double scale_m = cloud.step_m.maxCoeff(&axis);
  if (scale_m > kFineStep_m) {
    return CoarseSteps{"xyz"[axis], scale_m,
                       "the scale of the file; export it with a finer one, 0.001"};
  }
  return cloud.p_m.empty() ? std::nullopt : StepsOfDigits(cloud);
}

}  // namespace tera
