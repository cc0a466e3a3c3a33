#include "diagnose/blocks/actuation_candidates.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/quantile.h"
#include "diagnose/blocks/beats.h"
#include "diagnose/blocks/candidate_list.h"
#include "diagnose/tolerances/default_tolerances.h"
#include "physics/actuation/actuation.h"
#include "physics/actuation/actuation_mechanisms.h"

namespace tera {
namespace {

/// Shortest rise time to full rate under a rate limit of the search. A shorter rise is a motor's
/// lag, which steps of the lever show.
constexpr double kShortestRise_s = 0.08;

/// Kink spacing (FreeParameter::kink) of parameters that shift the times of rate changes.
constexpr double kKinkOfInstants = 0.06;
constexpr double kLongestDelay_s = 0.8;
constexpr double kLateToMeasure_s = 0.03;  ///< largest delay of the rate measurement
constexpr long kMostStepsToMeasure = 10;   ///< upper bound of that delay, in time steps of a replay
/// Delay of the rate behind a slow and a slower valve.
constexpr double kLateByLags_s[] = {0.05, 0.08};

/// Lower bounds of frequencies. Slower oscillations last as long as the motion between two changes
/// of a lever.
constexpr double kSlowestRing_radps = 3, kSlowestFlex_radps = 2;

/// Least time in which an axis moves together with other functions of its pump.
constexpr double kLeastTogether_s = 2;
constexpr double kMostBent_rad = 0.5;  ///< largest deflection of a flexible link

/// Rates and loads of an axis in the log, as bounds on the sizes of candidates.
struct Reach {
  double full_rate_radps = 0, slower_rate_radps = 0;  ///< `slower`: in the slower direction
  double largest_load_nm = 0;
  double lowest_rad = 0, highest_rad = 0;
  bool is_joint = false, has_stops = false, has_cylinder = false;
  /// Nyquist frequency of the samples; faster oscillations alias (Shannon 1949)
  double nyquist_radps = 0;
};

double Interval_s(const MeasuredRate& measured, double step_s) {
  std::vector<double> interval_s;
  for (std::size_t k = 1; k < measured.at_step.size(); ++k) {
    interval_s.push_back((measured.at_step[k] - measured.at_step[k - 1]) * step_s);
  }
  if (interval_s.empty()) return std::numeric_limits<double>::infinity();
  return Median(std::move(interval_s));
}

Reach ReachOf(const MachineModel& model, const AxisLog& log, const MeasuredRate& measured) {
  const std::size_t axis = measured.axis;
  Reach reach;
  reach.is_joint = axis < model.joints.size();
  if (reach.is_joint) {
    const Joint& joint = model.joints[axis];
    reach.full_rate_radps = std::max(joint.max_rate_positive_radps, joint.max_rate_negative_radps);
    reach.slower_rate_radps =
        std::min(joint.max_rate_positive_radps, joint.max_rate_negative_radps);
    if (reach.slower_rate_radps == 0) reach.slower_rate_radps = reach.full_rate_radps;
    reach.has_stops = joint.type != JointType::kContinuous && joint.lower_rad < joint.upper_rad;
    for (const Cylinder& cylinder : model.cylinders) {
      reach.has_cylinder = reach.has_cylinder || cylinder.joint == static_cast<int>(axis);
    }
  } else {
    reach.full_rate_radps = model.gear_drives[axis - model.joints.size()].max_rate_radps;
    reach.slower_rate_radps = reach.full_rate_radps;
  }
  reach.nyquist_radps = std::numbers::pi / Interval_s(measured, log.step_s);
  reach.lowest_rad = reach.highest_rad = log.motion[axis].position_rad;
  for (std::size_t k = 0; k < log.steps; ++k) {
    const AxisMotion& motion = log.motion[k * log.axes + axis];
    reach.largest_load_nm = std::max(reach.largest_load_nm, std::abs(motion.load_nm));
    reach.lowest_rad = std::min(reach.lowest_rad, motion.position_rad);
    reach.highest_rad = std::max(reach.highest_rad, motion.position_rad);
  }
  return reach;
}

/// Possible delays between a reading of the lever and the change of rate: the measurement's delay
/// in single steps, and longer delays of drives that lag.
std::vector<double> Latenesses_s(double step_s) {
  const long most = std::min(std::lround(kLateToMeasure_s / step_s), kMostStepsToMeasure);
  std::vector<double> late_s;
  for (long steps = 0; steps <= most; ++steps) late_s.push_back(steps * step_s);
  late_s.insert(late_s.end(), std::begin(kLateByLags_s), std::end(kLateByLags_s));
  return late_s;
}

/// Starting values for a controller that reads the lever periodically (`input_hold`). The
/// likelihood has too narrow a peak for a blind search. Therefore periods in the changes of the
/// rate are starting values. A lag delays the apparent phase, which must be right to one step of
/// the replay.
std::vector<std::vector<double>> HoldStarts(const AxisLog& log, std::size_t axis) {
  std::vector<std::vector<double>> starts = {{0.05, 0.0}, {0.1, 0.0},  {0.1, 0.5},
                                             {0.2, 0.0},  {0.2, 0.33}, {0.2, 0.67}};
  for (const MeasuredRate& measured : log.measured) {
    if (measured.axis != axis) continue;
    std::vector<double> t_s;
    for (const double step : measured.at_step) t_s.push_back(step * log.step_s);
    for (const Beat& beat : BeatsOf(t_s, measured.rate_radps, {})) {
      for (const double late_s : Latenesses_s(log.step_s)) {
        const double phase = beat.phase - late_s / beat.period_s;
        starts.push_back({beat.period_s, phase - std::floor(phase)});
      }
    }
  }
  return starts;
}

void AddTimingAndMap(const std::vector<std::vector<double>>& holds, double step_s,
                     CandidateList* out) {
  // A fractional delay splits a command between two steps. The spread starts above zero, because a
  // small change from zero has no effect.
  out->Add("command_delay",
           {{.index = 0, .upper = kLongestDelay_s, .kink = step_s / kLongestDelay_s},
            {.index = 1, .upper = 0.2, .refines = true}},
           {{0.04, 0.008}, {0.1, 0.02}, {0.2, 0.04}, {0.35, 0.07}});
  out->Add("input_hold", {{0, 0.02, 0.6, true}, {1, 0, 1, false, kKinkOfInstants}}, holds);
  out->Add("lever_saturation",
           {{0, 0.2, 1}, {.index = 1, .lower = -0.5, .upper = 0.5, .refines = true}},
           {{0.9, 0}, {0.75, 0}, {0.6, 0}});
  out->Add("dead_band", {{0, 0, 0.8}, {1, -0.9, 0.9}},
           {{0.03, 0}, {0.08, 0}, {0.15, 0}, {0.25, 0}, {0.4, 0}});
  out->Add("valve_curve", {{0, 0.4, 3, true}}, {{1.2}, {1.5}, {2}, {0.8}});
  out->Add("asymmetric_gain", {{0, 0.3, 3, true}}, {{1.2}, {1.5}, {1.9}, {0.7}});
  out->Add("rate_gain", {{0, 0.3, 4}}, {{0.9}, {1.15}, {0.75}, {2}});
}

/// True if the oscillation is still visible when it swings back. Otherwise it is a lag or an
/// overshoot.
bool Swings(const std::vector<double>& ring) {
  const double eta_radps = ring[0], beta_1ps = ring[1];
  return beta_1ps < eta_radps;
}

/// Limits the first number of each start, a frequency, to `most`. Removes duplicates.
std::vector<std::vector<double>> StartsUpTo(double most,
                                            const std::vector<std::vector<double>>& starts) {
  std::vector<std::vector<double>> kept;
  for (std::vector<double> start : starts) {
    start[0] = std::min(start[0], most);
    if (std::find(kept.begin(), kept.end(), start) == kept.end()) kept.push_back(std::move(start));
  }
  return kept;
}

/// Adds the candidates of the actuator slot. A lag shorter than a step is not observable.
void AddActuator(const Reach& reach, double step_s, CandidateList* out) {
  const double w = reach.full_rate_radps;
  out->Add("actuator_lag", {{0, step_s, 1.5}, {.index = 1, .refines = true}},
           {{0.05, 0}, {0.12, 0}, {0.25, 0}, {0.5, 0}});
  // A wider band, or a limit that rarely acts, would imitate a lag.
  out->Add(
      "rate_limit",
      {{0, w / 5, w / kShortestRise_s, true}, {.index = 1, .upper = 2 * step_s, .refines = true}},
      {{w / 0.1, 0}, {w / 0.3, 0}, {w / 1, 0}});
  if (reach.nyquist_radps > kSlowestRing_radps) {
    const double most = std::min(60.0, reach.nyquist_radps);
    Candidate& ring = out->Add(
        "actuator_ring", {{0, kSlowestRing_radps, most, true}, {1, 0.5, 30, true}, {2, -1.5, 1.5}},
        StartsUpTo(most, {{20, 6, 0}, {12, 4, 0}, {28, 8, 0}, {8, 3, 0}}));
    ring.is_itself = Swings;
  }
  if (reach.has_stops) {
    out->Add("end_cushion", {{0, 0.02, 0.6, true}, {1, 0.02, 0.9}}, {{0.08, 0.3}, {0.2, 0.2}});
  }
}

void AddGainAndLoad(const Reach& reach, CandidateList* out) {
  const double low = reach.lowest_rad, high = reach.highest_rad;
  if (reach.has_cylinder && low < high) {
    out->Add("cylinder_lever", {{3, low, high}},
             {{0, 0, 0, 0.5 * (low + high)},
              {0, 0, 0, 0.8 * low + 0.2 * high},
              {0, 0, 0, 0.2 * low + 0.8 * high}});
  }
  // Less friction would imitate a lag. With more friction, full levers would not move the axis.
  const double w = reach.slower_rate_radps;
  out->Add("drive_friction",
           {{.index = 0,
             .lower = 0.01 * w,
             .upper = 0.25 * w,
             .logarithmic = true,
             .expected = Expected{0, kFrictionTolerance * reach.full_rate_radps}},
            {1, 0, 0.5},
            {.index = 2, .lower = 1, .upper = 2.5, .refines = true}},
           {{0.03 * w, 0.02, 1, 0.02},
            {0.08 * w, 0.08, 1, 0.02},
            {0.2 * w, 0.08, 1, 0.02},
            {0.1 * w, 0.08, 2, 0.02}});
  out->Add("backlash", {{0, 5e-4, 0.15, true, kKinkOfInstants}}, {{0.004}, {0.015}, {0.04}});
  const double load = reach.largest_load_nm;
  if (load <= 0) return;
  // The stall load may be below the largest load. The axis then cannot raise this load.
  out->Add("pressure_droop", {{0, 0.5 * load, 30 * load, true}, {1, 0, 0.5}},
           {{8 * load, 0.05}, {3 * load, 0.05}, {1.5 * load, 0.05}});
  out->Add("sag", {{0, 2e-4, 0.15, true}}, {{0.003, 40}, {0.01, 40}, {0.04, 40}});
  if (reach.is_joint && reach.nyquist_radps > kSlowestFlex_radps) {
    const double most = std::min(80.0, reach.nyquist_radps);
    // Steel and oil oscillate. A higher damping would imitate a lag.
    out->Add("structural_flex",
             {{0, kSlowestFlex_radps, most, true},
              {1, 0.01, 0.5},
              {.index = 2, .upper = std::min(1.0, kMostBent_rad / load), .refines = true}},
             StartsUpTo(most, {{30, 0.1, 0}, {12, 0.1, 0}, {6, 0.1, 0}, {12, 0.4, 0}}));
  }
}

/// Flow candidates of the pump, with bounds from the total demand while functions move together.
std::vector<Candidate> CandidatesOfPump(const MachineModel& model, const PumpDemand& demand) {
  if (demand.together_s < kLeastTogether_s) return {};
  const Pump& pump = model.pumps[demand.pump];
  CandidateList out(pump.name, EffectTarget::kPump, EffectsAt(model.effects.pumps, demand.pump),
                    ActuationMechanisms());
  const double most = std::min(5.0, demand.most_m3ps / pump.max_flow_m3ps);
  if (most > 0.2) {
    out.Add("flow_sharing", {{0, 0.05, most}},
            {{0.9 * most}, {0.75 * most}, {0.6 * most}, {0.45 * most}});
  }
  const double w = demand.most_w;
  if (w > 10) {
    out.Add("power_limit", {{0, 0.1 * w, w}}, {{0.85 * w, 0.1}, {0.65 * w, 0.1}, {0.4 * w, 0.1}});
  }
  return out.Take();
}

CandidateList ListOf(const MachineModel& model, std::size_t axis) {
  const std::size_t joints = model.joints.size();
  if (axis < joints) {
    return {model.joints[axis].name, EffectTarget::kJoint, EffectsAt(model.effects.joints, axis),
            ActuationMechanisms()};
  }
  return {model.ground_tools.gears[axis - joints].name, EffectTarget::kGear,
          EffectsAt(model.effects.gears, axis - joints), ActuationMechanisms()};
}

}  // namespace

std::vector<Candidate> LossOfAxis(const MachineModel& model, std::size_t axis) {
  CandidateList out = ListOf(model, axis);
  out.Add("command_drops", {{0, 0.02, 2, true}, {1, 0, 1}}, {{0.1, 0.05}});
  return out.Take();
}

std::vector<Candidate> CandidatesOfAxis(const MachineModel& model, const AxisLog& log,
                                        const MeasuredRate& measured,
                                        const std::optional<PumpDemand>& pump) {
  const std::size_t axis = measured.axis;
  const Reach reach = ReachOf(model, log, measured);
  CandidateList out = ListOf(model, axis);
  AddTimingAndMap(HoldStarts(log, axis), log.step_s, &out);
  AddActuator(reach, log.step_s, &out);
  AddGainAndLoad(reach, &out);
  std::vector<Candidate> candidates = out.Take();
  if (pump) {
    for (Candidate& candidate : CandidatesOfPump(model, *pump))
      candidates.push_back(std::move(candidate));
  }
  return candidates;
}

}  // namespace tera
