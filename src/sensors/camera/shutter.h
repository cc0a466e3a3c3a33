#pragma once

#include <string>

#include "core/config/model_archive.h"
#include "core/time.h"

namespace tera {

/// Exposure timing of a shutter.
struct ShutterModel {
  double readout_s = 0;     ///< between the first and the last row's exposure; 0: global shutter
  bool motion_blur = true;  ///< false: each row shows the instant at the middle of its exposure
  double step_px = 1;       ///< maximum image motion between consecutive instants
  int most_pictures = 15;  ///< maximum number of instants per image; faster motion has larger steps
};

void Serialize(ModelArchive* archive, ShutterModel* model);

/// Instants that compose one image.
///
/// Frames  times are relative to the middle of the middle row's exposure, the image's time stamp.
/// Model   the exposure of row y of h is centred at (y / (h - 1) - 1/2) readout. The span of all
///         exposures consists of equal slots, each represented by its middle instant. A row's light
///         is the mean of the instants, weighted by the exposure time within each slot. The timing
///         error is at most half a slot.
class Exposures {
 public:
  /// `pictures` is the odd number of slots, so that the stamp is one of the instants.
  Exposures(const ShutterModel& model, double exposure_s, int rows, int pictures);

  /// Half the time from the first row's opening to the last row's closing.
  static double Reach_s(const ShutterModel& model, double exposure_s);
  /// Smallest number of slots for which no motion exceeds a step, given the total motion
  /// `motion_px`.
  static int PicturesFor(const ShutterModel& model, double motion_px);

  int pictures() const { return pictures_; }
  TimeNs Instant_ns(int picture) const;
  /// Weight of an instant in a row's light; the weights sum to 1.
  double Share(int row, int picture) const;
  /// The instant nearest to the middle of a row's exposure.
  int MiddleOf(int row) const;

 private:
  double RowMiddle_s(int row) const;

  double readout_s_, open_s_, slot_s_;
  int rows_, pictures_;
};

}  // namespace tera
