#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "soil/track/wheel_bench.h"

/// The stresses under a rigid wheel, integrated around its rim as the authors of single-wheel tests
/// do, with nothing of TERA's ground.
///
/// Model   Normal stress: Wong and Reece 1967, J. Terramechanics 4(1), greatest at (c1 + c2 s) of
///         the entry angle, nothing below the axle; c1 = 0.4, c2 = 0.15. Shear: Janosi and
///         Hanamoto, with j_x = r ((theta_1 - theta) - (1 - s) (sin theta_1 - sin theta)) and j_y =
///         r (1 - s) (theta_1 - theta) tan beta. Side: shear and Hegedus' bulldozing over the sunk
///         side of the wheel, before and behind the axle, times sin beta: Ishigami, Miwa, Nagatani
///         and Yoshida 2007, J. Field Robotics 24(3). No slip sinkage.

namespace tera::testing_soil {

struct WheelSoil {
  double cohesion_pa, friction_rad;
  double k_c, k_phi, exponent;  ///< N/m^(n+1), N/m^(n+2)
  double density_kgpm3;
  double shear_m;  ///< K

  std::string Yaml() const {
    return fmt::format(
        "soil: of_the_bin\n"
        "custom_soils: [{{preset: tera:config/soils/sand.yaml, name: of_the_bin,\n"
        "  bank_density_kgpm3: {}, max_density_kgpm3: {},\n"
        "  k_c_npm_n1: {}, k_phi_npm_n2: {}, sinkage_exponent: {}, shear_cohesion_pa: {},\n"
        "  shear_friction_deg: {}, shear_modulus_m: {}}}]\n",
        density_kgpm3, 1.2 * density_kgpm3, k_c, k_phi, exponent, cohesion_pa, friction_rad / kDeg,
        shear_m);
  }
};

struct WheelForces {
  double sinkage_m = 0, load_n = 0, drawbar_n = 0, traction_n = 0;
  double side_n = 0, face_n = 0;  ///< face_n is the part of side_n on the wheel's side
};

/// Hegedus' resistance, per unit length, against a face `depth_m` deep.
inline double HegedusResistance_npm(const WheelSoil& soil, double depth_m) {
  const double x_c = 45 * kDeg - soil.friction_rad / 2;
  const double cot = 1 / std::tan(x_c);
  const double d1 = cot + std::tan(x_c + soil.friction_rad);
  const double d2 = cot + cot * cot * std::tan(soil.friction_rad);
  const double weight_npm3 = soil.density_kgpm3 * kStandardGravity_mps2;
  return d1 * (soil.cohesion_pa * depth_m + 0.5 * weight_npm3 * depth_m * depth_m * d2);
}

inline WheelForces StressesFrom(double entry_rad, const RigidWheel& wheel, const WheelSoil& soil,
                                double slip, double slip_angle_rad) {
  constexpr double kC1 = 0.40, kC2 = 0.15;
  constexpr int kParts = 400;
  const double r = wheel.radius_m, b = wheel.width_m;
  const double peak_rad = (kC1 + kC2 * slip) * entry_rad;
  const auto depth_m = [&](double a) { return r * (std::cos(a) - std::cos(entry_rad)); };
  WheelForces f{.sinkage_m = depth_m(0)};
  const double da = entry_rad / kParts;
  for (double a = 0.5 * da; a < entry_rad; a += da) {
    const double bears_as = a > peak_rad ? a : entry_rad - a / peak_rad * (entry_rad - peak_rad);
    const double p_pa = (soil.k_c / b + soil.k_phi) * std::pow(depth_m(bears_as), soil.exponent);
    const double j_x_m = r * ((entry_rad - a) - (1 - slip) * (std::sin(entry_rad) - std::sin(a)));
    const double j_y_m = r * (1 - slip) * (entry_rad - a) * std::tan(slip_angle_rad);
    const double strength_pa = soil.cohesion_pa + p_pa * std::tan(soil.friction_rad);
    const double t_x_pa = strength_pa * -std::expm1(-j_x_m / soil.shear_m);
    f.load_n += r * b * da * (p_pa * std::cos(a) + t_x_pa * std::sin(a));
    f.drawbar_n += r * b * da * (t_x_pa * std::cos(a) - p_pa * std::sin(a));
    f.traction_n += r * b * da * t_x_pa;
    f.side_n += r * b * da * strength_pa * -std::expm1(-j_y_m / soil.shear_m);
    f.face_n += 2 * HegedusResistance_npm(soil, depth_m(a)) * (r - depth_m(a) * std::cos(a)) * da;
  }
  f.side_n += std::sin(slip_angle_rad) * f.face_n;
  return f;
}

/// From the entry angle at which the stresses carry the wheel's load. Slip from 0 to 1.
inline WheelForces WongReece(const RigidWheel& wheel, const WheelSoil& soil, double slip,
                             double slip_angle_rad = 0) {
  double low_rad = 0.01, high_rad = 85 * kDeg;
  for (int k = 0; k < 50; ++k) {
    const double entry_rad = 0.5 * (low_rad + high_rad);
    const WheelForces f = StressesFrom(entry_rad, wheel, soil, slip, slip_angle_rad);
    (f.load_n < wheel.load_n ? low_rad : high_rad) = entry_rad;
  }
  return StressesFrom(low_rad, wheel, soil, slip, slip_angle_rad);
}

}  // namespace tera::testing_soil
