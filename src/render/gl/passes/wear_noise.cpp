#include "render/gl/passes/wear_noise.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/random.h"

namespace tera {
namespace {

constexpr int kSide = WearNoise::kSide;
constexpr std::size_t kCells = static_cast<std::size_t>(kSide) * kSide * kSide;
constexpr double kDeviation = 0.2;

/// A random lattice of `period` points per side, interpolated at kSide points per side.
class Octave {
 public:
  Octave(const std::string& name, int period) : period_(period) {
    const Stream stream(0, name + "/" + std::to_string(period));
    values_.resize(static_cast<std::size_t>(period) * period * period);
    for (std::size_t k = 0; k < values_.size(); ++k) {
      values_[k] = static_cast<float>(stream.Uniform(k));
    }
  }
  float At(int i, int j, int k) const {
    const Place x = PlaceOf(i), y = PlaceOf(j), z = PlaceOf(k);
    const auto along_x = [&](int b, int c) {
      return Mix(Value(x.low, b, c), Value(x.high, b, c), x.share);
    };
    const auto along_y = [&](int c) { return Mix(along_x(y.low, c), along_x(y.high, c), y.share); };
    return Mix(along_y(z.low), along_y(z.high), z.share);
  }

 private:
  struct Place {
    int low, high;
    float share;
  };
  static float Mix(float a, float b, float share) { return a + (b - a) * share; }
  Place PlaceOf(int i) const {
    const float at = static_cast<float>(i * period_) / kSide;
    const int low = static_cast<int>(at);
    const float t = at - static_cast<float>(low);
    return {low, (low + 1) % period_, t * t * t * (t * (t * 6 - 15) + 10)};
  }
  float Value(int a, int b, int c) const {
    return values_[(static_cast<std::size_t>(c) * period_ + b) * period_ + a];
  }

  int period_;
  std::vector<float> values_;
};

std::vector<float> Sum(const std::string& name, int coarsest, int octaves) {
  std::vector<float> sum(kCells, 0.0f);
  float weight = 1;
  for (int o = 0; o < octaves; ++o, weight *= 0.5f) {
    const Octave octave(name, coarsest << o);
    std::size_t n = 0;
    for (int k = 0; k < kSide; ++k) {
      for (int j = 0; j < kSide; ++j) {
        for (int i = 0; i < kSide; ++i) sum[n++] += weight * octave.At(i, j, k);
      }
    }
  }
  return sum;
}

/// Scales to mean 1/2 and standard deviation kDeviation.
void Standardise(std::vector<float>* values) {
  double mean = 0, square = 0;
  for (const float v : *values) mean += v / static_cast<double>(kCells);
  for (const float v : *values) square += (v - mean) * (v - mean) / static_cast<double>(kCells);
  const double scale = kDeviation / std::sqrt(square);
  for (float& v : *values) v = static_cast<float>(0.5 + scale * (v - mean));
}

}  // namespace

WearNoise MakeWearNoise() {
  std::vector<float> coarse = Sum("render/wear/coarse", 4, 4);
  std::vector<float> fine = Sum("render/wear/fine", 16, 2);
  Standardise(&coarse);
  Standardise(&fine);
  WearNoise noise;
  noise.rg.resize(2 * kCells);
  for (std::size_t n = 0; n < kCells; ++n) {
    const auto byte = [](float v) {
      return static_cast<std::uint8_t>(std::lround(255 * std::clamp(v, 0.0f, 1.0f)));
    };
    noise.rg[2 * n] = byte(coarse[n]);
    noise.rg[2 * n + 1] = byte(fine[n]);
  }
  return noise;
}

}  // namespace tera
