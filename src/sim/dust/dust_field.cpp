#include "sim/dust/dust_field.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/check.h"

namespace tera {
namespace {

constexpr double kVonKarman = 0.4;
constexpr double kRoughness_m = 0.005;
/// A layer with less in every cell does not spread to the next layer.
constexpr double kTrace_kg = 1e-12;
constexpr double kMostMoved = 0.8;  ///< largest share of a cell's content that a step may move
constexpr std::array<double, kDustSizes> kAerodynamic_m = {1e-6, 5e-6, 17.3e-6};

/// Slope at a face, limited: the mean of the upwind slope and the face's own slope, but at most
/// twice either; 0 if their signs differ.
double LimitedSlope(double upwind, double here) {
  if (upwind * here <= 0) return 0;
  const double mean = 0.5 * (upwind + here);
  return std::copysign(std::min({std::abs(mean), 2 * std::abs(upwind), 2 * std::abs(here)}), mean);
}

}  // namespace

double SettlingSpeed_mps(int size) {
  constexpr double kUnitDensity_kgpm3 = 1000;
  return StokesSpeed_mps(kAerodynamic_m[size], kUnitDensity_kgpm3);
}

double Extinction_m2pkg(int size) {
  constexpr double kFine_m2pkg = 1000, kCoarse_m2pkg = 600;
  if (size == 0) return kFine_m2pkg;
  if (size == 1) return kCoarse_m2pkg;
  constexpr double kGrain_kgpm3 = 2650, kUnit_kgpm3 = 1000, kQ = 2;
  const double diameter_m = kAerodynamic_m[size] * std::sqrt(kUnit_kgpm3 / kGrain_kgpm3);
  return 3 * kQ / (2 * kGrain_kgpm3 * diameter_m);
}

DustAir NeutralAir(const Wind& wind, int layers, double layer_m) {
  const double friction_mps = FrictionVelocity_mps(wind.speed_mps);
  DustAir air;
  for (int k = 0; k < layers; ++k) {
    const double z_m = (k + 0.5) * layer_m;
    const double speed_mps = friction_mps / kVonKarman * std::log(z_m / kRoughness_m);
    air.wind_W_mps.emplace_back(std::max(speed_mps, 0.0) * wind.towards_W());
    air.diffusivity_m2ps.push_back(std::max(kVonKarman * friction_mps * z_m, kStirred_m2ps));
  }
  return air;
}

double DustGrid::HeightAbove(const Vec3& p_W_m) const {
  const Vec2 place = (p_W_m.head<2>() - origin_W_m) / cell_m;
  const int i = std::clamp(static_cast<int>(std::floor(place.x())), 0, nx - 1);
  const int j = std::clamp(static_cast<int>(std::floor(place.y())), 0, ny - 1);
  return p_W_m.z() - base_m[static_cast<std::size_t>(j) * nx + i];
}

DustField::DustField(DustGrid grid, DustAir air) : grid_(std::move(grid)), air_(std::move(air)) {
  const auto layers = static_cast<std::size_t>(grid_.nz);
  TERA_CHECK(air_.wind_W_mps.size() == layers && air_.diffusivity_m2ps.size() == layers, layers);
  TERA_CHECK(grid_.base_m.size() == static_cast<std::size_t>(grid_.nx) * grid_.ny);
  face_m2ps_.assign(layers, 0.0);
  for (std::size_t k = 1; k < layers; ++k) {
    face_m2ps_[k] = 0.5 * (air_.diffusivity_m2ps[k - 1] + air_.diffusivity_m2ps[k]);
  }
  for (std::vector<double>& cells : cells_kg_) cells.assign(grid_.index(0, 0, grid_.nz), 0.0);
}

void DustField::Emit(const Vec3& centre_W_m, double radius_m, const DustMass& mass_kg) {
  const double cell_m = grid_.cell_m;
  const Vec3 at((centre_W_m.x() - grid_.origin_W_m.x()) / cell_m - 0.5,
                (centre_W_m.y() - grid_.origin_W_m.y()) / cell_m - 0.5,
                grid_.HeightAbove(centre_W_m) / cell_m - 0.5);
  // At least one cell centre lies within the ball.
  const double radius = std::max(radius_m / cell_m, 1.0);
  const Eigen::Vector3i low = (at.array() - radius).ceil().cast<int>();
  const Eigen::Vector3i high = (at.array() + radius).floor().cast<int>();
  struct Share {
    Eigen::Vector3i cell;
    double weight;
  };
  std::vector<Share> shares;
  double sum = 0;
  for (int k = low.z(); k <= high.z(); ++k) {
    for (int j = low.y(); j <= high.y(); ++j) {
      for (int i = low.x(); i <= high.x(); ++i) {
        const double weight = 1 - (Vec3(i, j, k) - at).squaredNorm() / (radius * radius);
        if (weight <= 0) continue;
        shares.push_back({{i, j, std::max(k, 0)}, weight});
        sum += weight;
      }
    }
  }
  for (int size = 0; size < kDustSizes; ++size) emitted_kg_[size] += mass_kg[size];
  const Eigen::Array3i end(grid_.nx, grid_.ny, grid_.nz);
  for (const auto& [cell, weight] : shares) {
    const bool is_inside = (cell.array() >= 0).all() && (cell.array() < end).all();
    for (int size = 0; size < kDustSizes; ++size) {
      double& to =
          is_inside ? cells_kg_[size][grid_.index(cell.x(), cell.y(), cell.z())] : left_kg_[size];
      to += mass_kg[size] * weight / sum;
    }
    if (!is_inside) continue;
    for (int axis = 0; axis < 3; ++axis) {
      const bool is_first = reach_.is_empty() && axis == 0;
      if (is_first) {
        for (int a = 0; a < 3; ++a) reach_.low[a] = cell[a], reach_.high[a] = cell[a] + 1;
      }
      reach_.low[axis] = std::min(reach_.low[axis], cell[axis]);
      reach_.high[axis] = std::max(reach_.high[axis], cell[axis] + 1);
    }
  }
}

/// Transports mass along a row. Cells outside [from, to) contain no dust.
void DustField::Carry(double dt_s, const Row& row, std::vector<double>* cells_kg) {
  double* c = cells_kg->data() + row.first;
  const auto at = [&](int i) { return c[static_cast<std::size_t>(i) * row.stride]; };
  const double nu = row.speed_mps * dt_s / grid_.cell_m;
  const double per_m2ps = dt_s / (grid_.cell_m * grid_.cell_m);
  const int n = row.to - row.from;
  flux_.assign(static_cast<std::size_t>(n) + 1, 0.0);
  const auto within = [&](int i) { return i >= row.from && i < row.to ? at(i) : 0.0; };
  for (int f = 0; f <= n; ++f) {  // face between cells i - 1 and i
    const int i = row.from + f;
    const double below = within(i - 1), above = within(i);
    const bool is_inner = f > 0 && f < n;
    if (!is_inner && !(f == 0 ? row.is_open_below : row.is_open_beyond)) continue;
    double flux = nu > 0 ? nu * below : nu * above;
    if (is_inner && !row.is_upwind) {
      const double here = above - below;
      const double upwind = nu > 0 ? below - within(i - 2) : within(i + 1) - above;
      flux += 0.5 * std::abs(nu) * (1 - std::abs(nu)) * LimitedSlope(upwind, here);
    }
    if (is_inner) {
      const double diffusivity = row.face_m2ps != nullptr ? row.face_m2ps[i] : row.uniform_m2ps;
      flux -= diffusivity * per_m2ps * (above - below);
    }
    flux_[f] = flux;
  }
  *row.below_kg -= flux_[0];
  *row.beyond_kg += flux_[n];
  for (int f = 0; f < n; ++f) {
    c[static_cast<std::size_t>(row.from + f) * row.stride] += flux_[f] - flux_[f + 1];
  }
}

/// Whether a layer of the reach, perpendicular to the axis, contains more than traces of dust.
bool DustField::HasDust(int axis, int layer) const {
  std::array<int, 3> low = reach_.low, high = reach_.high;
  low[axis] = layer;
  high[axis] = layer + 1;
  for (const std::vector<double>& cells : cells_kg_) {
    for (int k = low[2]; k < high[2]; ++k) {
      for (int j = low[1]; j < high[1]; ++j) {
        const double* row = &cells[grid_.index(0, j, k)];
        if (std::any_of(row + low[0], row + high[0], [](double kg) { return kg > kTrace_kg; })) {
          return true;
        }
      }
    }
  }
  return false;
}

/// Extends the reach by one cell at both ends if the outer layers contain dust. Dust moves at most
/// one cell per step.
void DustField::Grow(int axis) {
  const std::array<int, 3> end = {grid_.nx, grid_.ny, grid_.nz};
  int &low = reach_.low[axis], &high = reach_.high[axis];
  const bool grows_down = low > 0 && HasDust(axis, low);
  const bool grows_up = high < end[axis] && HasDust(axis, high - 1);
  low -= grows_down ? 1 : 0;
  high += grows_up ? 1 : 0;
}

void DustField::CarryAll(int axis, int size, double dt_s, const Vec2& gust_W_mps) {
  const int across = axis == 0 ? 1 : 0, last = axis == 2 ? 1 : 2;
  for (int b = reach_.low[last]; b < reach_.high[last]; ++b) {
    for (int a = reach_.low[across]; a < reach_.high[across]; ++a) {
      Row row{};
      row.from = reach_.low[axis];
      row.to = reach_.high[axis];
      row.is_open_below = row.from == 0;
      row.is_open_beyond = row.to == std::array{grid_.nx, grid_.ny, grid_.nz}[axis];
      row.below_kg = axis == 2 ? &settled_kg_[size] : &left_kg_[size];
      row.beyond_kg = &left_kg_[size];
      if (axis == 2) {
        row.first = grid_.index(a, b, 0);
        row.stride = grid_.index(0, 0, 1);
        row.speed_mps = -SettlingSpeed_mps(size);
        row.face_m2ps = face_m2ps_.data();
        row.is_upwind = true;
      } else {
        row.first = axis == 0 ? grid_.index(0, a, b) : grid_.index(a, 0, b);
        row.stride = axis == 0 ? 1 : static_cast<std::size_t>(grid_.nx);
        row.speed_mps = (air_.wind_W_mps[b] + gust_W_mps)[axis];
        row.uniform_m2ps = air_.diffusivity_m2ps[b];
      }
      Carry(dt_s, row, &cells_kg_[size]);
    }
  }
}

double DustField::LongestStep_s(const Vec2& gust_W_mps) const {
  double rate_hz = 1e-9;
  for (std::size_t k = 0; k < air_.wind_W_mps.size(); ++k) {
    const double speed_mps = (air_.wind_W_mps[k] + gust_W_mps).cwiseAbs().maxCoeff();
    rate_hz = std::max(rate_hz, speed_mps / grid_.cell_m +
                                    2 * air_.diffusivity_m2ps[k] / (grid_.cell_m * grid_.cell_m));
  }
  return kMostMoved / rate_hz;
}

void DustField::Advance(double dt_s, const Vec2& gust_W_mps) {
  if (reach_.is_empty()) return;
  const int steps = static_cast<int>(std::ceil(dt_s / LongestStep_s(gust_W_mps)));
  for (int s = 0; s < steps; ++s) {
    for (const int axis : {0, 1, 2}) {
      Grow(axis);
      for (int size = 0; size < kDustSizes; ++size) CarryAll(axis, size, dt_s / steps, gust_W_mps);
    }
  }
}

DustField::Budget DustField::budget() const {
  Budget budget{emitted_kg_, {}, settled_kg_, left_kg_};
  for (int size = 0; size < kDustSizes; ++size) {
    for (const double kg : cells_kg_[size]) budget.airborne_kg[size] += kg;
  }
  return budget;
}

}  // namespace tera
