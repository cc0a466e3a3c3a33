#pragma once

#include <optional>

#include "core/config/config.h"
#include "sim/operators/dead_zone_compensation.h"
#include "sim/operators/operator.h"
#include "sim/operators/planar_arm.h"
#include "sim/operators/trench_work.h"

namespace tera {

/// Parameters of a dig cycle. Radii are measured from the slew axis. Azimuths are measured from the
/// undercarriage's x axis at the start, positive to the left. Heights are above the ground at that
/// place.
struct DigPlan {
  PlanarArm::Joints joints;
  int tip_frame = -1;
  int shovel = -1;  ///< the shovel that the bucket joint moves
  double dig_azimuth_rad = 0;
  double azimuth_step_rad = 0;  ///< added to dig_azimuth_rad after each cycle
  double dump_azimuth_rad = 0;
  double reach_m = 4.2;  ///< radius at which the teeth enter the ground
  double cut_length_m = 1.6;
  double cut_depth_m = 0.2;
  double cut_speed_mps = 0.7;
  double dump_reach_m = 3.8;
  double dump_height_m = 1.3;  ///< height of the bucket's tip while swinging and dumping
  /// Slew angle away from the dump place before the tip is lowered; 0: none.
  double clear_dump_rad = 0;
  double servo_gain_1ps = 4.0;  ///< feedback gain of all joints, see ServoLever
  /// Deceleration with which the slew approaches its target; 0: unlimited.
  double slew_braking_radps2 = 0;
  double patience_s = 4.0;  ///< the operator ends a phase after this time
  int cycles = 0;           ///< number of cycles; 0: endless
  bool to_design = false;   ///< dig the trench of the scenario's task instead of one place
  // The members below apply only with `to_design`.
  SkidSteerLevers tracks;
  int blade = -1;  ///< joint of a blade that anchors the machine during digging; -1: none
  std::optional<TrenchPlan> trench;
};

/// Operator that digs, lifts, slews, dumps and returns. Joint targets come from inverse kinematics
/// on the current ground.
///
/// Model   a sequence of phases. Each has a target for the bucket's tip in the arm's plane and one
///         for the slew; the joints follow by ServoLever. During the cut the tip's target moves
///         along the planned line. If the soil holds the tip back, the target stops and rises, as
///         an operator lifts a stalled bucket.
///         Levers pass through DeadZoneCompensation and are limited to the rate of a human hand.
///         The slew rate is at most sqrt(2 a e), so that the deceleration a stops it within the
///         remaining angle e.
///         When the machine turns or slides, the dump place stays fixed in W. The dig place keeps
///         its azimuth in W and its radius from the slew axis.
///
///         With a trench, TrenchWork chooses cuts and stands. A cut never goes below the design.
///         The slew keeps the bucket on the trench's line. The bucket is lifted upright out of the
///         trench before the machine slews. It dumps beside the trench, at the lowest of a few
///         places of the heap. From stand to stand the machine drives backwards along the line. The
///         work ends at the last stand, when no cut remains there.
/// Omits   force control; avoidance of obstacles; boom swing and travel stay neutral.
class DigCycle : public Operator {
 public:
  DigCycle(const MachineModel& model, const DigPlan& plan);
  std::vector<double> Levers(const OperatorView& view) override;

 private:
  enum class Phase { kMove, kApproach, kLower, kCut, kCurl, kLift, kSwing, kDump, kReturn, kDone };

  struct Target {
    PlanarArm::Tip tip;
    double slew_rad = 0;
  };

  /// Blade angles: in the ground, and raised for driving.
  struct BladePlaces {
    double anchored_rad = 0, up_rad = 0;
  };
  static BladePlaces PlacesOfBlade(const MachineModel& model, int joint);

  /// A place as slew angle and radius, relative to the machine's current pose.
  struct Place {
    double slew_rad, r_m;
  };

  /// Target that brings the tip to a point in W: the position of the tip in the arm's plane, and
  /// the slew angle at which this plane contains the point.
  Target InPlane(const OperatorView& view, const Vec3& p_W_m, double pitch_rad) const;

  // The functions below apply to a trench.
  Vec3 OnLine(const OperatorView& view, double r_m, double z_W_m) const;
  double AxisStation(const OperatorView& view) const;
  Target TrenchTarget(const OperatorView& view) const;
  Target Entry(const OperatorView& view, double z_W_m) const;
  Target CutTarget(const OperatorView& view) const;
  Target LiftTarget(const OperatorView& view) const;
  PlanarArm::Tip TrenchCarry(const OperatorView& view) const;
  /// Height of the tip above the slewing frame at which the lift out of a trench ends.
  double LiftEnd_m(const OperatorView& view) const;
  /// True if the bucket is above the trench's rim, or if the lift has taken too long.
  bool IsLifted(const OperatorView& view, const PlanarArm::Tip& tip) const;
  void ChooseCut(const OperatorView& view);
  void ChooseDump(const OperatorView& view);
  void AdvanceMove(const OperatorView& view, bool posed);
  void DriveTracks(const OperatorView& view, std::vector<double>* levers) const;
  /// Undercarriage heading, relative to the direction towards the trench's first end.
  double Heading_rad(const OperatorView& view) const;
  /// Tilt of the undercarriage relative to its attitude before the cut.
  double Lean_rad(const OperatorView& view) const;
  /// True if a cut in a trench must stop and rise: the tip lags, is pulled below its line, or the
  /// machine leans.
  bool IsHeldBack(const OperatorView& view, const PlanarArm::Tip& tip,
                  const PlanarArm::Tip& target) const;
  bool StandsAsPlanned(const OperatorView& view) const;

  Pose SlewFrame(const OperatorView& view) const;
  Place PlaceOf(const OperatorView& view, double azimuth_rad, double r_m) const;
  Place DumpPlace(const OperatorView& view) const;
  Place DigPlace(const OperatorView& view) const;
  void Enter(Phase phase, const OperatorView& view);
  void StartCut(const OperatorView& view);
  void Advance(const OperatorView& view);
  Target TargetNow(const OperatorView& view) const;
  PlanarArm::Tip CutPoint(double s_m) const;
  /// Tip during the curl of the bucket. In total it moves inwards by `drag` bucket lengths.
  PlanarArm::Tip CurlTip(const OperatorView& view, double drag) const;
  double GroundInPlane(const OperatorView& view, double azimuth_rad, double r_m) const;
  PlanarArm::Angles ReachableAngles(const MachineModel& model, const PlanarArm::Tip& tip) const;
  PlanarArm::Tip TipNow(const MachineState& state) const;
  double Capacity_m3(const OperatorView& view) const;
  double SlewLever(const OperatorView& view, double target_rad) const;
  void AdvanceCut(const OperatorView& view, bool held_back);
  double ArmError_rad(const OperatorView& view, const PlanarArm::Tip& tip) const;
  SoilReaction::Load LoadOf(const OperatorView& view) const;
  double PhaseTime_s(const OperatorView& view) const;

  DigPlan plan_;
  PlanarArm arm_;
  Phase phase_ = Phase::kApproach;
  TimeNs phase_start_ns_ = 0, last_ns_ = 0;
  int cycle_ = 0;
  bool started_ = false;
  Pose X_WJ_start_ =
      /// Frame of the slew joint at the start of the first cycle, or at the current stand.
      Pose::Identity();
  double dig_azimuth_rad_;
  double cut_s_m_ = 0;                ///< progress along the cut
  double cut_raised_m_ = 0;           ///< rise of the cut above its planned line, due to stalls
  std::vector<double> cut_ground_m_;  ///< ground heights along the cut when it was planned
  std::vector<double> levers_;        ///< last output
  std::vector<DeadZoneCompensation> dead_zones_;  ///< one per lever
  double phase_load_kg_ = 0;                      ///< load at the start of the phase
  PlanarArm::Tip phase_tip_;                      ///< tip at the start of the phase
  std::optional<PlanarArm::Angles> last_angles_;
  double dump_azimuth_rad_;
  std::optional<TrenchWork> trench_;
  TrenchCut cut_;
  int empty_pulls_ = 0;        ///< number of consecutive nearly empty loads
  Vec3 up_W_ = Vec3::UnitZ();  ///< the undercarriage's z axis before the cut
  double rim_m_ = 0;           ///< highest ground at the part of the trench in reach
  double stand_m_ = 0;         ///< station of the slew axis at the current or the next stand
  bool drives_ = false;        ///< arm and blade are ready for driving
  BladePlaces blade_;
};

/// Reads the keys of `type: dig_cycle` or, if `to_design`, of `type: dig_to_design`. If the machine
/// has no suitable arm, reports to `config` and returns nothing.
std::optional<DigPlan> ReadDigPlan(const ConfigMap& config, const MachineModel& model,
                                   bool to_design);

}  // namespace tera
