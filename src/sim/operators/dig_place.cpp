#include "sim/operators/dig_place.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

const double kFootOverHeight = std::sqrt(3.0);  // of 30 deg

}  // namespace

bool IsInHeap(const RadialCut& cut, const SpoilHeap& heap) {
  if (heap.height_m <= 0) return false;
  const double turned_rad = heap.azimuth_rad - cut.azimuth_rad;
  const double along_m = heap.r_m * std::cos(turned_rad), aside_m = heap.r_m * std::sin(turned_rad);
  const double nearest_m = std::clamp(along_m, cut.reach_m - cut.length_m, cut.reach_m);
  return std::hypot(along_m - nearest_m, aside_m) < kFootOverHeight * heap.height_m;
}

double NextDigAzimuth_rad(const RadialCut& cut, double step_rad, const SpoilHeap& heap) {
  RadialCut next = cut;
  next.azimuth_rad += step_rad;
  for (double turned_rad = std::abs(step_rad); step_rad != 0 && turned_rad < 2 * kPi;
       turned_rad += std::abs(step_rad)) {
    if (!IsInHeap(next, heap)) return next.azimuth_rad;
    next.azimuth_rad += step_rad;
  }
  return cut.azimuth_rad + step_rad;
}

}  // namespace tera
