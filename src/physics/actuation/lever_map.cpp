#include "physics/actuation/lever_map.h"

#include <algorithm>
#include <cmath>

namespace tera {

LeverMapParameters LeverMapOf(const Effects& effects) {
  LeverMapParameters parameters;
  if (const Effect* saturation = FindEffect(effects, "lever_saturation")) {
    parameters.limit_positive = (*saturation)["limit"] * (1 + (*saturation)["asymmetry"]);
    parameters.limit_negative = (*saturation)["limit"] * (1 - (*saturation)["asymmetry"]);
  }
  if (const Effect* band = FindEffect(effects, "dead_band")) {
    parameters.dead_positive = (*band)["width"] * (1 + (*band)["asymmetry"]);
    parameters.dead_negative = (*band)["width"] * (1 - (*band)["asymmetry"]);
  }
  if (const Effect* curve = FindEffect(effects, "valve_curve")) {
    parameters.exponent = (*curve)["exponent"];
  }
  if (const Effect* asymmetry = FindEffect(effects, "asymmetric_gain")) {
    parameters.negative_gain = (*asymmetry)["ratio"];
  }
  if (const Effect* gain = FindEffect(effects, "rate_gain")) {
    parameters.positive_gain *= (*gain)["gain"];
    parameters.negative_gain *= (*gain)["gain"];
  }
  return parameters;
}

double MapLever(const LeverMapParameters& parameters, double u) {
  double y = std::clamp(u, -parameters.limit_negative, parameters.limit_positive);
  y = y > 0 ? std::max(0.0, y - parameters.dead_positive)
            : std::min(0.0, y + parameters.dead_negative);
  if (parameters.exponent != 1) y = std::copysign(std::pow(std::abs(y), parameters.exponent), y);
  return y * (y > 0 ? parameters.positive_gain : parameters.negative_gain);
}

}  // namespace tera
