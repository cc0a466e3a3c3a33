#pragma once

#include <span>
#include <string_view>

#include "core/config/config.h"
#include "core/types/effects.h"

namespace tera {

/// The parameters of one quantity's quantisation and saturation.
struct StepAndLimit {
  std::string_view step, limit;
};

/// Reports steps of quantisation beyond the limit of saturation: what is clipped would round to
/// zero, or to more than the limit. At the one of both that `config` has.
void CheckSteps(const ConfigMap& config, const Effects& effects,
                std::span<const StepAndLimit> quantities);

}  // namespace tera
