#pragma once

#include <initializer_list>
#include <string_view>
#include <vector>

#include "core/types/effects.h"

/// Common parts of the mechanism tables of sensor kinds.

namespace tera {

using EffectParameters = std::vector<EffectParameter>;

/// Parameters with common unit, range and ideal value `otherwise`.
EffectParameters Alike(const std::vector<std::string_view>& names, std::string_view unit,
                       double lower, double upper, double otherwise);

EffectParameters Joined(std::initializer_list<EffectParameters> parts);

/// Parameters of the translation and rotation from the documented to the true mounting.
EffectParameters ShiftParameters();
EffectParameters TurnParameters();

/// Parameters of the warm-up of a sensor, `temperature_drift`.
EffectParameters WarmUpParameters();

/// Probability of an outlier, `outliers`.
EffectParameters ProbabilityParameter();

}  // namespace tera
