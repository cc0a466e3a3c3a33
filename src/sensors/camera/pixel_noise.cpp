#include "sensors/camera/pixel_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace tera {
namespace {

/// Standard normal quantiles at the centres of 2^bits equal parts of (0, 1), scaled to unit
/// variance. The look-up replaces logarithm and cosine per pixel.
template <int bits>
class NormalQuantiles {
 public:
  static constexpr int kBits = bits;

  explicit NormalQuantiles(Workers* workers) {
    constexpr std::size_t kLeastOfThread = 256;
    workers->ForRanges(values_.size(), kLeastOfThread, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        values_[i] = static_cast<float>(Quantile((i + 0.5) / values_.size()));
      }
    });
    double squares = 0;
    for (const float v : values_) squares += v * v / values_.size();
    for (float& v : values_) v /= static_cast<float>(std::sqrt(squares));
  }
  float operator[](std::uint64_t part) const { return values_[part & (values_.size() - 1)]; }

 private:
  /// Bisection of the normal distribution function.
  static double Quantile(double p) {
    double low = -8, high = 8;
    while (high - low > 1e-9) {
      const double middle = 0.5 * (low + high);
      (0.5 * std::erfc(-middle / std::sqrt(2.0)) < p ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

  std::array<float, 1u << bits> values_;
};

/// Calls `visit(i, draw)` for each pixel i of `pixels`, with draw `first` + i.
template <typename Visit>
void ForEachDraw(const UniformBits& noise, std::uint64_t first, std::size_t pixels,
                 Workers* workers, const Visit& visit) {
  constexpr std::size_t kBlock = 512;  // fits the first-level cache
  constexpr std::size_t kLeastOfThread = 16 * kBlock;
  workers->ForRanges(pixels, kLeastOfThread, [&](std::size_t from, std::size_t to) {
    std::array<std::uint64_t, kBlock> bits;
    for (std::size_t begin = from; begin < to; begin += kBlock) {
      const std::size_t count = std::min(kBlock, to - begin);
      noise.Draw(first + begin, std::span(bits).first(count));
      for (std::size_t k = 0; k < count; ++k) visit(begin + k, bits[k]);
    }
  });
}

}  // namespace

/// 2^16 quantiles reach 4.3 sigma. Except in the rare tails, their steps are below the stored
/// millimetre.
void AddDisparityNoise(double scale_1pm, const UniformBits& noise, std::uint64_t first,
                       const Image<float>& air, Workers* workers, Image<float>* depth_m) {
  static const NormalQuantiles<16> normal(workers);
  constexpr int kUnused = UniformBits::kBits - normal.kBits;
  const auto scale = static_cast<float>(scale_1pm);
  ForEachDraw(noise, first, depth_m->data.size(), workers, [&](std::size_t i, std::uint64_t draw) {
    float& z_m = depth_m->data[i];
    if (z_m <= 0) return;
    float disparity_off = scale * z_m * normal[draw >> kUnused];
    if (!air.empty()) disparity_off *= std::exp(air.data[i]);
    const float disparity_left = 1 - disparity_off;
    z_m = disparity_left > 0 ? z_m / disparity_left : 0;
  });
}

/// Rounding to 255 levels hides the steps of 2^12 quantiles. One draw supplies the three values of
/// a pixel.
void AddRgbNoise(double sigma, const UniformBits& noise, std::uint64_t first, Workers* workers,
                 Image<std::uint8_t>* rgb) {
  static const NormalQuantiles<12> normal(workers);
  constexpr float kMaxValue = 255.0f;
  constexpr int kUnused = UniformBits::kBits - 48;
  const auto gain = static_cast<float>(sigma);
  ForEachDraw(noise, first, rgb->data.size() / 3, workers,
              [&](std::size_t pixel, std::uint64_t draw) {
                draw >>= kUnused;
                for (std::size_t c = 0; c < 3; ++c, draw >>= normal.kBits) {
                  std::uint8_t& value = rgb->data[3 * pixel + c];
                  const float noisy = static_cast<float>(value) + gain * normal[draw];
                  value = static_cast<std::uint8_t>(std::clamp(noisy, 0.0f, kMaxValue) + 0.5f);
                }
              });
}

}  // namespace tera
