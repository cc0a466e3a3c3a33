#pragma once

#include <initializer_list>
#include <string_view>
#include <vector>

#include "core/types/effects.h"

/// Parts of the rows that kinds of sensors write about their mechanisms.

namespace tera {

using EffectParameters = std::vector<EffectParameter>;

/// One range for several names, all ideal unless stated otherwise.
EffectParameters Alike(const std::vector<std::string_view>& names, std::string_view unit,
                       double lower, double upper, double otherwise);

EffectParameters Joined(std::initializer_list<EffectParameters> parts);

/// How far and by how much the true place differs from the documented one.
EffectParameters ShiftParameters();
EffectParameters TurnParameters();

/// How a sensor warms up, `temperature_drift`.
EffectParameters WarmUpParameters();

/// How often a measurement is wild, `outliers`.
EffectParameters ProbabilityParameter();

}  // namespace tera
