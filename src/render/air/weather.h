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
  double rain_mmph = 0;           ///< rate of rain
  double puddle_depth_m = 0;      ///< maximum depth of water in hollows
  double snow_depth_m = 0;        ///< on the ground
};

}  // namespace tera
