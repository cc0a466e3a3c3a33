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

/// A track or wheel on the ground: it carries, drives, steers, sinks and leaves a rut.
///
/// Frames  W; patches as in ContactPatch, in the frame B of the gear's link.
/// Model   Normal force: points on each patch bear elastically with p = s k_e pen, where pen is the
///         penetration. The pressure is at most Bekker's at the sinkage of the point. The factor s
///         has peaks under road wheels and the mean 1. Rut models the plastic sinkage below.
///         Damping is a fraction of critical for the mass that the pressure supports. It acts
///         against motion along the vertical of the machine; the ground never pulls.
///         Shear: each patch has a shear displacement j that moves with the shoes: dj/dt = v_slip -
///         v_shoe (j - j_upstream) / length. It is zero where a shoe first meets the ground. Slip
///         is relative to the soil, which yields under a descending shoe. The soil yields in the
///         direction half-way between the normal of the patch and the machine's down, so that
///         rolling raised patches cause no shear. The stress is (c + p tan phi)(1 - exp(-|j|/K))
///         along j, see terramechanics.h. At rest it acts as a spring; at steady slip it gives the
///         closed-form thrust. WheelContact models wheels.
///         Sides: a sunk side face that is pushed into soil meets passive pressure. The pressure
///         grows with the mean displacement of the soil beside the gear. The side of a track that
///         leans far enough bears like its shoes, see SideFaces.
///         Resistance: work on the rut that comes from forward motion acts as a drag over a short
///         distance. Gear that does not shear the ground is only carried: it has no shear force and
///         no drag. An obstacle low enough to climb bears the gear like pavement, moves with its
///         own velocity and covers the ground below.
/// Omits   Shear on the sides of grousers, tension of the track.
/// Source  Bekker 1969; Janosi and Hanamoto 1961; Wills 1963; side faces: Hegedus 1960, see
///         PushedFace.
class GearContact {
 public:
  /// `soils` are the soils of the ground, scaled by the footing of the machine.
  GearContact(const RunningGear& gear, bool shears, std::vector<SoilType> soils);

  struct Result {
    Wrench wrench;          ///< about the link's origin
    double traction_n = 0;  ///< shear on the shoes along the machine's forward travel
    double sinkage_m = 0;
    double slip = 0;    ///< 1 - v / (r w), with v along the link's x axis at the contact
    double grip_n = 0;  ///< shear strength of the ground under all patches
  };
  Result Act(const BodyState& body, double rate_radps, double dt_s, const LowObstacles& obstacles,
             Columns* ground);

 private:
  struct Patch {
    int upstream = -1, downstream = -1;  ///< neighbours against and along the travel of the shoes
    Vec2 j_in_m = Vec2::Zero();          ///< shear displacement where shoes enter the patch
    Vec2 j_out_m = Vec2::Zero();         ///< shear displacement where shoes leave the patch
    double pushed_m = 0;                 ///< lateral displacement of its side face into soil
    bool in_contact = false;
    bool is_on_wheel = false;
    double shear_modulus_m = 0;  ///< of the soil of the last contact
    /// Ends the contact. The soil between the grousers and its shear decay with the distance moved.
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
    /// position along the patch from its middle; pressure divided by the mean pressure
    double along_m, share;
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
  std::vector<std::vector<Row>> rows_;  ///< for each patch; empty until it first bears
  std::vector<WheelContact> wheels_;
  Rut rut_;
  double contact_m_ = 0;    ///< length of the ground under the gear
  double forward_mps_ = 0;  ///< mean speed over the ground at the contact
  double deepest_m_ = 0;    ///< sinkage of the lowest patch
  double rut_work_j_ = 0;   ///< plastic work that the drag has not yet paid
};

}  // namespace tera
