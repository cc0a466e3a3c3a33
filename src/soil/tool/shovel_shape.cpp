#include "soil/tool/shovel_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/check.h"
#include "core/units.h"

namespace tera {
namespace {

constexpr double kTiny = 1e-12;
constexpr double kSteepestRise_rad = 85 * kDeg;  ///< steepest slope of soil at a side wall

double NotZero(double x) { return std::abs(x) > kTiny ? x : kTiny; }

double Cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

double TwiceArea_m2(const std::vector<Vec2>& profile) {
  double sum_m2 = 0;
  for (std::size_t k = 0; k < profile.size(); ++k) {
    sum_m2 += Cross(profile[k], profile[(k + 1) % profile.size()]);
  }
  return sum_m2;
}

/// The polyline without its first `length_m`, with at least three points.
std::vector<Vec2> Behind(double length_m, std::vector<Vec2> profile) {
  while (length_m > 0 && profile.size() > 3) {
    const Vec2 along = profile[1] - profile[0];
    if (along.norm() > length_m) {
      profile[0] += length_m * along.normalized();
      break;
    }
    length_m -= along.norm();
    profile.erase(profile.begin());
  }
  return profile;
}

/// Mean height across a width of soil with the height `most_m` in the middle and the given slopes
/// from both ends. The first slope may be negative.
double MeanOfRoof_m(double most_m, double rise_a, double rise_b, double width_m) {
  if (rise_a < 0) {
    if (most_m >= 0) return 0.5 * rise_a * width_m;
    const double met_m = std::min(most_m / rise_a, width_m);
    return (most_m * met_m + 0.5 * rise_a * (width_m * width_m - met_m * met_m)) / width_m;
  }
  if (most_m <= 0) return most_m;
  const double ridge_m = rise_a * rise_b / std::max(rise_a + rise_b, kTiny) * width_m;
  if (most_m >= ridge_m) return 0.5 * ridge_m;
  return most_m * (1 - 0.5 * most_m / ridge_m);
}

}  // namespace

ShovelShape::ShovelShape(const Shovel& shovel)
    : profile_(shovel.profile_B_m),
      half_width_m_(0.5 * shovel.width_m),
      capacity_m3_(shovel.capacity_m3) {
  const std::size_t n = profile_.size();
  TERA_CHECK(n >= 3, shovel.name, n);
  held_ = Behind(shovel.teeth > 0 ? shovel.tooth_length_m : 0, profile_);
  const double twice_area = TwiceArea_m2(profile_);
  held_area_m2_ = 0.5 * std::abs(TwiceArea_m2(held_));
  TERA_CHECK(held_area_m2_ > 0, shovel.name);
  inside_m2_ = 2 * held_area_m2_;
  for (std::size_t k = 0; k + 1 < held_.size(); ++k) {
    inside_m2_ += (held_[k + 1] - held_[k]).norm() * shovel.width_m;
  }
  const double turn = twice_area > 0 ? 1 : -1;
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 a = profile_[k], b = profile_[(k + 1) % n];
    const Vec2 d = (b - a).normalized();
    segments_.push_back({a, b, turn * Vec2(d.y(), -d.x())});
    radius_m_ = std::max(radius_m_, std::hypot(a.norm(), half_width_m_));
  }
  const Vec2 m = segments_.back().outward;
  mouth_normal_B_ = Vec3(m.x(), 0, m.y());
}

Vec3 ShovelShape::edge_B() const { return Vec3(profile_[0].x(), 0, profile_[0].y()); }

Vec3 ShovelShape::top_edge_B() const { return Vec3(profile_.back().x(), 0, profile_.back().y()); }

Vec3 ShovelShape::edge_direction_B() const {
  const Vec2 d = (profile_[0] - profile_[1]).normalized();
  return Vec3(d.x(), 0, d.y());
}

Vec3 ShovelShape::LevelUp_B() const {
  const Vec2 mouth = held_.front() - held_.back();
  const Vec3 up(-mouth.y(), 0, mouth.x());
  return up.dot(mouth_normal_B_) > 0 ? Vec3(up.normalized()) : Vec3(-up.normalized());
}

bool ShovelShape::IsOverEdge(const Vec3& up_B) const {
  const Vec2 up(up_B.x(), up_B.z());
  return held_.front().dot(up) <= held_.back().dot(up);
}

Vec3 ShovelShape::LowerLip_B(const Vec3& up_B) const {
  const Vec2 lip = IsOverEdge(up_B) ? held_.front() : held_.back();
  return Vec3(lip.x(), 0, lip.y());
}

ShovelShape::LevelExtent ShovelShape::ExtentAcross(const Vec3& up_B) const {
  Vec2 up(up_B.x(), up_B.z());
  up = up.norm() > kTiny ? Vec2(up.normalized()) : Vec2(Vec2::UnitY());
  LevelExtent extent{.right = Vec2(up.y(), -up.x()),
                     .up = up,
                     .from_m = std::numeric_limits<double>::infinity(),
                     .to_m = -std::numeric_limits<double>::infinity()};
  for (const Vec2& p : profile_) {
    extent.from_m = std::min(extent.from_m, p.dot(extent.right));
    extent.to_m = std::max(extent.to_m, p.dot(extent.right));
  }
  return extent;
}

ShovelShape::Uprights::Uprights(const ShovelShape& shape, const Pose& X_WB)
    : R_BW_(X_WB.linear().transpose()),
      p_WB_m_(X_WB.translation()),
      half_width_m_(shape.half_width_m_) {}

ShovelShape::Upright ShovelShape::Uprights::At(double x_m, double y_m) const {
  constexpr double kInfinite_m = std::numeric_limits<double>::infinity();
  Upright line{R_BW_ * (Vec3(x_m, y_m, 0) - p_WB_m_), R_BW_.col(2), -kInfinite_m, kInfinite_m};
  const double y = line.o_B.y(), rise = line.u_B.y();
  if (std::abs(rise) < kTiny) {
    if (std::abs(y) > half_width_m_) line.to_m = -kInfinite_m;
  } else {
    const double za = (-half_width_m_ - y) / rise, zb = (half_width_m_ - y) / rise;
    line.from_m = std::min(za, zb), line.to_m = std::max(za, zb);
  }
  return line;
}

/// z at which the line crosses the segment from `a` to `a + d` in B's x-z plane. Empty if it does
/// not.
std::optional<double> ShovelShape::Upright::Crosses_m(const Vec2& a, const Vec2& d) const {
  const Vec2 u(u_B.x(), u_B.z());
  const double denominator = Cross(u, d);
  if (std::abs(denominator) < kTiny) return std::nullopt;
  const Vec2 to = a - Vec2(o_B.x(), o_B.z());
  const double s = Cross(to, u) / denominator;
  if (s < 0 || s > 1) return std::nullopt;
  return Cross(to, d) / denominator;
}

std::optional<double> ShovelShape::LowestOfShell(const Upright& line, const Vec2& behind_B) const {
  if (line.is_beside()) return std::nullopt;
  double low_m = std::numeric_limits<double>::infinity();
  const auto take = [&](const Vec2& a, const Vec2& d) {
    low_m = std::min(low_m, line.Crosses_m(a, d).value_or(low_m));
  };
  for (const Vec2& p : profile_) take(p, behind_B);
  for (std::size_t k = 0; k + 1 < profile_.size(); ++k) {
    take(profile_[k], profile_[k + 1] - profile_[k]);
    take(profile_[k] + behind_B, profile_[k + 1] - profile_[k]);
  }
  low_m = std::max(low_m, line.from_m);
  return low_m < line.to_m ? std::optional(low_m) : std::nullopt;
}

std::optional<double> ShovelShape::HeightOfPassedEdge(const Upright& line,
                                                      const Vec2& came_B) const {
  return line.is_beside() ? std::nullopt : line.Crosses_m(profile_[0], came_B);
}

std::optional<ShovelShape::Crossing> ShovelShape::VerticalCrossing(const Upright& line) const {
  if (line.is_beside()) return std::nullopt;
  const double z0 = line.from_m, z1 = line.to_m;
  const Vec3& u_B = line.u_B;
  Crossing crossing;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  std::size_t low_segment = 0;
  for (std::size_t k = 0; k < segments_.size(); ++k) {
    const std::optional<double> z = line.Crosses_m(segments_[k].a, segments_[k].b - segments_[k].a);
    if (!z) continue;
    if (*z < low) low = *z, low_segment = k;
    high = std::max(high, *z);
  }
  if (!(high > low)) return std::nullopt;
  crossing.low_m = std::max(low, z0);
  crossing.high_m = std::min(high, z1);
  if (crossing.high_m <= crossing.low_m) return std::nullopt;
  crossing.through_mouth = low_segment + 1 == segments_.size();
  if (z0 > low) {  // through a side wall
    crossing.through_mouth = false;
    crossing.low_normal_B = Vec3(0, u_B.y() > 0 ? -1 : 1, 0);
  } else {
    const Vec2 n = segments_[low_segment].outward;
    crossing.low_normal_B = Vec3(n.x(), 0, n.y());
  }
  return crossing;
}

/// Heaped soil as vertical slices, each from floor to surface.
struct ShovelShape::Heap {
  static constexpr int kSlices = 40;
  struct Slice {
    double x = 0, floor = 0, surface = 0;
  };
  Vec2 right, up;  ///< axes in the plane of the profile
  double dx = 0;
  double rise = 0;  ///< slope of the planes that cut off the soil; heights are relative to them
  std::array<Slice, kSlices> slices;

  Vec2 Level(const Vec2& p) const { return Vec2(p.dot(right), p.dot(up)); }
  void CountFromPlanes(const Vec3& normal_B) {
    constexpr double kLeastUp = 0.1;
    const Vec2 n = Level(Vec2(normal_B.x(), normal_B.z()));
    rise = -n.x() / std::max(n.y(), kLeastUp);
    for (Slice& s : slices) s.floor -= rise * s.x, s.surface -= rise * s.x;
  }
  /// Area of the section below the level `cap`.
  double AreaBelow(double cap) const {
    double area = 0;
    for (const Slice& s : slices) area += std::max(0.0, std::min(s.surface, cap) - s.floor) * dx;
    return area;
  }
  /// Lowest floor and highest surface.
  std::pair<double, double> Extent() const {
    double top = -std::numeric_limits<double>::infinity(), bottom = -top;
    for (const Slice& s : slices) {
      if (s.surface <= s.floor) continue;
      top = std::max(top, s.surface);
      bottom = std::min(bottom, s.floor);
    }
    return {bottom, top};
  }
  /// Centre of the section below `cap`, in the axes of Level. Empty if there is no soil.
  std::optional<Vec2> CentreBelow(double cap) const {
    double area = 0;
    Vec2 moment = Vec2::Zero();
    for (const Slice& s : slices) {
      const double height = std::min(s.surface, cap) - s.floor;
      if (height <= 0) continue;
      area += height * dx;
      moment += height * dx * Vec2(s.x, s.floor + 0.5 * height);
    }
    if (area <= 0) return std::nullopt;
    const Vec2 centre = moment / area;
    return Vec2(centre.x(), centre.y() + rise * centre.x());
  }
};

/// The fullest heap under `up_B`. Soil rises at repose from each lip inwards. Over the mouth it
/// also rises from the side walls, which may have different heights.
ShovelShape::Heap ShovelShape::FullestHeap(const Vec3& up_B, double repose_rad) const {
  const Vec2 up = Vec2(up_B.x(), up_B.z()).normalized();
  Heap heap{.right = Vec2(up.y(), -up.x()), .up = up};
  const double slope = std::tan(repose_rad);
  const double tilt_rad = std::atan2(std::abs(up_B.y()), Vec2(up_B.x(), up_B.z()).norm());
  const double rise_low = std::tan(std::max(repose_rad - tilt_rad, -kSteepestRise_rad));
  const double rise_high = std::tan(std::min(repose_rad + tilt_rad, kSteepestRise_rad));
  const Vec2 lip_a = heap.Level(held_.front()), lip_b = heap.Level(held_.back());
  const double mouth_slope = (lip_b.y() - lip_a.y()) / NotZero(lip_b.x() - lip_a.x());
  double from = std::numeric_limits<double>::infinity(), to = -from;
  for (const Vec2& p : held_) {
    from = std::min(from, heap.Level(p).x());
    to = std::max(to, heap.Level(p).x());
  }
  heap.dx = (to - from) / Heap::kSlices;
  const double mouth_left = std::min(lip_a.x(), lip_b.x());
  const double mouth_right = std::max(lip_a.x(), lip_b.x());
  for (int k = 0; k < Heap::kSlices; ++k) {
    Heap::Slice& slice = heap.slices[k];
    slice.x = from + (k + 0.5) * heap.dx;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    bool open = false, bottomless = false;
    for (std::size_t m = 0; m < held_.size(); ++m) {
      const bool is_mouth = m + 1 == held_.size();
      const Vec2 a = heap.Level(held_[m]), b = heap.Level(held_[is_mouth ? 0 : m + 1]);
      if ((a.x() - slice.x) * (b.x() - slice.x) > 0 || a.x() == b.x()) continue;
      const double z = a.y() + (b.y() - a.y()) * (slice.x - a.x()) / (b.x() - a.x());
      if (z < low) low = z, bottomless = is_mouth;
      if (z > high) high = z, open = is_mouth;
    }
    if (!(high > low) || bottomless) continue;
    // Outwards from a lip, soil does not rise.
    const double inward_a = lip_a.x() < lip_b.x() ? slice.x - lip_a.x() : lip_a.x() - slice.x;
    const double inward_b = lip_b.x() < lip_a.x() ? slice.x - lip_b.x() : lip_b.x() - slice.x;
    double surface = std::min(lip_a.y() + slope * std::max(0.0, inward_a),
                              lip_b.y() + slope * std::max(0.0, inward_b));
    const bool under_mouth = slice.x > mouth_left && slice.x < mouth_right;
    if (open && under_mouth) {
      const double side_wall = lip_a.y() + mouth_slope * (slice.x - lip_a.x());
      surface =
          side_wall + MeanOfRoof_m(surface - side_wall, rise_low, rise_high, 2 * half_width_m_);
    } else {
      surface = std::min(surface, high);
    }
    slice.floor = low;
    slice.surface = std::max(low, surface);
  }
  return heap;
}

ShovelShape::Hold ShovelShape::HoldFor(const Vec3& up_B, double repose_rad, double volume_m3,
                                       const Vec3& surface_up_B) const {
  Hold hold;
  const Vec2 up(up_B.x(), up_B.z());
  if (up.norm() < kTiny || capacity_m3_ <= 0) return hold;
  Heap heap = FullestHeap(up_B, repose_rad);
  heap.CountFromPlanes(surface_up_B);
  const auto [bottom, top] = heap.Extent();
  const double volume_per_area_m = capacity_m3_ / held_area_m2_;
  if (top > bottom) hold.volume_m3 = heap.AreaBelow(top) * volume_per_area_m;
  // Level with the requested volume, then the centre below it.
  double cap = top;
  if (volume_m3 < hold.volume_m3) {
    constexpr int kBisections = 20;
    double low = bottom, high = top;
    for (int k = 0; k < kBisections; ++k) {
      cap = 0.5 * (low + high);
      (heap.AreaBelow(cap) * volume_per_area_m < volume_m3 ? low : high) = cap;
    }
  }
  const Vec2 centre = heap.CentreBelow(cap).value_or(heap.Level(held_[held_.size() / 2]));
  const Vec2 in_B = centre.x() * heap.right + centre.y() * heap.up;
  hold.com_B_m = Vec3(in_B.x(), 0, in_B.y());
  return hold;
}

}  // namespace tera
