#include "soil/avalanche.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/units.h"

namespace tera {
namespace {

constexpr double kHysteresis_rad = 0.5 * kDeg;  ///< start and stop lie this far from repose
constexpr double kFlowSpeed_mps = 1.5;      ///< at which an excess travels from column to column
constexpr double kLargestShare = 1.0 / 12;  ///< of an excess per step: no overshoot on 8 neighbours
constexpr double kLeastExcess_m = 2e-4;     ///< a smaller excess has come to rest
constexpr int kLookDown = 12;               ///< columns over which a bank's height is measured
constexpr double kBreakSpeed_mps = 1.0;     ///< at which a failing bank crumbles

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

}  // namespace

double CulmannHeight_m(const SoilType& soil, double slope_rad) {
  if (slope_rad <= soil.friction_angle_rad) return std::numeric_limits<double>::infinity();
  return 4 * soil.cohesion_pa / (soil.bank_density_kgpm3 * kStandardGravity_mps2) *
         std::sin(slope_rad) * std::cos(soil.friction_angle_rad) /
         (1 - std::cos(slope_rad - soil.friction_angle_rad));
}

Avalanche::Avalanche(const std::vector<SoilType>& soils) {
  for (const SoilType& soil : soils) {
    angles_.push_back({std::tan(soil.repose_angle_rad + kHysteresis_rad),
                       std::tan(soil.repose_angle_rad - kHysteresis_rad),
                       std::tan(std::max(soil.friction_angle_rad, soil.repose_angle_rad)),
                       CulmannHeight_m(soil, kPi / 2), soil.friction_angle_rad});
  }
}

void Avalanche::Wake(ColumnId k, Columns* ground) {
  const Columns::Place place = ground->PlaceOf(k);
  for (int j = std::max(0, place.j - 1); j <= std::min(ground->ny() - 1, place.j + 1); ++j) {
    for (int i = std::max(0, place.i - 1); i <= std::min(ground->nx() - 1, place.i + 1); ++i) {
      const ColumnId m = ground->Touch(i, j);
      if (m >= is_active_.size()) {
        is_active_.resize(ground->id_end());
        flowing_.resize(ground->id_end());
      }
      if (is_active_[m]) continue;
      is_active_[m] = 1;
      active_.push_back(m);
    }
  }
}

bool Avalanche::CollectOutflow(ColumnId k, double share, Columns* ground) {
  const Column& c = ground->at(k);
  const double loose_m = c.loose_m();
  if (loose_m <= 0) return false;
  const Angles& angle = angles_[c.top_layer()->soil];
  const auto [i, j] = ground->PlaceOf(k);
  const double tan_limit = flowing_[k] ? angle.tan_stop : angle.tan_start;
  std::array<double, 8> excess_m{};
  double total_m = 0;
  bool starts = false;
  for (std::size_t d = 0; d < kDirections.size(); ++d) {
    const auto& [di, dj, distance] = kDirections[d];
    if (!ground->Contains(i + di, j + dj)) continue;
    const Column* to = ground->Beside(k, di, dj);
    if (to != nullptr && c.top_m > to->blocked_m) continue;
    const double run_m = distance * ground->cell_m();
    const double drop_m = c.top_m - (to != nullptr ? to->top_m : ground->TopAt(i + di, j + dj));
    starts = starts || drop_m - tan_limit * run_m > kLeastExcess_m;
    excess_m[d] = std::max(0.0, drop_m - angle.tan_stop * run_m);
    total_m += excess_m[d];
  }
  if (!starts) return false;
  const double scale = std::min(share, loose_m / total_m);
  for (std::size_t d = 0; d < kDirections.size(); ++d) {
    if (excess_m[d] <= 0) continue;
    const ColumnId to = ground->Touch(i + kDirections[d].di, j + kDirections[d].dj);
    transfers_.push_back({k, to, scale * excess_m[d]});
  }
  return true;
}

double Avalanche::Overhang_m(ColumnId k, const Columns& ground) const {
  const Column& c = ground.at(k);
  if (c.loose_m() > 0) return 0;
  const std::uint8_t material = ground.soil_at(k);
  const Angles& angle = angles_[material];
  const SoilType& soil = ground.soils()[material];
  const auto [i, j] = ground.PlaceOf(k);
  double overhang_m = 0;
  for (const auto& [di, dj, distance] : kDirections) {
    if (!ground.Contains(i + di, j + dj)) continue;
    const Column* beside = ground.Beside(k, di, dj);
    const double run_m = distance * ground.cell_m();
    if (beside != nullptr && c.top_m - beside->top_m <= angle.tan_stand * run_m)
      continue;  // no edge
    for (int m = 1; m <= kLookDown && ground.Contains(i + m * di, j + m * dj); ++m) {
      const double drop_m = c.top_m - ground.TopAt(i + m * di, j + m * dj);
      const double stands_m = std::max(angle.culmann_m, angle.tan_stand * m * run_m);
      if (m == 1 && drop_m <= angle.tan_stand * run_m) break;  // no edge on this side
      if (drop_m <= stands_m) continue;
      if (drop_m <= CulmannHeight_m(soil, std::atan2(drop_m, m * run_m))) continue;
      overhang_m = std::max(overhang_m, drop_m - stands_m);
    }
  }
  return overhang_m;
}

void Avalanche::Flow(double dt_s, Columns* ground) {
  for (const ColumnId k : ground->TakeChanged()) Wake(k, ground);
  const double share = std::min(kLargestShare, kFlowSpeed_mps * dt_s / ground->cell_m());
  const std::vector<ColumnId> visited = std::exchange(active_, {});
  for (const ColumnId k : visited) is_active_[k] = 0;
  transfers_.clear();
  for (const ColumnId k : visited) {
    const double overhang_m = Overhang_m(k, *ground);
    if (overhang_m > kLeastExcess_m) ground->Break(k, std::min(overhang_m, kBreakSpeed_mps * dt_s));
  }
  for (const ColumnId k : visited) flowing_[k] = CollectOutflow(k, share, ground) ? 1 : 0;
  SpoilMix moved;
  for (const Transfer& t : transfers_) {
    moved.clear();
    ground->TakeLoose(t.from, t.thickness_m, &moved);
    ground->Deposit(t.to, moved);
  }
}

}  // namespace tera
