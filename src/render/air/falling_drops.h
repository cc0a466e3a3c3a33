#pragma once

#include <vector>

#include "core/motion.h"
#include "core/time.h"
#include "render/air/rain.h"
#include "render/air/weather.h"

namespace tera {

/// Raindrops as a camera sees them in one exposure.
///
/// Frames  W world, C camera (x right, y down, z forward).
/// Model   drops of Rain's size distribution in periodic boxes, larger drops in larger boxes. Each
///         drop falls at constant velocity with the wind at 2 m above ground. It leaves a streak
///         along its path, from half an exposure before the image's time to half an exposure
///         after. A streak covers pi/4 d^2 / (w l) of the light of each pixel it crosses. d is the
///         drop's diameter, l the streak's length and w its width in the image, at least
///         kLeastWidth_px.
/// Omits   drops below 0.5 mm and beyond the boxes, which the rain's extinction represents; the
///         camera's own motion; defocus; drop oscillation.
/// Source  rain.h; Garg and Nayar 2007, "Vision and rain", IJCV 75 (streaks and their
///         transparency).
class FallingDrops {
 public:
  FallingDrops(const Rain& rain, const Wind& wind);

  struct Streak {
    Vec3 from_C_m, to_C_m;
    double diameter_m;
  };
  /// Streaks in front of a camera at X_WC, within the range of their boxes.
  std::vector<Streak> Seen(const Pose& X_WC, TimeNs t_ns, double exposure_s) const;

  static constexpr double kLeastWidth_px = 1.3;
  /// Fraction of a pixel's light that a streak of that image size covers.
  static double Cover(double diameter_px, double width_px, double length_px);

 private:
  struct Drop {
    Vec3 p_m;  ///< within its box
    double diameter_m;
    Vec3 v_W_mps;
  };
  struct Shell {
    double side_m;
    std::vector<Drop> drops;
  };
  std::vector<Shell> shells_;
};

}  // namespace tera
