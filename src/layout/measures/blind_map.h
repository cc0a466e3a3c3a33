#pragma once

#include <vector>

#include "layout/layout.h"
#include "layout/measures/figure.h"
#include "layout/measures/polar_grid.h"
#include "layout/measures/seen.h"
#include "layout/study/study.h"

namespace tera {

/// Map of the places around the machine that a layout sees at one height above the ground.
///
/// Model   tests the centre of each cell. A cell does not count at moments when it lies inside the
///         machine's outline from above, inside a solid object, or off the site.
class BlindMap {
 public:
  explicit BlindMap(double height_m) : height_m_(height_m) {}

  /// Adds the places of this moment. The caller has excluded those inside the machine's outline
  /// (LeaveOutHull).
  void Add(const PolarPlaces& places, const Layout& layout, const SeenFrom& seen,
           const Sighting& sighting);

  double height_m() const { return height_m_; }
  /// Share of the counted moments at which each cell is seen, by PolarGrid::Index. Negative if the
  /// cell never counted.
  std::vector<double> SeenShare() const;
  /// Unseen area within 12 m and from there to 24 m: "map/HEIGHT m/blind_m2_to_12m" and "_to_24m".
  std::vector<Figure> Figures() const;

 private:
  double height_m_;
  std::vector<double> seen_ = std::vector<double>(PolarGrid::kSectors * PolarGrid::kRings);
  std::vector<double> counted_ = seen_;
  std::vector<double> near_blind_m2_, far_blind_m2_;  ///< one per moment
};

}  // namespace tera
