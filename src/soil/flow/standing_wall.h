#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "soil/columns/columns.h"
#include "soil/flow/layered_bank.h"

namespace tera {

class Grains;

/// Greatest height at which a bank of slope `slope_rad` stands (infinite below the friction angle).
/// Source  Culmann's wedge: Das, Principles of Geotechnical Engineering, ch. 15; upright it is
///         4 c / (rho g) tan(45 deg + phi / 2).
double CulmannHeight_m(const SoilType& soil, double slope_rad);

/// Banks, and the failing of those too high to stand.
///
/// Model   Columns are upright prisms: between neighbours of unequal height stands an upright wall.
///         A bank stands up to Culmann's critical height for its slope from the wall at its edge to
///         that at its toe. The search looks down over several columns in eight directions. Loose
///         soil on top does not count; loose soil at the toe supports, and so does a tool. A
///         cohesive bank that is too high loses the wedge above the plane through its toe at half
///         the sum of slope and friction angle. The wedge becomes clods where it stood, which slide
///         down the plane. One with no or little cohesion crumbles at the surface into loose soil,
///         down to the slope of internal friction. Gear that stands on the wedge loads it: q for
///         each square metre of its surface counts as 2 q / (rho g) of height. Where the uppermost
///         soil stands on other soils, the least safe surface through them counts (LayeredBanks).
/// Omits   heaps behind the edge as surcharge, water in cracks, undercut banks.
class StandingWalls {
 public:
  struct Failure {
    ColumnId column;    ///< at the edge
    std::uint8_t soil;  ///< uppermost of those that stand upright there
    double top_m;       ///< z of the bank, below the loose soil on it
    double drop_m;      ///< from there to the toe
    double run_m;       ///< from the wall at the edge to that at the toe
    double overhang_m;  ///< of the drop, more than stands
    Vec2 out;           ///< level direction, of length 1, in which it falls; zero on all sides
    SlipSurface slip;   ///< of a wedge; one that crumbles has none
  };

  explicit StandingWalls(const std::vector<SoilType>& soils);
  /// Whether the top of a column is the edge of a bank that cannot stand.
  std::optional<Failure> FailureAt(ColumnId k, const Columns& ground) const;
  /// Calls visit(k) for columns within reach of gear that has been on the ground since the last
  /// call. Their banks may fail though nothing there has changed.
  template <typename Visit>
  static void ForLoaded(Columns* ground, Visit visit) {
    const int reach = static_cast<int>(kLoadReach_m / ground->cell_m());
    for (const Columns::Box& box : ground->TakeLoaded()) {
      for (int j = std::max(0, box.j0 - reach); j <= std::min(ground->ny() - 1, box.j1 + reach);
           ++j) {
        for (int i = std::max(0, box.i0 - reach); i <= std::min(ground->nx() - 1, box.i1 + reach);
             ++i) {
          const ColumnId k = ground->IdAt(i, j);
          if (k != Columns::kNone) visit(k);
        }
      }
    }
  }
  /// Lets banks fail for `dt_s`, wedges all at once, in clods as large as there is room for.
  void Fail(const std::vector<Failure>& failures, double dt_s, Columns* ground,
            Grains* grains) const;

 private:
  static constexpr double kLoadReach_m = 1.0;  ///< from gear to the edge of a bank that it loads
  struct Limit {
    double tan_stand;  ///< of the slope that stands at any height
    double upright_m;  ///< critical height of an upright wall
  };
  bool IsEdge(ColumnId k, const Columns& ground) const;
  std::optional<Failure> FailureOfTop(ColumnId k, const Columns& ground) const;
  std::optional<Failure> FailureOfLayers(ColumnId k, const Columns& ground) const;
  bool StandsAsSlope(const BankLayers& layers, double length_m) const;

  std::vector<Limit> limits_;  ///< one for each soil
  LayeredBanks layered_;
  double least_tan_stand_ = std::numeric_limits<double>::infinity();
};

}  // namespace tera
