#pragma once

#include <string>

#include "core/config/model_archive.h"
#include "core/time.h"

namespace tera {

/// What a shutter makes of motion.
struct ShutterModel {
  double readout_s = 0;  ///< from the first row's exposure to the last row's; 0: all rows at once
  bool motion_blur = true;  ///< false: each row is of one instant, the middle of its exposure
  double step_px = 1;       ///< farthest that anything moves from one instant drawn to the next
  int most_pictures = 15;   ///< instants drawn for one picture; beyond, steps grow
};

void Serialize(ModelArchive* archive, ShutterModel* model);

/// The instants from which one picture is put together.
///
/// Frames  times count from the middle of the middle row's exposure, which is the picture's stamp.
/// Model   row y of h is exposed about (y / (h - 1) - 1/2) readout; the span of all exposures is
///         cut into equal slots, each standing for the instant in its middle; a row's light is the
///         mean of the instants by the time that its exposure has in each slot. An error in time
///         is at most half a slot.
class Exposures {
 public:
  /// `pictures` slots, an odd number, so that one instant is the middle.
  Exposures(const ShutterModel& model, double exposure_s, int rows, int pictures);

  /// Half of the time from the first row's opening to the last row's closing.
  static double Reach_s(const ShutterModel& model, double exposure_s);
  /// The fewest slots of `model` in which nothing goes further than a step, if it goes `motion_px`
  /// in all.
  static int PicturesFor(const ShutterModel& model, double motion_px);

  int pictures() const { return pictures_; }
  TimeNs Instant_ns(int picture) const;
  /// The share of an instant in the light of a row; over all instants 1.
  double Share(int row, int picture) const;
  /// The instant nearest the middle of a row's exposure.
  int MiddleOf(int row) const;

 private:
  double RowMiddle_s(int row) const;

  double readout_s_, open_s_, slot_s_;
  int rows_, pictures_;
};

}  // namespace tera
