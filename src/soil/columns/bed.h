#pragma once

#include <vector>

#include "core/types/terrain_surface.h"
#include "soil/columns/columns.h"
#include "soil/columns/spoil.h"
#include "soil/soil.h"

namespace tera {

/// The load bed of a truck and the soil in it.
///
/// Frames  W; B is the frame of the carrier. F has the axes of B and its origin at the middle of
///         the floor.
/// Model   The bed has its own columns, which stand on the floor and are fixed in F. The walls are
///         the border of these columns. The wall towards -x is the gate. BedFlow moves the soil.
///         The renderer draws the soil as resting clods, one for each column.
/// Omits   Acceleration of the carrier, thickness of the walls, resistance of the walls to shovels.
class Bed {
 public:
  Bed(const SoilBed& shape, const std::vector<SoilType>& soils);

  void Move(const Pose& X_WB, bool gate_is_open = false);
  const Pose& X_WF() const { return X_WF_; }
  /// Unit vector against gravity, in F.
  Vec3 up_F() const { return X_WF_.linear().row(2); }
  /// True if the point lies above the floor.
  bool Holds(const Vec3& p_W_m) const;
  /// Columns on the floor, in F. An empty column has the height of the floor.
  const Columns& columns() const { return columns_; }
  Columns& columns() { return columns_; }
  /// Clamps a point in F to the inside of the walls and zeroes the velocity across the wall that
  /// clamps it. An open gate does not clamp.
  void KeepWithinWalls(Vec3* p_F_m, Vec3* v_F_mps) const;
  /// Adds soil to the column nearest to a point in W.
  void Deposit(const Vec3& p_W_m, const Spoil& spoil);
  /// Soil that falls over the border of the bed, with its position and velocity in W.
  struct Overflow {
    SpoilMix soil;
    Vec3 p_W_m, v_W_mps;
  };
  /// Removes the loose soil above `rim_m` from a column at the border. The soil leaves at
  /// `v_F_mps`, but at least at 0.3 m/s outwards.
  Overflow TakeOverflow(int i, int j, double rim_m, const Vec2& v_F_mps);

  double wall_m() const { return shape_.wall_m; }
  bool gate_is_open() const { return gate_is_open_; }
  BedLoad load() const { return load_; }
  /// Mass of soil in the bed.
  double mass_kg() const { return columns_.GroundGain().net_kg; }
  /// Appends the soil as resting clods, as the renderer draws it.
  void Show(std::vector<TerrainSurface::Grain>* grains) const;

 private:
  SoilBed shape_;
  Vec2 half_m_;  ///< half the inner length and width
  Pose X_WF_ = Pose::Identity();
  bool gate_is_open_ = false;
  Columns columns_;
  BedLoad load_;
};

}  // namespace tera
