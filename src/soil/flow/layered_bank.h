#pragma once

#include <array>
#include <span>
#include <vector>

#include "soil/columns/columns.h"

namespace tera {

/// A layer of one soil in a bank.
struct BankLayer {
  double height_m = 0;
  std::uint8_t soil = 0;
};

/// Layers of a bank from its top down, without the loose soil on it.
struct BankLayers {
  static constexpr int kMost = 6;

  std::array<BankLayer, kMost> layer;
  int count = 0;

  BankLayers(ColumnId k, double height_m, const Columns& ground);
  std::span<const BankLayer> all() const {
    return std::span(layer).first(static_cast<std::size_t>(count));
  }
};

/// A slip surface of a bank, from its toe up.
struct SlipSurface {
  struct Part {
    double height_m = 0;
    double tan_slope = 0;
  };
  std::array<Part, BankLayers::kMost> part;
  int count = 0;            ///< number of parts; the soil above them cracks vertically
  double tan_friction = 0;  ///< mean over the soils along the surface, weighted by length
  double drives_over_holds = 0;

  /// Height above the toe at a horizontal distance behind it; infinite behind the crack.
  double HeightAt(double behind_m) const;
  /// Horizontal and vertical extent.
  double length_m() const;
  double height_m() const;
};

/// Finds the slip surface with the least safety in a layered bank.
///
/// Model   The face of the bank rises over a horizontal length `run_m`. Only surfaces that reach
///         the ground more than `beyond_m` behind the toe count. The slipping soil moves as one
///         block at an angle omega below horizontal. Its slip surface has a kink at each layer
///         border: in layer k its slope is omega + phi_k (upper bound). The weight drives with W
///         sin(omega); each layer resists with c_k L_k cos(phi_k). In a single soil this is
///         Culmann's wedge. The search covers all omega, surfaces through all layers, and surfaces
///         that end at a layer border. The layers above such a border crack vertically and act as
///         load only. The crack depth of a layer is 2 c / (rho g) tan(45 deg + phi / 2).
/// Omits   Slips within an upper layer alone, water in cracks.
/// Source  Chen 1975, Limit Analysis and Soil Plasticity, ch. 9; cracks: Terzaghi 1943, Theoretical
///         Soil Mechanics, ch. 9.
class LayeredBanks {
 public:
  explicit LayeredBanks(const std::vector<SoilType>& soils);
  SlipSurface LeastSafe(std::span<const BankLayer> layers, double run_m, double beyond_m) const;

 private:
  /// The safety varies little around its minimum. Steps of 3 deg overestimate it by 0.5 % for
  /// vertical faces, and by 4 % for a face only 15 deg steeper than friction.
  static constexpr int kAngles = 29;
  struct Soil {
    double weight_npm3, crack_m, tan_friction;
    /// horizontal extent of the slip surface divided by its vertical extent; 0 for a vertical one
    std::array<double, kAngles> goes;
    /// resistance from cohesion against the motion of the block
    std::array<double, kAngles> hold_pa;
  };
  SlipSurface SlipAt(std::span<const BankLayer> layers, int cracked, double run_m, int angle) const;

  std::vector<Soil> soils_;
};

}  // namespace tera
