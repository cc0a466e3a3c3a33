#pragma once

#include <cstdint>
#include <vector>

#include "core/terrain_surface.h"
#include "soil/soil.h"

namespace tera {

/// Soil on the move: a mass, the volume it takes up, and what it is.
struct Spoil {
  double mass_kg = 0;
  double volume_m3 = 0;
  std::uint8_t soil = 0;

  void Add(const Spoil& other) {
    if (other.mass_kg > mass_kg) soil = other.soil;
    mass_kg += other.mass_kg;
    volume_m3 += other.volume_m3;
  }
  /// Takes the share `f` in [0, 1] out of this.
  Spoil Take(double f);
};

/// One vertical column of ground, from a fixed level far below the site up to the surface: bank
/// (undisturbed) soil, then a compacted crust of the same soil, then loose soil.
struct Column {
  double bank_m = 0;       ///< z of the top of the bank soil, crust included
  double crust_m = 0;      ///< thickness of the crust
  double crust_kgpm2 = 0;  ///< its mass for each square metre
  double loose_m = 0;      ///< thickness of the loose soil
  double loose_kgpm2 = 0;  ///< its mass for each square metre
  double pressed_m = 0;    ///< plastic sinkage pressed into this surface, for reloading
  std::uint8_t bank_soil = 0;
  std::uint8_t loose_soil = 0;

  double top_m() const { return bank_m + loose_m; }
};

/// The ground as columns, its mass ledger, and the visible surface, always in step.
///
/// Frames  W. Column (i, j) stands under vertex (i, j) of the surface and is cell x cell wide.
/// Model   Every operation moves mass: from one column to another, to a tool, or over the border of
///         the site (outside_kg). Bank soil has its type's density, the crust and the loose soil
///         their own. Mass is kept per area in double precision.
/// Omits   layers of different soils below the surface, moisture that moves.
class Columns {
 public:
  /// Columns with the given surface heights (row-major, i fastest) of undisturbed soil.
  Columns(Vec2 origin_W_m, double cell_m, int nx, int ny, const std::vector<double>& height_m,
          const std::vector<std::uint8_t>& bank_soil, std::vector<SoilType> soils);

  int nx() const { return surface_.nx; }
  int ny() const { return surface_.ny; }
  double cell_m() const { return surface_.cell_m; }
  double area_m2() const { return area_m2_; }
  std::size_t index(int i, int j) const { return surface_.index(i, j); }
  bool Contains(int i, int j) const { return i >= 0 && j >= 0 && i < nx() && j < ny(); }
  double x_m(int i) const { return surface_.origin_W_m.x() + i * surface_.cell_m; }
  double y_m(int j) const { return surface_.origin_W_m.y() + j * surface_.cell_m; }
  /// Nearest column's index along an axis, not limited to the site.
  int NearestI(double x_m) const;
  int NearestJ(double y_m) const;
  /// Bilinear height, the nearest border value outside the site.
  double HeightAt(double x_m, double y_m) const;

  /// Surface between the columns, bilinear; the nearest border's outside the site.
  struct Sample {
    double top_m, pressed_m;
    std::size_t k;  ///< a column beside
  };
  Sample SampleAt(double x_m, double y_m) const;

  const Column& at(std::size_t k) const { return columns_[k]; }
  const TerrainSurface& surface() const { return surface_; }
  const std::vector<SoilType>& soils() const { return soils_; }
  /// Soil at the surface of a column, as an index into soils().
  std::uint8_t soil_at(std::size_t k) const;

  /// Raises the undisturbed ground, before anything has moved: no soil is moved from elsewhere.
  void Raise(std::size_t k, double dz_m);
  /// Takes everything above z_m away.
  Spoil Cut(std::size_t k, double z_m);
  /// Takes up to `thickness_m` of loose soil away.
  Spoil TakeLoose(std::size_t k, double thickness_m);
  /// Puts loose soil on a column.
  void Deposit(std::size_t k, const Spoil& spoil);
  /// Deposit by place; beyond the site's border it leaves the ledger's ground for its outside.
  void DepositAt(int i, int j, const Spoil& spoil);
  /// Presses the surface down by `ds_m`: loose soil and then the upper `influence_m` of the bank
  /// become denser. What exceeds the greatest density is returned, to be put beside.
  Spoil Press(std::size_t k, double ds_m, double influence_m);
  /// Turns `thickness_m` of the top of the bank, which must be free of loose soil, into loose soil.
  void Break(std::size_t k, double thickness_m);
  /// Marks a column as touched by a running gear.
  void MarkRut(std::size_t k);

  /// A shovel stands in this column from `low_m` upwards: soil higher than that does not slide in.
  void Block(std::size_t k, double low_m) { blocked_m_[k] = static_cast<float>(low_m); }
  void Unblock(std::size_t k);
  double blocked_m(std::size_t k) const { return blocked_m_[k]; }

  double GroundMass_kg() const;
  double outside_kg() const { return outside_kg_; }

  /// Columns changed since the last call, each once, in order of change.
  std::vector<std::uint32_t> TakeChanged();

 private:
  void Changed(std::size_t k);
  void ShowRut(std::size_t k, double rut);
  void BumpTiles(std::size_t k);

  TerrainSurface surface_;
  std::vector<SoilType> soils_;
  std::vector<Column> columns_;
  double area_m2_ = 0;
  double floor_m_ = 0;  ///< level from which the bank's mass is counted
  double outside_kg_ = 0;
  std::vector<std::uint32_t> changed_;
  std::vector<std::uint8_t> is_changed_;
  std::vector<float> blocked_m_;  ///< lowest point of a shovel that stands in it, else infinite
};

}  // namespace tera
