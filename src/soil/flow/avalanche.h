#pragma once

#include <cstdint>
#include <vector>

#include "soil/columns/column_set.h"
#include "soil/columns/columns.h"
#include "soil/flow/standing_wall.h"

namespace tera {

class Grains;

/// Loose soil that flows down slopes, and banks that fail.
///
/// Model   Depth-averaged flow of the loose soil on top of each column, over the standing soil. The
///         faces between columns have velocities: gravity drives them down the slope of the
///         surface, momentum is carried along, and Coulomb friction acts against the flow's
///         direction. The slope that counts is the surface's full gradient, so that piles are
///         round. Ground at rest starts to flow where it is steeper than the start angle. Friction
///         mu_slow of slow flow lies between that and the angle of repose. Soil flows with speed v
///         in the upper thickness h of the loose depth H. Its friction is mu_slow (1 + (r - 1)
///         f(Fr) g(h / H)) + b I, Fr = v / sqrt(g h), I = 5/2 Fr d / h. f rises from 0 to 1 between
///         Froude numbers of 0.1 and 0.5, g between a skin and the whole depth. r is the soil's
///         `fast_flow_friction`. It exceeds 1 for moist crumbs; for dry grains it is below 1, so
///         that columns run out as far as Lube measured. I is the inertial number of a Bagnold
///         profile, d the soil's grain. The flowing layer is several times the loose soil above the
///         slope of slow friction, plus the soil that has come along. Deeper soil rests. All
///         velocities of a step come from one state, and so do all masses: the order of columns
///         does not matter. Banks fail as in StandingWalls. Only columns near a change are visited.
///         Nothing flows into a column in which a tool stands lower than the surface beside.
///         Columns may stand on a tilted floor of steel, t the tangent of its tilt. Gravity sees a
///         slope s of them as (s + t) / (1 - s t). Where t exceeds the friction of steel and no
///         wall below holds the soil, its whole depth slides on the floor. t + K s drives it
///         against that friction, K Rankine's active coefficient.
/// Omits   vertical acceleration, earth pressure other than hydrostatic but on a floor, entrainment
///         of bank soil, flow over the site's border; that a heap's own thrust lets it slide on a
///         floor that is a little less steep; that a load slides together behind a shut wall.
/// Source  Savage and Hutter 1989; runout of columns: Lube et al. 2004; start and stop angles:
///         Pouliquen and Forterre 2002; inertial number: Jop, Forterre and Pouliquen 2006; moist
///         columns run out less: Artoni et al. 2013 (arXiv 1401.2028), Sharma et al. 2024 (arXiv
///         2402.07285); how much friction of fast moist soil rises is this project's estimate.
class Avalanche {
 public:
  explicit Avalanche(const std::vector<SoilType>& soils);
  /// Lets time pass. Every few milliseconds of it, visits columns changed since the last visit and
  /// those still flowing. Wedges that fail become grains.
  void Flow(double dt_s, Columns* ground, Grains* grains);
  /// From now on all columns stand on a floor of steel, `up` against gravity in their axes. Whether
  /// it is open at its lower end.
  void StandOnSteel(const Vec3& up, bool is_open, Columns* ground);
  /// Whether a soil slides on that floor.
  bool SlidesOnSteel(std::uint8_t soil) const {
    return is_open_ && tilt_.norm() > steel_[soil].tan_start;
  }
  /// Velocity of the soil that crosses a column's faces towards +x and +y.
  Vec2 VelocityBeside(ColumnId k) const {
    return k < motion_.size() ? Vec2(motion_[k].face_mps[kX], motion_[k].face_mps[kY])
                              : Vec2(Vec2::Zero());
  }
  /// Columns to be visited next, besides those that change until then.
  std::size_t active_count() const { return active_.size(); }

 private:
  enum Axis { kX = 0, kY = 1 };
  struct Motion {
    double face_mps[2] = {0, 0};  ///< on the faces towards +x and +y
    double mobile_m = 0;          ///< of the loose soil, from the surface down: the part that flows
    double outflow_m = 0;         ///< of it wanted in this step
    bool rests = true;            ///< of a visited one: it does not flow and is gentle
    /// For a visited one, the slope of the loose soil across each axis. Firm soil, above it or
    /// below, pushes nothing sideways.
    double across_slope[2] = {0, 0};
  };
  struct Friction {
    double tan_start, tan_slow;
    double fast_over_slow;
    double grain_m;

    struct Layer {
      double flow_m, loose_m;
    };
    double Braked(double before_mps, double speed_mps, const Layer& layer, double gravity_mps2,
                  double dt_s) const;
  };
  /// Forces on the soil at a face: its drive and its friction.
  struct Drive {
    double along, across;  ///< slopes, against which it flows
    double gravity_mps2;   ///< normal to the surface that it flows on
    const Friction* friction;
    bool slides = false;  ///< on the floor, as deep as it lies
  };
  struct Flux {
    ColumnId column, beside;  ///< on both sides of a face
    Axis axis;
    double velocity_mps = 0;
    double along = 0;     ///< slope of the surface there, along the axis
    double gradient = 0;  ///< along both axes
    bool slides = false;  ///< on the floor

    ColumnId source() const { return velocity_mps > 0 ? column : beside; }
    ColumnId target() const { return velocity_mps > 0 ? beside : column; }
  };
  void Step(double dt_s, Columns* ground, Grains* grains);
  void FailWalls(double dt_s, Columns* ground, Grains* grains);
  void Wake(ColumnId k, Columns* ground);
  double VelocityOf(ColumnId k, int di, int dj, Axis axis, const Columns& ground) const;
  bool Flows(ColumnId k, const Columns& ground) const;
  void LookAround(ColumnId k, const Columns& ground);
  Drive OnFloor(const Drive& level, Axis axis, std::uint8_t soil) const;
  Flux FluxAt(ColumnId k, ColumnId to, Axis axis, double dt_s, const Columns& ground) const;
  void FindFluxes(double dt_s, const Columns& ground);
  void Mobilise(const Flux& flux, const Columns& ground);
  double Wanted_m(const Flux& flux, double dt_s, const Columns& ground);
  void MoveSoil(double dt_s, Columns* ground);

  double pending_s_ = 0;  ///< passed since the last visit
  int steps_ = 0;
  StandingWalls walls_;
  Vec2 tilt_ = Vec2::Zero();  ///< slope of the floor, along x and y
  bool is_tilted_ = false, is_open_ = false;
  double normal_mps2_ = 0;          ///< of gravity, normal to the floor
  std::vector<Friction> friction_;  ///< one for each soil
  std::vector<Friction> steel_;     ///< the same on a floor of steel
  std::vector<double> thrust_;      ///< of each soil, Rankine's active coefficient
  ColumnSet active_;                ///< to be visited at the next step
  ColumnSet is_visited_;            ///< in this step
  std::vector<ColumnId> visited_;   ///< the same, in the order of their ids
  std::vector<Motion> motion_;      ///< by id
  std::vector<Flux> fluxes_;
  std::vector<Columns::Transfer> moved_;  ///< by the fluxes
};

}  // namespace tera
