#pragma once

#include <cstddef>
#include <vector>

#include "layout/layout.h"
#include "layout/measures/figure.h"

namespace tera {

/// Quality of an elevation map of the ground ahead: the share of empty cells, and the height error.
///
/// Frames  H as in PolarGrid.
/// Model   the cells lie on the site's ground and have its local slope. A ranging viewer that sees
///         the centre of a cell (look.h) adds its expected points per square metre times the cell's
///         area, n in sum. Points arrive as a Poisson process, so a cell is empty with probability
///         exp(-n).
///         A range error e along the ray d changes the height by e (n . d) / n_z, where n is the
///         normal of the cell's plane. The height of a cell is the weighted mean of its points,
///         whose number is that expected in a non-empty cell. The error of the map is the root mean
///         square over the cells, weighted by their probability of having points.
/// Omits   the row structure of lidar points. If rows and columns are closer than the cell width, a
///         share of 1 - n is empty instead of exp(-n); the figure is then too high by at most 1 / e
///         of the cells. If rows are farther apart, the cells between them are empty at any point
///         density; the figure is then too low, without a bound. Compared with maps from scans, the
///         share was off by 0.03 to 0.10 and by -0.07 (docs/reference/layout.md).
///         Also roughness within a cell; errors of the mount and the pose, which all cells share;
///         objects that fill only a part of a cell.
class ElevationMap {
 public:
  explicit ElevationMap(const ElevationStudy& study) : study_(study) {}

  void Add(const Pose& X_WH, const Layout& layout, double reflectance, const Sighting& sighting,
           const TerrainSurface& ground);
  /// "elevation/gaps" is the share of empty cells. "elevation/sigma_m" is the root mean square
  /// height error over the cells with points, or 1 m at a moment without any.
  std::vector<Figure> Figures() const;

 private:
  struct Cell {
    Vec3 p_W_m, normal_W;
    double area_m2;         ///< from above
    double points = 0;      ///< expected number of points
    double weight_pm2 = 0;  ///< inverse variance of the mean height
  };
  std::vector<Cell> CellsOn(const TerrainSurface& ground, const Pose& X_WH) const;
  void Count(const std::vector<Cell>& cells);

  ElevationStudy study_;
  std::vector<double> gaps_, sigma_m_;
  std::vector<std::size_t> cells_;  ///< one per moment
};

}  // namespace tera
