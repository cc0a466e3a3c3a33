#pragma once

#include <algorithm>
#include <optional>

#include "soil/columns/columns.h"
#include "soil/soil_view.h"

namespace tera {

/// A vertical piece of one soil in a column. It may have mass but no height, from rounding.
struct SoilPiece {
  double top_m = 0, bottom_m = 0;  ///< z in W
  double kgpm2 = 0;
  std::uint8_t soil = 0;
  float moisture = 0;
  bool loose = false;
};

/// Calls visit(piece) for each piece from the surface down. The undisturbed soil ends at z =
/// `low_m`.
template <typename Visit>
void ForPieces(const Column& column, const GroundProfile& profile, double low_m, Visit visit) {
  double top_m = column.top_m;
  for (int n = column.layer_count - 1; n >= 0; --n) {
    const SoilLayer& layer = column.layers[n];
    const double bottom_m = top_m - layer.thickness_m;
    visit(SoilPiece{top_m, bottom_m, layer.kgpm2, layer.soil, layer.moisture, layer.loose});
    top_m = bottom_m;
  }
  // depth_m, end_m and below_m are depths below the undisturbed surface
  const double end_m = column.ground_m - low_m;
  for (double depth_m = column.ground_m - column.bank_m; depth_m < end_m;) {
    const Stratum& stratum = profile.Below(depth_m);
    const double below_m = std::min(end_m, stratum.bottom_m);
    visit(SoilPiece{column.ground_m - depth_m, column.ground_m - below_m,
                    (below_m - depth_m) * stratum.density_kgpm3, stratum.soil, stratum.moisture,
                    false});
    depth_m = below_m;
  }
}

/// Mean bulk density of the uppermost `depth_m` of a column.
double UpperDensity_kgpm3(const Column& column, const GroundProfile& profile, double depth_m);

/// Soil at a depth below the surface of the column nearest to (x, y). Empty above the surface and
/// outside the site.
std::optional<SoilSample> SampleBelow(const Columns& columns, double x_m, double y_m,
                                      double depth_m);

SoilVoxels CutIntoCubes(const Columns& columns, const VoxelBox& box);

}  // namespace tera
