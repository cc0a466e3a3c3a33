#pragma once

#include <vector>

#include "core/motion.h"
#include "core/time.h"
#include "render/air/rain.h"
#include "render/air/weather.h"

namespace tera {

/// Raindrops as a camera sees them during one exposure.
///
/// Frames  W world, C camera (x right, y down, z forward).
/// Model   drops have the size distribution of Rain. They fill periodic boxes around the camera;
///         larger drops have larger boxes. Each drop falls at constant velocity and drifts with the
///         wind at 2 m above ground. During the exposure it leaves a straight streak, centred on
///         the time of the image.
///         A streak hides the fraction pi/4 d^2 / (w l) of the light of each pixel that it crosses.
///         d is the drop's diameter, l the streak's length and w its width in the image, at least
///         kLeastWidth_px.
/// Omits   drops below 0.5 mm and drops beyond the boxes: the rain's extinction represents them.
///         Also the camera's motion, defocus and drop oscillation.
/// Source  rain.h; Garg and Nayar 2007, "Vision and rain", IJCV 75 (streaks and their
///         transparency).
class FallingDrops {
 public:
  FallingDrops(const Rain& rain, const Wind& wind);

  struct Streak {
    Vec3 from_C_m, to_C_m;
    double diameter_m;
  };
  /// Streaks in front of a camera at X_WC, from drops within half a box side.
  std::vector<Streak> Seen(const Pose& X_WC, TimeNs t_ns, double exposure_s) const;

  static constexpr double kLeastWidth_px = 1.3;
  /// Fraction of a pixel's light that a streak hides, from its size in the image.
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
