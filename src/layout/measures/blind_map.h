#pragma once

#include <vector>

#include "layout/layout.h"
#include "layout/measures/figure.h"
#include "layout/measures/polar_grid.h"
#include "layout/measures/seen.h"
#include "layout/study/study.h"

namespace tera {

/// Places around the machine that a layout sees at one height above the ground, over a cycle.
///
/// Model   tests the middle of each cell. Cells inside the machine's outline from above, inside
///         something solid or off the site's ground do not count at that moment.
class BlindMap {
 public:
  explicit BlindMap(double height_m) : height_m_(height_m) {}

  /// Adds the places of this moment at this height, without those in a machine's outline
  /// (LeaveOutHull).
  void Add(const PolarPlaces& places, const Layout& layout, const SeenFrom& seen,
           const Sighting& sighting);

  double height_m() const { return height_m_; }
  /// Share of the moments at which each cell is seen, by PolarGrid::Index; negative if the cell
  /// never counted.
  std::vector<double> SeenShare() const;
  /// "map/HEIGHT m/blind_m2_to_12m" and "_to_24m": the unseen area.
  std::vector<Figure> Figures() const;

 private:
  double height_m_;
  std::vector<double> seen_ = std::vector<double>(PolarGrid::kSectors * PolarGrid::kRings);
  std::vector<double> counted_ = seen_;
  std::vector<double> near_blind_m2_, far_blind_m2_;  ///< one per moment
};

}  // namespace tera
