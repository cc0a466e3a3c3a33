#include "render/ground/ground_detail.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "render/ground/lattice_noise.h"

namespace tera {
namespace {

constexpr int kSide = GroundDetail::kSide;
constexpr int kStones = 2600;
// Radius, as a fraction of the tile's side.
constexpr double kSmallestStone = 0.0035, kLargestStone = 0.03;

struct Relief {
  std::vector<float> height = std::vector<float>(static_cast<std::size_t>(kSide) * kSide);
  std::vector<float> tone = height;

  static std::size_t At(int i, int j) {
    const auto wrap = [](int k) { return static_cast<std::size_t>((k % kSide + kSide) % kSide); };
    return wrap(j) * kSide + wrap(i);
  }
};

/// Adds a dome with a slightly uneven outline on top of the relief so far.
void AddStone(double u, double v, double radius, double squash, double tone, Relief* relief) {
  const int reach = static_cast<int>(radius * kSide * 1.3) + 1;
  const int ci = static_cast<int>(u * kSide), cj = static_cast<int>(v * kSide);
  for (int dj = -reach; dj <= reach; ++dj) {
    for (int di = -reach; di <= reach; ++di) {
      const double x = di / (radius * kSide), y = dj / (radius * kSide) * squash;
      const double wobble = 1 + 0.12 * std::sin(3 * std::atan2(y, x) + tone * 40);
      const double r2 = (x * x + y * y) * wobble;
      if (r2 >= 1) continue;
      const std::size_t at = Relief::At(ci + di, cj + dj);
      const double dome = std::sqrt(1 - r2) * radius * 0.55;
      if (dome > relief->height[at] * 0.5) {
        relief->tone[at] = static_cast<float>(tone);
        relief->height[at] += static_cast<float>(dome);
      }
    }
  }
}

std::uint8_t Centred(double value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(128.0 + value * 127.0, 0.0, 255.0)));
}

}  // namespace

GroundDetail MakeGroundDetail() {
  Relief relief;
  const LatticeNoise rough("render/ground/relief", 12, 5), tone("render/ground/tone", 5, 6);
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) {
      const double u = (i + 0.5) / kSide, v = (j + 0.5) / kSide;
      relief.height[Relief::At(i, j)] = 0.035f * (rough.At(u, v) - 0.5f);
      relief.tone[Relief::At(i, j)] = (tone.At(u, v) - 0.5f) * 1.1f;
    }
  }
  const Stream stream(0, "render/ground/stones");
  for (int s = 0; s < kStones; ++s) {
    // Power law of sizes: many small, few large.
    const double size = kSmallestStone * std::pow(kLargestStone / kSmallestStone,
                                                  std::pow(stream.Uniform(s, 2), 3.5));
    AddStone(stream.Uniform(s, 0), stream.Uniform(s, 1), size, 0.8 + 0.5 * stream.Uniform(s, 3),
             0.55 * (stream.Uniform(s, 4) - 0.45), &relief);
  }
  GroundDetail detail;
  detail.rgba.resize(relief.height.size() * 4);
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) {
      const float* h = relief.height.data();
      const double slope_u = (h[Relief::At(i + 1, j)] - h[Relief::At(i - 1, j)]) * kSide * 0.5;
      const double slope_v = (h[Relief::At(i, j + 1)] - h[Relief::At(i, j - 1)]) * kSide * 0.5;
      std::uint8_t* texel = &detail.rgba[Relief::At(i, j) * 4];
      texel[0] = Centred(relief.tone[Relief::At(i, j)]);
      texel[1] = Centred(slope_u);
      texel[2] = Centred(slope_v);
      texel[3] = Centred(h[Relief::At(i, j)] * 30);
    }
  }
  return detail;
}

}  // namespace tera
