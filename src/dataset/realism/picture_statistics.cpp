#include "dataset/realism/picture_statistics.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/check.h"

namespace tera {
namespace {

constexpr int kWindow_px = 7;
constexpr double kWindowSigma_px = 7.0 / 6;
constexpr double kLeastShape = 0.2, kMostShape = 10;
constexpr double kFirstRing = 4;
constexpr int kRingsPerOctave = 4;
constexpr double kMaskNorm = 6,
                 kQuartile = 0.6745;  ///< norm of L; quartile of a normal distribution
constexpr double kMaskBin = 0.05, kMostMask = 600;
constexpr double kDark =
    0.01;  ///< fraction of full scale; limits the effect of single digital numbers in dark areas

template <typename T>
cv::Mat MatrixOf(const Image<T>& image) {
  return {image.height_px, image.width_px, CV_MAKETYPE(cv::DataType<T>::depth, image.channels),
          const_cast<T*>(image.data.data())};
}

double LinearOf(double srgb) {
  return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

/// Amplitude spectrum with frequency zero in the upper left corner.
cv::Mat Amplitudes(const Image<float>& luminance) {
  const int side = std::min(luminance.width_px, luminance.height_px);
  cv::Mat square;
  MatrixOf(luminance)(
      cv::Rect((luminance.width_px - side) / 2, (luminance.height_px - side) / 2, side, side))
      .convertTo(square, CV_64F);
  cv::Mat window;
  cv::createHanningWindow(window, square.size(), CV_64F);
  // The mean under the window must be zero, or it leaks into the lowest rings.
  square -= square.dot(window) / cv::sum(window)[0];
  cv::Mat spectrum, parts[2], amplitude;
  cv::dft(square.mul(window), spectrum, cv::DFT_COMPLEX_OUTPUT);
  cv::split(spectrum, parts);
  cv::magnitude(parts[0], parts[1], amplitude);
  return amplitude;
}

/// Per-pixel values derived from one image.
struct Maps {
  cv::Mat normalised, log_luminance, chroma, mask;

  explicit Maps(const Image<std::uint8_t>& rgb);
};

Maps::Maps(const Image<std::uint8_t>& rgb) {
  const Image<float> grey = Luminance(rgb);
  const cv::Mat dn = MatrixOf(grey);
  const cv::Size window(kWindow_px, kWindow_px);
  cv::Mat mean, square;
  cv::GaussianBlur(dn, mean, window, kWindowSigma_px);
  cv::GaussianBlur(dn.mul(dn), square, window, kWindowSigma_px);
  cv::Mat deviation = cv::max(square - mean.mul(mean), 0);
  cv::sqrt(deviation, deviation);
  normalised = (dn - mean) / (deviation + 1);

  cv::Mat table(1, 256, CV_32F), linear, channels[3];
  for (int k = 0; k < 256; ++k) table.at<float>(k) = static_cast<float>(LinearOf(k / 255.0));
  cv::LUT(MatrixOf(rgb), table, linear);
  cv::split(linear, channels);
  const cv::Mat light = 0.2126 * channels[0] + 0.7152 * channels[1] + 0.0722 * channels[2];
  cv::log(light + kDark, log_luminance);

  cv::Mat scaled, lab;
  MatrixOf(rgb).convertTo(scaled, CV_32F, 1 / 255.0);
  cv::cvtColor(scaled, lab, cv::COLOR_RGB2Lab);
  cv::split(lab, channels);
  cv::magnitude(channels[1], channels[2], chroma);

  const cv::Mat kernel = (cv::Mat_<float>(3, 3) << 1, -2, 1, -2, 4, -2, 1, -2, 1);
  cv::filter2D(dn, mask, CV_32F, kernel);
}

void AddPixels(const Maps& maps, const cv::Mat& inside, SurfaceSums* sums) {
  for (int y = 0; y + 1 < inside.rows; ++y) {
    for (int x = 0; x + 1 < inside.cols; ++x) {
      if (inside.at<std::uint8_t>(y, x) == 0) continue;
      sums->AddNormalised(maps.normalised.at<float>(y, x));
      sums->AddChroma(maps.chroma.at<float>(y, x));
      sums->AddMask(maps.mask.at<float>(y, x));
      const float here = maps.log_luminance.at<float>(y, x);
      sums->AddStep(maps.log_luminance.at<float>(y, x + 1) - here);
      sums->AddStep(maps.log_luminance.at<float>(y + 1, x) - here);
    }
  }
}

/// Pixels whose whole window lies inside the image and is 255 in `all`.
cv::Mat Within(const cv::Mat& all) {
  cv::Mat inside;
  cv::erode(all, inside, cv::Mat::ones(kWindow_px, kWindow_px, CV_8U), cv::Point(-1, -1), 1,
            cv::BORDER_CONSTANT, cv::Scalar(0));
  return inside;
}

}  // namespace

double AmplitudeSlope(const Image<float>& luminance) {
  const cv::Mat amplitude = Amplitudes(luminance);
  const int side = amplitude.rows;
  const double last = side / 4.0;
  std::vector<double> sum(static_cast<std::size_t>(side), 0), count = sum;
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      const double fx = std::min(i, side - i), fy = std::min(j, side - j);
      const auto ring = static_cast<std::size_t>(std::lround(std::hypot(fx, fy)));
      if (ring >= sum.size()) continue;
      sum[ring] += amplitude.at<double>(j, i);
      ++count[ring];
    }
  }
  // Rings are spaced uniformly in log frequency, because otherwise the many high frequencies would
  // dominate.
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  std::size_t before = 0;
  for (int k = 0;; ++k) {
    const double at = kFirstRing * std::pow(2.0, static_cast<double>(k) / kRingsPerOctave);
    if (at > last) break;
    const auto ring = static_cast<std::size_t>(std::lround(at));
    if (ring == before || sum[ring] <= 0) continue;
    before = ring;
    const double x = std::log(static_cast<double>(ring)), y = std::log(sum[ring] / count[ring]);
    n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  const double spread = n * sxx - sx * sx;
  return spread > 0 ? (n * sxy - sx * sy) / spread : 0;
}

double GeneralisedGaussianShape(double mean_square, double mean_absolute) {
  if (mean_absolute <= 0) return kMostShape;
  const double wanted = std::log(mean_square / (mean_absolute * mean_absolute));
  const auto ratio = [](double shape) {
    return std::lgamma(1 / shape) + std::lgamma(3 / shape) - 2 * std::lgamma(2 / shape);
  };
  double low = kLeastShape, high = kMostShape;  // bisection: the ratio falls as the shape grows
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (ratio(middle) > wanted ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

SurfaceSums::SurfaceSums() : mask_(static_cast<std::size_t>(kMostMask / kMaskBin) + 1, 0) {}

void SurfaceSums::AddNormalised(double x) {
  ++pixels_;
  square_ += x * x;
  absolute_ += std::abs(x);
}

void SurfaceSums::AddStep(double step) {
  ++steps_;
  double power = 1;
  for (double& sum : step_power_) {
    sum += power;
    power *= step;
  }
}

void SurfaceSums::AddChroma(double chroma) { chroma_ += chroma; }

void SurfaceSums::AddMask(double response) {
  const double bin = std::abs(response) / kMaskBin;
  ++mask_[std::min(static_cast<std::size_t>(bin), mask_.size() - 1)];
}

double SurfaceSums::mscn_shape() const {
  const auto n = static_cast<double>(std::max<std::int64_t>(pixels_, 1));
  return GeneralisedGaussianShape(square_ / n, absolute_ / n);
}

double SurfaceSums::step_kurtosis() const {
  if (steps_ == 0) return 0;
  std::array<double, 5> m = step_power_;
  for (double& moment : m) moment /= static_cast<double>(steps_);
  const double variance = m[2] - m[1] * m[1];
  if (variance <= 0) return 0;
  const double fourth = m[4] - 4 * m[1] * m[3] + 6 * m[1] * m[1] * m[2] - 3 * std::pow(m[1], 4);
  return fourth / (variance * variance);
}

double SurfaceSums::chroma() const {
  return chroma_ / static_cast<double>(std::max<std::int64_t>(pixels_, 1));
}

double SurfaceSums::noise_dn() const {
  std::int64_t below = 0;
  for (std::size_t bin = 0; bin < mask_.size(); ++bin) {
    if (2 * (below + mask_[bin]) < pixels_) {
      below += mask_[bin];
      continue;
    }
    // Interpolates linearly within the bin.
    const double share = mask_[bin] > 0
                             ? (0.5 * static_cast<double>(pixels_) - static_cast<double>(below)) /
                                   static_cast<double>(mask_[bin])
                             : 0;
    return (static_cast<double>(bin) + share) * kMaskBin / (kMaskNorm * kQuartile);
  }
  return 0;
}

void AddPicture(const Image<std::uint8_t>& rgb, const Image<std::uint8_t>& semantic,
                SurfaceSums* whole, std::vector<SurfaceSums>* of_class) {
  const Maps maps(rgb);
  AddPixels(maps, Within(cv::Mat(rgb.height_px, rgb.width_px, CV_8U, cv::Scalar(255))), whole);
  if (semantic.empty()) return;
  TERA_CHECK(semantic.width_px == rgb.width_px && semantic.height_px == rgb.height_px);
  for (std::size_t c = 0; c < of_class->size(); ++c) {
    const cv::Mat is_class = MatrixOf(semantic) == static_cast<double>(c);
    if (cv::countNonZero(is_class) > 0) AddPixels(maps, Within(is_class), &(*of_class)[c]);
  }
}

double Colourfulness(const Image<std::uint8_t>& rgb) {
  cv::Mat channels[3], numbers;
  MatrixOf(rgb).convertTo(numbers, CV_32F);
  cv::split(numbers, channels);
  cv::Scalar mean_rg, spread_rg, mean_yb, spread_yb;
  cv::meanStdDev(channels[0] - channels[1], mean_rg, spread_rg);
  cv::meanStdDev(0.5 * (channels[0] + channels[1]) - channels[2], mean_yb, spread_yb);
  return std::hypot(spread_rg[0], spread_yb[0]) + 0.3 * std::hypot(mean_rg[0], mean_yb[0]);
}

Image<float> Luminance(const Image<std::uint8_t>& rgb) {
  Image<float> grey(rgb.width_px, rgb.height_px);
  for (std::size_t p = 0; p < grey.data.size(); ++p) {
    const std::uint8_t* at = &rgb.data[3 * p];
    grey.data[p] = 0.299f * at[0] + 0.587f * at[1] + 0.114f * at[2];
  }
  return grey;
}

}  // namespace tera
