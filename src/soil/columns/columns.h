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

/// Identifies a column: index of its tile's chunk, row in the tile, place in the row.
using ColumnId = std::uint32_t;

/// The ground as columns, with its mass balance and its visible surface.
///
/// Frames  W. Column (i, j) stands under vertex (i, j) of the surface and is cell x cell wide.
/// Model   Columns are allocated tile by tile, when something happens in a tile. All other tiles
///         read UndisturbedGround, which copies of this object share. Every operation conserves
///         mass: soil moves between columns, to a tool, or over the border of the site
///         (outside_kg).
/// Omits   Water that flows between columns; TakeUp applies the moisture of the weather model.
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
  /// Index of the nearest column along an axis; it may lie outside the site.
  int NearestI(double x_m) const;
  int NearestJ(double y_m) const;

  /// Height of the surface of a column.
  double TopAt(int i, int j) const;
  /// Soil at the surface of a column, as an index into soils().
  std::uint8_t SoilAt(int i, int j) const;
  /// Bilinear height of the surface. Outside the site it is that of the nearest border point.
  double HeightAt(double x_m, double y_m) const { return SampleAt(x_m, y_m).top_m; }

  static constexpr float kOpen_m = std::numeric_limits<float>::infinity();
  /// The most used values of a column, close together in memory.
  struct Skin {
    double top_m = 0, loose_m = 0, pressed_m = 0;  ///< as in Column
    float blocked_m = kOpen_m;                     ///< lowest point of a tool in the column
    float firmness = 1;                            ///< see FirmnessOf
    float load_pa = 0;                             ///< pressure of the running gear on the column
    std::uint8_t soil = 0;                         ///< soil at the surface
    std::uint8_t rut = 0;                          ///< visibility of a rut, 0..255
    bool is_loose = false;                         ///< as in Column
    bool is_stale = false;  ///< within Transport: the skin does not match its column
  };

  /// The surface at a point, bilinear. Outside the site it is that of the nearest border point.
  struct Sample {
    double top_m = 0, pressed_m = 0;
    double firmness = 0;            ///< see FirmnessOf
    int i, j;                       ///< the nearest column
    const Skin* nearest = nullptr;  ///< skin of the nearest column, null if its tile has no columns
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
  /// Upward unit normal by central differences of one cell to each side.
  Vec3 NormalAt(double x_m, double y_m) const;
  /// True if the point is higher than any column of its tile has ever been. A fast test: false only
  /// means that a full test is needed.
  bool IsWellAbove(const Vec3& p_W_m) const {
    const Square square = SquareAt(p_W_m.x(), p_W_m.y());
    return square.chunk != nullptr && p_W_m.z() > square.chunk->ceiling_m;
  }

  /// A rectangle of columns, both ends included.
  struct Box {
    int i0, j0, i1, j1;
    bool operator==(const Box&) const = default;
  };
  /// True if no column in the tiles of `box` has ever reached `z_m`.
  bool IsAllBelow(const Box& box, double z_m) const;

  /// Allocates the tile of column (i, j) if needed and returns the column's id. References stay
  /// valid.
  ColumnId Touch(int i, int j);
  struct Place {
    int i, j;
  };
  Place PlaceOf(ColumnId k) const;
  const Column& at(ColumnId k) const { return chunks_[k >> kTileBits].columns[k & kLocalMask]; }
  const Skin& skin(ColumnId k) const { return chunks_[k >> kTileBits].skins[k & kLocalMask]; }
  static constexpr ColumnId kNone = ~ColumnId{0};
  /// Bits of an id, from the highest: chunk of the tile, row, place in the row.
  static constexpr int kRowBits = 6, kTileBits = 2 * kRowBits;
  static constexpr ColumnId kRowMask = (1u << kRowBits) - 1, kLocalMask = (1u << kTileBits) - 1;
  /// True if all eight neighbours belong to the same tile. Their ids then differ by Step().
  bool IsWithinTile(ColumnId k) const {
    const Chunk& chunk = chunks_[k >> kTileBits];
    const int i = static_cast<int>(k & kRowMask), j = static_cast<int>((k >> kRowBits) & kRowMask);
    return i > 0 && j > 0 && i + 1 < chunk.nx && j + 1 < chunk.ny;
  }
  static constexpr int Step(int di, int dj) { return dj * (1 << kRowBits) + di; }
  /// Id of a neighbour, kNone if its tile has no columns.
  ColumnId BesideId(ColumnId k, int di, int dj) const {
    const Chunk& chunk = chunks_[k >> kTileBits];
    const int i = static_cast<int>(k & kRowMask) + di;
    const int j = static_cast<int>((k >> kRowBits) & kRowMask) + dj;
    if (i >= 0 && j >= 0 && i < chunk.nx && j < chunk.ny) {
      return (k & ~kLocalMask) | static_cast<ColumnId>(j << kRowBits | i);
    }
    return IdAt(chunk.a * TerrainGrid::kTileCells + i, chunk.b * TerrainGrid::kTileCells + j);
  }
  /// Skin of a neighbour, null if its tile has no columns.
  const Skin* Beside(ColumnId k, int di, int dj) const {
    const ColumnId beside = BesideId(k, di, dj);
    return beside == kNone ? nullptr : &skin(beside);
  }
  /// Id of column (i, j), kNone outside the site or if its tile has no columns.
  ColumnId IdAt(int i, int j) const {
    if (!Contains(i, j)) return kNone;
    const std::int32_t n = chunk_of_tile_[TileOf(i, j)];
    if (n < 0) return kNone;
    const Chunk& chunk = chunks_[n];
    return static_cast<ColumnId>(n) << kTileBits |
           static_cast<ColumnId>(j - chunk.b * TerrainGrid::kTileCells) << kRowBits |
           static_cast<ColumnId>(i - chunk.a * TerrainGrid::kTileCells);
  }
  /// All ids are less than this.
  std::size_t id_end() const { return chunks_.size() << kTileBits; }

  const UndisturbedGround& undisturbed() const { return *ground_; }
  const TerrainSurface& surface() const { return surface_; }
  const SoilKinds& kinds() const { return kinds_; }
  const std::vector<SoilType>& soils() const { return kinds_.soils(); }
  std::uint8_t soil_at(ColumnId k) const { return skin(k).soil; }
  /// Strata of the undisturbed soil of a column.
  const GroundProfile& ProfileOf(ColumnId k) const { return profiles_[at(k).profile]; }
  /// Profiles of the undisturbed ground with their present moisture.
  const std::vector<GroundProfile>& profiles() const { return profiles_; }
  /// Stratum at the top of the undisturbed soil of a column.
  const Stratum& BankOf(ColumnId k) const;

  /// Adds the soil kinds that weather may produce. False if there is no room for them.
  bool AddHiddenKinds() { return kinds_.AddHidden(); }
  /// Gain of water in a slice of ground, as a height of water. The slice begins at the end of the
  /// slice above.
  struct Gained {
    double bottom_m, water_m;
  };
  /// Undisturbed ground after weather, by profile.
  struct Water {
    std::vector<GroundProfile> profiles;
    std::vector<std::vector<Gained>> gained;
  };
  /// Applies the moisture of the weather model. A layer gains as much water as undisturbed ground
  /// of its profile at the same depth, within the limits of its pores. Soil carried by tools or in
  /// the air keeps its water.
  void TakeUp(Water water);
  void SetWetness(std::vector<TerrainSurface::Wetness> wetness) {
    surface_.SetWetness(std::move(wetness));
  }
  /// Net mass of water that TakeUp has added to the columns.
  double water_kg() const { return water_kg_; }

  /// Raises or lowers the ground. No soil is taken from elsewhere.
  void Raise(const RaisedGround& raised);
  /// Removes all soil above z_m and adds it to `cut`.
  void Cut(ColumnId k, double z_m, SpoilMix* cut);
  /// Removes up to `thickness_m` of the loose soil at the surface and adds it to `taken`.
  void TakeLoose(ColumnId k, double thickness_m, SpoilMix* taken);
  /// Loose soil that moves from one column to another.
  struct Transfer {
    ColumnId from, to;
    double thickness_m;  ///< limited by the loose soil of `from`
  };
  /// Performs all transfers at once: all soil leaves before any arrives.
  void Transport(const std::vector<Transfer>& transfers);
  /// Adds loose soil to a column.
  void Deposit(ColumnId k, const Spoil& spoil);
  void Deposit(ColumnId k, const SpoilMix& spoil);
  /// Adds loose soil at (i, j). Outside the site it counts as outside_kg.
  void DepositAt(int i, int j, const SpoilMix& spoil);
  void DepositAt(int i, int j, const Spoil& spoil);
  /// Presses the surface down: see PressColumn.
  void Press(ColumnId k, const Pressing& pressing, SpoilMix* beside);
  /// Removes the upper `thickness_m` and adds it to `cut`. The new surface keeps the plastic
  /// sinkage of the old one.
  void Scrape(ColumnId k, double thickness_m, SpoilMix* cut);
  /// Turns the upper `thickness_m` into loose soil.
  void Break(ColumnId k, double thickness_m);
  /// Makes the present ground the reference of ChangeAt.
  void MarkStart();
  /// The column at (i, j). In a tile without columns it is the undisturbed column.
  Column ColumnAt(int i, int j) const;
  /// Change of a column since MarkStart, or since it was undisturbed if that is later.
  struct Change {
    double height_m = 0, kgpm2 = 0;
  };
  Change ChangeAt(int i, int j) const;
  /// True if tile (a, b) has its own columns.
  bool HasColumns(int a, int b) const { return chunk_of_tile_[surface_.tile_index(a, b)] >= 0; }

  /// Draws a light rut where running gear touches a column.
  void MarkRut(ColumnId k);

  /// Marks a tool above `low_m` in this column. Soil higher than `low_m` does not slide in.
  void Block(ColumnId k, double low_m) { SkinOf(k).blocked_m = static_cast<float>(low_m); }
  bool IsBlocked(ColumnId k) const { return skin(k).blocked_m < kOpen_m; }
  /// Removes the mark of a tool. If the tool does not block the column again, the caller must call
  /// Unblock.
  void Release(ColumnId k) {
    SkinOf(k).blocked_m = kOpen_m;
    SkinOf(k).load_pa = 0;
  }
  /// Marks columns that running gear presses on. Such columns do not support a bank.
  void Load(const std::vector<ColumnId>& columns, double pressure_pa);
  bool IsPropped(ColumnId k) const { return IsBlocked(k) && skin(k).load_pa == 0; }
  /// Bounding boxes of the columns loaded since the last call.
  std::vector<Box> TakeLoaded() { return std::exchange(loaded_, {}); }
  void Unblock(ColumnId k);

  /// Shows soil in the air.
  void ShowGrains(std::vector<TerrainSurface::Grain> grains) {
    for (TerrainSurface::Grain& grain : grains) grain.soil = kinds_.Shown(grain.soil);
    surface_.SetGrains(std::move(grains));
  }

  /// Mass gained since the undisturbed state: net over all columns, and the sum of the gains alone.
  struct Gain {
    double net_kg = 0, gained_kg = 0;
  };
  Gain GroundGain() const;
  double outside_kg() const { return outside_kg_; }

  /// Columns changed since the last call, each once, in order of change.
  std::vector<ColumnId> TakeChanged();

 private:
  struct Chunk {
    int a, b;    ///< indices of the tile
    int nx, ny;  ///< columns along x and y
    /// greatest height that any column has ever had
    double ceiling_m = -std::numeric_limits<double>::infinity();
    std::vector<Column> columns;
    std::vector<Skin> skins;
    std::vector<std::uint8_t> is_changed;
  };
  /// The four columns around a point, if all belong to one chunk.
  struct Square {
    const Chunk* chunk = nullptr;
    /// skin of the lowest i and j; the others follow at Step(1, 0), Step(0, 1), Step(1, 1)
    const Skin* skins = nullptr;
    int i, j;     ///< indices of the first column
    double u, v;  ///< position relative to the first column, in cells
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
  std::vector<std::int32_t> chunk_of_tile_;  ///< index into chunks_; -1 for a tile without columns
  std::vector<std::vector<Change>> start_;   ///< by chunk, for the chunks that exist at MarkStart
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
  // Buffers of Transport, kept to avoid allocation.
  std::vector<Arrival> arrivals_;
  std::vector<ColumnId> stale_;
};

}  // namespace tera
