#include "render/ground/lattice_noise.h"

#include <fmt/format.h>

#include <cmath>

#include "core/random.h"

namespace tera {
namespace {

constexpr std::uint64_t kScenerySeed = 0;  // the scenery does not depend on the scenario's seed

double Smooth(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }

}  // namespace

LatticeNoise::LatticeNoise(const std::string& name, int period, int octaves)
    : period_(period), octaves_(octaves) {
  for (int octave = 0; octave < octaves; ++octave) {
    const Stream stream(kScenerySeed, fmt::format("{}/octave{}", name, octave));
    const std::size_t side = static_cast<std::size_t>(period) << octave;
    std::vector<float> lattice(side * side);
    for (std::size_t i = 0; i < lattice.size(); ++i) {
      lattice[i] = static_cast<float>(stream.Uniform(i));
    }
    lattices_.push_back(std::move(lattice));
  }
}

float LatticeNoise::At(double u, double v) const {
  double sum = 0, weight = 1, total = 0;
  for (int octave = 0; octave < octaves_; ++octave) {
    const int side = period_ << octave;
    const double x = (u - std::floor(u)) * side, y = (v - std::floor(v)) * side;
    const int i = static_cast<int>(x) % side, j = static_cast<int>(y) % side;
    const double s = Smooth(x - std::floor(x)), t = Smooth(y - std::floor(y));
    const auto value = [&](int a, int b) {
      return static_cast<double>(
          lattices_[octave][static_cast<std::size_t>(b % side) * side + a % side]);
    };
    const double low = value(i, j) * (1 - s) + value(i + 1, j) * s;
    const double high = value(i, j + 1) * (1 - s) + value(i + 1, j + 1) * s;
    sum += weight * (low * (1 - t) + high * t);
    total += weight;
    weight *= 0.5;
  }
  return static_cast<float>(sum / total);
}

}  // namespace tera
