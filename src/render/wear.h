#pragma once

#include <optional>

#include "core/motion.h"

namespace tera {

/// Wear of a surface by work, each from 0 (factory condition) to 1 (worst condition).
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
/// Frames  B frame of the node's body, z up in its own zero pose.
/// Model   a point's distance from the soil determines the fractions of mud and bare steel; noise
///         fixed to the body determines their pattern.
struct NodeWear {
  Wear wear;
  Vec3 soil_albedo = Vec3(0.3, 0.22, 0.15);  ///< albedo of the soil's dry bank
  /// Distance from the soil at p_B is max(0, normal . p_B + offset) in metres; all zero: in the
  /// soil.
  Vec3 from_soil_normal_B = Vec3::Zero();
  double from_soil_offset_m = 0;
  /// Cutting edge: a line along y at this (x, z).
  std::optional<Vec2> edge_B_m;
};

}  // namespace tera
