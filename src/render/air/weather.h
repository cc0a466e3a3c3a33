#pragma once

#include <optional>

#include "core/motion.h"

/// Weather of a scenario: matter in the air, and precipitation on the ground.

namespace tera {

/// Wind over level ground, 10 m above it.
struct Wind {
  double speed_mps = 0;
  double from_rad = 0;  ///< direction that the wind comes from, clockwise from north

  /// Unit vector in W of the direction that the wind blows to.
  Vec2 towards_W() const;
};

/// Dust raised by work, and the air volume in which it is simulated.
struct DustModel {
  double emission_factor = 1;  ///< factor on the emission of the AP-42 formulas
  /// Silt content of driven surfaces; AP-42's mean of construction sites.
  double silt_percent = 8.5;
  double extent_m = 40;  ///< side length of the volume's square base, which contains the machines
  double height_m = 8;   ///< height of the volume above the ground
  double cell_m = 0.5;
};

/// Parameters of the weather. The models that use them name their sources: dust_field.h, rain.h,
/// ground_cover.h.
struct Weather {
  Wind wind;
  std::optional<DustModel> dust;  ///< empty: work raises no dust
  /// Visibility (Koschmieder) in fog and haze, without precipitation; 0: no value.
  double visibility_m = 0;
  double rain_mmph = 0;       ///< rate of rain
  double snowfall_mmph = 0;   ///< rate of falling snow, as melted water
  double puddle_depth_m = 0;  ///< maximum depth of water in hollows
  double snow_depth_m = 0;    ///< depth of snow on the ground

  /// Extinction of visible light by fog, rain and falling snow together. Without a visibility, fog
  /// adds nothing.
  double Extinction_1pm() const;
};

/// Contrast that remains at the visibility, after Koschmieder 1924.
inline constexpr double kVisibleContrast = 0.02;

/// Extinction at 905 nm of fog or haze of the given visibility V.
///
/// Model   3.91 / V (905 / 550)^-q, with V in km. q is 1.6 for V > 50, 1.3 for V > 6, 0.16 V + 0.34
///         for V > 1, V - 0.5 for V > 0.5, and else 0.
/// Source  Koschmieder 1924; Kim, McArthur and Korevaar 2001, "Comparison of laser beam propagation
///         at 785 nm and 1550 nm in fog and haze", eqs. 2 and 6.
double FogExtinction_1pm(double visibility_m);

/// Back-scatter of fog: the fraction of a light pulse that it scatters back, per metre and
/// steradian.
///
/// Model   0.046 over the range in metres at which 5 % of the contrast remains.
/// Source  Rasshofer, Spies and Spies 2011, "Influences of weather phenomena on automotive laser
///         radar systems", Adv. Radio Sci. 9, as in Hahner et al. 2021, "Fog simulation on real
///         LiDAR point clouds", section 3.
double FogBackscatter_1pmsr(double extinction_1pm);

}  // namespace tera
