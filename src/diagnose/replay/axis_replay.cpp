#include "diagnose/replay/axis_replay.h"

#include <algorithm>
#include <cmath>

#include "physics/slots/actuation.h"

namespace tera {

std::vector<std::vector<double>> AxisReplay::Predict(const MachineEffects& effects) const {
  MachineModel model = model_;
  model.effects = effects;
  Actuation actuation(model, {.machine = model.kind});
  std::vector<std::vector<double>> rates(log_.measured.size());
  std::vector<std::size_t> next(log_.measured.size(), 0);
  std::vector<double> before(log_.axes, 0.0);
  for (std::size_t k = 0; k < log_.steps; ++k) {
    actuation.Step(log_.levers_at(k), log_.motions_at(k), log_.step_s);
    for (std::size_t m = 0; m < rates.size(); ++m) {
      const MeasuredRate& measured = log_.measured[m];
      const double end_radps = actuation.drives()[measured.axis].rate_radps;
      // Samples up to the end of this step, between its start and its end.
      while (next[m] < measured.at_step.size() && measured.at_step[next[m]] <= k + 1.0) {
        const double s = std::max(0.0, measured.at_step[next[m]] - static_cast<double>(k));
        rates[m].push_back(std::lerp(before[measured.axis], end_radps, s));
        ++next[m];
      }
    }
    for (std::size_t axis = 0; axis < log_.axes; ++axis) {
      before[axis] = actuation.drives()[axis].rate_radps;
    }
  }
  return rates;
}

}  // namespace tera
