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

Avalanche::Avalanche(const Columns& ground) {
  const std::size_t n = static_cast<std::size_t>(ground.nx()) * ground.ny();
  is_active_.assign(n, 0);
  flowing_.assign(n, 0);
  for (const SoilType& soil : ground.soils()) {
    angles_.push_back({std::tan(soil.repose_angle_rad + kHysteresis_rad),
                       std::tan(soil.repose_angle_rad - kHysteresis_rad),
                       std::tan(std::max(soil.friction_angle_rad, soil.repose_angle_rad)),
                       CulmannHeight_m(soil, kPi / 2), soil.friction_angle_rad});
  }
}

void Avalanche::Wake(std::uint32_t k, const Columns& ground) {
  const int i = static_cast<int>(k % ground.nx()), j = static_cast<int>(k / ground.nx());
  for (int b = std::max(0, j - 1); b <= std::min(ground.ny() - 1, j + 1); ++b) {
    for (int a = std::max(0, i - 1); a <= std::min(ground.nx() - 1, i + 1); ++a) {
      const auto m = static_cast<std::uint32_t>(ground.index(a, b));
      if (is_active_[m]) continue;
      is_active_[m] = 1;
      active_.push_back(m);
    }
  }
}

bool Avalanche::CollectOutflow(std::uint32_t k, double share, const Columns& ground) {
  const Column& c = ground.at(k);
  if (c.loose_m <= 0) return false;
  const Angles& angle = angles_[c.loose_soil];
  const int i = static_cast<int>(k % ground.nx()), j = static_cast<int>(k / ground.nx());
  const double tan_limit = flowing_[k] ? angle.tan_stop : angle.tan_start;
  std::array<double, 8> excess_m{};
  double total_m = 0;
  bool starts = false;
  for (std::size_t d = 0; d < kDirections.size(); ++d) {
    const auto& [di, dj, distance] = kDirections[d];
    if (!ground.Contains(i + di, j + dj)) continue;
    const std::size_t to = ground.index(i + di, j + dj);
    if (c.top_m() > ground.blocked_m(to)) continue;
    const double run_m = distance * ground.cell_m();
    const double drop_m = c.top_m() - ground.at(to).top_m();
    starts = starts || drop_m - tan_limit * run_m > kLeastExcess_m;
    excess_m[d] = std::max(0.0, drop_m - angle.tan_stop * run_m);
    total_m += excess_m[d];
  }
  if (!starts) return false;
  const double scale = std::min(share, c.loose_m / total_m);
  for (std::size_t d = 0; d < kDirections.size(); ++d) {
    if (excess_m[d] <= 0) continue;
    const auto to =
        static_cast<std::uint32_t>(ground.index(i + kDirections[d].di, j + kDirections[d].dj));
    transfers_.push_back({k, to, scale * excess_m[d]});
  }
  return true;
}

double Avalanche::Overhang_m(std::uint32_t k, const Columns& ground) const {
  const Column& c = ground.at(k);
  if (c.loose_m > 0) return 0;
  const Angles& angle = angles_[c.bank_soil];
  const SoilType& soil = ground.soils()[c.bank_soil];
  const int i = static_cast<int>(k % ground.nx()), j = static_cast<int>(k / ground.nx());
  double overhang_m = 0;
  for (const auto& [di, dj, distance] : kDirections) {
    for (int m = 1; m <= kLookDown; ++m) {
      if (!ground.Contains(i + m * di, j + m * dj)) break;
      const double drop_m = c.bank_m - ground.at(ground.index(i + m * di, j + m * dj)).top_m();
      const double run_m = m * distance * ground.cell_m();
      if (m == 1 && drop_m <= angle.tan_stand * run_m) break;  // no edge on this side
      if (drop_m <= angle.culmann_m || drop_m <= angle.tan_stand * run_m) continue;
      if (drop_m <= CulmannHeight_m(soil, std::atan2(drop_m, run_m))) continue;
      overhang_m =
          std::max(overhang_m, drop_m - std::max(angle.culmann_m, angle.tan_stand * run_m));
    }
  }
  return overhang_m;
}

void Avalanche::Flow(double dt_s, Columns* ground) {
  for (const std::uint32_t k : ground->TakeChanged()) Wake(k, *ground);
  const double share = std::min(kLargestShare, kFlowSpeed_mps * dt_s / ground->cell_m());
  const std::vector<std::uint32_t> visited = std::exchange(active_, {});
  for (const std::uint32_t k : visited) is_active_[k] = 0;
  transfers_.clear();
  for (const std::uint32_t k : visited) {
    const double overhang_m = Overhang_m(k, *ground);
    if (overhang_m > kLeastExcess_m) ground->Break(k, std::min(overhang_m, kBreakSpeed_mps * dt_s));
  }
  for (const std::uint32_t k : visited) flowing_[k] = CollectOutflow(k, share, *ground) ? 1 : 0;
  for (const Transfer& t : transfers_)
    ground->Deposit(t.to, ground->TakeLoose(t.from, t.thickness_m));
}

}  // namespace tera
