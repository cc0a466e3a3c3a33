#pragma once

#include <vector>

#include "core/types/terrain_surface.h"
#include "soil/columns/columns.h"
#include "soil/columns/spoil.h"
#include "soil/soil.h"

namespace tera {

/// A truck's bed and the soil that lies in it.
///
/// Frames  W; B of the bed's carrier; F of the floor: axes of B, origin on the middle of the floor.
/// Model   Columns of their own on the floor, F fixed; the walls are their border. The wall at the
///         tail, towards -x, is a gate. The soil is seen as clods at rest, one for each column. How
///         it flows there: BedFlow.
/// Omits   the carrier's acceleration, the walls' thickness and resistance to shovels.
class Bed {
 public:
  Bed(const SoilBed& shape, const std::vector<SoilType>& soils);

  void Move(const Pose& X_WB, bool gate_is_open = false);
  const Pose& X_WF() const { return X_WF_; }
  /// Against gravity, in F.
  Vec3 up_F() const { return X_WF_.linear().row(2); }
  /// Whether a point lies over the floor.
  bool Holds(const Vec3& p_W_m) const;
  /// The soil, and the floor where there is none, in F.
  const Columns& columns() const { return columns_; }
  Columns& columns() { return columns_; }
  /// Keeps a point in F within the walls, and takes the velocity into them; an open gate is none.
  void KeepWithinWalls(Vec3* p_F_m, Vec3* v_F_mps) const;
  /// Lays soil down at a place in W.
  void Deposit(const Vec3& p_W_m, const Spoil& spoil);
  /// Soil that falls off over the rim, and the place and velocity in W with which it leaves.
  struct Overflow {
    SpoilMix soil;
    Vec3 p_W_m, v_W_mps;
  };
  /// Takes the soil above `rim_m` in a column at the border. It leaves with a velocity in F, at
  /// least at a slow walk outwards.
  Overflow TakeOverflow(int i, int j, double rim_m, const Vec2& v_F_mps);

  double wall_m() const { return shape_.wall_m; }
  bool gate_is_open() const { return gate_is_open_; }
  BedLoad load() const { return load_; }
  /// The mass that the columns hold.
  double mass_kg() const { return columns_.GroundGain().net_kg; }
  /// The soil as it is seen.
  void Show(std::vector<TerrainSurface::Grain>* grains) const;

 private:
  SoilBed shape_;
  Vec2 half_m_;  ///< of the inner box
  Pose X_WF_ = Pose::Identity();
  bool gate_is_open_ = false;
  Columns columns_;
  BedLoad load_;
};

}  // namespace tera
