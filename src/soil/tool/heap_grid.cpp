#include "soil/tool/heap_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/units.h"

namespace tera {
namespace {

/// offset from a corner of the shell, to sample both sides
constexpr double kBesideCorner_m = 1e-7;
constexpr double kStep_m = 1e-4;             ///< a greater height difference is a step of the shell
constexpr double kMostTilt_rad = 75 * kDeg;  ///< limit of the sideways tilt
constexpr double kMound = 0.3;               ///< slope of the bulge over the steepest slope
constexpr double kRoundTop = 0.25;  ///< radius of the top of the bulge over the length of the mouth
constexpr double kLeastNormal = 0.1;  ///< least upward component of the surface normal
constexpr double kOpen = std::numeric_limits<double>::infinity();

/// Greatest height of soil above a point of the rim, at a horizontal offset from it.
///
/// Frames  dx and dy from the point along the axes of the columns; the direction against gravity is
///         (0, up_y, up_z).
/// Model   Soil rises from the point at the slope t. Its rise g against gravity in turn changes the
///         horizontal distance: g^2 = t^2 (dx^2 + (dy - up_y g)^2 / up_z^2).
class Cone {
 public:
  Cone(double slope_rad, double up_y, double up_z) : up_y_(up_y), up_z_(up_z) {
    // lower limit, for a sideways tilt beyond the slope of the soil
    constexpr double kLeast = 0.05;
    const double t2 = std::pow(std::tan(slope_rad), 2), over_z2 = 1 / (up_z * up_z);
    a_ = std::max(kLeast, 1 - t2 * up_y * up_y * over_z2);
    b_ = t2 * up_y * over_z2;
    c_x_ = t2, c_y_ = t2 * over_z2;
  }
  double Rise_m(double dx_m, double dy_m) const {
    const double b = b_ * dy_m, c = c_x_ * dx_m * dx_m + c_y_ * dy_m * dy_m;
    return ((std::sqrt(b * b + a_ * c) - b) / a_ - dy_m * up_y_) / up_z_;
  }

 private:
  double up_y_, up_z_, a_, b_, c_x_, c_y_;
};

/// Mean over a triangle of the positive part of a linear function with the given corner values.
double MeanOfPositive(double a, double b, double c) {
  if (a > b) std::swap(a, b);
  if (b > c) std::swap(b, c);
  if (a > b) std::swap(a, b);
  if (c <= 0) return 0;
  if (a >= 0) return (a + b + c) / 3;
  if (b <= 0) return c * c * c / (3 * (c - a) * (c - b));
  return (a + b + c) / 3 - a * a * a / (3 * (b - a) * (c - a));
}

}  // namespace

HeapGrid::HeapGrid(const ShovelShape& shape, const Stance& stance, double cell_m,
                   const HeapRelief& relief) {
  const Vec3& up_B = stance.up_B;
  const Vec2 in_plane(up_B.x(), up_B.z());
  up_ = in_plane.normalized();
  right_ = Vec2(up_.y(), -up_.x());
  const double tilt_rad =
      std::clamp(std::atan2(up_B.y(), in_plane.norm()), -kMostTilt_rad, kMostTilt_rad);
  up_y_ = std::sin(tilt_rad), up_z_ = std::cos(tilt_rad);
  top_lip_ = Level(shape.held_B().back()), edge_lip_ = Level(shape.held_B().front());
  CutSlices(shape, cell_m);
  const int across = std::max(2, static_cast<int>(std::lround(2 * shape.half_width_m() / cell_m)));
  for (int j = 0; j <= across; ++j) ys_m_.push_back((2.0 * j / across - 1) * shape.half_width_m());
  Limit(stance, relief);
}

HeapGrid::Slice HeapGrid::SliceAt(const std::vector<Vec2>& outline, double x_m) const {
  Slice slice{x_m, kOpen, -kOpen, false};
  for (std::size_t m = 0; m < outline.size(); ++m) {
    const bool is_mouth = m + 1 == outline.size();
    const Vec2 &a = outline[m], &b = outline[is_mouth ? 0 : m + 1];
    if ((a.x() - x_m) * (b.x() - x_m) > 0 || a.x() == b.x()) continue;
    const double z_m = a.y() + (b.y() - a.y()) * (x_m - a.x()) / (b.x() - a.x());
    if (z_m < slice.floor_m) slice.floor_m = z_m, slice.holds = !is_mouth;
    if (is_mouth) {
      slice.ceiling_m = kOpen;
    } else {
      slice.ceiling_m = std::max(slice.ceiling_m, z_m);
    }
  }
  return slice;
}

/// Slices at equal distances and at the corners of the shell; two slices at a step of the shell.
void HeapGrid::CutSlices(const ShovelShape& shape, double cell_m) {
  std::vector<Vec2> outline;
  for (const Vec2& p : shape.held_B()) outline.push_back(Level(p));
  std::vector<double> corners_m;
  for (const Vec2& p : outline) corners_m.push_back(p.x());
  std::sort(corners_m.begin(), corners_m.end());
  for (std::size_t c = 0; c < corners_m.size(); ++c) {
    const Slice before = SliceAt(outline, corners_m[c] - kBesideCorner_m);
    const Slice after = SliceAt(outline, corners_m[c] + kBesideCorner_m);
    const bool is_step = before.holds != after.holds ||
                         std::abs(before.floor_m - after.floor_m) > kStep_m ||
                         (before.ceiling_m == kOpen) != (after.ceiling_m == kOpen);
    if (before.holds && (is_step || c == 0)) slices_.push_back(before);
    if (after.holds) slices_.push_back(after);
    if (c + 1 == corners_m.size()) break;
    const double gap_m = corners_m[c + 1] - corners_m[c];
    const int cells = static_cast<int>(std::lround(gap_m / cell_m));
    for (int k = 1; k < cells; ++k) {
      slices_.push_back(SliceAt(outline, corners_m[c] + gap_m * k / cells));
    }
  }
  std::erase_if(slices_, [](const Slice& s) { return !(s.ceiling_m > s.floor_m); });
}

/// The rim of the mouth: both lips, and the tops of the side walls.
std::array<HeapGrid::RimSide, 4> HeapGrid::Rim() const {
  std::array<RimSide, 4> rim_m;
  for (const double y_m : ys_m_) {
    rim_m[0].emplace_back(top_lip_.x(), y_m, top_lip_.y());
    rim_m[1].emplace_back(edge_lip_.x(), y_m, edge_lip_.y());
  }
  const Vec2 mouth = edge_lip_ - top_lip_;
  for (const Slice& slice : slices_) {
    const double s = (slice.x_m - top_lip_.x()) / mouth.x();
    if (!(s > 0 && s < 1)) continue;
    const double z_m = top_lip_.y() + s * mouth.y();
    rim_m[2].emplace_back(slice.x_m, ys_m_.front(), z_m);
    rim_m[3].emplace_back(slice.x_m, ys_m_.back(), z_m);
  }
  return rim_m;
}

/// Limits each column by the cones of all points of the rim. Along one side of the rim the limit is
/// convex, so the search starts at the result of the previous column.
void HeapGrid::Limit(const Stance& stance, const HeapRelief& relief) {
  const Cone cone(stance.slope_rad, up_y_, up_z_);
  const std::array<RimSide, 4> rim_m = Rim();
  std::array<std::size_t, 4> least{};
  const auto most_m = [&](double x_m, double y_m) {
    double most_m = kOpen;
    for (std::size_t side = 0; side < rim_m.size(); ++side) {
      const RimSide& points_m = rim_m[side];
      if (points_m.empty()) continue;
      const auto leaves_m = [&](std::size_t k) {
        return points_m[k].z() + cone.Rise_m(x_m - points_m[k].x(), y_m - points_m[k].y());
      };
      std::size_t& k = least[side];
      double at_m = leaves_m(k);
      for (const int step : {1, -1}) {
        while (k + step < points_m.size()) {  // k - 1 wraps to the largest number at 0
          const double next_m = leaves_m(k + step);
          if (next_m >= at_m) break;
          k += step, at_m = next_m;
        }
      }
      most_m = std::min(most_m, at_m);
    }
    return most_m;
  };
  const Vec2 mouth = edge_lip_ - top_lip_;
  const double middle_m = 0.5 * (top_lip_.x() + edge_lip_.x());
  const Vec3& n_B = stance.surface_up_B;
  const double n_up = std::max(kLeastNormal, up_.x() * n_B.x() + up_.y() * n_B.z());
  const double rise_x = -(right_.x() * n_B.x() + right_.y() * n_B.z()) / n_up;
  const double rise_y = -n_B.y() / n_up;
  const double leans_rad = std::atan2(n_B.cross(stance.up_B).norm(), n_B.dot(stance.up_B));
  const double round_m = kRoundTop * mouth.norm();
  const double mound = kMound * std::max(0.0, std::tan(stance.slope_rad) -
                                                  std::tan(std::min(leans_rad, stance.slope_rad)));
  lowest_m_ = kOpen, highest_m_ = -kOpen;
  for (std::size_t n = 0; n < slices_.size() * ys_m_.size(); ++n) {
    const Slice& slice = slices_[n / ys_m_.size()];
    const double y_m = ys_m_[n % ys_m_.size()];
    const double from_top_m = std::hypot(slice.x_m - middle_m, y_m, round_m) - round_m;
    const Vec2 place_m = PlaceOf(n);
    limits_.push_back({rise_x * (slice.x_m - middle_m) + rise_y * y_m - mound * from_top_m,
                       most_m(slice.x_m, y_m), relief(place_m.x(), place_m.y())});
    if (!slice.holds) continue;
    lowest_m_ = std::min(lowest_m_, slice.floor_m - limits_[n].mound_m);
    highest_m_ = std::max(highest_m_, limits_[n].most_m - limits_[n].mound_m);
  }
}

std::vector<HeapGrid::Column> HeapGrid::FilledTo(double level_m) const {
  std::vector<Column> columns;
  columns.reserve(limits_.size());
  for (std::size_t n = 0; n < limits_.size(); ++n) {
    const Slice& slice = slices_[n / ys_m_.size()];
    const double soil_m =
        std::min(level_m + limits_[n].mound_m, limits_[n].most_m) - limits_[n].relief_m;
    columns.push_back(
        {std::min(soil_m, slice.ceiling_m), slice.floor_m, soil_m >= slice.ceiling_m});
  }
  return columns;
}

double HeapGrid::VolumeBelow_m3(double level_m) const {
  const std::vector<Column> columns = FilledTo(level_m);
  const double cell_y_m = ys_m_[1] - ys_m_[0];
  double volume_m3 = 0;
  ForTriangles([&](std::size_t a, std::size_t b, std::size_t c) {
    const auto x_m = [&](std::size_t n) { return slices_[n / ys_m_.size()].x_m; };
    const double cell_x_m = std::max({x_m(a), x_m(b), x_m(c)}) - std::min({x_m(a), x_m(b), x_m(c)});
    volume_m3 += 0.5 * cell_x_m * cell_y_m *
                 MeanOfPositive(columns[a].depth_m(), columns[b].depth_m(), columns[c].depth_m());
  });
  return volume_m3;
}

Vec3 HeapGrid::At_B(std::size_t column, double height_m) const {
  const Vec2 in_plane = slices_[column / ys_m_.size()].x_m * right_ + height_m * up_;
  return Vec3(in_plane.x(), ys_m_[column % ys_m_.size()], in_plane.y());
}

/// Position in the plane of the mouth above or below a column.
Vec2 HeapGrid::PlaceOf(std::size_t column) const {
  const Vec2 mouth = edge_lip_ - top_lip_;
  const double x_m = slices_[column / ys_m_.size()].x_m - top_lip_.x();
  return Vec2(x_m * mouth.norm() / (std::abs(mouth.x()) > kStep_m ? mouth.x() : kStep_m),
              ys_m_[column % ys_m_.size()]);
}

}  // namespace tera
