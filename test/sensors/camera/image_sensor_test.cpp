#include "sensors/camera/image_sensor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/units.h"

namespace tera {
namespace {

constexpr int kImageSensorWidth = 160, kImageSensorHeight = 120;

CameraIntrinsics ImageSensorLens() {
  return {.width_px = kImageSensorWidth,
          .height_px = kImageSensorHeight,
          .fx_px = 120,
          .fy_px = 120,
          .cx_px = 79.5,
          .cy_px = 59.5};
}

/// A sensor per colour, of 12 bits and 10 000 electrons, behind a lens so long that its light is
/// even: photons follow from the luminance alone.
ImageSensorModel ImageSensorPlain() {
  ImageSensorModel model;
  model.filter.reset();
  model.full_well_e = 10'000;
  model.read_noise_e = 4;
  model.dark_current_eps = 0;
  model.black_dn = 100;
  return model;
}

CameraIntrinsics ImageSensorLongLens() {
  CameraIntrinsics lens = ImageSensorLens();
  lens.fx_px = lens.fy_px = 1e5;
  return lens;
}

Image<float> Flat(double luminance_cdpm2) {
  Image<float> picture(kImageSensorWidth, kImageSensorHeight, 3);
  std::fill(picture.data.begin(), picture.data.end(), static_cast<float>(luminance_cdpm2));
  return picture;
}

struct Moments {
  double mean = 0, variance = 0;
};

/// Moments of one channel's pixels, of a picture or of the difference of two.
Moments MomentsOf(const Image<std::uint16_t>& a, const Image<std::uint16_t>* less, int channel) {
  Moments out;
  double squares = 0, count = 0;
  for (std::size_t i = channel; i < a.data.size(); i += a.channels) {
    const double value = a.data[i] - (less ? static_cast<double>(less->data[i]) : 0.0);
    out.mean += value;
    squares += value * value;
    ++count;
  }
  out.mean /= count;
  out.variance = squares / count - out.mean * out.mean;
  return out;
}

/// Luminance at which green has this mean number of electrons.
double LuminanceFor(const ImageSensorModel& model, double electrons) {
  const double area_m2 = std::pow(model.pixel_um * 1e-6, 2);
  const double lux = kPi * model.transmission / (4 * model.f_number * model.f_number);
  const double photons = lux * model.exposure_s * area_m2 * kPhotonsPerLuxSecond / 3;
  return electrons / (photons * model.quantum_efficiency[1]);
}

// The photon transfer of EMVA 1288, 6.7. For pairs of flat pictures, half the variance of the
// difference over the mean above dark rises by K. The dark remainder is read noise and rounding,
// and the brightest level is the full well.
TEST(ImageSensor, PhotonTransferReturnsGainReadNoiseAndFullWell) {
  const ImageSensorModel model = ImageSensorPlain();
  const ImageSensor sensor(model, ImageSensorLongLens(), 1, "camera");
  double sum_xx = 0, sum_xy = 0;
  const Moments dark_mean = MomentsOf(sensor.Expose(Flat(0), 0), nullptr, 1);
  const Image<std::uint16_t> dark_pair = sensor.Expose(Flat(0), 1);
  const Moments dark = MomentsOf(sensor.Expose(Flat(0), 0), &dark_pair, 1);
  for (int level = 1; level <= 14; ++level) {
    const Image<float> flat = Flat(LuminanceFor(model, 500.0 * level));
    const Image<std::uint16_t> a = sensor.Expose(flat, 2 * level);
    const Image<std::uint16_t> b = sensor.Expose(flat, 2 * level + 1);
    const double x = MomentsOf(a, nullptr, 1).mean - dark_mean.mean;
    const double y = 0.5 * (MomentsOf(a, &b, 1).variance - dark.variance);
    sum_xx += x * x;
    sum_xy += x * y;
  }
  const double gain = sum_xy / sum_xx;
  EXPECT_NEAR(gain, 3995.0 / 10'000, 0.03 * 3995.0 / 10'000);  // (2^12 - 1 - 100) / full well
  const double read_e = std::sqrt(0.5 * dark.variance - 1.0 / 12) / gain;
  EXPECT_NEAR(read_e, 4, 0.12);
  const double most = MomentsOf(sensor.Expose(Flat(LuminanceFor(model, 1e5)), 40), nullptr, 1).mean;
  EXPECT_NEAR((most - dark_mean.mean) / gain, 10'000, 300);
}

// n = 19 200 pixels: five standard errors of the mean and, by Poisson's fourth moment, of the
// variance. Rounding adds 1/12 if counts are no integers.
TEST(ImageSensor, CountsOfFewPhotonsArePoissons) {
  ImageSensorModel model = ImageSensorPlain();
  model.read_noise_e = 0;
  model.gain_db = 20 * std::log10(10'000 / 3995.0);  // a digital number an electron
  const ImageSensor sensor(model, ImageSensorLongLens(), 3, "camera");
  for (const double electrons : {0.5, 3.0, 15.0, 25.0, 100.0}) {
    const Image<std::uint16_t> raw = sensor.Expose(Flat(LuminanceFor(model, electrons)), 7);
    const Moments moments = MomentsOf(raw, nullptr, 1);
    const double n = kImageSensorWidth * kImageSensorHeight;
    EXPECT_NEAR(moments.mean - 100, electrons, 5 * std::sqrt(electrons / n)) << electrons;
    EXPECT_NEAR(moments.variance, electrons,
                5 * electrons * std::sqrt((2 + 1 / electrons) / n) + 1.0 / 12)
        << electrons;
  }
}

// ISO 12232: light behind a lens of f/4 from 4000 cd/m^2 is pi 4000 0.9 / 64 = 176.7 lux.
TEST(ImageSensor, PhotonsFollowFromLensExposureAndPixel) {
  ImageSensorModel model = ImageSensorPlain();
  model.quantum_efficiency = Vec3(0.3, 0.6, 0.15);
  const ImageSensor sensor(model, ImageSensorLongLens(), 1, "camera");
  const double photons = 176.715 * 0.002 * 1.1152e16 / 3 * 3.45e-6 * 3.45e-6;  // in each colour
  const Image<std::uint16_t> raw = sensor.Expose(Flat(4000), 0);
  for (int c = 0; c < 3; ++c) {
    const double electrons = (MomentsOf(raw, nullptr, c).mean - 100) / sensor.gain_dn_per_e();
    EXPECT_NEAR(electrons, photons * model.quantum_efficiency[c], 0.005 * photons) << c;
  }
}

TEST(ImageSensor, ACornerIsDarkerByTheFourthPowerOfItsCosine) {
  ImageSensorModel model = ImageSensorPlain();
  model.bits = 16;
  model.full_well_e = 1e7;  // noise of half a thousandth
  const ImageSensor sensor(model, ImageSensorLens(), 1, "camera");
  const Image<std::uint16_t> raw = sensor.Expose(Flat(LuminanceFor(model, 5e6)), 0);
  const double middle = raw.at(79, 59, 1) - 100.0, corner = raw.at(0, 0, 1) - 100.0;
  const double cosine = 120 / std::sqrt(120 * 120 + 79.5 * 79.5 + 59.5 * 59.5);
  EXPECT_NEAR(corner / middle, std::pow(cosine, 4), 0.003);
}

// EMVA 1288, chapter 8: the constant pattern, by the mean of 16 pictures, which leaves a sixteenth
// of the noise variance. The deviation of 19 200 pixels is known to 0.5 %.
TEST(ImageSensor, SensitivityAndDarkSignalDifferFromPixelToPixelAndStay) {
  ImageSensorModel model = ImageSensorPlain();
  model.prnu = 0.02;
  model.dsnu_e = 12;
  const ImageSensor sensor(model, ImageSensorLongLens(), 5, "camera");
  const auto spatial_e = [&](double luminance) {
    std::vector<double> mean(kImageSensorWidth * kImageSensorHeight, 0.0);
    for (int k = 0; k < 16; ++k) {
      const Image<std::uint16_t> raw = sensor.Expose(Flat(luminance), k);
      for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += raw.data[3 * i + 1] / 16.0;
    }
    double sum = 0, squares = 0;
    for (const double m : mean) sum += m, squares += m * m;
    const double variance = squares / mean.size() - std::pow(sum / mean.size(), 2);
    return std::sqrt(variance) / sensor.gain_dn_per_e();
  };
  EXPECT_NEAR(spatial_e(0), 12, 0.5);
  const double bright = spatial_e(LuminanceFor(model, 6000));
  EXPECT_NEAR(std::sqrt(bright * bright - 12 * 12), 0.02 * 6000, 6);
}

TEST(ImageSensor, DarkCurrentDoublesWithTemperatureAndSomePixelsAreHot) {
  ImageSensorModel model = ImageSensorPlain();
  model.read_noise_e = 0;
  model.exposure_s = 1;
  model.dark_current_eps = 20;
  model.dark_temperature_degc = 25;
  model.dark_doubling_k = 8;
  model.temperature_degc = 41;
  model.hot_pixels = 0.01;
  const ImageSensor sensor(model, ImageSensorLongLens(), 6, "camera");
  const Image<std::uint16_t> raw = sensor.Expose(Flat(0), 0);
  double sum = 0;
  int hot = 0, others = 0;
  for (const std::uint16_t dn : raw.data) {
    const double electrons = (dn - 100) / sensor.gain_dn_per_e();
    if (electrons > 1000) {
      ++hot;
    } else {
      sum += electrons;
      ++others;
    }
  }
  EXPECT_NEAR(sum / others, 80, 0.8);
  EXPECT_NEAR(hot, 0.01 * raw.data.size(), 4 * std::sqrt(0.01 * raw.data.size()));
}

TEST(ImageSensor, RowsAreOffTogetherAndAnewInEachPicture) {
  ImageSensorModel model = ImageSensorPlain();
  model.read_noise_e = 0;
  model.row_noise_e = 30;
  const ImageSensor sensor(model, ImageSensorLongLens(), 8, "camera");
  const Image<float> flat = Flat(LuminanceFor(model, 2000));
  std::vector<double> offset_e;
  for (int k = 0; k < 4; ++k) {
    const Image<std::uint16_t> raw = sensor.Expose(flat, k);
    for (int y = 0; y < kImageSensorHeight; ++y) {
      double sum = 0;
      for (int x = 0; x < kImageSensorWidth; ++x) sum += raw.at(x, y, 1) - 100.0;
      offset_e.push_back(sum / kImageSensorWidth / sensor.gain_dn_per_e() - 2000);
    }
  }
  double squares = 0, both = 0;
  for (const double e : offset_e) squares += e * e / offset_e.size();
  for (int y = 0; y < kImageSensorHeight; ++y)
    both += offset_e[y] * offset_e[kImageSensorHeight + y] / kImageSensorHeight;
  EXPECT_NEAR(std::sqrt(squares), 30, 3);
  EXPECT_LT(std::abs(both), 0.35 * squares);
}

/// Colour of the middle of a flat picture of these values over the exposure's white.
Vec3 MiddleOf(const ImageSensorModel& model, const Vec3& colour) {
  const ImageSensor sensor(model, ImageSensorLongLens(), 2, "camera");
  Image<float> flat(kImageSensorWidth, kImageSensorHeight, 3);
  const double white = LuminanceFor(model, model.full_well_e);
  for (std::size_t i = 0; i < flat.data.size(); ++i) {
    flat.data[i] = static_cast<float>(white * colour[static_cast<Eigen::Index>(i % 3)]);
  }
  const Image<std::uint8_t> rgb = sensor.Develop(sensor.Expose(flat, 0));
  Vec3 sum = Vec3::Zero();
  for (int y = 40; y < 80; ++y) {
    for (int x = 40; x < 120; ++x) {
      for (int c = 0; c < 3; ++c) sum[c] += rgb.at(x, y, c) / 3200.0;
    }
  }
  return sum;
}

// sRGB of 0.5, 0.2 and 0.05 is 187.5, 123.6 and 63.0 of 255, for any filters.
TEST(ImageSensor, ColoursComeBackBehindAllFilters) {
  ImageSensorModel model = ImageSensorPlain();
  model.full_well_e = 1e6;
  model.bits = 14;
  model.quantum_efficiency = Vec3(0.4, 0.6, 0.45);
  const std::optional<ColourFilter> filters[] = {std::nullopt, ColourFilter::kRggb,
                                                 ColourFilter::kBggr, ColourFilter::kGrbg,
                                                 ColourFilter::kGbrg};
  for (const auto& filter : filters) {
    model.filter = filter;
    const Vec3 seen = MiddleOf(model, Vec3(0.5, 0.2, 0.05));
    EXPECT_NEAR((seen - Vec3(187.5, 123.6, 63.0)).norm(), 0, 1.5) << seen.transpose();
  }
}

TEST(ImageSensor, SameSeedSamePicture) {
  const ImageSensorModel model = ImageSensorPlain();
  const Image<float> flat = Flat(LuminanceFor(model, 700));
  const ImageSensor one(model, ImageSensorLens(), 9, "a"), again(model, ImageSensorLens(), 9, "a"),
      other(model, ImageSensorLens(), 9, "b");
  EXPECT_EQ(one.Expose(flat, 3).data, again.Expose(flat, 3).data);
  EXPECT_NE(one.Expose(flat, 3).data, one.Expose(flat, 4).data);
  EXPECT_NE(one.Expose(flat, 3).data, other.Expose(flat, 3).data);
}

}  // namespace
}  // namespace tera
