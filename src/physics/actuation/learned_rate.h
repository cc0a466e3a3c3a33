#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "core/types/learned_effect.h"
#include "physics/description/machine.h"

namespace tera {

/// The way in which a lever moved last, -1 or 1; 0 at neutral.
///
/// Model   a held lever trembles: it has moved where it is more than 0.01 from where it was
///         followed to.
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

/// What a learned effect of an axis may depend on over a step, its rate aside. The lever is that of
/// the variable's axis, all else is of the axis that the effect acts on.
struct LearnedInput {
  double lever = 0, position_rad = 0, load_nm = 0, time_s = 0;
};

/// A learned effect at the end of an axis's chain, behind load_friction.
///
/// Model   share: w' = w (1 + c(x)), c >= -1; added: w' = w + c(x), but c no more than |w| either
///         way. So what a learned effect takes at most stops the axis and never turns it back, and
///         what stands still without it, as under neutral levers, stands still with it.
/// Omits   oil and power, which the pumps share out before it.
class LearnedRate {
 public:
  explicit LearnedRate(LearnedEffect effect) : effect_(std::move(effect)) {}

  bool ReadsLoad() const { return effect_.variable.kind == LearnedVariable::Kind::kLoad; }
  std::size_t lever_axis() const { return effect_.variable.axis; }
  /// What becomes of `rate_radps`, which the rest of the chain asks for over a step.
  double Step(double rate_radps, const LearnedInput& input);

 private:
  LearnedEffect effect_;
  LeverWay way_;
};

/// The variables that a learned effect of an axis (joints first, then gears) may depend on, as a
/// simulation and a replay know them: levers of all axes and their ways; its own position, load and
/// rate; time from the start of the scenario.
std::vector<LearnedVariable> LearnedVariablesOf(const MachineModel& model, std::size_t axis);

/// The learned effect of an axis, or nullptr.
const LearnedEffect* LearnedAt(const MachineEffects& effects, std::size_t axis);

}  // namespace tera
