#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "diagnose/replay/axis_log.h"
#include "diagnose/replay/pump_demand.h"

namespace tera {

/// Replays the actuation chain of every axis, without the rest of the machine. Inputs are the
/// recorded levers and the measured positions and loads. Outputs are the rates that joints and
/// running gears with other effects would have had. The replay uses measured positions, so errors
/// stay where they arise and do not accumulate.
///
/// Model   Actuation runs over the steps of the log. A joint follows the rate that its drive
///         demands. Full effort minus load, over the inertia of the links beyond the joint, limits
///         the joint's acceleration.
/// Omits   Joints that the ground or their end stops support; the inertia of other joints and of
///         the gears; limits of effort by position and direction; `payload`, whose weight is not in
///         the log's loads; the real losses of `command_drops`, which draws its own.
class AxisReplay {
 public:
  /// `model` and `log` must outlive this object.
  AxisReplay(const MachineModel& model, const AxisLog& log) : model_(model), log_(log) {}

  /// Rates with `effects` in place of the model's. Returns one list per measured rate of the log,
  /// at its times.
  std::vector<std::vector<double>> Predict(const MachineEffects& effects) const;

 private:
  const MachineModel& model_;
  const AxisLog& log_;
};

/// Effects of one axis and of the pump that feeds it.
struct AxisEffects {
  Effects axis, pump;
};

/// Replays the actuation chain of one axis, fast enough for the thousands of evaluations of a
/// search. The demand of the pump's other functions is fixed (pump_demand.h). An axis with several
/// pumps always gets its full demand.
class LoneAxisReplay {
 public:
  /// `measured` is one of the log's measured rates, or a subset of its samples. The object copies
  /// what it needs of all arguments.
  LoneAxisReplay(const MachineModel& model, const AxisLog& log, const MeasuredRate& measured);

  /// Factors on the nominal numbers of the axis: rate at full lever, full effort.
  struct Nominal {
    double rate = 1, effort = 1;
  };

  /// Rates with `effects` in place of the model's, at the times of the measured rate or at the
  /// first `most` of these times.
  std::vector<double> Predict(const AxisEffects& effects, const Nominal& nominal,
                              std::size_t most = std::numeric_limits<std::size_t>::max()) const;
  std::vector<double> Predict(const AxisEffects& effects) const {
    return Predict(effects, Nominal());
  }

  /// One flag per time of the measured rate: true if full effort could not reach the demanded rate
  /// at that time, or since the previous one.
  std::vector<bool> FallsShort(const AxisEffects& effects, const Nominal& nominal) const;

  /// A copy with `learned` as the axis's learned effect.
  LoneAxisReplay With(const LearnedEffect& learned) const;

  /// Effects of the axis and its pump in the model.
  AxisEffects effects() const;
  const std::optional<PumpDemand>& pump() const { return pump_; }

 private:
  /// Rate that the drive demands at the end of a step, and the rate that results.
  struct Rates {
    double asked_radps = 0, rate_radps = 0;
  };
  /// Replays the first `steps`. `take` receives the number and rates of each step.
  template <typename Take>
  void Run(const AxisEffects& effects, const Nominal& nominal, std::size_t steps,
           const Take& take) const;
  std::size_t StepsTo(std::size_t samples) const;

  MachineModel model_;
  std::size_t axis_ = 0;
  std::size_t axes_ = 0;
  double step_s_ = 0;
  std::vector<double> lever_, at_step_;
  std::vector<double> levers_;  ///< levers of all axes, steps x axes
  std::vector<AxisMotion> motion_;
  /// Rate change per step and unit of effort; 0: inertia unknown.
  std::vector<double> change_radpspnm_;
  std::optional<PumpDemand> pump_;
};

}  // namespace tera
