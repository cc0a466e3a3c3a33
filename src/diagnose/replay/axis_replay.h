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

  /// Nominal numbers of the axis, as factors on those of its model.
  struct Nominal {
    double rate = 1, effort = 1;
  };

  /// Rates at the measured rate's times, or the first `most` of them, with `effects` in place of
  /// the model's.
  std::vector<double> Predict(const AxisEffects& effects, const Nominal& nominal,
                              std::size_t most = std::numeric_limits<std::size_t>::max()) const;
  std::vector<double> Predict(const AxisEffects& effects) const {
    return Predict(effects, Nominal());
  }

  /// For each of the measured rate's times, whether full effort is too weak to accelerate the
  /// masses as demanded, at that time or since the previous one.
  std::vector<bool> FallsShort(const AxisEffects& effects, const Nominal& nominal) const;

  /// The same, with `learned` in place of the model's learned effect.
  AxisReplay With(const LearnedEffect& learned) const;

  /// The model's effects.
  AxisEffects effects() const;
  const std::optional<PumpDemand>& pump() const { return pump_; }

 private:
  /// The drive's demanded rate at the end of a step, and the resulting rate.
  struct Rates {
    double asked_radps = 0, rate_radps = 0;
  };
  /// Replays the first `steps`; `take` gets each step's number and rates.
  template <typename Take>
  void Run(const AxisEffects& effects, const Nominal& nominal, std::size_t steps,
           const Take& take) const;
  std::size_t StepsTo(std::size_t samples) const;

  MachineModel model_;
  std::size_t axis_ = 0;
  std::size_t axes_ = 0;
  double step_s_ = 0;
  std::vector<double> lever_, at_step_;
  std::vector<double> levers_;  ///< of all axes, steps x axes
  std::vector<AxisMotion> motion_;
  std::vector<double> change_radpspnm_;  ///< change of rate per step and effort; 0: no inertia
  std::optional<PumpDemand> pump_;
};

}  // namespace tera
