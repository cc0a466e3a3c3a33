#pragma once

#include <optional>

#include "core/motion.h"

namespace tera {

/// Wear of a surface, each component from 0 (as new) to 1 (worst).
struct Wear {
  double dust = 0;       ///< on surfaces that face upward, and as a film near the ground
  double mud = 0;        ///< on surfaces in or near the soil
  double scratches = 0;  ///< chipped and scraped paint; bare steel at a cutting edge
  double rust = 0;       ///< rusted fraction of the bare steel, with stains below it

  bool any() const { return dust > 0 || mud > 0 || scratches > 0 || rust > 0; }
  bool operator==(const Wear&) const = default;
};

/// Wear of a scene node.
///
/// Frames  B is the frame of the node's body, with z up when all joints are at zero.
/// Model   the distance of a point from the soil sets the fractions of mud and bare steel. Noise
///         that is fixed to the body sets the pattern.
struct NodeWear {
  Wear wear;
  Vec3 soil_albedo = Vec3(0.3, 0.22, 0.15);  ///< albedo of the dry soil, for dust and mud
  /// The distance of p_B from the soil is max(0, normal . p_B + offset) in m. If all are zero, the
  /// whole node counts as in the soil.
  Vec3 from_soil_normal_B = Vec3::Zero();
  double from_soil_offset_m = 0;
  /// Cutting edge: the line along y through this (x, z).
  std::optional<Vec2> edge_B_m;
};

}  // namespace tera
