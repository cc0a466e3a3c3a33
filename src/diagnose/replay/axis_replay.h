#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "diagnose/replay/axis_log.h"
#include "diagnose/replay/pump_demand.h"

namespace tera {

/// Effects of an axis, and of the pump that feeds it.
struct AxisEffects {
  Effects axis, pump;
};

/// The actuation chain of one axis alone, driven by recorded levers at measured positions and
/// loads. Gives the rates that a joint or gear with other effects would have had at these
/// positions. Errors stay where they arise and do not drift.
///
/// Model   Actuation over the steps of the log. A joint follows its drive's demand, limited by the
///         acceleration of the links beyond it under full effort minus load. The demand of the
///         pump's other functions is fixed (pump_demand.h). An axis fed by several pumps gets its
///         full demand.
/// Omits   joints that the ground or their end stops support; the inertia of other joints that move
///         or yield and of the gears; limits of effort by position and direction; `payload`, whose
///         weight is not in the log's loads; the messages lost by `command_drops`, which draws its
///         own.
class AxisReplay {
 public:
  /// The chain of the axis of one of the log's measured rates, or of some of its samples. Copies
  /// what it needs of all arguments.
  AxisReplay(const MachineModel& model, const AxisLog& log, const MeasuredRate& measured);

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

  /// The same, with `learned` in place of the model's learned effect.
  AxisReplay With(const LearnedEffect& learned) const;

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
