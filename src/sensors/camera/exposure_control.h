#pragma once

#include <deque>
#include <optional>
#include <string>

#include "core/config/model_archive.h"
#include "core/motion.h"

namespace tera {

/// The part of a picture that is metered, as shares of its width and height.
struct MeteringZone {
  double left = 0, top = 0, right = 1, bottom = 1;
};

/// Control that follows the pictures taken before.
struct ControlLoop {
  MeteringZone zone;
  int delay_pictures = 2;  ///< from a picture to the first that it has an influence on
  double rate = 0.5;       ///< share of the error, in EV, that one picture mends
};

struct AutomaticExposure : ControlLoop {
  double target = 0.18;  ///< mean of green's signal over its range
  double shortest_s = 2e-5, longest_s = 0.03;
  double least_gain_db = 0, most_gain_db = 24;
};

struct AutomaticWhiteBalance : ControlLoop {
  double most = 4;  ///< factor on red or blue; its inverse is the least
};

void Serialize(ModelArchive* archive, AutomaticExposure* model);
void Serialize(ModelArchive* archive, AutomaticWhiteBalance* model);

/// What a camera sets for one picture.
struct PictureSettings {
  double exposure_s = 0, gain_db = 0;
  Vec3 balance = Vec3::Ones();  ///< factors on red, green and blue
};

/// What a control loop sees of a picture.
struct Metered {
  double signal = 0;           ///< mean of green over its range, saturated pixels too
  Vec3 colour = Vec3::Zero();  ///< means over the pixels that are not saturated
};

/// Automatic exposure and white balance of one camera, picture by picture.
///
/// Model   of picture j with the product H of exposure and gain: picture j + delay has
///         H (target / signal)^rate, as exposure up to its longest, then as gain. Balance likewise,
///         from what it was to what makes red and blue equal green on average (grey world).
///         Before the first picture that has an influence, settings are those of the start.
/// Omits   weights within the zone, histograms, hysteresis; flicker avoidance.
/// Source  grey world: Buchsbaum 1980, "A spatial processor model for object colour perception".
class ExposureControl {
 public:
  ExposureControl(const std::optional<AutomaticExposure>& exposure,
                  const std::optional<AutomaticWhiteBalance>& balance,
                  const PictureSettings& start);

  /// Of the next picture.
  PictureSettings Settings() const;
  bool meters_exposure() const { return exposure_.has_value(); }
  bool meters_balance() const { return balance_.has_value(); }
  /// Takes that picture as its loops meter it.
  void Take(const Metered& for_exposure, const Metered& for_balance);

 private:
  /// H of an exposure loop's settings as exposure and gain.
  void Split(double product_s, PictureSettings* settings) const;

  std::optional<AutomaticExposure> exposure_;
  std::optional<AutomaticWhiteBalance> balance_;
  PictureSettings start_;
  std::deque<double> product_s_;  ///< of the pictures to come, the next first
  std::deque<Vec3> balances_;
};

}  // namespace tera
