#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "soil/tool/digging.h"

/// Destination of the soil that a shovel pushes aside.

namespace tera {
namespace {

constexpr std::size_t kWidestWedge = 60;  ///< greatest length of a moved row, in columns
constexpr double kFan_rad = 25 * kDeg;    ///< to both sides of the direction of motion
constexpr double kParcel_m = 0.001;       ///< least thickness of a parcel of spread soil
constexpr double kThickest_m = 0.02;      ///< greatest thickness of a parcel
constexpr int kLongestRoll = 60;          ///< greatest distance of rolling, in columns
/// Loose share of the pushed soil at which it starts to move as a heap, and at which all of it
/// does.
constexpr double kHalfLoose = 0.5, kNearlyLoose = 0.9;

/// Fractional part of a multiple of `ratio`. With these two ratios the pairs fill a square evenly
/// for any count (Roberts 2018, sequence R2).
constexpr double kAcross = 0.7548776662466927, kAlong = 0.5698402909980532;
double Turn(std::size_t n, double ratio) {
  const double at = ratio * static_cast<double>(n);
  return at - std::floor(at);
}

int Nearest(double columns) { return static_cast<int>(std::lround(columns)); }

}  // namespace

/// True if a part of the shovel moves sideways rather than up or down.
bool Digging::MovesAlong(const Vec3& v_W) {
  const double along_mps = v_W.head<2>().norm();
  return along_mps >= 0.5 * std::abs(v_W.z()) && along_mps >= kLeastSpeed_mps;
}

/// Direction of pushed soil: that of the motion, or towards the nearer side if pressed down.
Vec2 Digging::WayOut(const BodyState& body, const Vec3& p_W, const Vec3& v_W) const {
  if (MovesAlong(v_W)) return v_W.head<2>().normalized();
  const Mat3& R_WB = body.X_WB.linear();
  const double y_B = (R_WB.transpose() * (p_W - body.X_WB.translation())).y();
  const Vec2 side = (y_B >= 0 ? 1.0 : -1.0) * R_WB.col(1).head<2>();
  return Level({side.x(), side.y(), 0});
}

/// First position outside the footprint from one of its columns, in columns.
Vec2 Digging::WayOutFrom(const Swept& swept, const Vec2& direction) const {
  constexpr double kStep = 0.7;  // in columns; small enough to skip no column
  Vec2 at(swept.i, swept.j);
  while (InFootprint(Nearest(at.x()), Nearest(at.y()))) at += kStep * direction;
  return at;
}

/// Share of the soil above a part of the shovel that moves as a heap: 0 if half of the soil is
/// firm, 1 if nearly all is loose.
double Digging::SlidesAsHeap(const Place& at, const Swept& swept, const Columns& ground) const {
  const ColumnId k = ground.IdAt(at.i, at.j);
  if (k == Columns::kNone) return 0;
  const Columns::Skin& skin = ground.skin(k);
  const double over_m = skin.top_m - swept.crossing.low_m;
  return over_m > 0 ? std::clamp((skin.loose_m / over_m - kHalfLoose) / (kNearlyLoose - kHalfLoose),
                                 0.0, 1.0)
                    : 0;
}

/// Columns outside the footprint that move when a part of the shovel pushes in `way_out`. Firm soil
/// moves in a fan, above a plane from the shovel's lowest point at Rankine's passive angle. A heap
/// moves straight ahead, as far as the edge moves it.
Digging::Heap Digging::HeapBefore(const BodyState& body, const Swept& swept, const Vec2& way_out,
                                  const SoilType& soil, const Columns& ground) const {
  const Vec2 straight = WayOutFrom(swept, way_out);
  const double slides = SlidesAsHeap(PlaceNear(straight), swept, ground);
  // Without the fan, all soil from one place of the shovel would form one line.
  const double fan_rad = (1 - slides) * kFan_rad * (2 * Turn(put_, kAcross) - 1);
  const Vec2 direction(std::cos(fan_rad) * way_out.x() - std::sin(fan_rad) * way_out.y(),
                       std::sin(fan_rad) * way_out.x() + std::cos(fan_rad) * way_out.y());
  Heap heap{.out = WayOutFrom(swept, direction), .direction = direction};
  if (RidesOver(body, heap.At(0), soil.repose_angle_rad, ground)) {
    heap.out = WayOutFrom(swept, -direction);
    return heap;
  }
  const double rise_m = std::tan(kPi / 4 - soil.friction_angle_rad / 2) * ground.cell_m();
  const auto rises = [&](std::size_t n) {
    const auto [i, j] = heap.At(n);
    return ground.Contains(i, j) && !InFootprint(i, j) &&
           swept.crossing.low_m + static_cast<double>(n) * rise_m < ground.TopAt(i, j);
  };
  while (heap.columns < kWidestWedge && rises(heap.columns)) ++heap.columns;
  const auto wedge = static_cast<double>(heap.columns);
  const double moved = edge_.lifted_W_m().dot(way_out) / ground.cell_m();
  heap.columns = std::min(kWidestWedge,
                          static_cast<std::size_t>(wedge + slides * std::max(0.0, moved - wedge)));
  return heap;
}

/// Puts soil on the columns that move in `way_out`. From there it rolls down slopes steeper than
/// repose, or over a blade.
void Digging::PutOutside(const BodyState& body, const Swept& swept, const Vec2& way_out,
                         SpoilMix* spoil, Columns* ground) {
  const SoilType& soil = soils_[spoil->main_soil()];
  const Heap heap = HeapBefore(body, swept, way_out, soil, *ground);
  // Distributes parcels of useful size over the columns in turn.
  const double thickness_m = spoil->volume_m3() / ground->area_m2();
  const std::size_t parcels = std::clamp<std::size_t>(
      static_cast<std::size_t>(thickness_m / kParcel_m), 1,
      std::max(heap.columns, static_cast<std::size_t>(thickness_m / kThickest_m)));
  for (std::size_t p = 0; p < parcels; ++p) {
    const double turn = Turn(++put_, kAlong);
    Place rest = heap.At(static_cast<std::size_t>(turn * static_cast<double>(heap.columns)));
    const double repose_rad = soil.repose_angle_rad;
    for (int k = 0; k < kLongestRoll && RollsOn(repose_rad, *ground, &rest); ++k) continue;
    ground->DepositAt(rest.i, rest.j, spoil->Take(1.0 / static_cast<double>(parcels - p)));
  }
}

/// Drops the soil above a buried, moving bucket behind it.
void Digging::LetPassOver(const Swept& swept, const Vec3& v_W, Columns* ground) {
  SpoilMix over;
  ground->Cut(ground->Touch(swept.i, swept.j), highest_m_, &over);
  if (over.empty()) return;
  const Place behind = PlaceNear(WayOutFrom(swept, -v_W.head<2>().normalized()));
  const double repose_rad = soils_[over.main_soil()].repose_angle_rad;
  const auto parcels = static_cast<std::size_t>(over.volume_m3() / ground->area_m2() / kThickest_m);
  for (std::size_t p = 0; p <= parcels; ++p) {
    Place at = behind;
    for (int n = 0; n < kLongestRoll && RollsOn(repose_rad, *ground, &at); ++n) continue;
    ground->DepositAt(at.i, at.j, over.Take(1.0 / static_cast<double>(parcels + 1 - p)));
  }
}

/// True if soil in front of a blade flows over it: it has reached the slope at repose from the top
/// edge. Soil above the top edge, such as a bank, does not flow over.
bool Digging::RidesOver(const BodyState& body, const Place& at, double repose_rad,
                        const Columns& ground) const {
  if (shovel_.capacity_m3 > 0 || !ground.Contains(at.i, at.j)) return false;
  const Vec3 top_W = body.X_WB * shape_.top_edge_B();
  const Vec2 from_top(ground.x_m(at.i) - top_W.x(), ground.y_m(at.j) - top_W.y());
  const double ahead_m = from_top.dot(Level(body.X_WB.linear() * shape_.mouth_normal_B()));
  const double over_top_m = ground.TopAt(at.i, at.j) - top_W.z();
  return over_top_m < 0 && over_top_m > -std::max(0.0, ahead_m) * std::tan(repose_rad);
}

/// Moves `at` to the steepest lower neighbour outside the footprint if soil rolls there. True if it
/// moved.
bool Digging::RollsOn(double repose_rad, const Columns& ground, Place* at) const {
  if (!ground.Contains(at->i, at->j)) return false;
  const double top_m = ground.TopAt(at->i, at->j);
  double steepest = std::tan(repose_rad) * ground.cell_m();
  const Place from = *at;
  for (int dj = -1; dj <= 1; ++dj) {
    for (int di = -1; di <= 1; ++di) {
      const Place to{from.i + di, from.j + dj};
      if ((di == 0 && dj == 0) || !ground.Contains(to.i, to.j) || InFootprint(to.i, to.j)) continue;
      const double fall = (top_m - ground.TopAt(to.i, to.j)) / std::hypot(di, dj);
      if (fall > steepest) steepest = fall, *at = to;
    }
  }
  return at->i != from.i || at->j != from.j;
}

}  // namespace tera
