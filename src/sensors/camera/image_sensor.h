#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/config/model_archive.h"
#include "core/random.h"
#include "core/types/measurement.h"
#include "render/gl/camera_intrinsics.h"
#include "sensors/camera/exposure_control.h"
#include "sensors/camera/shutter.h"
#include "sensors/camera/vignetting.h"

namespace tera {

/// Colours of the filters before the first two pixels of the first two rows, as cameras name them.
enum class ColourFilter { kRggb, kBggr, kGrbg, kGbrg };

/// An image sensor with its lens, by the figures of an EMVA 1288 data sheet.
struct ImageSensorModel {
  double exposure_s = 0.002, f_number = 4, transmission = 0.9;
  double pixel_um = 3.45;
  Vec3 quantum_efficiency = Vec3(0.5, 0.6, 0.5);  ///< of red, green and blue light, with the filter
  double full_well_e = 10500, read_noise_e = 2.3;
  double dark_current_eps = 1;  ///< electrons a second in each pixel at dark_temperature_degc
  double temperature_degc = 35, dark_temperature_degc = 25, dark_doubling_k = 8;
  double prnu = 0;         ///< 1 sigma of the pixels' sensitivities, over their mean
  double dsnu_e = 0;       ///< 1 sigma of the pixels' dark signals
  double row_noise_e = 0;  ///< 1 sigma of what a whole row is off by in one picture
  double hot_pixels = 0;   ///< share of pixels that have kHotPixel times the dark current
  int bits = 12;
  double gain_db = 0;  ///< 0: the full well fills the range of `bits`
  double black_dn = 64;
  std::optional<ColourFilter> filter = ColourFilter::kRggb;  ///< none: a sensor for each colour
  std::optional<LensRim> rim;  ///< none: corners are darker by the fourth power alone
  std::optional<AutomaticExposure> auto_exposure;           ///< none: exposure_s and gain_db stay
  std::optional<AutomaticWhiteBalance> auto_white_balance;  ///< none: that of daylight
  std::optional<ShutterModel> shutter;  ///< none: the whole picture is of one instant
};

/// The longest that a pixel may gather light for one picture.
double LongestExposure_s(const ImageSensorModel& model);

void Serialize(ModelArchive* archive, ImageSensorModel* model);

/// What a pixel with an exceptional dark current has, over the others'.
inline constexpr double kHotPixel = 200;
/// Photons from 400 to 700 nm of daylight a second on a square metre, for each lux. Source:
/// Thimijan and Heins 1983, "Photometric, radiometric, and quantum light units of measure": 54 lux
/// of sun and sky are one micromole of photons.
inline constexpr double kPhotonsPerLuxSecond = 6.02214076e23 * 1e-6 / 54;

/// From luminance to what a camera delivers.
///
/// Model   illuminance behind the lens pi L tau v / (4 N^2), v = cos^4(angle), or what a lens that
///         looks sideways has in its place (angular_lens.h), less what the rim shades; of each
///         colour that of a white of its value; a third of daylight's photons are each colour's;
///         electrons are Poisson's of QE times photons (PRNU) and dark current, at most the full
///         well; then y = K (electrons + DSNU + row + read noise) + black, rounded, within the
///         range. Dark current doubles each dark_doubling_k. The picture is a bilinear, edge-aware
///         demosaic, white balanced for daylight, in sRGB. Poisson's counts are exact below 20 and
///         normal, rounded, above.
/// Omits   spectra; crosstalk, lag, blooming, correlated double sampling; compression of highlights
///         by a tone curve; aberrations of the lens.
/// Source  EMVA 1288 release 4.0, linear model, eqs. (1) to (15); cos^4: Kingslake 1992, "Optics in
///         photography"; sRGB: IEC 61966-2-1.
class ImageSensor {
 public:
  ImageSensor(const ImageSensorModel& model, const CameraIntrinsics& camera, std::uint64_t seed,
              const std::string& stream_name);

  /// As the model has them, balanced for daylight.
  PictureSettings UsualSettings() const;
  /// K, in digital numbers an electron.
  double gain_dn_per_e(const PictureSettings& settings) const;
  double gain_dn_per_e() const { return gain_dn_per_e(UsualSettings()); }
  /// The luminance on the axis that fills the range of green.
  double white_cdpm2(const PictureSettings& settings) const;
  /// Digital numbers of picture k, one channel behind colour filters, else three. Luminance in
  /// cd/m^2, three channels of linear sRGB.
  Image<std::uint16_t> Expose(const Image<float>& luminance_cdpm2, std::int64_t k,
                              const PictureSettings& settings) const;
  Image<std::uint16_t> Expose(const Image<float>& luminance_cdpm2, std::int64_t k) const {
    return Expose(luminance_cdpm2, k, UsualSettings());
  }
  /// sRGB of what Expose gives.
  Image<std::uint8_t> Develop(const Image<std::uint16_t>& raw_dn,
                              const PictureSettings& settings) const;
  Image<std::uint8_t> Develop(const Image<std::uint16_t>& raw_dn) const {
    return Develop(raw_dn, UsualSettings());
  }
  /// What a control loop sees of what Expose gives.
  Metered Meter(const Image<std::uint16_t>& raw_dn, const MeteringZone& zone) const;

 private:
  int ColourOf(int x_px, int y_px) const;
  double Electrons(std::size_t place, std::uint64_t draw, double photons, double efficiency,
                   double dark_e) const;

  ImageSensorModel model_;
  int width_px_, height_px_;
  std::vector<float> photons_per_cdpm2_;  ///< by pixel, of one colour
  std::vector<float> sensitivity_;        ///< by pixel and channel, about 1
  std::vector<float> dark_signal_e_;      ///< DSNU, likewise
  std::vector<float> dark_current_;       ///< over the mean, likewise
  Stream shot_, read_, row_;
};

}  // namespace tera
