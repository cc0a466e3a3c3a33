#pragma once

#include <array>
#include <span>
#include <vector>

#include "soil/columns/columns.h"
#include "soil/soil.h"

namespace tera {

/// A part of the depth that an edge cuts, of one strength.
struct CutLayer {
  double thickness_m = 0;
  double density_kgpm3 = 0;
  double friction_rad = 0;
  double tool_friction_rad = 0;
  double cohesion_pa = 0;
  double adhesion_pa = 0;
  bool is_loose = false;
};

/// Soil that an edge at some depth cuts through. It holds means over the layers and strata above
/// the edge, weighted by thickness, those layers themselves, and the soil at the edge.
///
/// Model   Loose soil has lost its cohesion; friction is the mean of its tangent. Neighbours of one
///         strength are one layer. There are at most kMostLayers; the lowest holds the mean of all
///         soil below the others.
struct CutSoil {
  static constexpr int kMostLayers = 6;

  CutLayer mean;
  std::array<CutLayer, kMostLayers> layer;  ///< from the surface down
  int layer_count = 0;
  std::uint8_t at_edge = 0;  ///< soil that the edge meets
  bool edge_in_loose = false;

  std::span<const CutLayer> layers() const {
    return std::span(layer).first(static_cast<std::size_t>(layer_count));
  }
};

/// The soil of a column above z_m, with the properties `soils`. At least that of the surface.
CutSoil SoilAbove(ColumnId k, double z_m, const Columns& ground,
                  const std::vector<SoilType>& soils);

}  // namespace tera
