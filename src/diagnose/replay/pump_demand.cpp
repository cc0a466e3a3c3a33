#include "diagnose/replay/pump_demand.h"

#include <algorithm>

#include "physics/actuation/actuation.h"

namespace tera {
namespace {

/// Axes that a pump feeds: joints, then running gears.
std::vector<std::size_t> AxesOf(const MachineModel& model, const Pump& pump) {
  std::vector<std::size_t> axes(pump.joints.begin(), pump.joints.end());
  for (const int gear : pump.gears) axes.push_back(model.joints.size() + gear);
  return axes;
}

std::optional<std::size_t> OnlyPumpOf(const MachineModel& model, std::size_t axis) {
  std::optional<std::size_t> only;
  for (std::size_t p = 0; p < model.pumps.size(); ++p) {
    const std::vector<std::size_t> axes = AxesOf(model, model.pumps[p]);
    if (std::find(axes.begin(), axes.end(), axis) == axes.end()) continue;
    if (only) return std::nullopt;
    only = p;
  }
  return only;
}

/// Number of pumps that feed an axis. Each delivers the same share.
double PumpsOf(const MachineModel& model, std::size_t axis) {
  return static_cast<double>(
      std::count_if(model.pumps.begin(), model.pumps.end(), [&](const Pump& pump) {
        const std::vector<std::size_t> axes = AxesOf(model, pump);
        return std::find(axes.begin(), axes.end(), axis) != axes.end();
      }));
}

void AddOther(const MachineModel& model, const AxisLog& log, std::size_t axis, PumpDemand* out) {
  AxisActuation chain = AxisActuationOf(model, axis, {.machine = model.kind});
  const double pumps = PumpsOf(model, axis);
  for (std::size_t k = 0; k < log.steps; ++k) {
    const AxisMotion& motion = log.motions_at(k)[axis];
    const double part_radps = chain.Demand(log.levers_at(k)[axis], log.step_s) / pumps;
    out->others_m3ps[k] += chain.Flow_m3ps(part_radps, motion.position_rad);
    out->others_w[k] += chain.Power_w(part_radps, motion);
  }
}

void AddOwn(const MachineModel& model, const AxisLog& log, std::size_t axis, PumpDemand* out) {
  AxisActuation chain = AxisActuationOf(model, axis, {.machine = model.kind});
  for (std::size_t k = 0; k < log.steps; ++k) {
    const AxisMotion& motion = log.motions_at(k)[axis];
    out->positive_m3prad.push_back(chain.Flow_m3ps(1, motion.position_rad));
    out->negative_m3prad.push_back(chain.Flow_m3ps(-1, motion.position_rad));
    const double rate_radps = chain.Demand(log.levers_at(k)[axis], log.step_s);
    const double own_m3ps = out->Own_m3ps(k, rate_radps);
    if (own_m3ps <= 0) continue;
    if (out->others_m3ps[k] > 0) out->together_s += log.step_s;
    out->most_m3ps = std::max(out->most_m3ps, own_m3ps + out->others_m3ps[k]);
    out->most_w = std::max(out->most_w, chain.Power_w(rate_radps, motion) + out->others_w[k]);
  }
}

}  // namespace

std::optional<PumpDemand> PumpDemandOf(const MachineModel& model, const AxisLog& log,
                                       std::size_t axis) {
  const auto pump = OnlyPumpOf(model, axis);
  if (!pump) return std::nullopt;
  PumpDemand demand;
  demand.pump = *pump;
  demand.others_m3ps.assign(log.steps, 0.0);
  demand.others_w.assign(log.steps, 0.0);
  for (const std::size_t other : AxesOf(model, model.pumps[*pump])) {
    if (other != axis) AddOther(model, log, other, &demand);
  }
  AddOwn(model, log, axis, &demand);
  return demand;
}

}  // namespace tera
