#include "soil/flow/standing_wall.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/units.h"
#include "soil/flow/grains.h"

namespace tera {
namespace {

constexpr int kLookDown = 12;  ///< columns over which the height of a bank is measured
constexpr double kLeastOverhang_m = 2e-4;
/// Lower faces under running gear are left to Bekker's pressure-sinkage.
constexpr double kLeastLoaded_m = 0.3;
/// soil with a lower critical height crumbles instead of slipping
constexpr double kLeastWedge_m = 0.1;
constexpr double kBreakSpeed_mps = 1.0;  ///< rate at which a bank crumbles, in height
constexpr double kVeneer_m = 0.05;       ///< thicker loose soil protects the bank from crumbling
constexpr double kLongestWedge_m = 10;
constexpr double kDeeper_m = 1e-3;  ///< a farther toe must be deeper by at least this
/// Least length of the summed directions of fall; below it, ground falls to all sides alike.
constexpr double kLeastLean = 0.1;
constexpr double kSide = 1 + 1e-9;  ///< tolerance for columns on the edge of a strip

struct Direction {
  int di, dj;
  double distance;  ///< in cells
};
const std::array<Direction, 8> kDirections = {{{1, 0, 1},
                                               {-1, 0, 1},
                                               {0, 1, 1},
                                               {0, -1, 1},
                                               {1, 1, std::sqrt(2.0)},
                                               {-1, -1, std::sqrt(2.0)},
                                               {1, -1, std::sqrt(2.0)},
                                               {-1, 1, std::sqrt(2.0)}}};

/// Uppermost standing soil of a column, z of its top and its thickness.
struct Bank {
  std::uint8_t soil;
  double top_m, thickness_m;
};

Bank BankAt(ColumnId k, const Columns& ground) {
  const Column& c = ground.at(k);
  const Stratum& stratum = ground.BankOf(k);
  const double stratum_m = c.bank_m - (c.ground_m - stratum.bottom_m);
  double top_m = c.top_m;
  int n = c.layer_count;
  for (; n > 0 && c.layers[n - 1].loose; --n) top_m -= c.layers[n - 1].thickness_m;
  if (n == 0) return {stratum.soil, top_m, stratum_m};
  Bank bank{c.layers[n - 1].soil, top_m, 0};
  for (; n > 0 && c.layers[n - 1].soil == bank.soil; --n) {
    bank.thickness_m += c.layers[n - 1].thickness_m;
  }
  if (n == 0 && stratum.soil == bank.soil) bank.thickness_m += stratum_m;
  return bank;
}

/// Horizontal unit vector towards the neighbours below `z_m`; zero if they lie on all sides alike.
Vec2 Outward(const Columns::Place& place, double z_m, const Columns& ground) {
  Vec2 sum = Vec2::Zero();
  for (const auto& [di, dj, distance] : kDirections) {
    if (!ground.Contains(place.i + di, place.j + dj)) continue;
    if (ground.TopAt(place.i + di, place.j + dj) < z_m) sum += Vec2(di, dj) / distance;
  }
  return sum.norm() > kLeastLean ? Vec2(sum.normalized()) : Vec2(Vec2::Zero());
}

/// Cuts the wedge behind an edge out of the ground, in a strip as wide as the column at the edge.
void SlideOff(const StandingWalls::Failure& failure, Columns* ground,
              std::vector<Grains::Broken>* broken) {
  const auto [i0, j0] = ground->PlaceOf(failure.column);
  const Vec2 edge(ground->x_m(i0), ground->y_m(j0)), out = failure.out;
  const double toe_m = failure.top_m - failure.drop_m;
  // The block slides down the chord of the slip surface, against the friction along it.
  const double length_m = failure.slip.length_m();
  const double chord_rad = std::atan2(failure.slip.height_m(), length_m);
  const double friction_rad = std::atan(failure.slip.tan_friction);
  const Vec3 down_W(out.x() * std::cos(chord_rad), out.y() * std::cos(chord_rad),
                    -std::sin(chord_rad));
  const double slide_mps2 = kStandardGravity_mps2 *
                            std::max(0.0, std::sin(chord_rad - friction_rad)) /
                            std::cos(friction_rad);
  const double half_m = 0.5 * ground->cell_m() * (std::abs(out.x()) + std::abs(out.y()));
  const double reach_m = std::min(kLongestWedge_m, length_m) + failure.run_m;
  const int reach = static_cast<int>(std::ceil(reach_m / ground->cell_m()));
  for (int j = j0 - reach; j <= j0 + reach; ++j) {
    for (int i = i0 - reach; i <= i0 + reach; ++i) {
      if (!ground->Contains(i, j)) continue;
      const Vec2 at(ground->x_m(i), ground->y_m(j));
      const double behind_m = (edge - at).dot(out);
      const double aside_m =
          out.isZero() ? (at - edge).norm() : (edge - at - behind_m * out).norm();
      if (aside_m > half_m * kSide || behind_m < -failure.run_m * kSide) continue;
      const double plane_m = toe_m + failure.slip.HeightAt(failure.run_m + behind_m + half_m);
      if (plane_m >= failure.top_m || plane_m >= ground->TopAt(i, j)) continue;
      const ColumnId k = ground->Touch(i, j);
      const bool holds =
          failure.drop_m >= kLeastLoaded_m ? ground->IsPropped(k) : ground->IsBlocked(k);
      if (holds) continue;
      const double top_m = ground->skin(k).top_m;
      const double way_m = (failure.run_m + behind_m) / down_W.head<2>().norm();
      broken->push_back({{},
                         Vec3(at.x(), at.y(), plane_m),
                         Vec3(at.x(), at.y(), top_m),
                         slide_mps2 * down_W,
                         out.isZero() ? 0 : way_m});
      ground->Cut(k, plane_m, &broken->back().soil);
    }
  }
}

/// Mean pressure of running gear on the surface of a wedge. `length_m` is the distance from the
/// edge to the end of the slip surface.
double Surcharge_pa(ColumnId k, const Direction& out, double length_m, const Columns& ground) {
  const auto [i, j] = ground.PlaceOf(k);
  const double step_m = out.distance * ground.cell_m();
  const int count = std::max(1, static_cast<int>(std::lround(length_m / step_m)));
  double sum_pa = 0;
  for (int m = 0; m < count && ground.Contains(i - m * out.di, j - m * out.dj); ++m) {
    const ColumnId behind = ground.IdAt(i - m * out.di, j - m * out.dj);
    if (behind != Columns::kNone) sum_pa += static_cast<double>(ground.skin(behind).load_pa);
  }
  return sum_pa / count;
}

}  // namespace

double CulmannHeight_m(const SoilType& soil, double slope_rad) {
  if (slope_rad <= soil.friction_angle_rad) return std::numeric_limits<double>::infinity();
  if (soil.cohesion_pa == 0) return 0;
  return 4 * soil.cohesion_pa / (soil.bank_density_kgpm3 * kStandardGravity_mps2) *
         std::sin(slope_rad) * std::cos(soil.friction_angle_rad) /
         (1 - std::cos(slope_rad - soil.friction_angle_rad));
}

StandingWalls::StandingWalls(const std::vector<SoilType>& soils) : layered_(soils) {
  for (const SoilType& soil : soils) {
    limits_.push_back({std::tan(std::max(soil.friction_angle_rad, soil.repose_angle_rad)),
                       CulmannHeight_m(soil, kPi / 2)});
    least_tan_stand_ = std::min(least_tan_stand_, limits_.back().tan_stand);
  }
}

/// Quick test: true if a neighbour lies below the slope that stands at any height.
bool StandingWalls::IsEdge(ColumnId k, const Columns& ground) const {
  const Columns::Skin& c = ground.skin(k);
  const double straight_m = c.top_m - c.loose_m - least_tan_stand_ * ground.cell_m();
  const double diagonal_m =
      c.top_m - c.loose_m - std::sqrt(2.0) * least_tan_stand_ * ground.cell_m();
  if (ground.IsWithinTile(k)) {
    return std::any_of(kDirections.begin(), kDirections.end(), [&](const Direction& d) {
      return (&c + Columns::Step(d.di, d.dj))->top_m < (d.distance > 1 ? diagonal_m : straight_m);
    });
  }
  return std::any_of(kDirections.begin(), kDirections.end(), [&](const Direction& d) {
    const Columns::Skin* beside = ground.Beside(k, d.di, d.dj);
    return beside == nullptr || beside->top_m < (d.distance > 1 ? diagonal_m : straight_m);
  });
}

/// Calls `take(out, m, step_m, fall_m, edge_fall_m)` for the columns in front of a bank. m counts
/// columns of length step_m. Sides whose first slope is at most `tan_edge` are skipped.
template <typename Take>
void ForFalls(ColumnId k, double top_m, double tan_edge, const Columns& ground, Take take) {
  const auto [i, j] = ground.PlaceOf(k);
  for (const Direction& out : kDirections) {
    const auto& [di, dj, distance] = out;
    const double step_m = distance * ground.cell_m();
    double edge_fall_m = 0;  // fall to the first neighbour
    for (int m = 1; m <= kLookDown && ground.Contains(i + m * di, j + m * dj); ++m) {
      const ColumnId below = ground.IdAt(i + m * di, j + m * dj);
      if (below != Columns::kNone && ground.IsBlocked(below)) break;  // a tool holds the bank up
      const double fall_m = top_m - ground.TopAt(i + m * di, j + m * dj);
      if (m == 1) edge_fall_m = fall_m;
      if (edge_fall_m <= tan_edge * step_m) break;  // no edge on this side
      take(out, m, step_m, fall_m, edge_fall_m);
    }
  }
}

std::optional<StandingWalls::Failure> StandingWalls::FailureAt(ColumnId k,
                                                               const Columns& ground) const {
  if (!IsEdge(k, ground) || ground.IsPropped(k)) return std::nullopt;
  std::optional<Failure> failure = FailureOfTop(k, ground);
  if (!failure) failure = FailureOfLayers(k, ground);
  const bool is_low = failure && (failure->slip.count == 0 || failure->drop_m < kLeastLoaded_m);
  return is_low && ground.IsBlocked(k) ? std::nullopt : failure;
}

/// Stability of the uppermost soil alone.
std::optional<StandingWalls::Failure> StandingWalls::FailureOfTop(ColumnId k,
                                                                  const Columns& ground) const {
  const Bank bank = BankAt(k, ground);
  const SoilType& soil = ground.soils()[bank.soil];
  const Limit& limit = limits_[bank.soil];
  std::optional<Failure> worst;
  double worst_edge_m = 0;
  ForFalls(k, bank.top_m, limit.tan_stand, ground,
           [&](const Direction& out, int m, double step_m, double fall_m, double edge_fall_m) {
             const double drop_m = std::min(bank.thickness_m, fall_m);
             const double run_m = (m - 1) * step_m;
             const double face_rad = std::atan2(drop_m, run_m);
             const double plane_rad = 0.5 * (face_rad + soil.friction_angle_rad);
             if (drop_m <= limit.tan_stand * m * step_m) return;  // stable at any height and load
             const double load_pa =
                 limit.upright_m <= kLeastWedge_m || drop_m < kLeastLoaded_m
                     ? 0
                     : Surcharge_pa(k, out, drop_m / std::tan(plane_rad) - run_m, ground);
             const double loaded_m =
                 drop_m + 2 * load_pa / (soil.bank_density_kgpm3 * kStandardGravity_mps2);
             const double stands_m = std::max(limit.upright_m, limit.tan_stand * m * step_m);
             const double overhang_m = loaded_m - stands_m;
             if (overhang_m <= (worst ? worst->overhang_m : kLeastOverhang_m)) return;
             if (loaded_m <= CulmannHeight_m(soil, face_rad)) return;
             worst = {k, bank.soil, bank.top_m, drop_m, run_m, overhang_m, Vec2::Zero(), {}};
             worst_edge_m = edge_fall_m;
           });
  if (!worst) return worst;
  worst->out = Outward(ground.PlaceOf(k), bank.top_m - 0.5 * worst_edge_m, ground);
  if (limit.upright_m <= kLeastWedge_m) return worst;  // it crumbles
  const double face_rad = std::atan2(worst->drop_m, worst->run_m);
  worst->slip.part[0] = {worst->drop_m, std::tan(0.5 * (face_rad + soil.friction_angle_rad))};
  worst->slip.count = 1;
  worst->slip.tan_friction = std::tan(soil.friction_angle_rad);
  return worst;
}

bool StandingWalls::StandsAsSlope(const BankLayers& layers, double length_m) const {
  double slope_m = 0;
  for (const BankLayer& layer : layers.all()) {
    slope_m += layer.height_m / limits_[layer.soil].tan_stand;
  }
  return slope_m <= length_m;
}

/// Stability of a bank of several soils whose uppermost soil stands.
std::optional<StandingWalls::Failure> StandingWalls::FailureOfLayers(ColumnId k,
                                                                     const Columns& ground) const {
  const Bank bank = BankAt(k, ground);
  std::optional<Failure> worst;
  double worst_edge_m = 0, seen_m = 0;
  const auto look_at = [&](const BankLayers& layers, int m, double step_m, double drop_m,
                           double edge_fall_m) {
    if (StandsAsSlope(layers, m * step_m)) return;
    const double run_m = (m - 1) * step_m;
    const SlipSurface slip = layered_.LeastSafe(layers.all(), run_m, m * step_m);
    if (slip.drives_over_holds <= std::max(1.0, worst ? worst->slip.drives_over_holds : 0)) return;
    const double overhang_m = drop_m * (1 - 1 / slip.drives_over_holds);
    worst = {k, bank.soil, bank.top_m, drop_m, run_m, overhang_m, Vec2::Zero(), slip};
    worst_edge_m = edge_fall_m;
  };
  ForFalls(k, bank.top_m, least_tan_stand_, ground,
           [&](const Direction&, int m, double step_m, double fall_m, double edge_fall_m) {
             // A flatter bank of equal height is safer.
             if (m == 1) seen_m = 0;
             if (fall_m <= std::max(bank.thickness_m, seen_m + kDeeper_m)) return;
             seen_m = fall_m;
             BankLayers layers(k, fall_m, ground);
             double drop_m = fall_m;
             for (; layers.count > 1; drop_m -= layers.layer[--layers.count].height_m) {
               look_at(layers, m, step_m, drop_m, edge_fall_m);
             }
           });
  if (worst) worst->out = Outward(ground.PlaceOf(k), bank.top_m - 0.5 * worst_edge_m, ground);
  return worst;
}

void StandingWalls::Fail(const std::vector<Failure>& failures, double dt_s, Columns* ground,
                         Grains* grains) const {
  std::vector<Grains::Broken> broken;
  for (const Failure& failure : failures) {
    if (failure.slip.count > 0) {
      SlideOff(failure, ground, &broken);
      continue;
    }
    const double loose_m = ground->skin(failure.column).loose_m;
    if (loose_m > kVeneer_m) continue;  // checked again when the loose soil has slid off
    ground->Break(failure.column, loose_m + std::min(failure.overhang_m, kBreakSpeed_mps * dt_s));
  }
  double volume_m3 = 0;
  for (const Grains::Broken& piece : broken) volume_m3 += piece.soil.volume_m3();
  const double clod_m3 = grains->RoomyClod_m3(volume_m3);
  for (const Grains::Broken& piece : broken) {
    grains->Pour(piece, clod_m3, ground);
  }
}

}  // namespace tera
