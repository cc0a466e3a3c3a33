#pragma once

#include <optional>

#include "core/config/config.h"
#include "sim/operators/dead_zone_compensation.h"
#include "sim/operators/operator.h"
#include "sim/operators/planar_arm.h"
#include "sim/operators/trench_work.h"

namespace tera {

/// Parameters of a dig cycle. Radii are from the slew axis. Azimuths are from the undercarriage's x
/// axis at the start, positive to the left. Heights are above the local ground.
struct DigPlan {
  PlanarArm::Joints joints;
  int tip_frame = -1;
  int shovel = -1;  ///< the shovel that the bucket joint moves
  double dig_azimuth_rad = 0;
  double azimuth_step_rad = 0;  ///< added to the dig azimuth after each cycle
  double dump_azimuth_rad = 0;
  double reach_m = 4.2;  ///< radius at which the teeth enter
  double cut_length_m = 1.6;
  double cut_depth_m = 0.2;
  double cut_speed_mps = 0.7;
  double dump_reach_m = 3.8;
  double dump_height_m = 1.3;   ///< height of the tip above the ground while swinging and dumping
  double clear_dump_rad = 0;    ///< slew angle from the dump place before the tip is lowered
  double servo_gain_1ps = 4.0;  ///< gain of all joints, see ServoLever
  double slew_braking_radps2 = 0;  ///< deceleration at which the slew stops; 0: at once
  double patience_s = 4.0;         ///< longest duration of a phase
  int cycles = 0;                  ///< 0: endless
  bool to_design = false;          ///< digs the scenario's task instead of one place
  // Only for that.
  SkidSteerLevers tracks;
  int blade = -1;  ///< joint of a blade that anchors the machine while it digs; -1: none
  std::optional<TrenchPlan> trench;
};

/// Digs, lifts, slews, dumps and returns. Joint targets come from inverse kinematics on the current
/// ground.
///
/// Model   a sequence of phases, each with a target of the tip in the arm's plane and of the slew;
///         joints follow by ServoLever. During the cut the target moves along the planned line. If
///         the soil holds the tip back, the target waits and rises, as an operator lifts a stalled
///         bucket. The levers pass through DeadZoneCompensation and are limited to the rate of a
///         hand. Places stay fixed in W when the tracks turn or slide, since an operator sees the
///         truck: the dump place fully, the dig place by its azimuth. The slew rate is at most
///         sqrt(2 a e), from which braking at a stops within the remaining angle e.
///
///         With a trench, each cycle's cut and the stands are those of TrenchWork. The cut follows
///         the design where that is above its depth, and the slew follows the trench's line. The
///         bucket is lifted upright out of the trench before it slews, and dumped where the heap
///         beside the machine is lowest. Between stands the machine backs along the line. Its work
///         ends at the last stand when no soil is left above the design.
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

  /// Angles of the blade's joint: in the ground, and up for driving.
  struct BladePlaces {
    double anchored_rad = 0, up_rad = 0;
  };
  static BladePlaces PlacesOfBlade(const MachineModel& model, int joint);

  /// The cycle's places relative to the machine's current pose.
  struct Place {
    double slew_rad, r_m;
  };

  /// A tip in the arm's plane and the slew that turns this plane to it.
  Target InPlane(const OperatorView& view, const Vec3& p_W_m, double pitch_rad) const;

  // The same for a trench.
  Vec3 OnLine(const OperatorView& view, double r_m, double z_W_m) const;
  double AxisStation(const OperatorView& view) const;
  Target TrenchTarget(const OperatorView& view) const;
  Target Entry(const OperatorView& view, double z_W_m) const;
  Target CutTarget(const OperatorView& view) const;
  Target LiftTarget(const OperatorView& view) const;
  PlanarArm::Tip TrenchCarry(const OperatorView& view) const;
  /// Height above the slewing frame at which the lift out of a trench ends.
  double LiftEnd_m(const OperatorView& view) const;
  /// Whether the bucket is over the trench's rim, or as high as it gets.
  bool IsLifted(const OperatorView& view, const PlanarArm::Tip& tip) const;
  void ChooseCut(const OperatorView& view);
  void ChooseDump(const OperatorView& view);
  void AdvanceMove(const OperatorView& view, bool posed);
  void DriveTracks(const OperatorView& view, std::vector<double>* levers) const;
  /// Angle of the undercarriage's heading from that to the trench's first end.
  double Heading_rad(const OperatorView& view) const;
  /// By how much the machine leans more than before the cut.
  double Lean_rad(const OperatorView& view) const;
  /// Whether a cut in a trench must wait and rise.
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
  /// Tip while the bucket curls; `drag` bucket lengths inwards in all.
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
      Pose::Identity();  ///< frame of the slew's axis at the start of the first cycle
  double dig_azimuth_rad_;
  double cut_s_m_ = 0;                            ///< along the cut
  double cut_raised_m_ = 0;                       ///< above the planned line, to get through
  std::vector<double> cut_ground_m_;              ///< heights in the plane when the cut was planned
  std::vector<double> levers_;                    ///< last output
  std::vector<DeadZoneCompensation> dead_zones_;  ///< one per lever
  double phase_load_kg_ = 0;                      ///< load at the start of the phase
  PlanarArm::Tip phase_tip_;                      ///< tip at the start of the phase
  std::optional<PlanarArm::Angles> last_angles_;
  double dump_azimuth_rad_;
  std::optional<TrenchWork> trench_;
  TrenchCut cut_;
  int empty_pulls_ = 0;        ///< in a row
  Vec3 up_W_ = Vec3::UnitZ();  ///< the undercarriage's z before the cut
  double rim_m_ = 0;           ///< highest ground at the trench at the start, then at each choice
  double stand_m_ = 0;         ///< station of the slew axis where it works, or to which it drives
  bool drives_ = false;        ///< arm and blade are in their places for driving
  BladePlaces blade_;
};

/// Reads the keys of `type: dig_cycle`, or of `dig_to_design`. Returns nothing and reports to
/// `config` if the machine has no such arm.
std::optional<DigPlan> ReadDigPlan(const ConfigMap& config, const MachineModel& model,
                                   bool to_design);

}  // namespace tera
