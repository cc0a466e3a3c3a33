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

/// A control loop that acts on later images.
struct ControlLoop {
  MeteringZone zone;
  int delay_pictures = 2;  ///< number of images from the metered one to the first one affected
  double rate = 0.5;       ///< share of the error, in EV, corrected per image
};

struct AutomaticExposure : ControlLoop {
  double target = 0.18;  ///< mean green signal as a share of its range
  double shortest_s = 2e-5, longest_s = 0.03;
  double least_gain_db = 0, most_gain_db = 24;
};

struct AutomaticWhiteBalance : ControlLoop {
  double most = 4;  ///< greatest factor on red or blue; its inverse is the least
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
  double signal = 0;           ///< mean green as a share of its range, with saturated pixels
  Vec3 colour = Vec3::Zero();  ///< means over the unsaturated pixels
};

/// Automatic exposure and white balance of one camera, image by image.
///
/// Model   H is the product of exposure and gain of image j. Image j + delay gets H (target /
///         signal)^rate. It is applied as exposure up to the longest one, then as gain. The balance
///         moves in the same way towards equal means of red, green and blue (grey world). The first
///         `delay` images keep the initial settings.
/// Omits   Weights within the zone, histograms, hysteresis; flicker avoidance.
/// Source  Grey world: Buchsbaum 1980, "A spatial processor model for object colour perception".
class ExposureControl {
 public:
  ExposureControl(const std::optional<AutomaticExposure>& exposure,
                  const std::optional<AutomaticWhiteBalance>& balance,
                  const PictureSettings& start);

  /// Settings of the next image.
  PictureSettings Settings() const;
  bool meters_exposure() const { return exposure_.has_value(); }
  bool meters_balance() const { return balance_.has_value(); }
  /// Passes the metering of the next image to both loops.
  void Take(const Metered& for_exposure, const Metered& for_balance);

 private:
  /// Splits H into exposure and gain.
  void Split(double product_s, PictureSettings* settings) const;

  std::optional<AutomaticExposure> exposure_;
  std::optional<AutomaticWhiteBalance> balance_;
  PictureSettings start_;
  std::deque<double> product_s_;  ///< products of exposure and gain of the next images, in order
  std::deque<Vec3> balances_;
};

}  // namespace tera
