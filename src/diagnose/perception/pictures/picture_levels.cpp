#include "diagnose/perception/pictures/picture_levels.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace tera {
namespace {

constexpr double kLeastSpread = 0.05;  ///< of the range of values: less is no contrast
constexpr double kWindowShare = 0.05;  ///< of the width: the window of mean and spread

/// Moving average of `count` values that are `stride` apart: the mean of each value and its `reach`
/// neighbours to either side, the first and last value repeated beyond the ends.
void SlideMean(const float* from, float* to, int count, int stride, int reach) {
  const auto at = [&](int i) { return from[std::clamp(i, 0, count - 1) * stride]; };
  double sum = 0;
  for (int i = -reach; i <= reach; ++i) sum += at(i);
  for (int i = 0; i < count; ++i) {
    to[i * stride] = static_cast<float>(sum / (2 * reach + 1));
    sum += at(i + reach + 1) - at(i - reach);
  }
}

/// Less the mean and over the spread of brightness about each pixel.
Image<float> WithoutExposure(const Image<float>& grey) {
  const double window_px = kWindowShare * grey.width_px;
  const Image<float> mean = Blurred(grey, window_px);
  Image<float> square(grey.width_px, grey.height_px);
  for (std::size_t i = 0; i < grey.data.size(); ++i) {
    const float off = grey.data[i] - mean.data[i];
    square.data[i] = off * off;
  }
  const Image<float> variance = Blurred(square, window_px);
  Image<float> plain(grey.width_px, grey.height_px);
  for (std::size_t i = 0; i < grey.data.size(); ++i) {
    const double spread = std::sqrt(variance.data[i] + kLeastSpread * kLeastSpread);
    plain.data[i] = static_cast<float>((grey.data[i] - mean.data[i]) / spread);
  }
  return plain;
}

}  // namespace

Image<float> Blurred(const Image<float>& picture, double sigma_px) {
  // Three windows of 2 r + 1 have the variance r (r + 1).
  const int reach = std::max(
      1, static_cast<int>(std::lround(0.5 * (std::sqrt(1 + 4 * sigma_px * sigma_px) - 1))));
  Image<float> from = picture, to(picture.width_px, picture.height_px);
  for (int pass = 0; pass < 3; ++pass) {
    for (int y = 0; y < picture.height_px; ++y) {
      SlideMean(&from.at(0, y), &to.at(0, y), picture.width_px, 1, reach);
    }
    std::swap(from, to);
    for (int x = 0; x < picture.width_px; ++x) {
      SlideMean(&from.at(x, 0), &to.at(x, 0), picture.height_px, picture.width_px, reach);
    }
    std::swap(from, to);
  }
  return from;
}

PictureLevels::PictureLevels(const Image<float>& grey) {
  TERA_CHECK(std::min(grey.width_px, grey.height_px) >= kSmallest_px, grey.width_px,
             grey.height_px);
  const Image<float> plain = WithoutExposure(grey);
  for (int level = 0; level < kCount; ++level) {
    levels_[static_cast<std::size_t>(level)] = Blurred(plain, std::pow(2.0, level));
  }
}

float PictureLevels::At(int level, const Vec2& px) const {
  const Image<float>& picture = levels_[static_cast<std::size_t>(level)];
  const double x = std::clamp(px.x(), 0.0, picture.width_px - 1.001);
  const double y = std::clamp(px.y(), 0.0, picture.height_px - 1.001);
  const int i = static_cast<int>(x), j = static_cast<int>(y);
  const auto a = static_cast<float>(x - i), b = static_cast<float>(y - j);
  const float upper = (1 - a) * picture.at(i, j) + a * picture.at(i + 1, j);
  const float lower = (1 - a) * picture.at(i, j + 1) + a * picture.at(i + 1, j + 1);
  return (1 - b) * upper + b * lower;
}

Vec2 PictureLevels::GradientAt(int level, const Vec2& px) const {
  return 0.5 * Vec2(At(level, px + Vec2::UnitX()) - At(level, px - Vec2::UnitX()),
                    At(level, px + Vec2::UnitY()) - At(level, px - Vec2::UnitY()));
}

bool PictureLevels::Holds(const Vec2& px) const {
  const Image<float>& picture = levels_.front();
  const Vec2 last(picture.width_px - 2, picture.height_px - 2);
  return (px.array() >= 1).all() && (px.array() <= last.array()).all();
}

}  // namespace tera
