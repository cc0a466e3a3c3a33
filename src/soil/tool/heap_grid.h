#pragma once

#include <array>
#include <functional>
#include <vector>

#include "soil/tool/shovel_shape.h"

namespace tera {

/// Depth of rough soil below the smooth heap, at least 0. `along_m` runs along the mouth from the
/// top edge to the cutting edge, `across_m` along B's y axis.
using HeapRelief = std::function<double(double along_m, double across_m)>;

/// Soil in a shovel as columns on a grid.
///
/// Frames  B frame of the shovel's link. Columns run along `up` in the plane of the profile. Their
///         x is along `right`, their y along B's y axis, their heights along `up`.
/// Model   A column reaches from the shell to the lowest of three surfaces. These are a plane, the
///         cones that rise at the heap's slope from all points of the mouth's rim, and overhanging
///         shell above. The plane bulges slightly towards the middle of the mouth; a steeper plane
///         bulges less. The relief is subtracted. Surface and shell are linear over triangles
///         between columns.
/// Omits   Hollows of the shell above the lowest one of a column.
class HeapGrid {
 public:
  /// Orientation of a heap: `up_B` is against gravity, `surface_up_B` is normal to its plane,
  /// `slope_rad` is its steepest slope.
  struct Stance {
    Vec3 up_B, surface_up_B;
    double slope_rad;
  };
  HeapGrid(const ShovelShape& shape, const Stance& stance, double cell_m, const HeapRelief& relief);

  /// Volume of soil below a level. The heap is full at `highest_m()` and empty at `lowest_m()`.
  double VolumeBelow_m3(double level_m) const;
  double lowest_m() const { return lowest_m_; }
  double highest_m() const { return highest_m_; }

  struct Column {
    double surface_m, floor_m;
    bool at_shell;  ///< the surface is the overhanging shell
    double depth_m() const { return surface_m - floor_m; }
  };
  /// All columns in index order, filled up to a level.
  std::vector<Column> FilledTo(double level_m) const;

  /// Calls `visit(i, j, k)` with the columns at the corners of each triangle, counterclockwise from
  /// above.
  template <typename Visit>
  void ForTriangles(Visit visit) const;

  Vec3 At_B(std::size_t column, double height_m) const;
  /// Position along and across the mouth, as HeapRelief takes it.
  Vec2 PlaceOf(std::size_t column) const;

 private:
  struct Slice {
    double x_m, floor_m, ceiling_m;
    bool holds;  ///< the shell, not the mouth, lies below
  };
  Vec2 Level(const Vec2& p_B) const { return Vec2(p_B.dot(right_), p_B.dot(up_)); }
  void CutSlices(const ShovelShape& shape, double cell_m);
  Slice SliceAt(const std::vector<Vec2>& outline, double x_m) const;
  /// Points along one side of the rim of the mouth.
  using RimSide = std::vector<Vec3>;
  std::array<RimSide, 4> Rim() const;
  void Limit(const Stance& stance, const HeapRelief& relief);

  Vec2 right_, up_;
  double up_y_, up_z_;  ///< direction against gravity: components along B's y axis and along `up_`
  Vec2 top_lip_, edge_lip_;  ///< in the axes of Level
  std::vector<Slice> slices_;
  std::vector<double> ys_m_;
  struct Limits {
    double mound_m, most_m, relief_m;
  };
  std::vector<Limits> limits_;  ///< for each column
  double lowest_m_ = 0, highest_m_ = 0;
};

template <typename Visit>
void HeapGrid::ForTriangles(Visit visit) const {
  constexpr double kSliver_m = 1e-5;  // width of the gap between two slices at a step of the shell
  const std::size_t across = ys_m_.size();
  for (std::size_t s = 0; s + 1 < slices_.size(); ++s) {
    if (slices_[s + 1].x_m - slices_[s].x_m < kSliver_m) continue;
    if (!slices_[s].holds || !slices_[s + 1].holds) continue;
    for (std::size_t j = 0; j + 1 < across; ++j) {
      const std::size_t a = s * across + j, b = a + across, c = b + 1, d = a + 1;
      if ((s + j) % 2 == 0) {
        visit(a, b, c), visit(a, c, d);
      } else {
        visit(a, b, d), visit(b, c, d);
      }
    }
  }
}

}  // namespace tera
