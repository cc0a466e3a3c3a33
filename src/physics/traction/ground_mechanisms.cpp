#include "physics/traction/ground_mechanisms.h"

#include <vector>

namespace tera {
namespace {

std::vector<Mechanism> Library() {
  const auto base = [](std::string_view id, std::vector<EffectParameter> parameters) {
    return Mechanism{id, Slot::kGround, {EffectTarget::kBase}, std::move(parameters)};
  };
  constexpr double kFarthest_m = 1e5;  // larger than any site
  return {
      base("track_scale", {{"scale", "1", 0.5, 1.5, {}}}),
      base("track_asymmetry", {{"difference", "1", -0.5, 0.5, {}}}),
      base("track_slip", {{"slip", "1", -0.5, 0.95, 0.0},
                          {"shear_modulus_m", "m", 0, 0.5, 0.0},
                          {"friction", "1", 0.05, 2, 0.7},
                          {"turn_slip", "1", 0, 1, 0.0}}),
      base("slope_slip", {{"slip", "1", -0.5, 0.95, 0.0}, {"slip_per_slope", "1", -5, 5, {}}}),
      base("side_slip", {{"drift_per_slope", "1", -5, 5, {}}}),
      base("effective_gauge", {{"ratio", "1", 0.5, 5, {}}}),
      base("icr_shift", {{"forward_m", "m", -5, 5, 0.0}, {"left_m", "m", -5, 5, 0.0}}),
      base("rolling_resistance",
           {{"coefficient", "1", 0, 0.5, {}}, {"slip_stiffness", "1", 1, 1000, 25.0}}),
      base("digging_force", {{"yield_mps", "m/s", 0, 5, {}}, {"holding", "1", 0, 2, 0.0}}),
      base("soil_strength", {{"strength", "1", 0.1, 10, 1.0}, {"stiffness", "1", 0.1, 10, 1.0}}),
      base("terrain_height", {{"x_m", "m", -kFarthest_m, kFarthest_m, {}},
                              {"y_m", "m", -kFarthest_m, kFarthest_m, {}},
                              {"radius_m", "m", 0, kFarthest_m, {}},
                              {"height_m", "m", -5, 5, {}},
                              {"edge_m", "m", 0.1, 100, 1.0}}),
  };
}

}  // namespace

std::span<const Mechanism> GroundMechanisms() {
  static const std::vector<Mechanism> library = Library();
  return library;
}

}  // namespace tera
