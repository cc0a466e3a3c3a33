#pragma once

#include <span>
#include <string_view>

#include "core/config/config.h"
#include "core/types/effects.h"

namespace tera {

/// Parameters of one quantity's quantisation and saturation.
struct StepAndLimit {
  std::string_view step, limit;
};

/// Reports quantisation steps above the saturation limit: clipped values would round to zero or
/// beyond the limit. The fault refers to the parameter that `config` contains.
void CheckSteps(const ConfigMap& config, const Effects& effects,
                std::span<const StepAndLimit> quantities);

}  // namespace tera
