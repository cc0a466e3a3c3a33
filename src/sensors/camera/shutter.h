#pragma once

#include <string>

#include "core/config/model_archive.h"
#include "core/time.h"

namespace tera {

/// Exposure timing of a shutter.
struct ShutterModel {
  double readout_s = 0;     ///< from the first to the last row's exposure; 0 for a global shutter
  bool motion_blur = true;  ///< false: each row shows the middle instant of its exposure
  double step_px = 1;       ///< greatest image motion between consecutive instants
  /// Greatest number of instants per image. Faster motion has larger steps.
  int most_pictures = 15;
};

void Serialize(ModelArchive* archive, ShutterModel* model);

/// Instants that are combined into one image.
///
/// Frames  Times are relative to the time stamp, which is the middle of the middle row's exposure.
/// Model   The exposure of row y of h is centred at (y / (h - 1) - 1/2) readout. The span of all
///         exposures is divided into equal slots. The middle instant of a slot represents it. The
///         light of a row is the mean of the instants, weighted by the exposure time in each slot.
///         The timing error is at most half a slot.
class Exposures {
 public:
  /// `pictures` is the number of slots. It is odd, so that the stamp is one of the instants.
  Exposures(const ShutterModel& model, double exposure_s, int rows, int pictures);

  /// Half the time from the opening of the first row to the closing of the last row.
  static double Reach_s(const ShutterModel& model, double exposure_s);
  /// Least number of slots with which no motion between instants exceeds step_px. `motion_px` is
  /// the total motion.
  static int PicturesFor(const ShutterModel& model, double motion_px);

  int pictures() const { return pictures_; }
  TimeNs Instant_ns(int picture) const;
  /// Weight of an instant in the light of a row; the weights sum to 1.
  double Share(int row, int picture) const;
  /// The instant nearest to the middle of a row's exposure.
  int MiddleOf(int row) const;

 private:
  double RowMiddle_s(int row) const;

  double readout_s_, open_s_, slot_s_;
  int rows_, pictures_;
};

}  // namespace tera
