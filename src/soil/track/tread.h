#pragma once

#include "core/types/ground_tools.h"
#include "soil/columns/columns.h"

namespace tera {

/// The print of a track's grousers in the rut behind it.
///
/// Frames  W; B the frame of the gear's link.
/// Model   The print is a wave along the track with the pitch of the grousers. Its height from
///         trough to crest is that of the grousers, at most the plastic sinkage of the ground. A
///         column that comes free in a trough gives soil to the column half a pitch further out,
///         until their heights differ by the wave. So mass is conserved. The wave is fixed to the
///         shoes: at slip i, prints are (1 - i) pitches apart on the ground. A column of width c
///         shows the mean of the wave, a factor of sin(pi c / pitch) / (pi c / pitch). Columns
///         wider than half a pitch show a smooth rut.
/// Omits   The shape of the grousers. The shape of the grousers. A trough whose outer neighbour,
///         half a pitch away, is still under the track: it gets no print.
class Tread {
 public:
  explicit Tread(const RunningGear& gear);

  /// Advances the shoes by `shoe_m` along their travel.
  void Roll(double shoe_m) { travel_m_ += shoe_m; }
  /// Prints column `k`, which the gear has just left.
  void Print(ColumnId k, const Pose& X_WB, Columns* ground) const;

 private:
  double pitch_m_, height_m_;
  double middle_B_m_ = 0;  ///< x of the middle of the gear
  double travel_m_ = 0;
};

}  // namespace tera
