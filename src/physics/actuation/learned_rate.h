#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "core/types/learned_effect.h"
#include "physics/description/machine.h"

namespace tera {

/// Direction of a lever's last motion, -1 or 1; 0 at neutral.
///
/// Model   hysteresis of 0.01 against the tremor of a held lever: a motion counts where the lever
///         is more than 0.01 from the followed position.
class LeverWay {
 public:
  double Step(double lever) {
    if (std::abs(lever - followed_) > kTremor) {
      way_ = lever > followed_ ? 1 : -1;
      followed_ = lever - way_ * kTremor;
    }
    return std::abs(lever) <= kTremor ? 0 : way_;
  }

 private:
  static constexpr double kTremor = 0.01;
  double followed_ = 0, way_ = 0;
};

/// Inputs of a learned effect over a step, apart from the rate. The lever is that of the variable's
/// axis; position and load are those of the affected axis.
struct LearnedInput {
  double lever = 0, position_rad = 0, load_nm = 0, time_s = 0;
};

/// A learned effect at the end of an axis's chain, after load_friction.
///
/// Model   share: w' = w (1 + c(x)), c >= -1; added: w' = w + c(x), |c| <= |w|. A learned effect
///         can therefore stop the axis but never reverse it. An axis at rest, as under neutral
///         levers, stays at rest.
/// Omits   oil and power, which the pumps share out earlier.
class LearnedRate {
 public:
  explicit LearnedRate(LearnedEffect effect) : effect_(std::move(effect)) {}

  bool ReadsLoad() const { return effect_.variable.kind == LearnedVariable::Kind::kLoad; }
  std::size_t lever_axis() const { return effect_.variable.axis; }
  /// Corrected rate for `rate_radps`, the demand of the rest of the chain over a step.
  double Step(double rate_radps, const LearnedInput& input);

 private:
  LearnedEffect effect_;
  LeverWay way_;
};

/// Variables that a learned effect of an axis (joints first, then gears) may depend on. Simulation
/// and replay both know them: levers of all axes and their directions; the axis's own position,
/// load and rate; time since the start of the scenario.
std::vector<LearnedVariable> LearnedVariablesOf(const MachineModel& model, std::size_t axis);

/// The learned effect of an axis, or nullptr.
const LearnedEffect* LearnedAt(const MachineEffects& effects, std::size_t axis);

}  // namespace tera
