#include "soil/columns/column.h"

#include <algorithm>
#include <limits>

#include "soil/columns/soil_type.h"
#include "soil/columns/soil_water.h"

namespace tera {
namespace {

constexpr double kThinnest_m = 1e-9;  ///< thinner layers are dropped
/// most compression in one iteration, as a share of the thickness of the layers
constexpr double kMostAtOnce = 0.5;
/// Width of the test plate that the subgrade moduli refer to.
constexpr double kFirmDepth_m = 0.3;

/// A share of a layer as moving soil. A layer may have mass but zero thickness, from rounding.
Spoil Parcel(const SoilLayer& layer, double share, const SoilType& soil, double area_m2) {
  const double kgpm2 = layer.kgpm2 * share;
  const double volume_m = layer.loose ? layer.thickness_m * share
                                      // undisturbed and compacted soil swells
                                      : kgpm2 / LooseDensity_kgpm3(soil);
  return {kgpm2 * area_m2, volume_m * area_m2, layer.soil, layer.moisture};
}

/// Merges two layers; the result has the soil of the heavier one.
SoilLayer Joined(const SoilLayer& a, const SoilLayer& b) {
  SoilLayer joined = a.kgpm2 >= b.kgpm2 ? a : b;
  joined.thickness_m = a.thickness_m + b.thickness_m;
  joined.kgpm2 = a.kgpm2 + b.kgpm2;
  if (joined.kgpm2 > 0) {
    joined.moisture =
        static_cast<float>((a.kgpm2 * a.moisture + b.kgpm2 * b.moisture) / joined.kgpm2);
  }
  return joined;
}

/// Makes room for one layer: merges the two neighbours with the smallest joint thickness.
void JoinThinnest(Column* c) {
  int best = 0;
  double thinnest_m = std::numeric_limits<double>::infinity();
  for (int n = 0; n + 1 < c->layer_count; ++n) {
    const double together_m = c->layers[n].thickness_m + c->layers[n + 1].thickness_m;
    if (together_m < thinnest_m) thinnest_m = together_m, best = n;
  }
  c->layers[best] = Joined(c->layers[best], c->layers[best + 1]);
  std::move(c->layers.begin() + best + 2, c->layers.begin() + c->layer_count,
            c->layers.begin() + best + 1);
  --c->layer_count;
}

double Layers_m(const Column& c) {
  double sum_m = 0;
  for (int n = 0; n < c.layer_count; ++n) sum_m += c.layers[n].thickness_m;
  return sum_m;
}

/// Density of a layer over that of undisturbed soil, both without the water from weather.
double DensityShare(const SoilLayer& layer, const SoilType& soil) {
  const double density_kgpm3 = layer.density_kgpm3();
  if (soil.unwetted_density_kgpm3 <= 0) return density_kgpm3 / soil.bank_density_kgpm3;
  const double moisture = layer.moisture;
  const double brought_kgpm3 =
      Porosity(density_kgpm3, moisture) * (moisture - soil.unwetted_moisture) * kWater_kgpm3;
  return (density_kgpm3 - brought_kgpm3) / soil.unwetted_density_kgpm3;
}

void AddLayer(const SoilLayer& layer, int at, Column* c) {
  if (c->layer_count == Column::kMostLayers) {
    JoinThinnest(c);
    at = std::min(at, c->layer_count);
  }
  std::move_backward(c->layers.begin() + at, c->layers.begin() + c->layer_count,
                     c->layers.begin() + c->layer_count + 1);
  c->layers[at] = layer;
  ++c->layer_count;
}

void CutBank(const ColumnMaterial& m, double z_m, Column* c, SpoilMix* cut) {
  double top_m = c->ground_m - c->bank_m;  // top_m and bottom_m are depths here
  const double bottom_m = c->ground_m - z_m;
  while (top_m < bottom_m) {
    const Stratum& stratum = m.profile.Below(top_m);
    const double thickness_m = std::min(bottom_m, stratum.bottom_m) - top_m;
    const SoilLayer layer{thickness_m, thickness_m * stratum.density_kgpm3, stratum.moisture,
                          stratum.soil, false};
    cut->Add(Parcel(layer, 1, m.soils[stratum.soil], m.area_m2));
    top_m = std::min(bottom_m, stratum.bottom_m);
  }
  c->bank_m = z_m;
}

/// Settles the loose soil at the surface until it reaches bank density and counts as standing soil.
/// Returns the part of `ds_m` that is left.
double SettleLoose(const ColumnMaterial& m, double ds_m, Column* c) {
  for (int n = c->layer_count - 1; n >= 0 && c->layers[n].loose && ds_m > 0; --n) {
    SoilLayer& layer = c->layers[n];
    const double least_m = layer.kgpm2 / m.soils[layer.soil].bank_density_kgpm3;
    const double take_m = std::min(ds_m, std::max(0.0, layer.thickness_m - least_m));
    layer.thickness_m -= take_m;
    ds_m -= take_m;
    if (layer.thickness_m - least_m < kThinnest_m) layer.loose = false;
  }
  return ds_m;
}

/// Turns undisturbed soil into layers, stratum by stratum, until the layers are `influence_m`
/// thick.
void ReachDown(const ColumnMaterial& m, double influence_m, Column* c) {
  double more_m = influence_m - Layers_m(*c);
  double depth_m = c->ground_m - c->bank_m;
  while (more_m > 0) {
    const Stratum& stratum = m.profile.Below(depth_m);
    const double take_m = std::min(more_m, stratum.bottom_m - depth_m);
    if (take_m < more_m && take_m < kThinnest_m) {  // end of the stratum within rounding
      depth_m = stratum.bottom_m;
      continue;
    }
    const SoilLayer layer{take_m, m.profile.Mass_kgpm2(depth_m, depth_m + take_m), stratum.moisture,
                          stratum.soil, false};
    c->bank_m -= take_m;
    if (c->layer_count > 0 && !c->layers[0].loose && c->layers[0].soil == layer.soil) {
      c->layers[0] = Joined(c->layers[0], layer);
    } else {
      AddLayer(layer, 0, c);
    }
    more_m -= take_m;
    depth_m += take_m;
  }
}

/// Compresses all layers by the same factor. Removes soil above the density that the pressure
/// reaches, or above the present density if that is higher.
void Compact(const ColumnMaterial& m, double ds_m, double pressure_pa, Column* c,
             SpoilMix* beside) {
  const double share = 1 - ds_m / Layers_m(*c);
  for (int n = 0; n < c->layer_count; ++n) {
    SoilLayer& layer = c->layers[n];
    const SoilType& soil = m.soils[layer.soil];
    const double most_kgpm3 =
        std::min(soil.max_density_kgpm3,
                 std::max(layer.density_kgpm3(), PressedDensity_kgpm3(soil, pressure_pa)));
    layer.thickness_m *= share;
    const double excess_kgpm2 = layer.kgpm2 - layer.thickness_m * most_kgpm3;
    if (excess_kgpm2 <= 0) continue;
    layer.kgpm2 -= excess_kgpm2;
    const double mass_kg = excess_kgpm2 * m.area_m2;
    beside->Add({mass_kg, mass_kg / LooseDensity_kgpm3(soil), layer.soil, layer.moisture});
  }
}

}  // namespace

double Column::loose_m() const {
  double sum_m = 0;
  for (int n = layer_count - 1; n >= 0 && layers[n].loose; --n) sum_m += layers[n].thickness_m;
  return sum_m;
}

double Column::Gain_kgpm2(const GroundProfile& profile) const {
  double gain_kgpm2 = 0;
  for (int n = 0; n < layer_count; ++n) gain_kgpm2 += layers[n].kgpm2;
  if (bank_m < ground_m) gain_kgpm2 -= profile.Mass_kgpm2(0, ground_m - bank_m);
  return gain_kgpm2;
}

void CutColumn(const ColumnMaterial& m, double z_m, Column* c, SpoilMix* cut) {
  while (c->layer_count > 0 && c->top_m > z_m) {
    SoilLayer& layer = c->layers[c->layer_count - 1];
    if (!layer.loose) c->pressed_m = 0;
    const bool whole = c->top_m - z_m > layer.thickness_m - kThinnest_m;
    const double share = whole ? 1 : (c->top_m - z_m) / layer.thickness_m;
    cut->Add(Parcel(layer, share, m.soils[layer.soil], m.area_m2));
    c->top_m -= layer.thickness_m * share;
    if (whole) {
      --c->layer_count;
    } else {
      layer.kgpm2 *= 1 - share;
      layer.thickness_m *= 1 - share;
    }
  }
  if (c->layer_count == 0 && c->bank_m > z_m) {
    CutBank(m, z_m, c, cut);
    c->pressed_m = 0;
  }
  c->top_m = c->bank_m + Layers_m(*c);
}

void DepositOn(const ColumnMaterial& m, const Spoil& spoil, Column* c) {
  const SoilLayer layer{spoil.volume_m3 / m.area_m2, spoil.mass_kg / m.area_m2, spoil.moisture,
                        spoil.soil, true};
  SoilLayer* top = c->layer_count > 0 ? &c->layers[c->layer_count - 1] : nullptr;
  if (top != nullptr && top->loose && top->soil == layer.soil) {
    *top = Joined(*top, layer);
  } else {
    AddLayer(layer, c->layer_count, c);
  }
  c->pressed_m = std::max(0.0, c->pressed_m - layer.thickness_m);
  c->top_m = c->bank_m + Layers_m(*c);
}

void PressColumn(const ColumnMaterial& m, const Pressing& pressing, Column* c, SpoilMix* beside) {
  c->pressed_m += pressing.ds_m;
  double rest_m = SettleLoose(m, pressing.ds_m, c);
  while (rest_m > 0) {
    ReachDown(m, pressing.influence_m, c);
    const double step_m = std::min(rest_m, kMostAtOnce * Layers_m(*c));
    Compact(m, step_m, pressing.pressure_pa, c, beside);
    rest_m -= step_m;
  }
  c->top_m = c->bank_m + Layers_m(*c);
}

double FirmnessOf(const Column& c, const std::vector<SoilType>& soils) {
  double left_m = kFirmDepth_m, share_m = 0;
  for (int n = c.layer_count - 1; n >= 0 && left_m > 0; --n) {
    const SoilLayer& layer = c.layers[n];
    const double depth_m = std::min(left_m, layer.thickness_m);
    if (layer.thickness_m > kThinnest_m) {
      share_m += depth_m * std::min(1.0, DensityShare(layer, soils[layer.soil]));
    }
    left_m -= depth_m;
  }
  return FirmnessAt((share_m + left_m) / kFirmDepth_m);
}

}  // namespace tera
