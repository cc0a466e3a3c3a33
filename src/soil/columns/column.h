#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "soil/columns/spoil.h"
#include "soil/columns/undisturbed_ground.h"
#include "soil/soil.h"

namespace tera {

/// Soil of one kind in a column, on top of the undisturbed ground.
struct SoilLayer {
  double thickness_m = 0;
  double kgpm2 = 0;    ///< mass for each square metre
  float moisture = 0;  ///< degree of saturation, 0..1
  std::uint8_t soil = 0;
  bool loose = true;  ///< it flows; otherwise it stands like bank soil

  double density_kgpm3() const { return kgpm2 / thickness_m; }
};

/// One vertical column of ground: undisturbed soil up to `bank_m`, then soil that was compacted or
/// put on it.
///
/// Model   undisturbed soil has its stratum's density, layers their own. There are at most
///         kMostLayers; the two thinnest neighbours of a fuller column become one, of the heavier
///         one's soil. Mass is kept per area in double precision.
struct Column {
  static constexpr int kMostLayers = 5;

  double ground_m = 0;   ///< z of the undisturbed surface, below which its strata lie
  double bank_m = 0;     ///< z of the top of the undisturbed soil
  double top_m = 0;      ///< z of the surface
  double pressed_m = 0;  ///< plastic sinkage pressed into this surface, for reloading
  std::array<SoilLayer, kMostLayers> layers;  ///< from below
  int layer_count = 0;
  std::uint8_t profile = 0;

  const SoilLayer* top_layer() const {
    return layer_count > 0 ? &layers[layer_count - 1] : nullptr;
  }
  /// Whether loose soil lies at the surface.
  bool is_loose() const { return layer_count > 0 && layers[layer_count - 1].loose; }
  /// Thickness of the loose soil at the surface.
  double loose_m() const;
  /// Mass for each square metre that it has more than at the start.
  double Gain_kgpm2(const GroundProfile& profile) const;
};

/// Material of the columns of a profile, and their cross-section.
struct ColumnMaterial {
  const GroundProfile& profile;
  const std::vector<SoilType>& soils;
  double area_m2;
};

/// Takes everything above z_m away and adds it to `cut`. Loose soil keeps its density; soil that
/// stood swells.
void CutColumn(const ColumnMaterial& material, double z_m, Column* column, SpoilMix* cut);

/// Puts loose soil on top.
void DepositOn(const ColumnMaterial& material, const Spoil& spoil, Column* column);

/// A pressing of a column's surface.
struct Pressing {
  double ds_m;         ///< by which the surface gives way
  double influence_m;  ///< depth of the soil that may become denser
  double pressure_pa = std::numeric_limits<double>::infinity();
};

/// Loose soil at the surface gives way first, until it is as dense as bank soil and stands like it;
/// then the upper soil becomes denser. Soil beyond the density that the pressure yields is shoved
/// away and added to `beside`.
void PressColumn(const ColumnMaterial& material, const Pressing& pressing, Column* column,
                 SpoilMix* beside);

/// Firmness (FirmnessAt) of a column's uppermost 0.3 m, as wide as Terzaghi's plate.
double FirmnessOf(const Column& column, const std::vector<SoilType>& soils);

}  // namespace tera
