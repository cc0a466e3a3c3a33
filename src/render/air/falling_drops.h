#pragma once

#include <vector>

#include "core/motion.h"
#include "core/time.h"
#include "render/air/rain.h"
#include "render/air/weather.h"

namespace tera {

/// Drops of rain as a camera sees them in one exposure.
///
/// Frames  W; C of the camera (x right, y down, z forward).
/// Model   drops of Rain's sizes in boxes that repeat in all directions, the larger drops in larger
///         boxes, each falling evenly with the wind 2 m above the ground. A drop leaves a streak
///         from where it is half an exposure before the picture's time to where it is half of one
///         after. Of a pixel that a streak crosses it covers pi/4 d^2 / (w l) of the light: d its
///         diameter, l the streak's length and w its width on the picture, no less than
///         kLeastWidth_px.
/// Omits   drops below 0.5 mm and those beyond the boxes, which the rain's extinction stands for;
///         the camera's own motion; defocus; drops' oscillations.
/// Source  rain.h; Garg and Nayar 2007, "Vision and rain", IJCV 75 (streaks and their
///         transparency).
class FallingDrops {
 public:
  FallingDrops(const Rain& rain, const Wind& wind);

  struct Streak {
    Vec3 from_C_m, to_C_m;
    double diameter_m;
  };
  /// Those before a camera at X_WC, nearer than their box reaches.
  std::vector<Streak> Seen(const Pose& X_WC, TimeNs t_ns, double exposure_s) const;

  static constexpr double kLeastWidth_px = 1.3;
  /// Share of a pixel's light that a streak of that size on the picture covers.
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
