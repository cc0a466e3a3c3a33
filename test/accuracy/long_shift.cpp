#include "accuracy/long_shift.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace tera {
namespace {

bool AllFinite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

bool IsFinite(const BodyState& link) {
  return link.X_WB.matrix().allFinite() && link.v_WB_mps.allFinite() &&
         link.w_WB_radps.allFinite() && link.a_WB_mps2.allFinite();
}

bool IsFinite(const CylinderState& c) {
  return AllFinite(
      {c.length_m, c.stroke_m, c.rate_mps, c.force_n, c.head_pressure_pa, c.rod_pressure_pa});
}

bool IsFinite(const SoilReaction::Load& load) {
  return std::isfinite(load.mass_kg) && load.com_B_m.allFinite() && std::isfinite(load.volume_m3) &&
         AllFinite(load.soil_kg);
}

template <typename T>
bool AllAreFinite(const std::vector<T>& parts) {
  return std::all_of(parts.begin(), parts.end(), [](const T& part) { return IsFinite(part); });
}

}  // namespace

double FromEnvironment(const char* name, double usual) {
  const char* given = std::getenv(name);
  return given ? std::atof(given) : usual;
}

bool IsFinite(const MachineState& state) {
  for (const auto& axes :
       {state.q_rad, state.qd_radps, state.effort_nm, state.friction_nm, state.gear_angle_rad,
        state.gear_rate_radps, state.gear_torque_nm, state.gear_friction_nm, state.levers,
        state.gear_sinkage_m, state.gear_slip}) {
    if (!AllFinite(axes)) return false;
  }
  return AllAreFinite(state.links) && AllAreFinite(state.shovel_load) &&
         AllAreFinite(state.cylinders);
}

double Tilt_rad(const MachineState& state) {
  return std::acos(std::clamp(state.links[0].X_WB.linear()(2, 2), -1.0, 1.0));
}

}  // namespace tera
