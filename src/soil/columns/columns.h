#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "core/types/terrain_surface.h"
#include "soil/columns/column.h"
#include "soil/columns/soil_kinds.h"
#include "soil/columns/spoil.h"
#include "soil/columns/undisturbed_ground.h"
#include "soil/soil.h"

namespace tera {

/// Place of a column in memory: its tile's chunk, and its row and place in the row there.
using ColumnId = std::uint32_t;

/// The ground as columns, its mass ledger, and the visible surface, always in step.
///
/// Frames  W. Column (i, j) stands under vertex (i, j) of the surface and is cell x cell wide.
/// Model   Only tiles in which something has happened have columns of their own; elsewhere the
///         ground is that of UndisturbedGround, which copies share. Every operation moves mass:
///         from one column to another, to a tool, or over the border of the site (outside_kg).
/// Omits   moisture that moves by itself; see TakeUp.
class Columns {
 public:
  Columns(UndisturbedGround ground, std::vector<SoilType> soils)
      : Columns(std::move(ground), SoilKinds(std::move(soils))) {}
  Columns(UndisturbedGround ground, SoilKinds kinds);

  const TerrainGrid& grid() const { return surface_; }
  int nx() const { return surface_.nx; }
  int ny() const { return surface_.ny; }
  double cell_m() const { return surface_.cell_m; }
  double area_m2() const { return area_m2_; }
  bool Contains(int i, int j) const { return surface_.Contains(i, j); }
  double x_m(int i) const { return surface_.x_m(i); }
  double y_m(int j) const { return surface_.y_m(j); }
  /// Nearest column's index along an axis, not limited to the site.
  int NearestI(double x_m) const;
  int NearestJ(double y_m) const;

  /// Height of a column's surface.
  double TopAt(int i, int j) const;
  /// Soil at a column's surface, as an index into soils().
  std::uint8_t SoilAt(int i, int j) const;
  /// Bilinear height, the nearest border value outside the site.
  double HeightAt(double x_m, double y_m) const { return SampleAt(x_m, y_m).top_m; }

  static constexpr float kOpen_m = std::numeric_limits<float>::infinity();
  /// Values of a column that are asked for most often, close together in memory.
  struct Skin {
    double top_m = 0, loose_m = 0, pressed_m = 0;  ///< as in Column
    float blocked_m = kOpen_m;                     ///< lowest point of a tool in it
    float firmness = 1;                            ///< see FirmnessOf
    float load_pa = 0;                             ///< of gear that stands on it
    std::uint8_t soil = 0;                         ///< at the surface
    std::uint8_t rut = 0;                          ///< as shown
    bool is_loose = false;                         ///< as in Column
    bool is_stale = false;                         ///< in Transport: not in step with its column
  };

  /// Surface between the columns, bilinear; the nearest border's outside the site.
  struct Sample {
    double top_m = 0, pressed_m = 0;
    double firmness = 0;            ///< see FirmnessOf
    int i, j;                       ///< the nearest column
    const Skin* nearest = nullptr;  ///< its skin, if its tile has columns
    void Add(const Skin& skin, double share) {
      top_m += share * skin.top_m;
      pressed_m += share * skin.pressed_m;
      firmness += share * static_cast<double>(skin.firmness);
    }
  };
  Sample SampleAt(double x_m, double y_m) const {
    const Square square = SquareAt(x_m, y_m);
    return square.chunk != nullptr ? SampleIn(square) : SampleAcross(x_m, y_m);
  }
  /// Soil at the surface of the nearest column.
  std::uint8_t SoilAt(const Sample& sample) const {
    return sample.nearest != nullptr ? sample.nearest->soil : SoilAt(sample.i, sample.j);
  }
  /// Upward unit normal of the surface there, over two cells.
  Vec3 NormalAt(double x_m, double y_m) const;
  /// Whether a point lies above all that its tile has ever held: a quick look, true only if so.
  bool IsWellAbove(const Vec3& p_W_m) const {
    const Square square = SquareAt(p_W_m.x(), p_W_m.y());
    return square.chunk != nullptr && p_W_m.z() > square.chunk->ceiling_m;
  }

  /// Columns of a rectangle, both ends among them.
  struct Box {
    int i0, j0, i1, j1;
    bool operator==(const Box&) const = default;
  };
  /// Whether all tiles of the columns in `box` have never held anything as high as `z_m`.
  bool IsAllBelow(const Box& box, double z_m) const;

  /// Gives the tile of column (i, j) columns of its own. References stay good.
  ColumnId Touch(int i, int j);
  struct Place {
    int i, j;
  };
  Place PlaceOf(ColumnId k) const;
  const Column& at(ColumnId k) const { return chunks_[k >> kTileBits].columns[k & kLocalMask]; }
  const Skin& skin(ColumnId k) const { return chunks_[k >> kTileBits].skins[k & kLocalMask]; }
  static constexpr ColumnId kNone = ~ColumnId{0};
  /// An id holds the chunk of its tile, the row, and the place in the row, from the highest bit on.
  static constexpr int kRowBits = 6, kTileBits = 2 * kRowBits;
  static constexpr ColumnId kRowMask = (1u << kRowBits) - 1, kLocalMask = (1u << kTileBits) - 1;
  /// Whether the eight columns around are of the same tile: their ids then differ by Step().
  bool IsWithinTile(ColumnId k) const {
    const Chunk& chunk = chunks_[k >> kTileBits];
    const int i = static_cast<int>(k & kRowMask), j = static_cast<int>((k >> kRowBits) & kRowMask);
    return i > 0 && j > 0 && i + 1 < chunk.nx && j + 1 < chunk.ny;
  }
  static constexpr int Step(int di, int dj) { return dj * (1 << kRowBits) + di; }
  /// The id of the column beside, if its tile has columns, else kNone.
  ColumnId BesideId(ColumnId k, int di, int dj) const {
    const Chunk& chunk = chunks_[k >> kTileBits];
    const int i = static_cast<int>(k & kRowMask) + di;
    const int j = static_cast<int>((k >> kRowBits) & kRowMask) + dj;
    if (i >= 0 && j >= 0 && i < chunk.nx && j < chunk.ny) {
      return (k & ~kLocalMask) | static_cast<ColumnId>(j << kRowBits | i);
    }
    return IdAt(chunk.a * TerrainGrid::kTileCells + i, chunk.b * TerrainGrid::kTileCells + j);
  }
  /// Its skin, or null.
  const Skin* Beside(ColumnId k, int di, int dj) const {
    const ColumnId beside = BesideId(k, di, dj);
    return beside == kNone ? nullptr : &skin(beside);
  }
  /// The id of column (i, j), if it is on the site and its tile has columns, else kNone.
  ColumnId IdAt(int i, int j) const {
    if (!Contains(i, j)) return kNone;
    const std::int32_t n = chunk_of_tile_[TileOf(i, j)];
    if (n < 0) return kNone;
    const Chunk& chunk = chunks_[n];
    return static_cast<ColumnId>(n) << kTileBits |
           static_cast<ColumnId>(j - chunk.b * TerrainGrid::kTileCells) << kRowBits |
           static_cast<ColumnId>(i - chunk.a * TerrainGrid::kTileCells);
  }
  /// Ids lie below this.
  std::size_t id_end() const { return chunks_.size() << kTileBits; }

  const UndisturbedGround& undisturbed() const { return *ground_; }
  const TerrainSurface& surface() const { return surface_; }
  const SoilKinds& kinds() const { return kinds_; }
  const std::vector<SoilType>& soils() const { return kinds_.soils(); }
  std::uint8_t soil_at(ColumnId k) const { return skin(k).soil; }
  /// Strata of a column's undisturbed soil.
  const GroundProfile& ProfileOf(ColumnId k) const { return profiles_[at(k).profile]; }
  /// The undisturbed ground's profiles as they are now.
  const std::vector<GroundProfile>& profiles() const { return profiles_; }
  /// Stratum of the undisturbed soil at the top of a column's bank.
  const Stratum& BankOf(ColumnId k) const;

  /// Adds the kinds of soil that weather may make; false if there is no room for them.
  bool AddHiddenKinds() { return kinds_.AddHidden(); }
  /// Water that the ground has gained, as a height, between the last depth and this one.
  struct Gained {
    double bottom_m, water_m;
  };
  /// Undisturbed ground as weather has left it, by profile.
  struct Water {
    std::vector<GroundProfile> profiles;
    std::vector<std::vector<Gained>> gained;
  };
  /// Takes up water. Layers gain as much as undisturbed ground of their profile at the same depth,
  /// as far as their pores hold or give it. Soil that is cut free keeps its water.
  void TakeUp(Water water);
  void SetWetness(std::vector<TerrainSurface::Wetness> wetness) {
    surface_.SetWetness(std::move(wetness));
  }
  /// Mass that TakeUp has brought to the columns or taken from them.
  double water_kg() const { return water_kg_; }

  /// Raises the undisturbed ground: no soil is moved from elsewhere.
  void Raise(const RaisedGround& raised);
  /// Takes everything above z_m away and adds it to `cut`.
  void Cut(ColumnId k, double z_m, SpoilMix* cut);
  /// Takes up to `thickness_m` of the loose soil at the surface away and adds it to `taken`.
  void TakeLoose(ColumnId k, double thickness_m, SpoilMix* taken);
  /// Loose soil on its way from one column to another.
  struct Transfer {
    ColumnId from, to;
    double thickness_m;  ///< at most the loose soil is taken
  };
  /// All soil leaves its columns before any arrives.
  void Transport(const std::vector<Transfer>& transfers);
  /// Puts loose soil on a column.
  void Deposit(ColumnId k, const Spoil& spoil);
  void Deposit(ColumnId k, const SpoilMix& spoil);
  /// Deposit by place; beyond the site's border it leaves the ledger's ground for its outside.
  void DepositAt(int i, int j, const SpoilMix& spoil);
  void DepositAt(int i, int j, const Spoil& spoil);
  /// Presses the surface down: see PressColumn.
  void Press(ColumnId k, const Pressing& pressing, SpoilMix* beside);
  /// Takes the upper `thickness_m` away and adds it to `cut`. The new surface keeps the prints
  /// pressed into the old one.
  void Scrape(ColumnId k, double thickness_m, SpoilMix* cut);
  /// Turns the upper `thickness_m` into loose soil.
  void Break(ColumnId k, double thickness_m);
  /// From now on, changes are counted from the present ground.
  void MarkStart();
  /// The column at a place; in a quiet tile, the column that it would have.
  Column ColumnAt(int i, int j) const;
  /// A column's gain since MarkStart, or since it was undisturbed.
  struct Change {
    double height_m = 0, kgpm2 = 0;
  };
  Change ChangeAt(int i, int j) const;
  /// Whether tile (a, b) has columns of its own, because something has happened there.
  bool HasColumns(int a, int b) const { return chunk_of_tile_[surface_.tile_index(a, b)] >= 0; }

  /// Marks a column as touched by a running gear.
  void MarkRut(ColumnId k);

  /// A tool stands in this column from `low_m` upwards: soil higher than that does not slide in.
  void Block(ColumnId k, double low_m) { SkinOf(k).blocked_m = static_cast<float>(low_m); }
  bool IsBlocked(ColumnId k) const { return skin(k).blocked_m < kOpen_m; }
  /// The tool may have left: unless it blocks the column again, Unblock is due.
  void Release(ColumnId k) {
    SkinOf(k).blocked_m = kOpen_m;
    SkinOf(k).load_pa = 0;
  }
  /// Gear presses on the columns that it blocks, which are no support for a bank then.
  void Load(const std::vector<ColumnId>& columns, double pressure_pa);
  bool IsPropped(ColumnId k) const { return IsBlocked(k) && skin(k).load_pa == 0; }
  /// Columns around those loaded since the last call.
  std::vector<Box> TakeLoaded() { return std::exchange(loaded_, {}); }
  void Unblock(ColumnId k);

  /// Shows soil in the air.
  void ShowGrains(std::vector<TerrainSurface::Grain> grains) {
    for (TerrainSurface::Grain& grain : grains) grain.soil = kinds_.Shown(grain.soil);
    surface_.SetGrains(std::move(grains));
  }

  /// Mass that columns have more than undisturbed: all together, and those alone that gained.
  struct Gain {
    double net_kg = 0, gained_kg = 0;
  };
  Gain GroundGain() const;
  double outside_kg() const { return outside_kg_; }

  /// Columns changed since the last call, each once, in order of change.
  std::vector<ColumnId> TakeChanged();

 private:
  struct Chunk {
    int a, b;                                                     ///< the tile's
    int nx, ny;                                                   ///< columns along x and y
    double ceiling_m = -std::numeric_limits<double>::infinity();  ///< no column was ever higher
    std::vector<Column> columns;
    std::vector<Skin> skins;
    std::vector<std::uint8_t> is_changed;
  };
  /// The four columns around a place, if one chunk has them all.
  struct Square {
    const Chunk* chunk = nullptr;
    const Skin* skins = nullptr;  ///< of the first; the others are Step(1, 0), ... farther
    int i, j;                     ///< the first one's
    double u, v;                  ///< from there, in cells
  };
  Square SquareAt(double x_m, double y_m) const {
    const double gx = (x_m - surface_.origin_W_m.x()) * cells_per_m_;
    const double gy = (y_m - surface_.origin_W_m.y()) * cells_per_m_;
    if (!(gx >= 0 && gy >= 0 && gx < nx() - 1 && gy < ny() - 1)) return {};
    const int i = static_cast<int>(gx), j = static_cast<int>(gy);
    const int a = i / TerrainGrid::kTileCells, b = j / TerrainGrid::kTileCells;
    const std::int32_t n = chunk_of_tile_[surface_.tile_index(a, b)];
    if (n < 0) return {};
    const Chunk& chunk = chunks_[n];
    const int di = i - a * TerrainGrid::kTileCells, dj = j - b * TerrainGrid::kTileCells;
    if (di + 1 >= chunk.nx || dj + 1 >= chunk.ny) return {};
    return {&chunk, &chunk.skins[Step(di, dj)], i, j, gx - i, gy - j};
  }
  static Sample SampleIn(const Square& at) {
    const double u = at.u, v = at.v;
    const int di = u < 0.5 ? 0 : 1, dj = v < 0.5 ? 0 : 1;
    Sample sample{.i = at.i + di, .j = at.j + dj, .nearest = at.skins + Step(di, dj)};
    sample.Add(at.skins[0], (1 - u) * (1 - v));
    sample.Add(at.skins[Step(1, 0)], u * (1 - v));
    sample.Add(at.skins[Step(0, 1)], (1 - u) * v);
    sample.Add(at.skins[Step(1, 1)], u * v);
    return sample;
  }
  Sample SampleAcross(double x_m, double y_m) const;
  Column& Get(ColumnId k) { return chunks_[k >> kTileBits].columns[k & kLocalMask]; }
  Skin& SkinOf(ColumnId k) { return chunks_[k >> kTileBits].skins[k & kLocalMask]; }
  int TileOf(int i, int j) const {
    return surface_.tile_index(std::min(i / TerrainGrid::kTileCells, surface_.tiles_x() - 1),
                               std::min(j / TerrainGrid::kTileCells, surface_.tiles_y() - 1));
  }
  void Unfold(int a, int b);
  void RefreshSkin(ColumnId k);
  ColumnMaterial MaterialOf(const Column& c) const {
    return {profiles_[c.profile], kinds_.soils(), area_m2_};
  }
  void NoteChange(ColumnId k);
  void Changed(ColumnId k, double rut = 0);
  void ChangesLater(ColumnId k);
  void Fetch(ColumnId k) const;
  void ShowRut(ColumnId k, double rut);

  std::shared_ptr<const UndisturbedGround> ground_;
  std::vector<GroundProfile> profiles_;
  TerrainSurface surface_;
  SoilKinds kinds_;
  std::vector<Chunk> chunks_;
  std::vector<std::int32_t> chunk_of_tile_;  ///< -1 where nothing has happened
  std::vector<std::vector<Change>> start_;   ///< of each chunk that was there at MarkStart
  double cells_per_m_ = 0;
  double area_m2_ = 0;
  double outside_kg_ = 0;
  double water_kg_ = 0;
  std::vector<ColumnId> changed_;
  std::vector<Box> loaded_;
  struct Arrival {
    ColumnId to;
    Spoil spoil;
  };
  // Transport's, kept for their memory.
  std::vector<Arrival> arrivals_;
  std::vector<ColumnId> stale_;
};

}  // namespace tera
