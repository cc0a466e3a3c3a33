#pragma once

#include <functional>

#include "core/motion.h"

namespace tera {

/// Unoccluded field of view of a camera or lidar: directions, sampling density and range. The
/// layout search uses it (src/layout).
///
/// Frames  S sensor, x forward, y left, z up.
struct ViewField {
  enum class Samples { kPoints, kPixels };
  Samples samples = Samples::kPoints;  ///< form of its samples
  /// Points or pixels of one scan or image per steradian in the direction of the unit vector d_S; 0
  /// outside the field.
  std::function<double(const Vec3& d_S)> per_steradian;
  /// True if all samples lie on a surface of zero solid angle, a plane or a cone.
  bool is_flat = false;
  /// Range limit for a surface that returns this fraction of the light: diffuse reflectance times
  /// cosine of incidence.
  std::function<double(double returned)> reach_m;
  double nearest_m = 0;  ///< minimum range
  /// True for a sensor that sees surfaces behind glass. A ranging sensor measures the glass.
  bool through_glass = false;
  bool ranges = true;                             ///< true for a ranging sensor
  double min_distance_m = 0, max_distance_m = 0;  ///< limits of measured distances
  /// Standard deviation of a measured distance.
  std::function<double(double distance_m)> distance_sigma_m;
  /// Meaning of a distance: depth along the axis x of S, or range from its origin.
  bool by_depth = false;
  double DistanceOf(const Vec3& p_S_m) const { return by_depth ? p_S_m.x() : p_S_m.norm(); }
  double bytes_per_sample = 0;  ///< uncompressed
  double samples_per_s = 0;
};

}  // namespace tera
