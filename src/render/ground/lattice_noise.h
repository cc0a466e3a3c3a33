#pragma once

#include <string>
#include <vector>

namespace tera {

/// Smooth noise on a square torus.
///
/// Model   value noise: uniform values in [0, 1] on a lattice of `period` x `period`, blended by
///         quintic steps; octave k doubles the lattice and halves the weight. Mean about 1/2.
class LatticeNoise {
 public:
  LatticeNoise(const std::string& name, int period, int octaves);
  /// At (u, v), periodic with period 1 in both.
  float At(double u, double v) const;

 private:
  int period_, octaves_;
  std::vector<std::vector<float>> lattices_;
};

}  // namespace tera
