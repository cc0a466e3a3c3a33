#include "sensors/slots/check_steps.h"

#include <fmt/format.h>

namespace tera {

void CheckSteps(const ConfigMap& config, const Effects& effects,
                std::span<const StepAndLimit> quantities) {
  const Effect* rounding = FindEffect(effects, "quantisation");
  const Effect* clipping = FindEffect(effects, "saturation");
  if (!rounding || !clipping) return;
  for (const auto& [step, limit] : quantities) {
    if ((*rounding)[step] <= (*clipping)[limit]) continue;
    config.Fault(
        config.Has("quantisation") ? "quantisation" : "saturation",
        {FaultKind::kOutOfRange,
         fmt::format("{} {:g} of quantisation is beyond {} {:g} of saturation, which leaves "
                     "no value between; need a step of at most the limit",
                     step, (*rounding)[step], limit, (*clipping)[limit])});
  }
}

}  // namespace tera
