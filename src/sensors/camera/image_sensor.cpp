#include "sensors/camera/image_sensor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/units.h"
#include "render/gl/angular_lens.h"

namespace tera {
namespace {

constexpr double kFewElectrons = 20;  ///< smaller counts use the exact Poisson distribution
constexpr std::array<std::string_view, 4> kFilterNames = {"rggb", "bggr", "grbg", "gbrg"};

/// Poisson count by inversion.
double FewOf(double mean, double uniform) {
  double probability = std::exp(-mean), below = probability, count = 0;
  while (uniform > below && count < 200) {
    probability *= mean / ++count;
    below += probability;
  }
  return count;
}

/// Poisson count; a rounded normal value for large means.
double CountOf(double mean, const Stream& draw, std::uint64_t index) {
  if (mean < kFewElectrons) return FewOf(mean, draw.Uniform(index));
  return std::max(0.0, std::round(mean + std::sqrt(mean) * draw.Gaussian(index)));
}

std::uint8_t Encoded(double linear) {
  const double x = std::clamp(linear, 0.0, 1.0);
  const double srgb = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255 * srgb));
}

/// Interpolates three colours at each pixel from the colour filter array.
cv::Mat Demosaiced(const Image<std::uint16_t>& raw, ColourFilter filter) {
  constexpr std::array<int, 4> kCodes = {cv::COLOR_BayerRGGB2RGB_EA, cv::COLOR_BayerBGGR2RGB_EA,
                                         cv::COLOR_BayerGRBG2RGB_EA, cv::COLOR_BayerGBRG2RGB_EA};
  const cv::Mat one(raw.height_px, raw.width_px, CV_16UC1,
                    const_cast<std::uint16_t*>(raw.data.data()));
  cv::Mat three;
  cv::demosaicing(one, three, kCodes[static_cast<std::size_t>(filter)]);
  return three;
}

/// Photons of one colour on an axial pixel at 1 cd/m^2.
double PhotonsOnAxis(const ImageSensorModel& model) {
  const double lux_s =
      kPi * model.transmission / (4 * model.f_number * model.f_number) * model.exposure_s;
  return lux_s * kPhotonsPerLuxSecond / 3 * std::pow(model.pixel_um * 1e-6, 2);
}

/// Relative illumination of a pixel, 1 on the axis.
double Falloff(const ImageSensorModel& model, const CameraIntrinsics& camera,
               const Vec2& pixel_px) {
  const double falloff = camera.Illumination(pixel_px);
  if (!model.rim || falloff == 0) return falloff;
  const double focal_mm = camera.fx_px * model.pixel_um * 1e-3;
  return falloff * PupilShare(*model.rim, focal_mm / (2 * model.f_number),
                              AngleFromAxis(camera.Unproject(pixel_px)));
}

/// Photons of one colour in each pixel of a uniform image of 1 cd/m^2.
std::vector<float> PhotonsOf(const ImageSensorModel& model, const CameraIntrinsics& camera) {
  const double on_axis = PhotonsOnAxis(model);
  std::vector<float> photons;
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x) {
      photons.push_back(static_cast<float>(on_axis * Falloff(model, camera, Vec2(x, y))));
    }
  }
  return photons;
}

}  // namespace

double LongestExposure_s(const ImageSensorModel& model) {
  return model.auto_exposure ? std::max(model.exposure_s, model.auto_exposure->longest_s)
                             : model.exposure_s;
}

static void Serialize(ModelArchive* archive, LensRim* rim) {
  archive->Visit("radius_mm", &rim->radius_mm, Positive("mm"));
  archive->Visit("distance_mm", &rim->distance_mm, AtLeast(0, "mm"));
}

void Serialize(ModelArchive* archive, ImageSensorModel* m) {
  archive->Visit("exposure_s", &m->exposure_s, Positive("s"));
  archive->Visit("f_number", &m->f_number, Positive("1"));
  archive->Visit("transmission", &m->transmission, Between(0, 1, "1"));
  archive->Visit("pixel_um", &m->pixel_um, Positive("um"));
  archive->Visit("quantum_efficiency", &m->quantum_efficiency, Between(0, 1, "1"));
  archive->Visit("full_well_e", &m->full_well_e, Positive("e"));
  archive->Visit("read_noise_e", &m->read_noise_e, AtLeast(0, "e"));
  archive->Visit("dark_current_eps", &m->dark_current_eps, AtLeast(0, "e/s"));
  archive->Visit("temperature_degc", &m->temperature_degc, Between(-50, 120, "C"));
  archive->Visit("dark_temperature_degc", &m->dark_temperature_degc, Between(-50, 120, "C"));
  archive->Visit("dark_doubling_k", &m->dark_doubling_k, Positive("K"));
  archive->Visit("prnu", &m->prnu, Between(0, 0.3, "1"));
  archive->Visit("dsnu_e", &m->dsnu_e, AtLeast(0, "e"));
  archive->Visit("row_noise_e", &m->row_noise_e, AtLeast(0, "e"));
  archive->Visit("hot_pixels", &m->hot_pixels, Between(0, 1, "1"));
  archive->Visit("bits", &m->bits, Between(8, 16, "bit"));
  archive->Visit("gain_db", &m->gain_db, Between(0, 48, "dB"));
  archive->Visit("black_dn", &m->black_dn, Between(0, 0.25 * (1 << m->bits), "DN"));
  std::string filter(m->filter ? kFilterNames[static_cast<std::size_t>(*m->filter)] : "none");
  archive->Visit("filter", &filter, {"rggb", "bggr", "grbg", "gbrg", "none"});
  const auto named = std::find(kFilterNames.begin(), kFilterNames.end(), filter);
  m->filter.reset();
  if (named != kFilterNames.end()) {
    m->filter = static_cast<ColourFilter>(named - kFilterNames.begin());
  }
  archive->Visit("rim", &m->rim);
  archive->Visit("auto_exposure", &m->auto_exposure);
  archive->Visit("auto_white_balance", &m->auto_white_balance);
  archive->Visit("shutter", &m->shutter);
}

ImageSensor::ImageSensor(const ImageSensorModel& model, const CameraIntrinsics& camera,
                         std::uint64_t seed, const std::string& stream_name)
    : model_(model),
      width_px_(camera.width_px),
      height_px_(camera.height_px),
      photons_per_cdpm2_(PhotonsOf(model, camera)),
      shot_(seed, stream_name + "/shot"),
      read_(seed, stream_name + "/read"),
      row_(seed, stream_name + "/row") {
  const Stream pattern(seed, stream_name + "/pattern");
  const std::size_t places = photons_per_cdpm2_.size() * (model.filter ? 1 : 3);
  for (std::size_t i = 0; i < places; ++i) {
    const Vec3 normal = pattern.Gaussian3(i);
    const bool is_hot = pattern.Uniform(i, 1) < model.hot_pixels;
    sensitivity_.push_back(static_cast<float>(std::max(0.0, 1 + model.prnu * normal[0])));
    dark_signal_e_.push_back(static_cast<float>(model.dsnu_e * normal[1]));
    dark_current_.push_back(static_cast<float>(is_hot ? kHotPixel : 1));
  }
}

PictureSettings ImageSensor::UsualSettings() const {
  PictureSettings settings{.exposure_s = model_.exposure_s, .gain_db = model_.gain_db};
  const Vec3& qe = model_.quantum_efficiency;
  for (int c = 0; c < 3; ++c) settings.balance[c] = qe[c] > 0 ? qe[1] / qe[c] : 1;
  return settings;
}

double ImageSensor::gain_dn_per_e(const PictureSettings& settings) const {
  const double range_dn = (1 << model_.bits) - 1 - model_.black_dn;
  return range_dn / model_.full_well_e * std::pow(10, settings.gain_db / 20);
}

double ImageSensor::white_cdpm2(const PictureSettings& settings) const {
  constexpr double kLeastEfficiency = 1e-3;  // for a sensor almost blind to green
  const double efficiency = std::max(model_.quantum_efficiency[1], kLeastEfficiency);
  const double photons = PhotonsOnAxis(model_) * settings.exposure_s / model_.exposure_s;
  return model_.full_well_e / std::pow(10, settings.gain_db / 20) / (efficiency * photons);
}

/// Colour of a pixel: 0 red, 1 green, 2 blue.
int ImageSensor::ColourOf(int x_px, int y_px) const {
  constexpr std::array<std::array<int, 4>, 4> kColours = {
      {{0, 1, 1, 2}, {2, 1, 1, 0}, {1, 0, 2, 1}, {1, 2, 0, 1}}};
  return kColours[static_cast<std::size_t>(*model_.filter)]
                 [static_cast<std::size_t>(2 * (y_px & 1) + (x_px & 1))];
}

double ImageSensor::Electrons(std::size_t place, std::uint64_t draw, double photons,
                              double efficiency, double dark_e) const {
  const double mean = efficiency * sensitivity_[place] * photons + dark_e * dark_current_[place];
  return std::min(CountOf(mean, shot_, draw), model_.full_well_e);
}

Image<std::uint16_t> ImageSensor::Expose(const Image<float>& luminance_cdpm2, std::int64_t k,
                                         const PictureSettings& settings) const {
  const int channels = model_.filter ? 1 : 3;
  Image<std::uint16_t> raw(width_px_, height_px_, channels);
  const double gain = gain_dn_per_e(settings), most = (1 << model_.bits) - 1;
  const double open = settings.exposure_s / model_.exposure_s;
  const double dark_e =
      model_.dark_current_eps * settings.exposure_s *
      std::exp2((model_.temperature_degc - model_.dark_temperature_degc) / model_.dark_doubling_k);
  const auto first = static_cast<std::uint64_t>(k) * raw.data.size();
  for (int y = 0; y < height_px_; ++y) {
    const auto picture_row = static_cast<std::uint64_t>(k) * height_px_ + y;
    const double row_e =
        model_.row_noise_e > 0 ? model_.row_noise_e * row_.Gaussian(picture_row) : 0;
    for (int x = 0; x < width_px_; ++x) {
      const auto pixel = static_cast<std::size_t>(y) * width_px_ + x;
      for (int c = 0; c < channels; ++c) {
        const std::size_t place = pixel * channels + c;
        const int colour = model_.filter ? ColourOf(x, y) : c;
        const float usual_photons = photons_per_cdpm2_[pixel] * luminance_cdpm2.at(x, y, colour);
        const double photons = open * usual_photons;
        const double electrons =
            Electrons(place, first + place, photons, model_.quantum_efficiency[colour], dark_e) +
            dark_signal_e_[place] + row_e + model_.read_noise_e * read_.Gaussian(first + place);
        const double dn = std::round(gain * electrons + model_.black_dn);
        raw.data[place] = static_cast<std::uint16_t>(std::clamp(dn, 0.0, most));
      }
    }
  }
  return raw;
}

Metered ImageSensor::Meter(const Image<std::uint16_t>& raw_dn, const MeteringZone& zone) const {
  const double most = (1 << model_.bits) - 1, range_dn = most - model_.black_dn;
  double green = 0, greens = 0;
  Vec3 sum = Vec3::Zero(), count = Vec3::Zero();
  const int left = static_cast<int>(zone.left * width_px_),
            top = static_cast<int>(zone.top * height_px_);
  for (int y = top; y < std::max(zone.bottom * height_px_, top + 2.0) && y < height_px_; ++y) {
    for (int x = left; x < std::max(zone.right * width_px_, left + 2.0) && x < width_px_; ++x) {
      for (int c = 0; c < raw_dn.channels; ++c) {
        const int colour = model_.filter ? ColourOf(x, y) : c;
        const double dn = raw_dn.at(x, y, c), signal = (dn - model_.black_dn) / range_dn;
        if (colour == 1) green += signal, ++greens;
        if (dn < most) sum[colour] += signal, ++count[colour];
      }
    }
  }
  return {greens > 0 ? std::max(green / greens, 0.0) : 0, sum.cwiseQuotient(count.cwiseMax(1))};
}

Image<std::uint8_t> ImageSensor::Develop(const Image<std::uint16_t>& raw_dn,
                                         const PictureSettings& settings) const {
  const double white = (1 << model_.bits) - 1 - model_.black_dn;
  // A look-up table for each colour: balance and encoding.
  std::array<std::vector<std::uint8_t>, 3> encoded;
  for (int c = 0; c < 3; ++c) {
    for (int dn = 0; dn < (1 << model_.bits); ++dn) {
      encoded[static_cast<std::size_t>(c)].push_back(
          Encoded(settings.balance[c] * (dn - model_.black_dn) / white));
    }
  }
  const cv::Mat three = model_.filter ? Demosaiced(raw_dn, *model_.filter) : cv::Mat();
  const std::uint16_t* dn = model_.filter ? three.ptr<std::uint16_t>() : raw_dn.data.data();
  Image<std::uint8_t> rgb(width_px_, height_px_, 3);
  for (std::size_t i = 0; i < rgb.data.size(); ++i) rgb.data[i] = encoded[i % 3][dn[i]];
  return rgb;
}

}  // namespace tera
