#pragma once

#include <cstddef>
#include <vector>

#include "layout/layout.h"
#include "layout/measures/figure.h"

namespace tera {

/// What an elevation map of the ground ahead would be worth: gaps, and the error of its heights.
///
/// Frames  H as in PolarGrid.
/// Model   cells of the map lie on the site's ground with its slope there; beyond it are none. Of a
///         viewer that ranges, the points expected on a cell are those on a square metre of it
///         times its area, if its middle is seen (look.h); they come as a Poisson process, so that
///         a cell is a gap with probability exp(-n). A range error e along the ray d moves a point
///         to where the plane of the cell is lower or higher by e (n . d) / n_z, n its normal: so
///         much is the error of its height. Points of a cell average by their weights, as many of
///         them as are expected of a cell that has any. The error of the map is that of the cells
///         that have points, each counted with the probability that it has; how many have none is
///         told by the gaps.
/// Omits   that points of a lidar stand in rows. Where rows and columns are closer than the cells
///         are wide, 1 - n of these are empty instead of exp(-n): too many gaps are told, by 1 / e
///         of the cells at most. Where rows are farther apart, the cells between them are empty
///         however many points a row has: too few are told, without such a bound. Beside maps made
///         of scans the figure was off by 0.03 to 0.10 and by -0.07 (docs/reference/layout.md).
///         Omits also roughness within a cell; errors of the mount and of the pose, which are the
///         same for all cells; what stands in a part of a cell only.
class ElevationMap {
 public:
  explicit ElevationMap(const ElevationStudy& study) : study_(study) {}

  void Add(const Pose& X_WH, const Layout& layout, double reflectance, const Sighting& sighting,
           const TerrainSurface& ground);
  /// "elevation/gaps", a share of the cells, and "elevation/sigma_m", root mean square over the
  /// cells that have points; 1 m at a moment at which none can have any.
  std::vector<Figure> Figures() const;

 private:
  struct Cell {
    Vec3 p_W_m, normal_W;
    double area_m2;         ///< from above
    double points = 0;      ///< expected on it
    double weight_pm2 = 0;  ///< of the mean of their heights: the inverse of its variance
  };
  std::vector<Cell> CellsOn(const TerrainSurface& ground, const Pose& X_WH) const;
  void Count(const std::vector<Cell>& cells);

  ElevationStudy study_;
  std::vector<double> gaps_, sigma_m_;
  std::vector<std::size_t> cells_;  ///< of each moment
};

}  // namespace tera
