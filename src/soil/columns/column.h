#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "soil/columns/spoil.h"
#include "soil/columns/undisturbed_ground.h"
#include "soil/soil.h"

namespace tera {

/// A layer of one soil in a column, above the undisturbed ground.
struct SoilLayer {
  double thickness_m = 0;
  double kgpm2 = 0;    ///< mass per square metre
  float moisture = 0;  ///< degree of saturation, 0..1
  std::uint8_t soil = 0;
  bool loose = true;  ///< loose soil flows; other soil stands like undisturbed soil

  double density_kgpm3() const { return kgpm2 / thickness_m; }
};

/// A vertical column of ground: undisturbed soil up to `bank_m`, then layers of compacted or
/// deposited soil.
///
/// Model   Undisturbed soil has the density of its stratum; layers have their own. A column has at
///         most kMostLayers layers. Beyond that, the two neighbours with the smallest joint
///         thickness are merged. The merged layer takes the soil of the heavier one. Mass per area
///         is kept in double precision.
struct Column {
  static constexpr int kMostLayers = 5;

  double ground_m = 0;   ///< z of the original surface; strata are counted in depth below it
  double bank_m = 0;     ///< z of the top of the undisturbed soil
  double top_m = 0;      ///< z of the surface
  double pressed_m = 0;  ///< plastic sinkage of this surface, for reloading under running gear
  std::array<SoilLayer, kMostLayers> layers;  ///< from the lowest up
  int layer_count = 0;
  std::uint8_t profile = 0;

  const SoilLayer* top_layer() const {
    return layer_count > 0 ? &layers[layer_count - 1] : nullptr;
  }
  /// True if the soil at the surface is loose.
  bool is_loose() const { return layer_count > 0 && layers[layer_count - 1].loose; }
  /// Thickness of the loose soil at the surface.
  double loose_m() const;
  /// Mass per square metre gained since the start; negative for a loss.
  double Gain_kgpm2(const GroundProfile& profile) const;
};

/// Strata and soils of the columns of one profile, and the area of a column.
struct ColumnMaterial {
  const GroundProfile& profile;
  const std::vector<SoilType>& soils;
  double area_m2;
};

/// Removes all soil above z_m and adds it to `cut`. Loose soil keeps its density. Undisturbed and
/// compacted soil swells to its loose density.
void CutColumn(const ColumnMaterial& material, double z_m, Column* column, SpoilMix* cut);

/// Adds loose soil on top.
void DepositOn(const ColumnMaterial& material, const Spoil& spoil, Column* column);

/// Compression of the surface of a column.
struct Pressing {
  double ds_m;         ///< sinkage of the surface in this step
  double influence_m;  ///< depth of the soil that may become denser
  double pressure_pa = std::numeric_limits<double>::infinity();
};

/// Presses the surface down. Loose soil at the surface settles first, until it reaches bank density
/// and counts as standing soil. Then all soil within the influence depth becomes denser. Soil above
/// the density that this pressure reaches (PressedDensity_kgpm3) is removed and added to `beside`.
void PressColumn(const ColumnMaterial& material, const Pressing& pressing, Column* column,
                 SpoilMix* beside);

/// Mean stiffness factor (FirmnessAt) of the uppermost 0.3 m, the width of Terzaghi's test plate.
double FirmnessOf(const Column& column, const std::vector<SoilType>& soils);

}  // namespace tera
