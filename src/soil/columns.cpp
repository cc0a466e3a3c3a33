#include "soil/columns.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/check.h"
#include "soil/soil_type.h"

namespace tera {
namespace {

constexpr double kFloorDepth_m = 10.0;  ///< the ledger's floor below the lowest point
constexpr double kLooseShown_m = 0.03;  ///< loose soil this thick looks fully loose
constexpr double kRutShown_m = 0.02;    ///< a rut this deep looks freshly pressed
constexpr double kRutOfContact = 0.35;  ///< share of the rut's look that a mere contact leaves
constexpr double kThinnest_m = 1e-9;    ///< thinner layers of loose soil join their neighbour

std::uint8_t Byte(double share) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0, 1.0)));
}

}  // namespace

Spoil Spoil::Take(double f) {
  const Spoil part{mass_kg * f, volume_m3 * f, soil};
  mass_kg -= part.mass_kg;
  volume_m3 -= part.volume_m3;
  return part;
}

Columns::Columns(Vec2 origin_W_m, double cell_m, int nx, int ny,
                 const std::vector<double>& height_m, const std::vector<std::uint8_t>& bank_soil,
                 std::vector<SoilType> soils)
    : soils_(std::move(soils)), area_m2_(cell_m * cell_m) {
  const std::size_t n = static_cast<std::size_t>(nx) * ny;
  TERA_CHECK(height_m.size() == n && bank_soil.size() == n, height_m.size(), n);
  surface_.origin_W_m = origin_W_m;
  surface_.cell_m = cell_m;
  surface_.nx = nx;
  surface_.ny = ny;
  surface_.height_m.resize(n);
  surface_.soil = bank_soil;
  surface_.moisture.resize(n);
  surface_.looseness.assign(n, 0);
  surface_.rut.assign(n, 0);
  surface_.tile_version.assign(static_cast<std::size_t>(surface_.tiles_x()) * surface_.tiles_y(),
                               1);
  columns_.resize(n);
  is_changed_.assign(n, 0);
  blocked_m_.assign(n, std::numeric_limits<float>::infinity());
  for (std::size_t k = 0; k < n; ++k) {
    columns_[k].bank_m = height_m[k];
    columns_[k].bank_soil = columns_[k].loose_soil = bank_soil[k];
    surface_.height_m[k] = static_cast<float>(height_m[k]);
    surface_.moisture[k] = Byte(soils_[bank_soil[k]].moisture);
  }
  floor_m_ = *std::min_element(height_m.begin(), height_m.end()) - kFloorDepth_m;
}

int Columns::NearestI(double x_m) const {
  return static_cast<int>(std::lround((x_m - surface_.origin_W_m.x()) / surface_.cell_m));
}

int Columns::NearestJ(double y_m) const {
  return static_cast<int>(std::lround((y_m - surface_.origin_W_m.y()) / surface_.cell_m));
}

double Columns::HeightAt(double x, double y) const { return SampleAt(x, y).top_m; }

Columns::Sample Columns::SampleAt(double x, double y) const {
  const double gx = std::clamp((x - surface_.origin_W_m.x()) / cell_m(), 0.0, nx() - 1.0);
  const double gy = std::clamp((y - surface_.origin_W_m.y()) / cell_m(), 0.0, ny() - 1.0);
  const int i = std::min(static_cast<int>(gx), nx() - 2);
  const int j = std::min(static_cast<int>(gy), ny() - 2);
  const double u = gx - i, v = gy - j;
  const std::size_t k = index(i, j);
  const Column &a = columns_[k], &b = columns_[k + 1];
  const Column &c = columns_[k + nx()], &d = columns_[k + nx() + 1];
  const auto blend = [&](double za, double zb, double zc, double zd) {
    return (1 - v) * ((1 - u) * za + u * zb) + v * ((1 - u) * zc + u * zd);
  };
  return {blend(a.top_m(), b.top_m(), c.top_m(), d.top_m()),
          blend(a.pressed_m, b.pressed_m, c.pressed_m, d.pressed_m),
          index(u < 0.5 ? i : i + 1, v < 0.5 ? j : j + 1)};
}

std::uint8_t Columns::soil_at(std::size_t k) const {
  const Column& c = columns_[k];
  return c.loose_m > 0 ? c.loose_soil : c.bank_soil;
}

void Columns::Raise(std::size_t k, double dz_m) {
  columns_[k].bank_m += dz_m;
  Changed(k);
}

Spoil Columns::Cut(std::size_t k, double z_m) {
  Column& c = columns_[k];
  if (c.top_m() <= z_m) return {};
  Spoil cut = TakeLoose(k, c.top_m() - z_m);
  const double depth = c.bank_m - z_m;
  if (depth <= 0 || c.loose_m > 0) return cut;
  const SoilType& soil = soils_[c.bank_soil];
  double kgpm2 = 0;
  if (depth >= c.crust_m) {
    kgpm2 = c.crust_kgpm2 + (depth - c.crust_m) * soil.bank_density_kgpm3;
    c.crust_m = c.crust_kgpm2 = 0;
  } else {
    kgpm2 = c.crust_kgpm2 * depth / c.crust_m;
    c.crust_m -= depth;
    c.crust_kgpm2 -= kgpm2;
  }
  c.bank_m -= depth;
  c.pressed_m = 0;
  const double mass_kg = kgpm2 * area_m2_;
  cut.Add({mass_kg, mass_kg / LooseDensity_kgpm3(soil), c.bank_soil});
  Changed(k);
  return cut;
}

Spoil Columns::TakeLoose(std::size_t k, double thickness_m) {
  Column& c = columns_[k];
  if (c.loose_m <= 0 || thickness_m <= 0) return {};
  Spoil all{c.loose_kgpm2 * area_m2_, c.loose_m * area_m2_, c.loose_soil};
  if (thickness_m >= c.loose_m - kThinnest_m) {
    c.loose_m = c.loose_kgpm2 = 0;
    Changed(k);
    return all;
  }
  const double share = thickness_m / c.loose_m;
  const double kgpm2 = c.loose_kgpm2 * share;
  c.loose_m -= thickness_m;
  c.loose_kgpm2 -= kgpm2;
  Changed(k);
  return {kgpm2 * area_m2_, thickness_m * area_m2_, c.loose_soil};
}

void Columns::Deposit(std::size_t k, const Spoil& spoil) {
  if (spoil.mass_kg <= 0) return;
  Column& c = columns_[k];
  const double kgpm2 = spoil.mass_kg / area_m2_;
  if (kgpm2 > c.loose_kgpm2) c.loose_soil = spoil.soil;
  c.loose_m += spoil.volume_m3 / area_m2_;
  c.loose_kgpm2 += kgpm2;
  c.pressed_m = std::max(0.0, c.pressed_m - spoil.volume_m3 / area_m2_);
  Changed(k);
}

void Columns::DepositAt(int i, int j, const Spoil& spoil) {
  if (Contains(i, j)) {
    Deposit(index(i, j), spoil);
  } else {
    outside_kg_ += spoil.mass_kg;
  }
}

Spoil Columns::Press(std::size_t k, double ds_m, double influence_m) {
  Column& c = columns_[k];
  const SoilType& soil = soils_[c.bank_soil];
  c.pressed_m += ds_m;
  Spoil beside;
  if (c.loose_m > 0) {
    const SoilType& loose = soils_[c.loose_soil];
    const double least_m = c.loose_kgpm2 / loose.bank_density_kgpm3;
    const double take_m = std::min(ds_m, std::max(0.0, c.loose_m - least_m));
    c.loose_m -= take_m;
    ds_m -= take_m;
    if (c.loose_m - least_m < kThinnest_m) {  // as dense as bank soil: part of the crust
      c.bank_m += c.loose_m;
      c.crust_m += c.loose_m;
      c.crust_kgpm2 += c.loose_kgpm2;
      c.loose_m = c.loose_kgpm2 = 0;
    }
  }
  if (ds_m > 0) {
    if (c.crust_m < influence_m) {
      c.crust_kgpm2 += (influence_m - c.crust_m) * soil.bank_density_kgpm3;
      c.crust_m = influence_m;
    }
    c.crust_m -= ds_m;
    c.bank_m -= ds_m;
    const double excess_kgpm2 = c.crust_kgpm2 - c.crust_m * soil.max_density_kgpm3;
    if (excess_kgpm2 > 0) {
      c.crust_kgpm2 -= excess_kgpm2;
      const double mass_kg = excess_kgpm2 * area_m2_;
      beside = {mass_kg, mass_kg / LooseDensity_kgpm3(soil), c.bank_soil};
    }
  }
  Changed(k);
  ShowRut(k, kRutOfContact + (1 - kRutOfContact) * c.pressed_m / kRutShown_m);
  return beside;
}

void Columns::Break(std::size_t k, double thickness_m) {
  const double z_m = columns_[k].bank_m - thickness_m;
  Deposit(k, Cut(k, z_m));
}

void Columns::MarkRut(std::size_t k) { ShowRut(k, kRutOfContact); }

void Columns::Unblock(std::size_t k) {
  blocked_m_[k] = std::numeric_limits<float>::infinity();
  Changed(k);  // what was held back may now slide
}

double Columns::GroundMass_kg() const {
  double total_kg = 0;
  for (int j = 0; j < ny(); ++j) {  // by rows, to keep the sums small
    double row_kgpm2 = 0;
    for (int i = 0; i < nx(); ++i) {
      const Column& c = columns_[index(i, j)];
      row_kgpm2 += (c.bank_m - c.crust_m - floor_m_) * soils_[c.bank_soil].bank_density_kgpm3 +
                   c.crust_kgpm2 + c.loose_kgpm2;
    }
    total_kg += row_kgpm2 * area_m2_;
  }
  return total_kg;
}

std::vector<std::uint32_t> Columns::TakeChanged() {
  for (const std::uint32_t k : changed_) is_changed_[k] = 0;
  return std::exchange(changed_, {});
}

void Columns::Changed(std::size_t k) {
  if (!is_changed_[k]) {
    is_changed_[k] = 1;
    changed_.push_back(static_cast<std::uint32_t>(k));
  }
  const Column& c = columns_[k];
  const float height = static_cast<float>(c.top_m());
  const std::uint8_t soil = c.loose_m > 0 ? c.loose_soil : c.bank_soil;
  const std::uint8_t looseness = Byte(c.loose_m / kLooseShown_m);
  std::uint8_t rut = surface_.rut[k];
  if (c.loose_m > kLooseShown_m || (c.pressed_m <= 0 && c.crust_m <= 0)) rut = 0;
  if (height == surface_.height_m[k] && soil == surface_.soil[k] &&
      looseness == surface_.looseness[k] && rut == surface_.rut[k]) {
    return;
  }
  surface_.height_m[k] = height;
  surface_.soil[k] = soil;
  surface_.moisture[k] = Byte(soils_[soil].moisture);
  surface_.looseness[k] = looseness;
  surface_.rut[k] = rut;
  BumpTiles(k);
}

void Columns::ShowRut(std::size_t k, double rut) {
  const std::uint8_t shown = Byte(rut);
  if (shown <= surface_.rut[k]) return;
  surface_.rut[k] = shown;
  BumpTiles(k);
}

void Columns::BumpTiles(std::size_t k) {
  const int i = static_cast<int>(k % nx()), j = static_cast<int>(k / nx());
  constexpr int kCells = TerrainSurface::kTileCells;
  // A vertex on the border belongs to the tiles on both sides.
  const int a0 = std::max(0, (i - 1) / kCells), a1 = std::min(i / kCells, surface_.tiles_x() - 1);
  const int b0 = std::max(0, (j - 1) / kCells), b1 = std::min(j / kCells, surface_.tiles_y() - 1);
  for (int b = b0; b <= b1; ++b) {
    for (int a = a0; a <= a1; ++a) {
      ++surface_.tile_version[static_cast<std::size_t>(b) * surface_.tiles_x() + a];
    }
  }
}

}  // namespace tera
