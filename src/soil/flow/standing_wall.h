#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "soil/columns/columns.h"
#include "soil/flow/layered_bank.h"

namespace tera {

class Grains;

/// Greatest stable height of a bank of slope `slope_rad`; infinite below the friction angle. For a
/// vertical wall it is 4 c / (rho g) tan(45 deg + phi / 2).
/// Source  Culmann's wedge: Das, Principles of Geotechnical Engineering, ch. 15.
double CulmannHeight_m(const SoilType& soil, double slope_rad);

/// Stability of banks, and failure of those that are too high.
///
/// Model   Columns are vertical prisms, with a vertical wall between neighbours of unequal height.
///         A bank stands up to Culmann's critical height for its slope, measured from the wall at
///         its edge to the wall at its toe. The search looks down over several columns in eight
///         directions. Loose soil on top is ignored. Loose soil at the toe and tools support the
///         bank.
///         A cohesive bank that is too high loses a wedge. The wedge lies above a plane through the
///         toe, at half the sum of slope and friction angle. It becomes clods, which slide down the
///         plane. A bank with little or no cohesion crumbles at its surface into loose soil, down
///         to the slope of internal friction. Running gear on the wedge adds load: a pressure q
///         counts as 2 q / (rho g) of height. If the uppermost soil lies on other soils, the slip
///         surface with the least safety decides (LayeredBanks).
/// Omits   Heaps behind the edge as surcharge, water in cracks, undercut banks.
class StandingWalls {
 public:
  struct Failure {
    ColumnId column;    ///< at the edge
    std::uint8_t soil;  ///< uppermost standing soil at the edge
    double top_m;       ///< z of the top of the bank, below loose soil on it
    double drop_m;      ///< height from the toe to the top
    double run_m;       ///< horizontal distance from the wall at the edge to that at the toe
    double overhang_m;  ///< height in excess of the stable height
    /// Horizontal unit vector of the fall; zero for a fall to all sides.
    Vec2 out;
    SlipSurface slip;  ///< empty for a bank that crumbles
  };

  explicit StandingWalls(const std::vector<SoilType>& soils);
  /// Failure of the bank whose upper edge is at column `k`; empty if the bank is stable.
  std::optional<Failure> FailureAt(ColumnId k, const Columns& ground) const;
  /// Calls visit(k) for columns near running gear that has moved since the last call. Their banks
  /// may fail without any other change.
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
  /// Applies failures for `dt_s`. All wedges break at once, in clods large enough for the limit of
  /// their number.
  void Fail(const std::vector<Failure>& failures, double dt_s, Columns* ground,
            Grains* grains) const;

 private:
  /// Distance from running gear within which it loads the edge of a bank.
  static constexpr double kLoadReach_m = 1.0;
  struct Limit {
    double tan_stand;  ///< slope that is stable at any height
    double upright_m;  ///< critical height of a vertical wall
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
