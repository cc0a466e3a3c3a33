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

/// Filter colours of the first two pixels of the first two rows, in camera notation.
enum class ColourFilter { kRggb, kBggr, kGrbg, kGbrg };

/// An image sensor with the light loss of its lens, in terms of an EMVA 1288 data sheet.
struct ImageSensorModel {
  double exposure_s = 0.002, f_number = 4, transmission = 0.9;
  double pixel_um = 3.45;
  Vec3 quantum_efficiency = Vec3(0.5, 0.6, 0.5);  ///< red, green, blue; with the colour filter
  double full_well_e = 10500, read_noise_e = 2.3;
  double dark_current_eps = 1;  ///< electrons per second and pixel at dark_temperature_degc
  double temperature_degc = 35, dark_temperature_degc = 25, dark_doubling_k = 8;
  double prnu = 0;         ///< 1 sigma of the relative sensitivity of pixels
  double dsnu_e = 0;       ///< 1 sigma of the dark signal of pixels
  double row_noise_e = 0;  ///< 1 sigma of the common offset of a row in one image
  double hot_pixels = 0;   ///< fraction of pixels with kHotPixel times the dark current
  int bits = 12;
  double gain_db = 0;  ///< 0: the full well fills the range of `bits`
  double black_dn = 64;
  std::optional<ColourFilter> filter = ColourFilter::kRggb;  ///< none: three colours at each pixel
  std::optional<LensRim> rim;                      ///< none: only cos^4 darkens the corners
  std::optional<AutomaticExposure> auto_exposure;  ///< none: constant exposure_s and gain_db
  std::optional<AutomaticWhiteBalance> auto_white_balance;  ///< none: daylight balance
  std::optional<ShutterModel> shutter;  ///< none: global shutter without motion blur
};

/// Longest exposure of a pixel in one image.
double LongestExposure_s(const ImageSensorModel& model);

void Serialize(ModelArchive* archive, ImageSensorModel* model);

/// Ratio of the dark current of a hot pixel to that of other pixels.
inline constexpr double kHotPixel = 200;
/// Photons of daylight from 400 to 700 nm per second, square metre and lux.
///
/// Source  Thimijan and Heins 1983, "Photometric, radiometric, and quantum light units of measure":
///         54 lux of sun and sky are one micromole of photons.
inline constexpr double kPhotonsPerLuxSecond = 6.02214076e23 * 1e-6 / 54;

/// Conversion from luminance to digital images.
///
/// Model   Light: the illuminance behind the lens is pi L tau v / (4 N^2) with v = cos^4(angle),
///         reduced by the rim of the lens. For angular lenses, v is the relative illumination of
///         angular_lens.h. A colour value has the illuminance of a white surface of that value;
///         each colour has a third of the photons of daylight.
///         Signal: electrons are Poisson counts of QE times photons (PRNU) plus dark current, at
///         most the full well. Counts are exact below 20 and rounded normal values above. Then y =
///         K (electrons + DSNU + row + read noise) + black, rounded and clipped. The dark current
///         doubles per dark_doubling_k.
///         Image: a bilinear, edge-aware demosaic in sRGB with daylight white balance.
/// Omits   Spectra; crosstalk, lag, blooming, correlated double sampling; highlight compression by
///         a tone curve; lens aberrations.
/// Source  EMVA 1288 release 4.0, linear model, eqs. (1) to (15); cos^4: Kingslake 1992, "Optics in
///         photography"; sRGB: IEC 61966-2-1.
class ImageSensor {
 public:
  ImageSensor(const ImageSensorModel& model, const CameraIntrinsics& camera, std::uint64_t seed,
              const std::string& stream_name);

  /// Settings of the model, with daylight balance.
  PictureSettings UsualSettings() const;
  /// K, in digital numbers per electron.
  double gain_dn_per_e(const PictureSettings& settings) const;
  double gain_dn_per_e() const { return gain_dn_per_e(UsualSettings()); }
  /// Luminance on the axis that saturates green.
  double white_cdpm2(const PictureSettings& settings) const;
  /// Digital numbers of image k: one channel with a colour filter, otherwise three. Luminance is in
  /// cd/m^2, as three channels of linear sRGB.
  Image<std::uint16_t> Expose(const Image<float>& luminance_cdpm2, std::int64_t k,
                              const PictureSettings& settings) const;
  Image<std::uint16_t> Expose(const Image<float>& luminance_cdpm2, std::int64_t k) const {
    return Expose(luminance_cdpm2, k, UsualSettings());
  }
  /// Converts the output of Expose to sRGB.
  Image<std::uint8_t> Develop(const Image<std::uint16_t>& raw_dn,
                              const PictureSettings& settings) const;
  Image<std::uint8_t> Develop(const Image<std::uint16_t>& raw_dn) const {
    return Develop(raw_dn, UsualSettings());
  }
  /// Meters the output of Expose for a control loop.
  Metered Meter(const Image<std::uint16_t>& raw_dn, const MeteringZone& zone) const;

 private:
  int ColourOf(int x_px, int y_px) const;
  double Electrons(std::size_t place, std::uint64_t draw, double photons, double efficiency,
                   double dark_e) const;

  ImageSensorModel model_;
  int width_px_, height_px_;
  std::vector<float> photons_per_cdpm2_;  ///< per pixel, for one colour
  std::vector<float> sensitivity_;        ///< per pixel and channel, mean about 1
  std::vector<float> dark_signal_e_;      ///< DSNU, per pixel and channel
  std::vector<float> dark_current_;       ///< per pixel and channel, relative to the mean
  Stream shot_, read_, row_;
};

}  // namespace tera
