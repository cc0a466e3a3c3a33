#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "soil/tool/slip_ahead.h"

namespace tera {
namespace {

constexpr double kSteepestToEdge = 0.46630765815499864;  ///< tangent of 25 deg
constexpr double kFitSpan_m = 0.225;  ///< length of ground that is fitted by a line up to the edge
constexpr double kReachInDepths = 8;  ///< in depths; slip surfaces end within it
constexpr double kLeastReach_m = 3;   ///< a heap that slides as a whole ends within it
constexpr double kFirstStepInDepths = 0.1;
constexpr double kLeastFirstStep_m = 0.02;

/// Ratio of a geometric series of `steps` terms that starts with `first_m` and has the sum `sum_m`.
double RatioOfRow(double first_m, double sum_m, int steps) {
  double ratio = 1.2;
  for (int k = 0; k < 8; ++k) {
    ratio = std::pow(1 + sum_m / first_m * (ratio - 1), 1.0 / steps);
  }
  return std::max(ratio, 1.0 + 1e-6);
}

/// Positions ahead of the edge: 0, `near_m`, then with growing steps.
std::array<double, GroundAhead::kPlaces> PlacesAhead_m(double near_m, double depth_m) {
  std::array<double, GroundAhead::kPlaces> x_m{};
  double step_m = std::max(kLeastFirstStep_m, kFirstStepInDepths * depth_m);
  const double reach_m = std::max(kLeastReach_m, kReachInDepths * depth_m);
  const double ratio = RatioOfRow(step_m, reach_m, GroundAhead::kPlaces - 2);
  x_m[1] = near_m;
  for (int k = 2; k < GroundAhead::kPlaces; ++k, step_m *= ratio) x_m[k] = x_m[k - 1] + step_m;
  return x_m;
}

}  // namespace

GroundAhead LookAhead(const Vec3& p_W, double near_m, const Vec3& travel_W, const Columns& ground) {
  GroundAhead ahead;
  const auto look = [&](int k) {
    const Vec2 at = (p_W + ahead.x_m[k] * travel_W).head<2>();
    const Columns::Sample sample = ground.SampleAt(at.x(), at.y());
    ahead.top_m[k] = sample.top_m - p_W.z();
    ahead.firm_m[k] = ahead.top_m[k] - (sample.nearest == nullptr ? 0 : sample.nearest->loose_m);
  };
  ahead.x_m[1] = near_m;
  look(1);
  if (ahead.top_m[1] <= 0) return ahead;
  ahead.x_m = PlacesAhead_m(near_m, ahead.top_m[1]);
  // Sums of a least-squares line through the nearest ground.
  double n = 0, x = 0, z = 0, xx = 0, xz = 0;
  for (int k = 1; k < GroundAhead::kPlaces; ++k) {
    look(k);
    const double x_m = ahead.x_m[k] - near_m;
    if (x_m > kFitSpan_m) continue;
    ++n, x += x_m, z += ahead.top_m[k], xx += x_m * x_m, xz += x_m * ahead.top_m[k];
  }
  const double slope = std::clamp((n * xz - x * z) / std::max(n * xx - x * x, 1e-12),
                                  -kSteepestToEdge, kSteepestToEdge);
  ahead.top_m[0] = std::max(0.0, (z - slope * x) / n - near_m * slope);
  ahead.firm_m[0] = std::min(ahead.top_m[0], ahead.firm_m[1]);
  return ahead;
}

}  // namespace tera
