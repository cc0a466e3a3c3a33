#pragma once

#include <deque>
#include <optional>
#include <string>

#include "core/config/model_archive.h"
#include "core/motion.h"

namespace tera {

/// Metered image region, as fractions of width and height.
struct MeteringZone {
  double left = 0, top = 0, right = 1, bottom = 1;
};

/// Control loop on previous images.
struct ControlLoop {
  MeteringZone zone;
  int delay_pictures = 2;  ///< from an image to the first image that it affects
  double rate = 0.5;       ///< fraction of the error, in EV, corrected per image
};

struct AutomaticExposure : ControlLoop {
  double target = 0.18;  ///< mean of green's signal over its range
  double shortest_s = 2e-5, longest_s = 0.03;
  double least_gain_db = 0, most_gain_db = 24;
};

struct AutomaticWhiteBalance : ControlLoop {
  double most = 4;  ///< maximum factor on red or blue; its inverse is the minimum
};

void Serialize(ModelArchive* archive, AutomaticExposure* model);
void Serialize(ModelArchive* archive, AutomaticWhiteBalance* model);

/// Camera settings of one image.
struct PictureSettings {
  double exposure_s = 0, gain_db = 0;
  Vec3 balance = Vec3::Ones();  ///< factors on red, green and blue
};

/// Metering result of an image.
struct Metered {
  double signal = 0;           ///< mean of green over its range, including saturated pixels
  Vec3 colour = Vec3::Zero();  ///< means over the unsaturated pixels
};

/// Automatic exposure and white balance of one camera, image by image.
///
/// Model   H is the product of exposure and gain of image j. Image j + delay has
///         H (target / signal)^rate, as exposure up to its longest, then as gain. The balance moves
///         likewise towards equal means of red, green and blue (grey world). The first `delay`
///         images keep the initial settings.
/// Omits   weights within the zone, histograms, hysteresis; flicker avoidance.
/// Source  grey world: Buchsbaum 1980, "A spatial processor model for object colour perception".
class ExposureControl {
 public:
  ExposureControl(const std::optional<AutomaticExposure>& exposure,
                  const std::optional<AutomaticWhiteBalance>& balance,
                  const PictureSettings& start);

  /// Settings of the next image.
  PictureSettings Settings() const;
  bool meters_exposure() const { return exposure_.has_value(); }
  bool meters_balance() const { return balance_.has_value(); }
  /// Meters the next image for both loops.
  void Take(const Metered& for_exposure, const Metered& for_balance);

 private:
  /// Splits H into exposure and gain.
  void Split(double product_s, PictureSettings* settings) const;

  std::optional<AutomaticExposure> exposure_;
  std::optional<AutomaticWhiteBalance> balance_;
  PictureSettings start_;
  std::deque<double> product_s_;  ///< settings of the next images, in order
  std::deque<Vec3> balances_;
};

}  // namespace tera
