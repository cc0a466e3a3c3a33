#pragma once

#include <string>
#include <vector>

namespace tera {

/// Smooth periodic noise in two dimensions.
///
/// Model   value noise: uniform random values in [0, 1] on a lattice of `period` x `period` points,
///         interpolated with quintic steps. Octave k doubles the lattice and halves the weight. The
///         mean is about 1/2.
class LatticeNoise {
 public:
  LatticeNoise(const std::string& name, int period, int octaves);
  /// Value at (u, v); the period is 1 in both.
  float At(double u, double v) const;

 private:
  int period_, octaves_;
  std::vector<std::vector<float>> lattices_;
};

}  // namespace tera
