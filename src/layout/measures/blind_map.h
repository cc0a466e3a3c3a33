#pragma once

#include <string>
#include <vector>

#include "layout/layout.h"
#include "layout/measures/figure.h"
#include "layout/measures/seen.h"
#include "layout/study/study.h"

namespace tera {

/// A polar grid of places at one height above the ground, about the machine.
///
/// Frames  H stands on the ground at the upper structure's origin, turned to its heading: azimuth 0
///         is ahead, counterclockwise from above.
/// Source  5 degrees by 1 m, out to 12 and 24 m: the grid of the blind area diagrams of NIOSH and
///         Caterpillar (planes at 0, 900 and 1500 mm).
struct PolarGrid {
  static constexpr int kSectors = 72, kRings = 24, kNearRings = 12;
  static constexpr double kRing_m = 1.0;

  /// Middle of a cell, x and y in H.
  static Vec2 Middle_m(int sector, int ring);
  static std::size_t Index(int sector, int ring) {
    return static_cast<std::size_t>(sector) * kRings + ring;
  }
};

/// Which places around the machine a layout sees at one height over the ground, over a cycle.
///
/// Model   the middle of each cell; cells within the outline of the machine from above
/// (HullRadii_m),
///         in something solid or beyond the site's ground do not count at that moment.
class BlindMap {
 public:
  explicit BlindMap(double height_m) : height_m_(height_m) {}

  /// A cell that counts at a moment.
  struct Place {
    std::size_t cell;  ///< PolarGrid::Index
    Vec3 p_W_m;
  };
  /// Those of this moment, the same for all layouts. `hull_m` is HullRadii_m of as many sectors as
  /// the grid has.
  std::vector<Place> Places(const Pose& X_WH, const std::vector<double>& hull_m,
                            const Sighting& sighting, const TerrainSurface& ground) const;
  /// Adds what `layout` sees of these.
  void Add(const std::vector<Place>& places, const Layout& layout, const SeenFrom& seen,
           const Sighting& sighting);

  double height_m() const { return height_m_; }
  /// Share of the moments at which each cell is seen, by PolarGrid::Index; negative where the cell
  /// never counted.
  std::vector<double> SeenShare() const;
  /// "map/HEIGHT m/blind_m2_to_12m" and "_to_24m": the area that nobody sees.
  std::vector<Figure> Figures() const;

 private:
  double height_m_;
  std::vector<double> seen_ = std::vector<double>(PolarGrid::kSectors * PolarGrid::kRings);
  std::vector<double> counted_ = seen_;
  std::vector<double> near_blind_m2_, far_blind_m2_;  ///< of each moment
};

}  // namespace tera
