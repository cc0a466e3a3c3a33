#pragma once

#include "core/types/ground_tools.h"
#include "soil/columns/columns.h"

namespace tera {

/// The print of a track's grousers in the rut that it leaves behind.
///
/// Frames  W; B the frame of the gear's link.
/// Model   A wave along the track, as long as the grousers' pitch. From trough to crest it is as
///         high as they are, but no higher than the ground was pressed in. Where a column comes
///         free in a trough, soil goes from it to the column half a pitch farther out, until the
///         two differ by the wave. So the wave keeps the rut's mass. It stands still on the shoes:
///         on ground over which they slip by i, prints are a pitch times 1 - i apart. A column is
///         the mean of the wave over its width c, sin(pi c / pitch) / (pi c / pitch) of it. Columns
///         wider than half a pitch cannot show it and keep its mean, a smooth rut.
/// Omits   the grousers' own shape; prints of ground that comes free beside the track while the
///         ground half a pitch farther out is still under it.
class Tread {
 public:
  explicit Tread(const RunningGear& gear);

  /// The shoes move on by `shoe_m` along their travel.
  void Roll(double shoe_m) { travel_m_ += shoe_m; }
  /// Prints column `k`, which has just come free.
  void Print(ColumnId k, const Pose& X_WB, Columns* ground) const;

 private:
  double pitch_m_, height_m_;
  double middle_B_m_ = 0;  ///< x of the gear's middle
  double travel_m_ = 0;
};

}  // namespace tera
