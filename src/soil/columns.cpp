#include "soil/columns.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/check.h"
#include "core/units.h"
#include "soil/soil_type.h"

namespace tera {
namespace {

constexpr double kLooseShown_m = 0.03;  ///< loose soil this thick looks fully loose
constexpr double kRutShown_m = 0.02;    ///< a rut this deep looks freshly pressed
constexpr double kRutOfContact = 0.35;  ///< share of the rut's look that a mere contact leaves
constexpr int kCells = TerrainGrid::kTileCells;

std::uint8_t Byte(double share) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0, 1.0)));
}

}  // namespace

Columns::Columns(UndisturbedGround ground, std::vector<SoilType> soils)
    : ground_(std::move(ground)),
      surface_(SurfaceOf(ground_)),
      soils_(std::move(soils)),
      chunk_of_tile_(surface_.tile_count(), -1),
      area_m2_(surface_.cell_m * surface_.cell_m) {}

int Columns::NearestI(double x_m) const {
  return static_cast<int>(std::lround((x_m - surface_.origin_W_m.x()) / surface_.cell_m));
}

int Columns::NearestJ(double y_m) const {
  return static_cast<int>(std::lround((y_m - surface_.origin_W_m.y()) / surface_.cell_m));
}

int Columns::TileOf(int i, int j) const {
  return surface_.tile_index(std::min(i / kCells, surface_.tiles_x() - 1),
                             std::min(j / kCells, surface_.tiles_y() - 1));
}

const Column* Columns::Find(int i, int j) const {
  const std::int32_t n = chunk_of_tile_[TileOf(i, j)];
  if (n < 0) return nullptr;
  const Chunk& chunk = chunks_[n];
  return &chunk.columns[((j - chunk.b * kCells) << kRowBits) | (i - chunk.a * kCells)];
}

ColumnId Columns::Touch(int i, int j) {
  TERA_CHECK(Contains(i, j), i, j);
  std::int32_t& n = chunk_of_tile_[TileOf(i, j)];
  if (n < 0) {
    n = static_cast<std::int32_t>(chunks_.size());
    const int a = std::min(i / kCells, surface_.tiles_x() - 1);
    const int b = std::min(j / kCells, surface_.tiles_y() - 1);
    chunks_.push_back(
        {a, b, std::vector<Column>(1u << kTileBits), std::vector<std::uint8_t>(1u << kTileBits)});
    const bool uniform = ground_.IsUniform(a, b);
    const std::uint8_t profile = ground_.ProfileAt(Vec2(x_m(a * kCells), y_m(b * kCells)));
    for (int local = 0; local < 1 << kTileBits; ++local) {
      const int ci = a * kCells + (local & static_cast<int>(kRowMask));
      const int cj = b * kCells + (local >> kRowBits);
      if (!Contains(ci, cj)) continue;
      Column& c = chunks_.back().columns[local];
      c.ground_m = c.bank_m = c.top_m = ground_.HeightAt(ci, cj);
      c.profile = uniform ? profile : ground_.ProfileAt(Vec2(x_m(ci), y_m(cj)));
    }
  }
  const Chunk& chunk = chunks_[n];
  return static_cast<ColumnId>(n) << kTileBits |
         static_cast<ColumnId>(j - chunk.b * kCells) << kRowBits |
         static_cast<ColumnId>(i - chunk.a * kCells);
}

Columns::Place Columns::PlaceOf(ColumnId k) const {
  const Chunk& chunk = chunks_[k >> kTileBits];
  return {chunk.a * kCells + static_cast<int>(k & kRowMask),
          chunk.b * kCells + static_cast<int>((k >> kRowBits) & kRowMask)};
}

const Column* Columns::Beside(ColumnId k, int di, int dj) const {
  const int i = static_cast<int>(k & kRowMask) + di;
  const int j = static_cast<int>((k >> kRowBits) & kRowMask) + dj;
  const Chunk& chunk = chunks_[k >> kTileBits];
  if (i >= 0 && j >= 0 && i < kCells && j < kCells) return &chunk.columns[j << kRowBits | i];
  return Contains(chunk.a * kCells + i, chunk.b * kCells + j)
             ? Find(chunk.a * kCells + i, chunk.b * kCells + j)
             : nullptr;
}

ColumnId Columns::BesideId(ColumnId k, int di, int dj) const {
  const int i = static_cast<int>(k & kRowMask) + di;
  const int j = static_cast<int>((k >> kRowBits) & kRowMask) + dj;
  if (i >= 0 && j >= 0 && i < kCells && j < kCells) {
    return (k & ~kLocalMask) | static_cast<ColumnId>(j << kRowBits | i);
  }
  const Chunk& chunk = chunks_[k >> kTileBits];
  const int gi = chunk.a * kCells + i, gj = chunk.b * kCells + j;
  if (!Contains(gi, gj)) return kNone;
  const std::int32_t n = chunk_of_tile_[TileOf(gi, gj)];
  if (n < 0) return kNone;
  return static_cast<ColumnId>(n) << kTileBits |
         static_cast<ColumnId>(gj - chunks_[n].b * kCells) << kRowBits |
         static_cast<ColumnId>(gi - chunks_[n].a * kCells);
}

double Columns::TopAt(int i, int j) const {
  const Column* c = Find(i, j);
  return c != nullptr ? c->top_m : ground_.HeightAt(i, j);
}

std::uint8_t Columns::SoilAt(int i, int j) const {
  const Column* c = Find(i, j);
  if (c == nullptr) {
    return ground_.profiles[ground_.ProfileAt(Vec2(x_m(i), y_m(j)))].strata().front().soil;
  }
  if (c->layer_count > 0) return c->top_layer()->soil;
  return ground_.profiles[c->profile].Below(c->ground_m - c->bank_m).soil;
}

Columns::Sample Columns::SampleAt(double x, double y) const {
  const double gx = std::clamp((x - surface_.origin_W_m.x()) / cell_m(), 0.0, nx() - 1.0);
  const double gy = std::clamp((y - surface_.origin_W_m.y()) / cell_m(), 0.0, ny() - 1.0);
  const int i = std::min(static_cast<int>(gx), nx() - 2);
  const int j = std::min(static_cast<int>(gy), ny() - 2);
  const double u = gx - i, v = gy - j;
  Sample sample{0, 0, u < 0.5 ? i : i + 1, v < 0.5 ? j : j + 1};
  const auto add = [&](int ci, int cj, double share) {
    const Column* c = Find(ci, cj);
    sample.top_m += share * (c != nullptr ? c->top_m : ground_.HeightAt(ci, cj));
    if (c != nullptr) sample.pressed_m += share * c->pressed_m;
  };
  add(i, j, (1 - u) * (1 - v));
  add(i + 1, j, u * (1 - v));
  add(i, j + 1, (1 - u) * v);
  add(i + 1, j + 1, u * v);
  return sample;
}

std::uint8_t Columns::soil_at(ColumnId k) const {
  const Column& c = at(k);
  return c.layer_count > 0 ? c.top_layer()->soil : BankOf(k).soil;
}

const Stratum& Columns::BankOf(ColumnId k) const {
  const Column& c = at(k);
  return ground_.profiles[c.profile].Below(c.ground_m - c.bank_m);
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
  const Column& c = at(k);
  const double take_m = std::min(thickness_m, c.loose_m());
  if (take_m > 0) Cut(k, c.top_m - take_m, taken);
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

void Columns::Press(ColumnId k, double ds_m, double influence_m, SpoilMix* beside) {
  Column& c = Get(k);
  PressColumn(MaterialOf(c), ds_m, influence_m, &c, beside);
  Changed(k);
  ShowRut(k, kRutOfContact + (1 - kRutOfContact) * c.pressed_m / kRutShown_m);
}

void Columns::Break(ColumnId k, double thickness_m) {
  SpoilMix broken;
  Cut(k, at(k).top_m - thickness_m, &broken);
  Deposit(k, broken);
}

void Columns::MarkRut(ColumnId k) { ShowRut(k, kRutOfContact); }

void Columns::Unblock(ColumnId k) {
  Get(k).blocked_m = std::numeric_limits<float>::infinity();
  Changed(k);  // what was held back may now slide
}

Columns::Gain Columns::GroundGain() const {
  Gain total;
  for (const Chunk& chunk : chunks_) {
    Gain of_chunk;  // apart, to keep the sums small
    for (const Column& c : chunk.columns) {
      const double gain_kg = c.Gain_kgpm2(ground_.profiles[c.profile]) * area_m2_;
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

void Columns::Changed(ColumnId k) {
  std::uint8_t& is_changed = chunks_[k >> kTileBits].is_changed[k & kLocalMask];
  if (!is_changed) {
    is_changed = 1;
    changed_.push_back(k);
  }
  const Column& c = at(k);
  const Place place = PlaceOf(k);
  const double loose_m = c.loose_m();
  const bool stands_pressed = c.pressed_m > 0 || (c.layer_count > 0 && !c.layers[0].loose);
  TerrainSurface::Vertex vertex = surface_.at(place.i, place.j);
  vertex.height_m = static_cast<float>(c.top_m);
  vertex.cover.soil = soil_at(k);
  vertex.cover.moisture = Byte(c.layer_count > 0 ? c.top_layer()->moisture : BankOf(k).moisture);
  vertex.cover.looseness = Byte(loose_m / kLooseShown_m);
  if (loose_m > kLooseShown_m || !stands_pressed) vertex.cover.rut = 0;
  surface_.Set(place.i, place.j, vertex);
}

void Columns::ShowRut(ColumnId k, double rut) {
  const Place place = PlaceOf(k);
  TerrainSurface::Vertex vertex = surface_.at(place.i, place.j);
  vertex.cover.rut = std::max(vertex.cover.rut, Byte(rut));
  surface_.Set(place.i, place.j, vertex);
}

}  // namespace tera
