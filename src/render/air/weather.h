#pragma once

#include <optional>

#include "core/motion.h"

/// Airborne matter of a scenario, and precipitation on its ground.

namespace tera {

/// Wind over level ground, at 10 m height.
struct Wind {
  double speed_mps = 0;
  double from_rad = 0;  ///< direction of origin: clockwise from north

  /// Unit vector of the downwind direction.
  Vec2 towards_W() const;
};

/// Dust emission by work, and the volume in which it is simulated.
struct DustModel {
  double emission_factor = 1;  ///< factor on the AP-42 emission
  double silt_percent = 8.5;   ///< silt of travelled surfaces; AP-42's mean of construction sites
  double extent_m = 40;        ///< side of the air volume's square, about the machines
  double height_m = 8;         ///< height of the air volume above ground
  double cell_m = 0.5;
};

/// Source  see each use: dust_field.h, rain.h, ground_cover.h.
struct Weather {
  Wind wind;
  std::optional<DustModel> dust;  ///< none: work raises no dust
  double visibility_m = 0;        ///< Koschmieder's, of fog and haze alone; 0: not stated
  double rain_mmph = 0;           ///< rate of rain
  double snowfall_mmph = 0;       ///< rate of falling snow, as water
  double puddle_depth_m = 0;      ///< maximum depth of water in hollows
  double snow_depth_m = 0;        ///< on the ground

  /// Extinction of visible light by stated fog, rain and falling snow together.
  double Extinction_1pm() const;
};

/// Contrast left at the visibility, after Koschmieder 1924.
inline constexpr double kVisibleContrast = 0.02;

/// Extinction at 905 nm of fog or haze with a visibility.
///
/// Model   3.91 / V (905 / 550)^-q, with q = 1.6 beyond 50 km, 1.3 to 6 km, 0.16 V + 0.34 to 1 km,
///         V - 0.5 to 500 m, and 0 in thicker fog; V in km.
/// Source  Koschmieder 1924; Kim, McArthur and Korevaar 2001, "Comparison of laser beam propagation
///         at 785 nm and 1550 nm in fog and haze", eqs. 2 and 6.
double FogExtinction_1pm(double visibility_m);

/// Fraction per metre and steradian of a pulse's light that fog of that extinction scatters back.
///
/// Model   0.046 over the range in metres at which 5 % of the contrast remains.
/// Source  Rasshofer, Spies and Spies 2011, "Influences of weather phenomena on automotive laser
///         radar systems", Adv. Radio Sci. 9, as in Hahner et al. 2021, "Fog simulation on real
///         LiDAR point clouds", section 3.
double FogBackscatter_1pmsr(double extinction_1pm);

}  // namespace tera
