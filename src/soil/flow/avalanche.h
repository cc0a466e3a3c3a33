#pragma once

#include <cstdint>
#include <vector>

#include "soil/columns/column_set.h"
#include "soil/columns/columns.h"
#include "soil/flow/standing_wall.h"

namespace tera {

class Grains;

/// Flow of loose soil down slopes, and failure of banks.
///
/// Model   Depth-averaged flow of the loose soil on each column, over the standing soil. Velocities
///         live on the faces between columns. Gravity drives them down the surface, momentum is
///         advected, and Coulomb friction acts against the flow. The slope is the full gradient of
///         the surface, so that piles become round. Soil at rest starts to flow where it is steeper
///         than the start angle.
///         The friction coefficient mu_slow of slow flow lies between the start angle and the angle
///         of repose. For speed v, flowing thickness h and loose depth H, friction is mu_slow (1 +
///         (r - 1) f(Fr) g(h / H)) + b I.
///         Fr = v / sqrt(g h) is the Froude number. I = 5/2 Fr d / h is the inertial number of a
///         Bagnold profile for grain size d. f rises from 0 to 1 between Froude numbers of 0.1 and
///         0.5. g rises from 0 to 1 between a thin skin and the full depth. r is
///         `fast_flow_friction` of the soil. It exceeds 1 for moist crumbs. It is below 1 for dry
///         grains, so that columns of grains run out as far as Lube measured.
///         The flowing thickness is a multiple of the loose soil above the slope of slow friction,
///         plus inflowing soil. Deeper soil rests. All velocities of a step come from one state,
///         and all masses too, so the order of columns has no effect. Banks fail as in
///         StandingWalls. A step visits only columns near a change. A column takes no soil while a
///         tool in it stands lower than the neighbouring surface.
///         Columns may stand on a tilted steel floor, where t is the tangent of the tilt. A slope s
///         then counts as (s + t) / (1 - s t). Soil slides over its whole depth if t exceeds the
///         steel friction and no wall holds it. The drive of the slide is t + K s, with Rankine's
///         active coefficient K.
/// Omits   Vertical acceleration, entrainment of undisturbed soil, flow over the border of the
///         site. Earth pressure other than hydrostatic, except on a floor. Slides on a floor just
///         below the friction angle that the thrust of the heap would start. Slides of a whole load
///         behind a shut wall.
/// Source  Savage and Hutter 1989; runout of columns: Lube et al. 2004; start and stop angles:
///         Pouliquen and Forterre 2002; inertial number: Jop, Forterre and Pouliquen 2006; shorter
///         runout of moist columns: Artoni et al. 2013 (arXiv 1401.2028), Sharma et al. 2024 (arXiv
///         2402.07285). The rise of friction in fast moist soil is an estimate of this project.
class Avalanche {
 public:
  explicit Avalanche(const std::vector<SoilType>& soils);
  /// Advances time. Every 8 ms it visits the columns that changed or still flow. Failed wedges
  /// become grains.
  void Flow(double dt_s, Columns* ground, Grains* grains);
  /// Puts all columns on a steel floor. `up` is the direction against gravity in their axes.
  /// `is_open` is true if the lower end of the floor has no wall.
  void StandOnSteel(const Vec3& up, bool is_open, Columns* ground);
  /// True if the soil slides on the steel floor.
  bool SlidesOnSteel(std::uint8_t soil) const {
    return is_open_ && tilt_.norm() > steel_[soil].tan_start;
  }
  /// Velocity of the soil across the faces of a column towards +x and +y.
  Vec2 VelocityBeside(ColumnId k) const {
    return k < motion_.size() ? Vec2(motion_[k].face_mps[kX], motion_[k].face_mps[kY])
                              : Vec2(Vec2::Zero());
  }
  /// Number of columns that the next step must visit. Columns that change before that step are
  /// added later.
  std::size_t active_count() const { return active_.size(); }

 private:
  enum Axis { kX = 0, kY = 1 };
  struct Motion {
    double face_mps[2] = {0, 0};  ///< on the faces towards +x and +y
    double mobile_m = 0;          ///< thickness of the flowing soil, from the surface down
    double outflow_m = 0;         ///< sum of the thicknesses that all fluxes request in this step
    bool rests = true;  ///< set in a visit: no flow, and no slope steep enough to start one
    /// Set in a visit: slope of the loose soil across each axis. Firm soil exerts no lateral
    /// pressure and does not count.
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
  /// Driving slope and friction of the soil at a face.
  struct Drive {
    /// slopes along and across the axis of the face; soil flows against them
    double along, across;
    double gravity_mps2;  ///< gravity normal to the surface under the flow
    const Friction* friction;
    bool slides = false;  ///< the whole depth slides on the steel floor
  };
  struct Flux {
    ColumnId column, beside;  ///< the columns on both sides of a face
    Axis axis;
    double velocity_mps = 0;
    double along = 0;     ///< slope of the surface along the axis
    double gradient = 0;  ///< magnitude of the slope over both axes
    bool slides = false;  ///< slides on the steel floor

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

  double pending_s_ = 0;  ///< time since the last step
  int steps_ = 0;
  StandingWalls walls_;
  Vec2 tilt_ = Vec2::Zero();  ///< slope of the floor along x and y
  bool is_tilted_ = false, is_open_ = false;
  double normal_mps2_ = 0;          ///< gravity normal to the floor
  std::vector<Friction> friction_;  ///< one for each soil
  std::vector<Friction> steel_;     ///< one for each soil, on a steel floor
  std::vector<double> thrust_;      ///< one for each soil: Rankine's active coefficient
  ColumnSet active_;                ///< to visit in the next step
  ColumnSet is_visited_;            ///< visited in this step
  std::vector<ColumnId> visited_;   ///< the same columns, sorted by id
  std::vector<Motion> motion_;      ///< by id
  std::vector<Flux> fluxes_;
  std::vector<Columns::Transfer> moved_;  ///< transfers of the fluxes
};

}  // namespace tera
