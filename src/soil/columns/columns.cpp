#include "soil/columns/columns.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/check.h"
#include "core/units.h"
#include "soil/columns/soil_type.h"
#include "soil/columns/soil_water.h"

namespace tera {
namespace {

constexpr double kLooseShown_m = 0.03;  ///< loose soil this thick is drawn as fully loose
constexpr double kRutShown_m = 0.02;    ///< a rut this deep is drawn at full strength
/// share of that strength that a contact without sinkage leaves
constexpr double kRutOfContact = 0.35;
constexpr int kCells = TerrainGrid::kTileCells;
constexpr std::size_t kAhead = 6;  ///< Transport prefetches this many columns ahead.

/// Gain of water between two depths, as a height of water.
double GainedBetween_m(const std::vector<Columns::Gained>& gained, double top_m, double bottom_m) {
  double sum_m = 0, above_m = 0;
  for (const Columns::Gained& slice : gained) {
    const double shared_m = std::min(bottom_m, slice.bottom_m) - std::max(top_m, above_m);
    if (shared_m > 0) sum_m += slice.water_m * shared_m / (slice.bottom_m - above_m);
    above_m = slice.bottom_m;
  }
  return sum_m;
}

/// Adds to each layer the water that ground at the same depth has gained, within the limits of its
/// pores.
void WetLayers(const SoilKinds& kinds, const std::vector<Columns::Gained>& gained, Column* c) {
  double top_m = 0;
  for (int n = c->layer_count - 1; n >= 0; --n) {
    SoilLayer& layer = c->layers[n];
    const double bottom_m = top_m + layer.thickness_m;
    const SoilWater& water = kinds.soils()[layer.soil].water;
    const double moisture = layer.moisture;
    const double pores_m =
        layer.thickness_m > 0 ? layer.thickness_m * Porosity(layer.density_kgpm3(), moisture) : 0;
    if (water.holds() && pores_m > 0) {
      const double was_m = moisture * pores_m;
      const double least_m = std::min(was_m, water.residual * pores_m);
      const double is_m = std::clamp(was_m + GainedBetween_m(gained, top_m, bottom_m), least_m,
                                     std::max(was_m, pores_m));
      layer.kgpm2 += kWater_kgpm3 * (is_m - was_m);
      layer.moisture = static_cast<float>(is_m / pores_m);
      layer.soil = kinds.At(layer.soil, is_m / pores_m);
    }
    top_m = bottom_m;
  }
}

std::uint8_t Byte(double share) {
  return static_cast<std::uint8_t>(255 * std::clamp(share, 0.0, 1.0) + 0.5);
}

}  // namespace

Columns::Columns(UndisturbedGround ground, SoilKinds kinds)
    : ground_(std::make_shared<const UndisturbedGround>(std::move(ground))),
      profiles_(ground_->profiles),
      surface_(SurfaceOf(*ground_)),
      kinds_(std::move(kinds)),
      chunk_of_tile_(surface_.tile_count(), -1),
      cells_per_m_(1 / surface_.cell_m),
      area_m2_(surface_.cell_m * surface_.cell_m) {}

int Columns::NearestI(double x_m) const {
  return static_cast<int>(std::lround((x_m - surface_.origin_W_m.x()) / surface_.cell_m));
}

int Columns::NearestJ(double y_m) const {
  return static_cast<int>(std::lround((y_m - surface_.origin_W_m.y()) / surface_.cell_m));
}

Column Columns::ColumnAt(int i, int j) const {
  const ColumnId k = IdAt(i, j);
  if (k != kNone) return at(k);
  Column quiet;
  quiet.ground_m = quiet.bank_m = quiet.top_m = ground_->HeightAt(i, j);
  quiet.profile = ground_->ProfileAt(Vec2(x_m(i), y_m(j)));
  return quiet;
}

void Columns::MarkStart() {
  start_.clear();
  for (const Chunk& chunk : chunks_) {
    start_.emplace_back();
    for (const Column& c : chunk.columns) {
      start_.back().push_back({c.top_m - c.ground_m, c.Gain_kgpm2(profiles_[c.profile])});
    }
  }
}

Columns::Change Columns::ChangeAt(int i, int j) const {
  const ColumnId k = IdAt(i, j);
  if (k == kNone) return {};
  const Column& c = at(k);
  Change change{c.top_m - c.ground_m, c.Gain_kgpm2(profiles_[c.profile])};
  const std::size_t chunk = k >> kTileBits;
  if (chunk < start_.size()) {
    const Change& before = start_[chunk][k & kLocalMask];
    change.height_m -= before.height_m;
    change.kgpm2 -= before.kgpm2;
  }
  return change;
}

bool Columns::IsAllBelow(const Box& box, double z_m) const {
  for (int b = box.j0 / kCells; b <= std::min(box.j1 / kCells, surface_.tiles_y() - 1); ++b) {
    for (int a = box.i0 / kCells; a <= std::min(box.i1 / kCells, surface_.tiles_x() - 1); ++a) {
      const std::int32_t n = chunk_of_tile_[surface_.tile_index(a, b)];
      if (n < 0 || chunks_[n].ceiling_m >= z_m) return false;
    }
  }
  return true;
}

ColumnId Columns::Touch(int i, int j) {
  TERA_CHECK(Contains(i, j), i, j);
  const ColumnId k = IdAt(i, j);
  if (k != kNone) return k;
  Unfold(std::min(i / kCells, surface_.tiles_x() - 1),
         std::min(j / kCells, surface_.tiles_y() - 1));
  return IdAt(i, j);
}

void Columns::Unfold(int a, int b) {
  const auto n = static_cast<ColumnId>(chunks_.size());
  const int nx_here = a == surface_.tiles_x() - 1 ? nx() - a * kCells : kCells;
  const int ny_here = b == surface_.tiles_y() - 1 ? ny() - b * kCells : kCells;
  constexpr std::size_t kColumns = std::size_t{1} << kTileBits;
  chunks_.push_back({.a = a,
                     .b = b,
                     .nx = nx_here,
                     .ny = ny_here,
                     .columns = std::vector<Column>(kColumns),
                     .skins = std::vector<Skin>(kColumns),
                     .is_changed = std::vector<std::uint8_t>(kColumns)});
  chunk_of_tile_[surface_.tile_index(a, b)] = static_cast<std::int32_t>(n);
  const bool uniform = ground_->IsUniform(a, b);
  const std::uint8_t profile = ground_->ProfileAt(Vec2(x_m(a * kCells), y_m(b * kCells)));
  for (int j = 0; j < ny_here; ++j) {
    for (int i = 0; i < nx_here; ++i) {
      const int ci = a * kCells + i, cj = b * kCells + j;
      const ColumnId k = n << kTileBits | static_cast<ColumnId>(j << kRowBits | i);
      Column& c = Get(k);
      c.ground_m = c.bank_m = c.top_m = ground_->HeightAt(ci, cj);
      c.profile = uniform ? profile : ground_->ProfileAt(Vec2(x_m(ci), y_m(cj)));
      RefreshSkin(k);
    }
  }
}

void Columns::RefreshSkin(ColumnId k) {
  const Column& c = at(k);
  Skin& skin = SkinOf(k);
  skin.top_m = c.top_m;
  double& ceiling_m = chunks_[k >> kTileBits].ceiling_m;
  ceiling_m = std::max(ceiling_m, c.top_m);
  skin.loose_m = c.loose_m();
  skin.pressed_m = c.pressed_m;
  skin.soil = c.layer_count > 0 ? c.top_layer()->soil : BankOf(k).soil;
  skin.is_loose = c.is_loose();
  skin.firmness = static_cast<float>(FirmnessOf(c, soils()));
}

Columns::Place Columns::PlaceOf(ColumnId k) const {
  const Chunk& chunk = chunks_[k >> kTileBits];
  return {chunk.a * kCells + static_cast<int>(k & kRowMask),
          chunk.b * kCells + static_cast<int>((k >> kRowBits) & kRowMask)};
}

double Columns::TopAt(int i, int j) const {
  const ColumnId k = IdAt(i, j);
  return k != kNone ? skin(k).top_m : ground_->HeightAt(i, j);
}

std::uint8_t Columns::SoilAt(int i, int j) const {
  const ColumnId k = IdAt(i, j);
  if (k != kNone) return skin(k).soil;
  return profiles_[ground_->ProfileAt(Vec2(x_m(i), y_m(j)))].strata().front().soil;
}

/// SampleAt where the four columns do not share one chunk.
Columns::Sample Columns::SampleAcross(double x, double y) const {
  const double gx = std::clamp((x - surface_.origin_W_m.x()) * cells_per_m_, 0.0, nx() - 1.0);
  const double gy = std::clamp((y - surface_.origin_W_m.y()) * cells_per_m_, 0.0, ny() - 1.0);
  const int i = std::min(static_cast<int>(gx), nx() - 2);
  const int j = std::min(static_cast<int>(gy), ny() - 2);
  const double u = gx - i, v = gy - j;
  Sample sample{.i = u < 0.5 ? i : i + 1, .j = v < 0.5 ? j : j + 1};
  const auto add_at = [&](int ci, int cj, double share) {
    const ColumnId m = IdAt(ci, cj);
    if (m == kNone) return sample.Add({.top_m = ground_->HeightAt(ci, cj)}, share);
    sample.Add(skin(m), share);
    if (ci == sample.i && cj == sample.j) sample.nearest = &skin(m);
  };
  add_at(i, j, (1 - u) * (1 - v));
  add_at(i + 1, j, u * (1 - v));
  add_at(i, j + 1, (1 - u) * v);
  add_at(i + 1, j + 1, u * v);
  return sample;
}

Vec3 Columns::NormalAt(double x, double y) const {
  const double h = cell_m();
  const auto normal = [h](double fall_x_m, double fall_y_m) {
    return Vec3(fall_x_m, fall_y_m, 2 * h).normalized();
  };
  const double gx = (x - surface_.origin_W_m.x()) * cells_per_m_;
  const double gy = (y - surface_.origin_W_m.y()) * cells_per_m_;
  if (gx >= 0 && gy >= 0 && gx < nx() - 1 && gy < ny() - 1) {
    const int i = static_cast<int>(gx), j = static_cast<int>(gy);
    const ColumnId k = IdAt(i, j);
    if (k != kNone && IsWithinTile(k) && IsWithinTile(k + Step(1, 1))) {
      const Skin* skins = &skin(k);
      const auto top_m = [skins](int di, int dj) { return skins[Step(di, dj)].top_m; };
      const double u = gx - i, v = gy - j;
      const auto fall_x_m = [&](int dj) {
        return (1 - u) * (top_m(-1, dj) - top_m(1, dj)) + u * (top_m(0, dj) - top_m(2, dj));
      };
      const auto fall_y_m = [&](int di) {
        return (1 - v) * (top_m(di, -1) - top_m(di, 1)) + v * (top_m(di, 0) - top_m(di, 2));
      };
      return normal((1 - v) * fall_x_m(0) + v * fall_x_m(1),
                    (1 - u) * fall_y_m(0) + u * fall_y_m(1));
    }
  }
  return normal(HeightAt(x - h, y) - HeightAt(x + h, y), HeightAt(x, y - h) - HeightAt(x, y + h));
}

const Stratum& Columns::BankOf(ColumnId k) const {
  const Column& c = at(k);
  return profiles_[c.profile].Below(c.ground_m - c.bank_m);
}

void Columns::Raise(const RaisedGround& raised) {
  const double reach_m = raised.radius_m + raised.edge_m;
  const Vec2& c_W = raised.centre_W_m;
  for (int j = std::max(0, NearestJ(c_W.y() - reach_m));
       j <= std::min(ny() - 1, NearestJ(c_W.y() + reach_m)); ++j) {
    for (int i = std::max(0, NearestI(c_W.x() - reach_m));
         i <= std::min(nx() - 1, NearestI(c_W.x() + reach_m)); ++i) {
      const double beyond_m = (Vec2(x_m(i), y_m(j)) - c_W).norm() - raised.radius_m;
      if (beyond_m >= raised.edge_m) continue;
      const double share = 0.5 * (1 + std::cos(kPi * std::max(0.0, beyond_m / raised.edge_m)));
      const ColumnId k = Touch(i, j);
      Column& c = Get(k);
      for (double* z_m : {&c.ground_m, &c.bank_m, &c.top_m}) *z_m += share * raised.height_m;
      Changed(k);
    }
  }
}

void Columns::Cut(ColumnId k, double z_m, SpoilMix* cut) {
  Column& c = Get(k);
  if (c.top_m <= z_m) return;
  CutColumn(MaterialOf(c), z_m, &c, cut);
  Changed(k);
}

void Columns::TakeLoose(ColumnId k, double thickness_m, SpoilMix* taken) {
  const double take_m = std::min(thickness_m, skin(k).loose_m);
  if (take_m > 0) Cut(k, skin(k).top_m - take_m, taken);
}

/// Marks a column whose skin and surface are updated at the end of Transport.
void Columns::ChangesLater(ColumnId k) {
  bool& is_stale = SkinOf(k).is_stale;
  if (!is_stale) stale_.push_back(k);
  is_stale = true;
}

/// Prefetches a column. The memory stride between rows is too large for the hardware prefetcher.
void Columns::Fetch(ColumnId k) const {
  const auto* bytes = reinterpret_cast<const char*>(&at(k));
  __builtin_prefetch(bytes, 1);
  __builtin_prefetch(bytes + 64, 1);
  __builtin_prefetch(bytes + sizeof(Column) - 1, 1);
}

void Columns::Transport(const std::vector<Transfer>& transfers) {
  arrivals_.clear();
  stale_.clear();
  SpoilMix taken;
  const std::size_t count = transfers.size();
  for (std::size_t n = 0; n < count; ++n) {
    if (n + kAhead < count) Fetch(transfers[n + kAhead].from);
    const Transfer& transfer = transfers[n];
    Column& from = Get(transfer.from);
    const double take_m = std::min(transfer.thickness_m, from.loose_m());
    if (take_m <= 0) continue;
    taken.clear();
    CutColumn(MaterialOf(from), from.top_m - take_m, &from, &taken);
    ChangesLater(transfer.from);
    for (const Spoil& part : taken.parts()) arrivals_.push_back({transfer.to, part});
  }
  for (std::size_t n = 0; n < arrivals_.size(); ++n) {
    if (n + kAhead < arrivals_.size()) Fetch(arrivals_[n + kAhead].to);
    const Arrival& arrival = arrivals_[n];
    Column& to = Get(arrival.to);
    DepositOn(MaterialOf(to), arrival.spoil, &to);
    ChangesLater(arrival.to);
  }
  for (std::size_t n = 0; n < stale_.size(); ++n) {
    if (n + kAhead < stale_.size()) Fetch(stale_[n + kAhead]);
    SkinOf(stale_[n]).is_stale = false;
    Changed(stale_[n]);
  }
}

void Columns::Deposit(ColumnId k, const Spoil& spoil) {
  if (spoil.mass_kg <= 0) return;
  Column& c = Get(k);
  DepositOn(MaterialOf(c), spoil, &c);
  Changed(k);
}

void Columns::Deposit(ColumnId k, const SpoilMix& spoil) {
  for (const Spoil& part : spoil.parts()) Deposit(k, part);
}

void Columns::DepositAt(int i, int j, const SpoilMix& spoil) {
  for (const Spoil& part : spoil.parts()) DepositAt(i, j, part);
}

void Columns::DepositAt(int i, int j, const Spoil& spoil) {
  if (Contains(i, j)) {
    Deposit(Touch(i, j), spoil);
  } else {
    outside_kg_ += spoil.mass_kg;
  }
}

void Columns::Press(ColumnId k, const Pressing& pressing, SpoilMix* beside) {
  Column& c = Get(k);
  PressColumn(MaterialOf(c), pressing, &c, beside);
  Changed(k, kRutOfContact + (1 - kRutOfContact) * c.pressed_m / kRutShown_m);
}

void Columns::Scrape(ColumnId k, double thickness_m, SpoilMix* cut) {
  const double pressed_m = at(k).pressed_m;
  Cut(k, at(k).top_m - thickness_m, cut);
  Get(k).pressed_m = pressed_m;
  Changed(k);
}

void Columns::Break(ColumnId k, double thickness_m) {
  SpoilMix broken;
  Cut(k, at(k).top_m - thickness_m, &broken);
  Deposit(k, broken);
}

void Columns::TakeUp(Water water) {
  std::swap(profiles_, water.profiles);
  const std::vector<GroundProfile>& before = water.profiles;
  for (std::size_t n = 0; n < chunks_.size(); ++n) {
    for (std::size_t local = 0; local < chunks_[n].columns.size(); ++local) {
      Column& c = chunks_[n].columns[local];
      const auto k = static_cast<ColumnId>(n << kTileBits | local);
      if (c.layer_count == 0 && c.bank_m == c.ground_m) {
        SkinOf(k).soil = BankOf(k).soil;
        continue;
      }
      const double before_kgpm2 = c.Gain_kgpm2(before[c.profile]);
      WetLayers(kinds_, water.gained[c.profile], &c);
      water_kg_ += (c.Gain_kgpm2(profiles_[c.profile]) - before_kgpm2) * area_m2_;
      RefreshSkin(k);
      NoteChange(k);  // weakened soil may now slide
    }
  }
}

void Columns::MarkRut(ColumnId k) { ShowRut(k, kRutOfContact); }

void Columns::Load(const std::vector<ColumnId>& columns, double pressure_pa) {
  if (columns.empty() || pressure_pa <= 0) return;
  Box box{nx(), ny(), -1, -1};
  for (const ColumnId k : columns) {
    SkinOf(k).load_pa = static_cast<float>(pressure_pa);
    const auto [i, j] = PlaceOf(k);
    box = {std::min(box.i0, i), std::min(box.j0, j), std::max(box.i1, i), std::max(box.j1, j)};
  }
  if (std::find(loaded_.begin(), loaded_.end(), box) == loaded_.end()) loaded_.push_back(box);
}

void Columns::Unblock(ColumnId k) {
  Release(k);
  Changed(k);  // soil that was held back may now slide
}

Columns::Gain Columns::GroundGain() const {
  Gain total;
  for (const Chunk& chunk : chunks_) {
    Gain of_chunk;  // one sum per chunk limits the rounding error
    for (const Column& c : chunk.columns) {
      const double gain_kg = c.Gain_kgpm2(profiles_[c.profile]) * area_m2_;
      of_chunk.net_kg += gain_kg;
      of_chunk.gained_kg += std::max(0.0, gain_kg);
    }
    total.net_kg += of_chunk.net_kg;
    total.gained_kg += of_chunk.gained_kg;
  }
  return total;
}

std::vector<ColumnId> Columns::TakeChanged() {
  for (const ColumnId k : changed_) chunks_[k >> kTileBits].is_changed[k & kLocalMask] = 0;
  return std::exchange(changed_, {});
}

void Columns::NoteChange(ColumnId k) {
  std::uint8_t& is_changed = chunks_[k >> kTileBits].is_changed[k & kLocalMask];
  if (is_changed) return;
  is_changed = 1;
  changed_.push_back(k);
}

/// Updates the skin and the visible surface. `rut` is the least visibility of the rut.
void Columns::Changed(ColumnId k, double rut) {
  NoteChange(k);
  RefreshSkin(k);
  Skin& skin = SkinOf(k);
  const Column& c = at(k);
  const bool stands_pressed = c.pressed_m > 0 || (c.layer_count > 0 && !c.layers[0].loose);
  if (skin.loose_m > kLooseShown_m || !stands_pressed) skin.rut = 0;
  skin.rut = std::max(skin.rut, Byte(rut));
  TerrainSurface::Vertex vertex;
  vertex.height_m = static_cast<float>(c.top_m);
  vertex.cover.soil = kinds_.Shown(skin.soil);
  vertex.cover.moisture = Byte(c.layer_count > 0 ? c.top_layer()->moisture : BankOf(k).moisture);
  vertex.cover.looseness = Byte(skin.loose_m / kLooseShown_m);
  vertex.cover.rut = skin.rut;
  const Place place = PlaceOf(k);
  surface_.Set(place.i, place.j, vertex);
}

void Columns::ShowRut(ColumnId k, double rut) {
  Skin& skin = SkinOf(k);
  if (Byte(rut) <= skin.rut) return;
  skin.rut = Byte(rut);
  const Place place = PlaceOf(k);
  TerrainSurface::Vertex vertex = surface_.AsSet(place.i, place.j);
  vertex.cover.rut = skin.rut;
  surface_.Set(place.i, place.j, vertex);
}

}  // namespace tera
