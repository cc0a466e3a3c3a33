#pragma once

#include <array>
#include <cmath>

#include "core/motion.h"

namespace tera {

/// A rectangle of occupied ground.
///
/// Frames  W; rotated by `yaw_rad` from x towards y.
struct Footprint {
  Vec2 middle_W_m = Vec2::Zero();
  double yaw_rad = 0;
  Vec2 half_m = Vec2::Zero();  ///< half length along the heading, half width across it

  Vec2 Along() const { return {std::cos(yaw_rad), std::sin(yaw_rad)}; }
  Vec2 Across() const { return {-std::sin(yaw_rad), std::cos(yaw_rad)}; }
  std::array<Vec2, 4> Corners_W_m() const;
};

/// Whether two footprints are closer than `gap_m`, by the separating axis test. Two corners that
/// face each other count as too close at a slightly larger distance.
///
/// Source  Gottschalk, Lin and Manocha 1996, "OBBTree", for the test.
bool Meet(const Footprint& a, const Footprint& b, double gap_m);

}  // namespace tera
