#include "sim/dig_cycle.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "sim/joint_servo.h"

namespace tera {
namespace {

constexpr double kServoGain_1ps = 5.0;
constexpr double kTipTolerance_m = 0.12;
constexpr double kAngleTolerance_rad = 6 * kDeg;
constexpr double kClearance_m = 0.45;     // of the tip above the ground before lowering or slewing
constexpr double kCutLag_m = 0.15;        // the target waits when the tip is this far behind
constexpr double kStallLift_mps = 0.12;   // how fast a stalled cut comes up
constexpr double kCutPatience = 2.2;      // times the undisturbed duration of the cut
constexpr double kDumpedFraction = 0.05;  // of the load at the start of the dump
constexpr double kMaxPhase_s = 6.0;       // a phase never holds the cycle up longer
// Pitches of the tip direction.
constexpr double kEntryPitch_rad = -75 * kDeg;
constexpr double kCutEndPitch_rad = -112 * kDeg;
constexpr double kCarryPitch_rad = -188 * kDeg;
constexpr double kDumpPitch_rad = -60 * kDeg;
// The cut goes down over its first part and comes up over its last.
constexpr double kRampIn = 0.35, kRampOut = 0.2;
constexpr int kGroundSamples = 24;

double Smooth(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * (3 - 2 * s);
}

double Mix(double a, double b, double s) { return a + (b - a) * s; }

/// The angle equal to `angle` that is nearest to `reference`.
double Nearest(double angle_rad, double reference_rad) {
  return angle_rad + 2 * kPi * std::round((reference_rad - angle_rad) / (2 * kPi));
}

}  // namespace

DigCycle::DigCycle(const MachineModel& model, const DigPlan& plan)
    : plan_(plan),
      arm_(model, plan.joints, plan.tip_frame),
      dig_azimuth_rad_(plan.dig_azimuth_rad) {}

std::vector<double> DigCycle::Levers(const OperatorView& view) {
  std::vector<double> levers(view.model.levers.size(), 0.0);
  if (!started_) {
    started_ = true;
    last_ns_ = view.t_ns;
    Enter(Phase::kApproach, view);
  }
  Advance(view);
  if (phase_ == Phase::kDone) return levers;

  const Target target = TargetNow(view);
  const PlanarArm::Angles angles = ReachableAngles(view.model, target.tip);
  const double dt_s = ToSeconds(view.t_ns - last_ns_);
  last_ns_ = view.t_ns;
  const auto rate = [&](double now, double before) {
    return phase_ == Phase::kCut && dt_s > 0 ? (now - before) / dt_s : 0.0;
  };
  const PlanarArm::Angles before = last_angles_.value_or(angles);
  last_angles_ = angles;

  for (std::size_t i = 0; i < levers.size(); ++i) {
    const int joint = view.model.levers[i].joint;
    if (joint < 0) continue;
    const auto servo = [&](double q_rad, double qd_radps) {
      levers[i] = ServoLever(view.model, view.state, joint, q_rad, qd_radps, kServoGain_1ps);
    };
    if (joint == plan_.joints.slew) servo(Nearest(target.slew_rad, view.state.q_rad[joint]), 0);
    if (joint == plan_.joints.boom) servo(angles.boom_rad, rate(angles.boom_rad, before.boom_rad));
    if (joint == plan_.joints.arm) servo(angles.arm_rad, rate(angles.arm_rad, before.arm_rad));
    if (joint == plan_.joints.bucket) {
      servo(angles.bucket_rad, rate(angles.bucket_rad, before.bucket_rad));
    }
  }
  return levers;
}

void DigCycle::Enter(Phase phase, const OperatorView& view) {
  phase_ = phase;
  phase_start_ns_ = view.t_ns;
  phase_tip_ = TipNow(view.state);
  last_angles_.reset();
  if (phase == Phase::kCut) {
    cut_s_m_ = 0;
    cut_raised_m_ = 0;
    cut_ground_m_.clear();
    for (int k = 0; k <= kGroundSamples; ++k) {
      const double r_m = plan_.reach_m - plan_.cut_length_m * k / kGroundSamples;
      cut_ground_m_.push_back(GroundInPlane(view, dig_azimuth_rad_, r_m));
    }
  }
}

void DigCycle::Advance(const OperatorView& view) {
  const Target target = TargetNow(view);
  const PlanarArm::Tip tip = TipNow(view.state);
  const double slew_error_rad =
      std::abs(Nearest(target.slew_rad, view.state.q_rad[plan_.joints.slew]) -
               view.state.q_rad[plan_.joints.slew]);
  const double tip_error_m = std::hypot(tip.r_m - target.tip.r_m, tip.z_m - target.tip.z_m);
  const bool pitched = std::abs(tip.pitch_rad - target.tip.pitch_rad) < 3 * kAngleTolerance_rad;
  const bool late = PhaseTime_s(view) > kMaxPhase_s;
  const double dt_s = ToSeconds(view.t_ns - last_ns_);
  double load_kg = 0;
  for (const SoilReaction::Load& load : view.state.shovel_load) load_kg += load.mass_kg;

  switch (phase_) {
    case Phase::kApproach:
      if ((slew_error_rad < kAngleTolerance_rad && tip_error_m < 2 * kTipTolerance_m) || late) {
        Enter(Phase::kLower, view);
      }
      break;
    case Phase::kLower:
      if (tip_error_m < kTipTolerance_m || PhaseTime_s(view) > 1.5) Enter(Phase::kCut, view);
      break;
    case Phase::kCut:
      if (tip_error_m < kCutLag_m) {
        cut_s_m_ += plan_.cut_speed_mps * dt_s;
      } else {
        cut_raised_m_ += kStallLift_mps * dt_s;
      }
      if (cut_s_m_ >= plan_.cut_length_m ||
          PhaseTime_s(view) > kCutPatience * plan_.cut_length_m / plan_.cut_speed_mps) {
        Enter(Phase::kCurl, view);
      }
      break;
    case Phase::kCurl:
      if (tip.pitch_rad < kCarryPitch_rad + 4 * kAngleTolerance_rad || PhaseTime_s(view) > 2.5) {
        Enter(Phase::kLift, view);
      }
      break;
    case Phase::kLift:
      if (tip.z_m - GroundInPlane(view, view.state.q_rad[plan_.joints.slew], tip.r_m) >
              0.7 * plan_.dump_height_m ||
          late) {
        Enter(Phase::kSwing, view);
      }
      break;
    case Phase::kSwing:
      if ((slew_error_rad < kAngleTolerance_rad && tip_error_m < 4 * kTipTolerance_m) || late) {
        Enter(Phase::kDump, view);
      }
      break;
    case Phase::kDump:
      if ((pitched && load_kg < kDumpedFraction * 100.0) || PhaseTime_s(view) > 2.5) {
        ++cycle_;
        dig_azimuth_rad_ += plan_.azimuth_step_rad;
        const bool done = plan_.cycles > 0 && cycle_ >= plan_.cycles;
        Enter(done ? Phase::kDone : Phase::kApproach, view);
      }
      break;
    case Phase::kDone:
      break;
  }
}

DigCycle::Target DigCycle::TargetNow(const OperatorView& view) const {
  const double dump_ground_m = GroundInPlane(view, plan_.dump_azimuth_rad, plan_.dump_reach_m);
  const PlanarArm::Tip carry = {plan_.dump_reach_m - 0.6, dump_ground_m + plan_.dump_height_m + 0.5,
                                kCarryPitch_rad};
  const double dig_ground_m = GroundInPlane(view, dig_azimuth_rad_, plan_.reach_m);
  switch (phase_) {
    case Phase::kApproach:
      return {{plan_.reach_m, dig_ground_m + kClearance_m, kEntryPitch_rad}, dig_azimuth_rad_};
    case Phase::kLower:
      return {{plan_.reach_m, dig_ground_m, kEntryPitch_rad}, dig_azimuth_rad_};
    case Phase::kCut:
      return {CutPoint(cut_s_m_), dig_azimuth_rad_};
    case Phase::kCurl: {
      const double s = Smooth(PhaseTime_s(view) / 1.2);
      return {{phase_tip_.r_m - 0.15 * s, phase_tip_.z_m + 0.55 * s,
               Mix(phase_tip_.pitch_rad, kCarryPitch_rad, s)},
              dig_azimuth_rad_};
    }
    case Phase::kLift:
      return {carry, dig_azimuth_rad_};
    case Phase::kSwing:
      return {carry, plan_.dump_azimuth_rad};
    case Phase::kDump:
    case Phase::kDone:
      return {{plan_.dump_reach_m, dump_ground_m + plan_.dump_height_m, kDumpPitch_rad},
              plan_.dump_azimuth_rad};
  }
  return {};
}

PlanarArm::Tip DigCycle::CutPoint(double s_m) const {
  const double s = std::clamp(s_m / plan_.cut_length_m, 0.0, 1.0);
  const double depth_m =
      plan_.cut_depth_m * std::min(Smooth(s / kRampIn), Smooth((1.0 - s) / kRampOut + 0.3));
  const double at = s * kGroundSamples;
  const int k = std::min(static_cast<int>(at), kGroundSamples - 1);
  const double ground_m = Mix(cut_ground_m_[k], cut_ground_m_[k + 1], at - k);
  return {plan_.reach_m - s * plan_.cut_length_m, ground_m - depth_m + cut_raised_m_,
          Mix(kEntryPitch_rad, kCutEndPitch_rad, s)};
}

double DigCycle::GroundInPlane(const OperatorView& view, double azimuth_rad, double r_m) const {
  const Joint& slew = view.model.joints[plan_.joints.slew];
  const Pose X_WJ =
      view.state.links[slew.parent].X_WB * slew.X_PJ * Eigen::AngleAxisd(azimuth_rad, slew.axis_J);
  const Vec3 p_W = X_WJ * Vec3(r_m, 0, 0);
  // The plane is nearly vertical: a height difference in W is one along the plane's z.
  return view.ground.HeightAt(p_W.x(), p_W.y()) - p_W.z();
}

PlanarArm::Angles DigCycle::ReachableAngles(const MachineModel& model,
                                            const PlanarArm::Tip& tip) const {
  PlanarArm::Tip nearer = tip;  // draw a target that is out of reach in, until it is not
  std::optional<PlanarArm::Angles> angles = arm_.Inverse(nearer);
  for (int k = 0; !angles && k < 60; ++k) {
    nearer.r_m -= 0.05;
    angles = arm_.Inverse(nearer);
  }
  if (!angles) angles = PlanarArm::Angles{};
  const auto clamp = [&](double q_rad, int joint) {
    return std::clamp(q_rad, model.joints[joint].lower_rad, model.joints[joint].upper_rad);
  };
  return {clamp(angles->boom_rad, plan_.joints.boom), clamp(angles->arm_rad, plan_.joints.arm),
          clamp(angles->bucket_rad, plan_.joints.bucket)};
}

PlanarArm::Tip DigCycle::TipNow(const MachineState& state) const {
  return arm_.Forward({state.q_rad[plan_.joints.boom], state.q_rad[plan_.joints.arm],
                       state.q_rad[plan_.joints.bucket]});
}

double DigCycle::PhaseTime_s(const OperatorView& view) const {
  return ToSeconds(view.t_ns - phase_start_ns_);
}

}  // namespace tera
