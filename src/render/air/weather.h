#pragma once

#include <optional>

#include "core/motion.h"

/// What the air of a scenario carries, and what has fallen from it.

namespace tera {

/// Wind over level ground, 10 m above it.
struct Wind {
  double speed_mps = 0;
  double from_rad = 0;  ///< whence it blows: from north, clockwise

  /// Its direction, level.
  Vec2 towards_W() const;
};

/// That work raises dust, and where it is followed.
struct DustModel {
  double emission_factor = 1;  ///< of the amounts that AP-42 gives
  double silt_percent = 8.5;   ///< of surfaces driven over; AP-42's mean of construction sites
  double extent_m = 40;        ///< side of the square of air, about the machines
  double height_m = 8;         ///< of that air above the ground
  double cell_m = 0.5;
};

/// Source  as where each is used: dust_field.h, rain.h, ground_cover.h.
struct Weather {
  Wind wind;
  std::optional<DustModel> dust;  ///< none: work raises no dust
  double rain_mmph = 0;           ///< rate of rain
  double puddle_depth_m = 0;      ///< at most, of water in hollows
  double snow_depth_m = 0;        ///< that lies on the ground
};

}  // namespace tera
