#pragma once

#include <functional>

#include "core/motion.h"

namespace tera {

/// What a sensor that sees could see if nothing stood in the way: in which directions, how finely,
/// how far. For whoever asks where sensors should sit (src/layout).
///
/// Frames  S sensor, x forward, y left, z up.
struct ViewField {
  enum class Samples { kPoints, kPixels };
  Samples samples = Samples::kPoints;  ///< what it takes of the world
  /// Points or pixels of one scan or picture per steradian along the unit vector d_S; 0 where it
  /// does not look.
  std::function<double(const Vec3& d_S)> per_steradian;
  /// All its samples lie on a surface without thickness, a plane or a cone, so that none of them
  /// are per steradian.
  bool is_flat = false;
  /// Farthest that it sees a surface that returns this share of the light: its diffuse reflectance
  /// times the cosine of the incidence.
  std::function<double(double returned)> reach_m;
  double nearest_m = 0;  ///< that it sees anything
  /// It shows what lies behind glass. Where it ranges, it has the glass.
  bool through_glass = false;
  bool ranges = true;                             ///< it measures where what it sees is,
  double min_distance_m = 0, max_distance_m = 0;  ///< within these limits
  /// Standard deviation of a distance that it measures.
  std::function<double(double distance_m)> distance_sigma_m;
  /// What all of these are distances by: depths along the axis x of S, or ranges from its origin.
  bool by_depth = false;
  double DistanceOf(const Vec3& p_S_m) const { return by_depth ? p_S_m.x() : p_S_m.norm(); }
  double bytes_per_sample = 0;  ///< as measured, before compression
  double samples_per_s = 0;
};

}  // namespace tera
