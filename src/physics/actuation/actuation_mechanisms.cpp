#include "physics/actuation/actuation_mechanisms.h"

#include <vector>

#include "core/units.h"

namespace tera {
namespace {

using enum Slot;

/// The ranges exceed those of known machines (docs/reference/mechanisms.md). So a fit to recorded
/// data does not stop at a bound.
std::vector<Mechanism> Table() {
  const std::vector<EffectTarget> drives = {EffectTarget::kJoint, EffectTarget::kGear},
                                  joint = {EffectTarget::kJoint}, pump = {EffectTarget::kPump};
  return {
      {"command_delay",
       kCommandTiming,
       drives,
       {{"delay_s", "s", 0, 2, {}}, {"spread_s", "s", 0, 0.5, 0.0}}},
      {"input_hold",
       kCommandTiming,
       drives,
       {{"period_s", "s", 1e-3, 5, {}}, {"phase", "1", 0, 1, 0.0}}},
      {"command_drops",
       kCommandTiming,
       drives,
       {{"period_s", "s", 1e-3, 5, {}}, {"probability", "1", 0, 1, {}}}},
      {"lever_saturation",
       kLeverMap,
       drives,
       {{"limit", "1", 0.05, 1, {}}, {"asymmetry", "1", -0.9, 0.9, 0.0}}},
      {"dead_band",
       kLeverMap,
       drives,
       {{"width", "1", 0, 0.9, {}}, {"asymmetry", "1", -1, 1, 0.0}}},
      {"valve_curve", kLeverMap, drives, {{"exponent", "1", 0.3, 5, {}}}},
      {"asymmetric_gain", kLeverMap, drives, {{"ratio", "1", 0.2, 5, {}}}},
      {"rate_gain", kLeverMap, drives, {{"gain", "1", 0, 5, {}}}},
      {"flow_sharing", kFlow, pump, {{"capacity", "1", 0.05, 5, 1.0}}},
      {"power_limit", kFlow, pump, {{"power_w", "W", 1, 1e7, {}}, {"regulator_s", "s", 0, 2, 0.1}}},
      {"rate_limit",
       kActuator,
       drives,
       {{"max_change_radps2", "rad/s2", 1e-3, 1e4, {}}, {"band_s", "s", 0, 1, 0.0}}},
      {"actuator_lag",
       kActuator,
       drives,
       {{"time_s", "s", 0, 5, {}}, {"pilot_ratio", "1", 0, 1, 0.0}}},
      {"actuator_ring",
       kActuator,
       drives,
       {{"eta_radps", "rad/s", 0, 200, 20.0},
        {"beta_1ps", "1/s", 0.01, 200, 6.0},
        {"phi_rad", "rad", -kPi, kPi, 0.0}}},
      {"end_cushion",
       kActuator,
       joint,
       {{"zone_rad", "rad", 1e-4, 2, {}}, {"end_ratio", "1", 0.01, 1, 0.2}}},
      {"cylinder_lever",
       kKinematicGain,
       joint,
       {{"barrel_m", "m", 0, 20, 0.0},
        {"rod_m", "m", 0, 20, 0.0},
        {"angle_at_zero_rad", "rad", -2 * kPi, 2 * kPi, 0.0},
        {"reference_rad", "rad", -2 * kPi, 2 * kPi, {}}}},
      {"backlash", kKinematicGain, drives, {{"gap_rad", "rad", 0, 0.5, {}}}},
      {"pressure_droop",
       kLoadFriction,
       drives,
       {{"stall_nm", "N m", 0, 1e8, 0.0}, {"response_s", "s", 0, 1, 0.05}}},
      {"coulomb_friction", kLoadFriction, drives, {{"effort_nm", "N m", 0, 1e7, {}}}},
      {"viscous_friction",
       kLoadFriction,
       drives,
       {{"coefficient_nmsprad", "N m s/rad", 0, 1e8, {}}, {"oil_degc", "C", -20, 110, 40.0}}},
      {"stribeck_friction",
       kLoadFriction,
       drives,
       {{"excess_nm", "N m", 0, 1e7, {}}, {"rate_radps", "rad/s", 1e-4, 10, 0.02}}},
      {"asymmetric_friction",
       kLoadFriction,
       drives,
       {{"positive_nm", "N m", 0, 1e7, 0.0},
        {"negative_nm", "N m", 0, 1e7, 0.0},
        {"positive_nmsprad", "N m s/rad", 0, 1e8, 0.0},
        {"negative_nmsprad", "N m s/rad", 0, 1e8, 0.0}}},
      {"effort_offset", kLoadFriction, joint, {{"effort_nm", "N m", -1e7, 1e7, {}}}},
      {"sag",
       kLoadFriction,
       drives,
       {{"drift_radps", "rad/s", 0, 0.15, {}}, {"oil_degc", "C", -20, 110, 40.0}}},
      {"drive_friction",
       kLoadFriction,
       drives,
       {{"lost_radps", "rad/s", 0, 5, {}},
        {"time_s", "s", 0, 1, 0.05},
        {"breakaway", "1", 1, 5, 1.0},
        {"stribeck_radps", "rad/s", 1e-4, 1, 0.02}}},
      {"payload",
       kLoadFriction,
       joint,
       {{"mass_kg", "kg", 0, 1e5, {}},
        {"x_m", "m", -20, 20, {}},
        {"y_m", "m", -20, 20, 0.0},
        {"z_m", "m", -20, 20, 0.0}}},
      {"structural_flex",
       kLoadFriction,
       joint,
       {{"natural_radps", "rad/s", 0.5, 500, {}},
        {"damping", "1", 0, 0.95, 0.05},
        {"compliance_radpnm", "rad/(N m)", 0, 1, 0.0}}},
  };
}

}  // namespace

std::span<const Mechanism> ActuationMechanisms() {
  static const std::vector<Mechanism> table = Table();
  return table;
}

}  // namespace tera
