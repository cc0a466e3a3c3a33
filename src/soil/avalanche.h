#pragma once

#include <cstdint>
#include <vector>

#include "soil/columns.h"

namespace tera {

/// Loose soil that slides down, and banks that are too steep to stand.
///
/// Model   A column whose loose surface is steeper than the start angle towards any of its eight
///         neighbours (at their true distances) flows until it is no steeper than the stop angle
///         towards all of them; each step moves a share of every excess height, at the speed of a
///         dense granular flow. Both angles lie close around the angle of repose. All outflows are
///         computed from the same surface, then applied, so that the order of columns does not
///         matter. A bank stands up to Culmann's critical height for its slope, looking down over
///         several columns; above that its top breaks into loose soil.
///         Only columns near a change are visited. Nothing slides into a column in which a shovel
///         stands.
/// Omits   inertia of the flow, entrainment of bank soil, flow over the site's border.
/// Source  Culmann's wedge: Das, Principles of Geotechnical Engineering, ch. 15.
class Avalanche {
 public:
  explicit Avalanche(const std::vector<SoilType>& soils);
  /// Visits columns changed since the last call and those still flowing.
  void Flow(double dt_s, Columns* ground);
  /// Columns to be visited at the next call, besides those that change until then.
  std::size_t active_count() const { return active_.size(); }

 private:
  struct Transfer {
    ColumnId from, to;
    double thickness_m;
  };
  void Wake(ColumnId k, Columns* ground);
  bool CollectOutflow(ColumnId k, double share, Columns* ground);
  double Overhang_m(ColumnId k, const Columns& ground) const;

  std::vector<ColumnId> active_;
  std::vector<std::uint8_t> is_active_;  ///< by id
  std::vector<std::uint8_t> flowing_;    ///< by id
  std::vector<Transfer> transfers_;
  struct Angles {
    double tan_start, tan_stop, tan_stand;
    double culmann_m;  ///< 4 c / (rho g)
    double friction_rad;
  };
  std::vector<Angles> angles_;  ///< one for each soil
};

/// Greatest height at which a bank of slope `slope_rad` stands (infinite below the friction angle).
double CulmannHeight_m(const SoilType& soil, double slope_rad);

}  // namespace tera
