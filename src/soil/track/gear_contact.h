#pragma once

#include <cmath>
#include <vector>

#include "core/types/ground_tools.h"
#include "soil/columns/columns.h"
#include "soil/track/low_obstacles.h"
#include "soil/track/plate.h"
#include "soil/track/rut.h"
#include "soil/track/wheel_contact.h"

namespace tera {

/// Track or wheel on the ground: carries, drives, steers, sinks and leaves a rut.
///
/// Frames  W; patches as in ContactPatch, in the frame B of the gear's link.
/// Model   Normal: points fixed to each patch bear elastically, p = s k_e pen, at most Bekker's
///         pressure at their sinkage; s has peaks under road wheels and the mean 1. The rut below
///         is Rut's. Damping is a fraction of critical for the mass that the pressure carries,
///         against motion along the machine's vertical, and the ground never pulls. Tangential:
///         each patch has a shear displacement j, carried along by the moving shoes: dj/dt = v_slip
///         - v_shoe (j - j_upstream) / length; it is zero where a shoe meets the ground. Slip is
///         over the soil, which gives way as a rolling shoe comes down on it, half-way between the
///         patch's normal and the machine's down, so that raised patches that roll shear nothing.
///         Stress (c + p tan phi)(1 - exp(-|j|/K)) along j, see terramechanics.h: a spring at rest,
///         the closed-form thrust at steady slip. Wheels: WheelContact. Sides: a sunk side face
///         pushed into soil meets passive pressure, mobilised by the way by which a place beside
///         the gear is pushed. When a leaning machine's track faces down with its side, the side
///         bears as its shoes do, see SideFaces. Resistance: work done on the rut by moving on,
///         rather than down, acts as a drag over a short distance. Gear that does not shear the
///         ground is carried alone: no shear force, no drag. An obstacle low enough for the gear to
///         climb bears it as pavement does and moves under it with its own velocity. It keeps the
///         gear off the ground below.
/// Omits   shear on the sides of grousers, tension of the track.
/// Source  Bekker 1969; Janosi and Hanamoto 1961; Wills 1963; side faces:
///         Hegedus 1960, see PushedFace.
class GearContact {
 public:
  /// `soils` are those of the ground, as the machine meets them.
  GearContact(const RunningGear& gear, bool shears, std::vector<SoilType> soils);

  struct Result {
    Wrench wrench;          ///< about the link's origin
    double traction_n = 0;  ///< shear on the shoes along the machine's forward travel
    double sinkage_m = 0;
    double slip = 0;    ///< 1 - v / (r w), v along the link's x axis where the gear bears
    double grip_n = 0;  ///< shear strength of the ground under all patches
  };
  Result Act(const BodyState& body, double rate_radps, double dt_s, const LowObstacles& obstacles,
             Columns* ground);

 private:
  struct Patch {
    int upstream = -1, downstream = -1;  ///< neighbours against and along the shoes' travel
    Vec2 j_in_m = Vec2::Zero();          ///< shear displacement where shoes enter the patch
    Vec2 j_out_m = Vec2::Zero();         ///< shear displacement where shoes leave the patch
    double pushed_m = 0;                 ///< by its side face into the soil beside it, across
    bool in_contact = false;
    bool is_on_wheel = false;
    double shear_modulus_m = 0;  ///< of the soil that it last stood on
    /// Off the ground it keeps the soil between its ribs, and their shear, until it has moved on.
    void Lift(double moved_m) {
      in_contact = false;
      const double kept = shear_modulus_m > 0 ? std::exp(-moved_m / shear_modulus_m) : 0;
      j_in_m *= kept;
      j_out_m *= kept;
    }
  };
  struct Step;
  struct Pressed;
  void ActOn(std::size_t k, const Step& step, const LowObstacles& obstacles, GearSum* sum);
  struct Row {
    double along_m, share;  ///< from the patch's middle; of its pressure
  };
  const std::vector<Row>& RowsOf(std::size_t patch_index, double cell_m);
  Pressed Bear(std::size_t patch_index, const Footprint& foot, double touching,
               const BodyState& body, const Columns& ground, const LowObstacles& obstacles);
  void Carry(std::size_t k, const Footprint& foot, const Pressed& pressed, const Step& step,
             GearSum* sum);
  Vec2 Shear(std::size_t k, const Pressed& pressed, const Vec2& slip_mps, const Step& step);
  double PushAside_n(std::size_t k, const Footprint& foot, const Step& step);
  Vec3 PayBack(const Vec3& v_WB_mps, double dt_s);

  RunningGear gear_;
  bool has_sides_ = false;
  bool shears_ = true;
  std::vector<SoilType> soils_;
  std::vector<Patch> patches_;
  std::vector<Plate> plates_;
  std::vector<std::vector<Row>> rows_;  ///< of each patch that has borne
  std::vector<WheelContact> wheels_;
  Rut rut_;
  double contact_m_ = 0;    ///< length of the ground under the gear
  double forward_mps_ = 0;  ///< mean speed over the ground where it bears
  double deepest_m_ = 0;    ///< sinkage of its lowest patch
  double rut_work_j_ = 0;   ///< plastic work still to be paid back as drag
};

}  // namespace tera
