#pragma once

#include <optional>

#include "core/motion.h"

namespace tera {

/// What work has left on a surface, each 0 (as it left the factory) to 1 (as bad as it gets).
struct Wear {
  double dust = 0;       ///< lies on what faces upward, and as a film near the ground
  double mud = 0;        ///< sticks to what is in the soil or near it
  double scratches = 0;  ///< chipped and scraped paint, steel rubbed bare at a cutting edge
  double rust = 0;       ///< share of the bare steel that has rusted, and stains under it

  bool any() const { return dust > 0 || mud > 0 || scratches > 0 || rust > 0; }
  bool operator==(const Wear&) const = default;
};

/// The wear of a node of a scene.
///
/// Frames  B of the node's body, z up in its own zero pose.
/// Model   how far a point is from the soil decides how much of it is hidden by mud and rubbed
///         bare; noise fixed to the body decides where.
struct NodeWear {
  Wear wear;
  Vec3 soil_albedo = Vec3(0.3, 0.22, 0.15);  ///< of the soil's dry bank
  /// Metres from the soil at p_B are max(0, normal . p_B + offset); all zero: it is in the soil.
  Vec3 from_soil_normal_B = Vec3::Zero();
  double from_soil_offset_m = 0;
  /// Cutting edge, a line along y at this (x, z).
  std::optional<Vec2> edge_B_m;
};

}  // namespace tera
