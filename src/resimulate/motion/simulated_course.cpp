#include "resimulate/motion/simulated_course.h"

#include <algorithm>
#include <cmath>

namespace tera {
namespace {

/// The two steps around a time, and the fraction between them.
struct Place {
  std::size_t a = 0, b = 0;
  double s = 0;
};

Place PlaceOf(const SimulatedCourse& course, TimeNs t_ns) {
  const auto last = static_cast<double>(course.steps.size() - 1);
  const double at = std::clamp(ToSeconds(t_ns - course.zero_ns) / course.step_s, 0.0, last);
  const auto a = static_cast<std::size_t>(at);
  return {a, std::min(a + 1, course.steps.size() - 1), at - static_cast<double>(a)};
}

}  // namespace

double SimulatedCourse::RateAt(TimeNs t_ns, std::size_t axis) const {
  const auto [a, b, s] = PlaceOf(*this, t_ns);
  return std::lerp(steps[a].rate_radps[axis], steps[b].rate_radps[axis], s);
}

double SimulatedCourse::PositionAt(TimeNs t_ns, std::size_t axis) const {
  const auto [a, b, s] = PlaceOf(*this, t_ns);
  return std::lerp(steps[a].position_rad[axis], steps[b].position_rad[axis], s);
}

Pose SimulatedCourse::PoseAt(TimeNs t_ns) const {
  const auto [a, b, s] = PlaceOf(*this, t_ns);
  return Interpolate(steps[a].X_WB, steps[b].X_WB, s);
}

}  // namespace tera
