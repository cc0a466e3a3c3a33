#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "core/motion.h"
#include "core/units.h"

/// A yard with known heights and objects, and its points as from a scanner.
namespace testing_survey {

using tera::Vec2;
using tera::Vec3;

/// Standard deviation of each coordinate of a point.
inline constexpr double kNoise_m = 0.01;

inline constexpr double kEast_m = 40, kNorth_m = 30, kRise = 0.05;  ///< rises towards the east
/// A cone of soil at 35 degrees.
inline const Vec2 kPile_m(28, 20);
inline constexpr double kPileHeight_m = 1.8;
inline const double kPileRadius_m = kPileHeight_m / std::tan(35 * tera::kDeg);
/// A trench with upright walls.
inline const Vec2 kTrenchLow_m(8, 5), kTrenchHigh_m(9.2, 17);
inline constexpr double kTrenchDepth_m = 1.5;
/// A circle without points.
inline const Vec2 kHole_m(35, 24);
inline constexpr double kHoleRadius_m = 1.5;

inline bool InTrench(const Vec2& at) {
  return (at.array() > kTrenchLow_m.array()).all() && (at.array() < kTrenchHigh_m.array()).all();
}

/// Height of the ground at a place of the yard.
inline double GroundAt(const Vec2& at) {
  const double pile_m = std::max(0.0, kPileHeight_m * (1 - (at - kPile_m).norm() / kPileRadius_m));
  return kRise * at.x() + pile_m - (InTrench(at) ? kTrenchDepth_m : 0);
}

/// A box that stands with its middle on the ground.
struct YardBox {
  Vec2 at_m;
  double yaw_rad;
  Vec3 size_m;
};

inline const std::vector<YardBox> kBoxes = {
    {{15, 24}, 20 * tera::kDeg, {6.0, 2.4, 2.6}},   // a container
    {{20, 8}, -35 * tera::kDeg, {1.2, 0.8, 1.0}},   // a crate
    {{25, 12}, 70 * tera::kDeg, {0.5, 0.4, 1.75}},  // as large as a person
    {{32, 8}, 0, {0.2, 0.2, 3.0}},                  // a post
};

inline bool InBox(const YardBox& box, const Vec2& at) {
  const Vec2 along(std::cos(box.yaw_rad), std::sin(box.yaw_rad)), from = at - box.at_m;
  return std::abs(along.dot(from)) < 0.5 * box.size_m.x() &&
         std::abs(along.x() * from.y() - along.y() * from.x()) < 0.5 * box.size_m.y();
}

class YardScanner {
 public:
  explicit YardScanner(unsigned seed) : random_(seed) {}

  /// Points of the yard, `spacing_m` apart on the ground and on all faces, and 60 outliers.
  std::vector<Vec3> Scan(double spacing_m) {
    ScanGround(spacing_m);
    ScanTrenchWalls(spacing_m);
    for (const YardBox& box : kBoxes) ScanBox(box, 0.5 * spacing_m);
    ScanOutliers();
    return points_;
  }

 private:
  double Uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  void Take(const Vec3& p) {
    std::normal_distribution<double> noise(0, kNoise_m);
    points_.push_back(p + Vec3(noise(random_), noise(random_), noise(random_)));
  }

  /// One point anywhere in each square.
  void ScanGround(double spacing_m) {
    for (double y = 0; y < kNorth_m - 0.5 * spacing_m; y += spacing_m) {
      for (double x = 0; x < kEast_m - 0.5 * spacing_m; x += spacing_m) {
        const Vec2 at(x + Uniform(0, spacing_m), y + Uniform(0, spacing_m));
        bool hidden = (at - kHole_m).norm() < kHoleRadius_m;
        for (const YardBox& box : kBoxes) hidden = hidden || InBox(box, at);
        if (!hidden) Take(Vec3(at.x(), at.y(), GroundAt(at)));
      }
    }
  }

  void ScanTrenchWalls(double spacing_m) {
    const auto wall = [&](const Vec2& from, const Vec2& to) {
      for (double s = 0; s < (to - from).norm(); s += spacing_m) {
        for (double d = 0; d < kTrenchDepth_m; d += spacing_m) {
          const Vec2 at = from + (s + Uniform(0, spacing_m)) * (to - from).normalized();
          Take(Vec3(at.x(), at.y(), kRise * at.x() - d - Uniform(0, spacing_m)));
        }
      }
    };
    const Vec2 a = kTrenchLow_m, c = kTrenchHigh_m, b(c.x(), a.y()), d(a.x(), c.y());
    wall(a, b);
    wall(b, c);
    wall(d, c);
    wall(a, d);
  }

  void ScanBox(const YardBox& box, double spacing_m) {
    const Vec2 along(std::cos(box.yaw_rad), std::sin(box.yaw_rad)), across(-along.y(), along.x());
    const double foot_m = GroundAt(box.at_m);
    const auto take = [&](double u, double v, double h) {
      const Vec2 at = box.at_m + u * along + v * across;
      if (foot_m + h > GroundAt(at)) Take(Vec3(at.x(), at.y(), foot_m + h));
    };
    const Vec3 half = 0.5 * box.size_m;
    for (double u = -half.x(); u < half.x(); u += spacing_m) {
      for (double v = -half.y(); v < half.y(); v += spacing_m) {
        take(std::min(half.x(), u + Uniform(0, spacing_m)),
             std::min(half.y(), v + Uniform(0, spacing_m)), box.size_m.z());
      }
    }
    for (double h = 0; h < box.size_m.z(); h += spacing_m) {
      for (double u = -half.x(); u <= half.x(); u += spacing_m) {
        take(u, half.y(), std::min(box.size_m.z(), h + Uniform(0, spacing_m)));
        take(u, -half.y(), std::min(box.size_m.z(), h + Uniform(0, spacing_m)));
      }
      for (double v = -half.y(); v <= half.y(); v += spacing_m) {
        take(half.x(), v, std::min(box.size_m.z(), h + Uniform(0, spacing_m)));
        take(-half.x(), v, std::min(box.size_m.z(), h + Uniform(0, spacing_m)));
      }
    }
  }

  /// Dust and birds above, and echoes from below.
  void ScanOutliers() {
    for (int k = 0; k < 60; ++k) {
      const double x = Uniform(0, kEast_m), y = Uniform(0, kNorth_m);
      const double away_m = k % 3 == 0 ? -Uniform(2.5, 4) : Uniform(5, 12);
      points_.emplace_back(x, y, kRise * x + away_m);
    }
  }

  std::mt19937_64 random_;
  std::vector<Vec3> points_;
};

}  // namespace testing_survey
