#include "sensors/slots/mechanism_rows.h"

namespace tera {

EffectParameters Alike(const std::vector<std::string_view>& names, std::string_view unit,
                       double lower, double upper, double otherwise) {
  EffectParameters parameters;
  for (const std::string_view name : names) {
    parameters.push_back({name, unit, lower, upper, otherwise});
  }
  return parameters;
}

EffectParameters Joined(std::initializer_list<EffectParameters> parts) {
  EffectParameters all;
  for (const EffectParameters& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

EffectParameters ShiftParameters() { return Alike({"x_m", "y_m", "z_m"}, "m", -20, 20, 0); }

EffectParameters TurnParameters() {
  return Alike({"roll_deg", "pitch_deg", "yaw_deg"}, "deg", -180, 180, 0);
}

EffectParameters WarmUpParameters() {
  return {{"warm_up_k", "K", -100, 100, 30}, {"time_constant_s", "s", 1, 1e5, 600}};
}

EffectParameters ProbabilityParameter() { return {{"probability", "1", 0, 1, {}}}; }

}  // namespace tera
