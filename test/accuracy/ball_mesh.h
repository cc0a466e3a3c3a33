#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "core/units.h"
#include "own_folder.h"

namespace tera {

/// Writes a ball of radius 1 m about its origin as an OBJ file; a scenario scales it.
///
/// Model   128 meridians and 64 parallels with vertices on the sphere, so that the mesh lies at
///         most 1 - cos(pi / 64) = 0.12 % of the radius inside it.
inline std::filesystem::path WriteBallMesh() {
  constexpr int kMeridians = 128, kParallels = 64;
  const auto file = OwnFolder() / "ball.obj";
  std::ofstream obj(file);
  obj << "o body\n";
  for (int p = 0; p <= kParallels; ++p) {
    for (int m = 0; m < kMeridians; ++m) {
      const double polar_rad = kPi * p / kParallels, round_rad = 2 * kPi * m / kMeridians;
      obj << fmt::format("v {} {} {}\n", std::sin(polar_rad) * std::cos(round_rad),
                         std::sin(polar_rad) * std::sin(round_rad), std::cos(polar_rad));
    }
  }
  const auto vertex = [](int p, int m) { return p * kMeridians + m % kMeridians + 1; };
  for (int p = 0; p < kParallels; ++p) {
    for (int m = 0; m < kMeridians; ++m) {
      const int a = vertex(p, m), b = vertex(p + 1, m), c = vertex(p + 1, m + 1),
                d = vertex(p, m + 1);
      if (p + 1 < kParallels) obj << fmt::format("f {} {} {}\n", a, b, c);
      if (p > 0) obj << fmt::format("f {} {} {}\n", a, c, d);
    }
  }
  return file;
}

}  // namespace tera
