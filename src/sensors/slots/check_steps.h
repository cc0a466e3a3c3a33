#pragma once

#include <span>
#include <string_view>

#include "core/config/config.h"
#include "core/types/effects.h"

namespace tera {

/// Parameters of quantisation and saturation of one quantity.
struct StepAndLimit {
  std::string_view step, limit;
};

/// Reports quantisation steps above the saturation limit, which leave no value in between. The
/// fault goes to the parameter that `config` contains.
void CheckSteps(const ConfigMap& config, const Effects& effects,
                std::span<const StepAndLimit> quantities);

}  // namespace tera
