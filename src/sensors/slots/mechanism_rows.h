#pragma once

#include <initializer_list>
#include <string_view>
#include <vector>

#include "core/types/effects.h"

/// Common parts of the mechanism tables of sensor kinds.

namespace tera {

using EffectParameters = std::vector<EffectParameter>;

/// Parameters with a common range and the ideal value `otherwise`.
EffectParameters Alike(const std::vector<std::string_view>& names, std::string_view unit,
                       double lower, double upper, double otherwise);

EffectParameters Joined(std::initializer_list<EffectParameters> parts);

/// Translation and rotation between the true and the documented mounting.
EffectParameters ShiftParameters();
EffectParameters TurnParameters();

/// Warm-up of a sensor, `temperature_drift`.
EffectParameters WarmUpParameters();

/// Probability of an outlier, `outliers`.
EffectParameters ProbabilityParameter();

}  // namespace tera
