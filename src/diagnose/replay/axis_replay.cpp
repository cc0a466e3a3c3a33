#include "diagnose/replay/axis_replay.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "physics/actuation/actuation.h"

namespace tera {
namespace {

/// Interpolates rates at the ends of steps linearly to the times of the samples.
class SampledRate {
 public:
  SampledRate(const std::vector<double>& at_step, std::size_t count)
      : at_step_(at_step), count_(count) {
    rates_.reserve(count);
  }
  void Add(std::size_t step, double end_radps) {
    while (rates_.size() < count_ && at_step_[rates_.size()] <= static_cast<double>(step) + 1) {
      const double s = std::max(0.0, at_step_[rates_.size()] - static_cast<double>(step));
      rates_.push_back(std::lerp(before_radps_, end_radps, s));
    }
    before_radps_ = end_radps;
  }
  std::vector<double> Take() { return std::move(rates_); }

 private:
  const std::vector<double>& at_step_;
  std::size_t count_ = 0;
  std::vector<double> rates_;
  double before_radps_ = 0;
};

/// Full effort of an axis's motor. Zero for running gears, whose load is the whole machine.
double FullEffort_nm(const MachineModel& model, std::size_t axis) {
  return axis < model.joints.size() ? model.joints[axis].max_effort_nm : 0;
}

/// Rate change in one step per newton metre; 0 if the inertia is unknown.
double ChangePerEffort_radpspnm(double inertia_kgm2, double dt_s) {
  return inertia_kgm2 > 0 ? dt_s / inertia_kgm2 : 0;
}

/// Rate at the end of a step. Full effort limits the acceleration.
double Accelerated(double from_radps, double asked_radps, double full_nm, double load_nm,
                   double change_radpspnm) {
  if (change_radpspnm <= 0 || full_nm <= 0) return asked_radps;
  const double most_radps = std::max(0.0, full_nm - load_nm) * change_radpspnm;
  const double least_radps = -std::max(0.0, full_nm + load_nm) * change_radpspnm;
  const double change_radps = asked_radps - from_radps;
  if (change_radps >= least_radps && change_radps <= most_radps) return asked_radps;
  return from_radps + std::clamp(change_radps, least_radps, most_radps);
}

}  // namespace

AxisReplay::AxisReplay(const MachineModel& model, const AxisLog& log, const MeasuredRate& measured)
    : model_(model),
      axis_(measured.axis),
      axes_(log.axes),
      step_s_(log.step_s),
      at_step_(measured.at_step),
      levers_(log.lever),
      pump_(PumpDemandOf(model, log, measured.axis)) {
  for (std::size_t k = 0; k < log.steps; ++k) {
    lever_.push_back(log.levers_at(k)[axis_]);
    motion_.push_back(log.motions_at(k)[axis_]);
    change_radpspnm_.push_back(ChangePerEffort_radpspnm(log.inertias_at(k)[axis_], log.step_s));
  }
  // The replay needs none of these parts, and copies of them would slow down every prediction.
  for (Cylinder& cylinder : model_.cylinders) cylinder.bore_m = 0;
  for (Link& link : model_.links) link = {};
  model_.levers.clear();
  model_.track_visuals.clear();
  model_.wheel_visuals.clear();
  model_.frames.clear();
  model_.effects.joints.resize(model.joints.size());
  model_.effects.gears.resize(model.gear_drives.size());
  model_.effects.pumps.resize(model.pumps.size());
}

AxisReplay AxisReplay::With(const LearnedEffect& learned) const {
  AxisReplay with = *this;
  with.model_.effects.learned.resize(axes_);
  with.model_.effects.learned[axis_] = learned;
  return with;
}

AxisEffects AxisReplay::effects() const {
  const std::size_t joints = model_.joints.size();
  return {axis_ < joints ? model_.effects.joints[axis_] : model_.effects.gears[axis_ - joints],
          pump_ ? model_.effects.pumps[pump_->pump] : Effects()};
}

template <typename Take>
void AxisReplay::Run(const AxisEffects& effects, const Nominal& nominal, std::size_t steps,
                     const Take& take) const {
  const std::size_t joints = model_.joints.size();
  MachineModel model = model_;
  (axis_ < joints ? model.effects.joints[axis_] : model.effects.gears[axis_ - joints]) =
      effects.axis;
  AxisActuation actuation = AxisActuationOf(model, axis_, {.machine = model.kind});
  const double full_nm = nominal.effort * FullEffort_nm(model, axis_);
  const LearnedEffect* effect = LearnedAt(model.effects, axis_);
  auto learned = effect != nullptr ? std::optional(LearnedRate(*effect)) : std::nullopt;
  PumpFlow flow(PumpFlowOf(effects.pump, pump_ ? model.pumps[pump_->pump].max_flow_m3ps : 0));
  const bool is_shared = pump_ && !effects.pump.empty();
  Rates rates;
  for (std::size_t k = 0; k < steps; ++k) {
    double demand_radps = actuation.Demand(lever_[k], step_s_);
    if (is_shared) {
      demand_radps *=
          flow.Step(pump_->others_m3ps[k] + pump_->Own_m3ps(k, demand_radps),
                    pump_->others_w[k] + actuation.Power_w(demand_radps, motion_[k]), step_s_);
    }
    double delivered_radps = actuation.DeliveredRate(demand_radps, motion_[k], step_s_);
    if (learned) {
      delivered_radps = learned->Step(
          delivered_radps, {levers_[k * axes_ + learned->lever_axis()], motion_[k].position_rad,
                            motion_[k].load_nm, static_cast<double>(k) * step_s_});
    }
    rates.asked_radps = nominal.rate * delivered_radps;
    rates.rate_radps = Accelerated(rates.rate_radps, rates.asked_radps, full_nm, motion_[k].load_nm,
                                   change_radpspnm_[k]);
    take(k, rates);
  }
}

std::vector<double> AxisReplay::Predict(const AxisEffects& effects, const Nominal& nominal,
                                        std::size_t most) const {
  const std::size_t wanted = std::min(most, at_step_.size());
  SampledRate sampled(at_step_, wanted);
  Run(effects, nominal, StepsTo(wanted),
      [&](std::size_t k, const Rates& at_end) { sampled.Add(k, at_end.rate_radps); });
  return sampled.Take();
}

/// Number of steps up to the end of the step that contains the last of the first `samples`.
std::size_t AxisReplay::StepsTo(std::size_t samples) const {
  if (samples == at_step_.size()) return lever_.size();
  const double last = samples == 0 ? 0 : at_step_[samples - 1];
  return std::min(lever_.size(), static_cast<std::size_t>(std::max(0.0, last)) + 1);
}

std::vector<bool> AxisReplay::FallsShort(const AxisEffects& effects, const Nominal& nominal) const {
  std::vector<bool> falls_short(at_step_.size(), false);
  std::size_t next = 0;
  Run(effects, nominal, lever_.size(), [&](std::size_t k, const Rates& at_end) {
    const auto begins = static_cast<double>(k);
    while (next < at_step_.size() && at_step_[next] <= begins) ++next;
    if (at_end.asked_radps == at_end.rate_radps) return;
    // A sample in the next step is interpolated from the ends of both steps.
    std::size_t sample = next;
    while (sample < at_step_.size() && at_step_[sample] < begins + 2) falls_short[sample++] = true;
    if (sample == next && sample < at_step_.size()) falls_short[sample] = true;
  });
  return falls_short;
}

}  // namespace tera
