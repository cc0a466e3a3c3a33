#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "core/types/learned_effect.h"
#include "physics/description/machine.h"

namespace tera {

/// Direction of the last motion of a lever, -1 or 1; 0 at neutral.
///
/// Model   A hysteresis of 0.01 suppresses the tremor of a held lever: only motion of more than
///         0.01 from the followed position counts.
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

/// Inputs of a learned effect over a step, apart from the rate. The lever is that of the axis of
/// the effect's variable. Position and load are those of the affected axis.
struct LearnedInput {
  double lever = 0, position_rad = 0, load_nm = 0, time_s = 0;
};

/// A learned effect at the end of the chain of an axis, after load_friction.
///
/// Model   As a share, w' = w (1 + c(x)) with c >= -1. As an addition, w' = w + c(x) with |c| <=
///         |w|. So a learned effect can stop the axis but never reverse it, and an axis at rest
///         stays at rest.
/// Omits   Oil and power of the changed rate: the pumps share their flow earlier in the chain.
class LearnedRate {
 public:
  explicit LearnedRate(LearnedEffect effect) : effect_(std::move(effect)) {}

  bool ReadsLoad() const { return effect_.variable.kind == LearnedVariable::Kind::kLoad; }
  std::size_t lever_axis() const { return effect_.variable.axis; }
  /// Corrected rate for `rate_radps`, the output of the rest of the chain.
  double Step(double rate_radps, const LearnedInput& input);

 private:
  LearnedEffect effect_;
  LeverWay way_;
};

/// Variables that a learned effect of an axis (joints first, then gears) may depend on. Both
/// simulation and replay know them. They are the levers of all axes and their directions, the
/// axis's own position, load and rate, and the time since the start of the scenario.
std::vector<LearnedVariable> LearnedVariablesOf(const MachineModel& model, std::size_t axis);

/// The learned effect of an axis, or nullptr.
const LearnedEffect* LearnedAt(const MachineEffects& effects, std::size_t axis);

}  // namespace tera
