#include "sensors/sampling.h"

#include <algorithm>

namespace tera {

double SensedStep::FractionAt(TimeNs t_ns) const {
  if (t1_ns == t0_ns) return 1.0;
  return std::clamp(static_cast<double>(t_ns - t0_ns) / static_cast<double>(t1_ns - t0_ns), 0.0,
                    1.0);
}

Pose SensedStep::LinkAt(int link, double s) const {
  return Interpolate(before.links[link].X_WB, after.links[link].X_WB, s);
}

KeptScene SensedScene::Keep() const {
  const std::shared_ptr<const void> nobody;  // the scene owns the objects
  return {{nobody, &ground()}, ShapesNow(), {nobody, air().dust}};
}

void InstantSampler::Sample(const SensedStep& step) {
  for (; clock_.Due(next_) <= step.t1_ns; ++next_) MeasureAt(next_, clock_.Due(next_), step);
}

}  // namespace tera
