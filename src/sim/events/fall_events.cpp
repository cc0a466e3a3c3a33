#include "sim/events/fall_events.h"

#include <algorithm>
#include <limits>

#include "core/units.h"

namespace tera {
namespace {

constexpr double kFreeShare = 0.9;
constexpr double kLeastDrop_m = 0.05;

}  // namespace

FallEvents::FallEvents(const Scenario& scenario)
    : scenario_(scenario),
      drops_({.kind = EventKind::kDrop, .least_value = kLeastDrop_m}),
      top_m_(scenario.obstacles.size(), -std::numeric_limits<double>::infinity()) {}

void FallEvents::Observe(const Instant& before, const Instant& after) {
  drops_.Close(before.t_ns);
  const double dt_s = ToSeconds(after.t_ns - before.t_ns);
  for (std::size_t o = 0; o < scenario_.obstacles.size(); ++o) {
    const ScenarioObstacle& thing = scenario_.obstacles[o];
    if (!thing.dynamic) continue;
    const Vec3& com_B_m = thing.dynamic->com_B_m;
    const BodyState &was = before.obstacles[o], &is = after.obstacles[o];
    const double was_m = (was.X_WB * com_B_m).z(), is_m = (is.X_WB * com_B_m).z();
    const double down_mps2 =
        (PointVelocity(was, com_B_m).z() - PointVelocity(is, com_B_m).z()) / dt_s;
    if (down_mps2 <= kFreeShare * kStandardGravity_mps2) {
      top_m_[o] = is_m;
      continue;
    }
    top_m_[o] = std::max({top_m_[o], was_m, is_m});
    drops_.Hold({"", "", thing.name}, before.t_ns, after.t_ns, top_m_[o] - is_m);
  }
}

}  // namespace tera
