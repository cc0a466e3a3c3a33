#pragma once

#include <optional>

#include "core/config/config.h"
#include "sim/operators/dead_zone_compensation.h"
#include "sim/operators/operator.h"
#include "sim/operators/planar_arm.h"

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
/// Omits   force control; avoidance of obstacles; boom swing and travel stay neutral.
class DigCycle : public Operator {
 public:
  DigCycle(const MachineModel& model, const DigPlan& plan);
  std::vector<double> Levers(const OperatorView& view) override;

 private:
  enum class Phase { kApproach, kLower, kCut, kCurl, kLift, kSwing, kDump, kReturn, kDone };

  struct Target {
    PlanarArm::Tip tip;
    double slew_rad = 0;
  };

  /// The cycle's places relative to the machine's current pose.
  struct Place {
    double slew_rad, r_m;
  };

  Pose SlewFrame(const OperatorView& view) const;
  Place PlaceOf(const OperatorView& view, double azimuth_rad, double r_m) const;
  Place DumpPlace(const OperatorView& view) const;
  Place DigPlace(const OperatorView& view) const;
  void Enter(Phase phase, const OperatorView& view);
  void Advance(const OperatorView& view);
  Target TargetNow(const OperatorView& view) const;
  PlanarArm::Tip CutPoint(double s_m) const;
  double GroundInPlane(const OperatorView& view, double azimuth_rad, double r_m) const;
  PlanarArm::Angles ReachableAngles(const MachineModel& model, const PlanarArm::Tip& tip) const;
  PlanarArm::Tip TipNow(const MachineState& state) const;
  double Capacity_m3(const OperatorView& view) const;
  double SlewLever(const OperatorView& view, double target_rad) const;
  void AdvanceCut(const OperatorView& view, double lag_m);
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
};

/// Reads the keys of `type: dig_cycle`. Returns nothing and reports to `config` if the machine has
/// no such arm.
std::optional<DigPlan> ReadDigPlan(const ConfigMap& config, const MachineModel& model);

}  // namespace tera
