#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/units.h"
#include "soil/soil.h"

namespace tera::testing_soil {

/// Coulomb's trial wedges in the ground before a plate, in a plane along its travel, x ahead of the
/// plate's edge. The surface is as it lies; soil is firm below z = 0, loose above.
class TrialWedges {
 public:
  TrialWedges(const SoilType& soil, double rake_rad, double depth_m, double plate_m)
      : soil_(soil), rake_rad_(rake_rad), depth_m_(depth_m), plate_m_(plate_m) {}

  /// The least P of all plane slip surfaces, over x = 0 to 2 m of the surface z_m(x). It is for a
  /// part of the plate `width_m` wide, with the share `flanks` of its two flanks' shear.
  template <typename Surface>
  double Draft_n(double width_m, double flanks, const Surface& z_m) const {
    double least_n = std::numeric_limits<double>::infinity();
    for (double wedge_deg = 12; wedge_deg < 80; wedge_deg += 0.5) {
      least_n = std::min(least_n, Force_n(width_m, flanks, z_m, wedge_deg * kDeg));
    }
    return least_n * std::sin(rake_rad_ + soil_.soil_tool_friction_rad);
  }

 private:
  template <typename Surface>
  double Force_n(double width_m, double flanks, const Surface& z_m, double wedge_rad) const {
    constexpr double kStep_m = 0.002, g = 9.81;
    const double phi = soil_.friction_angle_rad, delta = soil_.soil_tool_friction_rad;
    const double firm_npm3 = soil_.bank_density_kgpm3 * g, loose_npm3 = firm_npm3 / soil_.swell;
    const double at_rest = 1 - std::sin(phi);
    double weight_npm = 0, cohesive_npm = 0, flank_n = 0;
    // Upright slices, ahead of the edge over the slip surface, behind it over the plate.
    double plate_m = 0;
    const double back_m = plate_m_ * std::max(0.0, std::cos(rake_rad_));
    for (double x_m = kStep_m * (0.5 - std::round(back_m / kStep_m)); x_m < 2; x_m += kStep_m) {
      const double low_m =
          -depth_m_ + (x_m > 0 ? x_m * std::tan(wedge_rad) : -x_m * std::tan(rake_rad_));
      const double top_m = z_m(x_m);
      if (low_m >= top_m) {
        if (x_m > 0) break;
        continue;
      }
      if (x_m < 0) plate_m += kStep_m / std::cos(rake_rad_);
      const double firm_m = std::max(0.0, std::min(top_m, 0.0) - low_m);
      const double loose_m = std::max(0.0, top_m - std::max(low_m, 0.0));
      weight_npm += kStep_m * (firm_npm3 * firm_m + loose_npm3 * loose_m);
      if (x_m > 0) {
        if (firm_m > 0) cohesive_npm += soil_.cohesion_pa * kStep_m / std::cos(wedge_rad);
        const double mean_pa = 0.5 * loose_npm3 * loose_m * loose_m +
                               firm_m * (loose_npm3 * loose_m + 0.5 * firm_npm3 * firm_m);
        flank_n += kStep_m * (soil_.cohesion_pa * firm_m + at_rest * std::tan(phi) * mean_pa);
      }
    }
    if (rake_rad_ > 89.9 * kDeg) plate_m = std::min(plate_m_, depth_m_ + std::max(0.0, z_m(0)));
    cohesive_npm += 2 * flanks * flank_n / width_m;
    const double sum = rake_rad_ + delta + wedge_rad + phi;
    if (sum > 179 * kDeg) return std::numeric_limits<double>::infinity();
    return width_m *
           (weight_npm * std::sin(wedge_rad + phi) + cohesive_npm * std::cos(phi) -
            soil_.adhesion_pa * plate_m * std::cos(rake_rad_ + wedge_rad + phi)) /
           std::sin(sum);
  }

  const SoilType& soil_;
  double rake_rad_, depth_m_, plate_m_;
};

}  // namespace tera::testing_soil
