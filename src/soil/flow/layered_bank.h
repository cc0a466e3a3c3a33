#pragma once

#include <array>
#include <span>
#include <vector>

#include "soil/columns/columns.h"

namespace tera {

/// A part of a bank's height, of one soil.
struct BankLayer {
  double height_m = 0;
  std::uint8_t soil = 0;
};

/// Layers that a bank stands in, from its top down, without loose soil on it.
struct BankLayers {
  static constexpr int kMost = 6;

  std::array<BankLayer, kMost> layer;
  int count = 0;

  BankLayers(ColumnId k, double height_m, const Columns& ground);
  std::span<const BankLayer> all() const {
    return std::span(layer).first(static_cast<std::size_t>(count));
  }
};

/// A surface along which a bank slips, from its toe up.
struct SlipSurface {
  struct Part {
    double height_m = 0;
    double tan_slope = 0;
  };
  std::array<Part, BankLayers::kMost> part;
  int count = 0;            ///< above these parts soil cracks upright
  double tan_friction = 0;  ///< of the soils that it goes through, by its length in each
  double drives_over_holds = 0;

  /// Height above the toe at a level distance behind it; none (infinite) behind the crack.
  double HeightAt(double behind_m) const;
  /// Level and upright length.
  double length_m() const;
  double height_m() const;
};

/// Finds the surface on which a bank of layers is the least safe.
///
/// Model   The bank's face rises from the toe over `run_m`; its surface comes out farther behind
///         the toe than `beyond_m`. The slipping soil moves as one block at an angle omega below
///         the level. Its slip surface has a kink at each border, where it leaves layer k at omega
///         + phi_k (upper bound). The weight drives W sin(omega), and each layer holds c_k L_k
///         cos(phi_k). In one soil that is Culmann's wedge. The search covers all omega, the
///         surface through all layers, and the surfaces that run out along a border. Layers above
///         such a border crack upright to the depth 2 c / (rho g) tan(45 deg + phi / 2) of each,
///         and there are a mere load.
/// Omits   layers that slip on their own, water in cracks.
/// Source  Chen 1975, Limit Analysis and Soil Plasticity, ch. 9; cracks: Terzaghi 1943, Theoretical
///         Soil Mechanics, ch. 9.
class LayeredBanks {
 public:
  explicit LayeredBanks(const std::vector<SoilType>& soils);
  SlipSurface LeastSafe(std::span<const BankLayer> layers, double run_m, double beyond_m) const;

 private:
  /// The least safety is flat over the angle. Steps of 3 deg overestimate it by 0.5 % for upright
  /// faces, and by 4 % where the face is only 15 deg steeper than friction.
  static constexpr int kAngles = 29;
  struct Soil {
    double weight_npm3, crack_m, tan_friction;
    std::array<double, kAngles> goes;     ///< level over height of its slip surface; 0 if upright
    std::array<double, kAngles> hold_pa;  ///< of cohesion, against the block's motion
  };
  SlipSurface SlipAt(std::span<const BankLayer> layers, int cracked, double run_m, int angle) const;

  std::vector<Soil> soils_;
};

}  // namespace tera
