#pragma once

#include <array>
#include <span>
#include <vector>

#include "soil/columns/columns.h"
#include "soil/soil.h"

namespace tera {

/// A layer of the cut with uniform strength.
struct CutLayer {
  double thickness_m = 0;
  double density_kgpm3 = 0;
  double friction_rad = 0;
  double tool_friction_rad = 0;
  double cohesion_pa = 0;
  double adhesion_pa = 0;
  bool is_loose = false;
};

/// Soil above a cutting edge at some depth: means over the depth, weighted by thickness, the single
/// layers, and the soil at the edge.
///
/// Model   Loose soil has no cohesion. Friction is averaged as its tangent. Adjacent soils of equal
///         strength form one layer. There are at most kMostLayers; the last one is the mean of all
///         deeper soil.
struct CutSoil {
  static constexpr int kMostLayers = 6;

  CutLayer mean;
  std::array<CutLayer, kMostLayers> layer;  ///< from the surface down
  int layer_count = 0;
  std::uint8_t at_edge = 0;  ///< soil at the edge
  bool edge_in_loose = false;

  std::span<const CutLayer> layers() const {
    return std::span(layer).first(static_cast<std::size_t>(layer_count));
  }
};

/// Soil of a column above z_m, with the properties `soils`. Contains at least the soil at the
/// surface.
CutSoil SoilAbove(ColumnId k, double z_m, const Columns& ground,
                  const std::vector<SoilType>& soils);

}  // namespace tera
