#include "sim/operators/dig_cycle.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "sim/operators/dig_poses.h"
#include "sim/operators/joint_servo.h"

namespace tera {
namespace {

using namespace dig;

constexpr double kLeverRate_1ps = 5.0;  // a hand goes from neutral to full lever in 0.2 s
constexpr double kTrackRate_1ps = 1.5;  // the hand is slower on the tracks
constexpr double kTipTolerance_m = 0.12;
// A cut in a trench ends if the machine tilts by more than this during it.
constexpr double kGiveUpLean_rad = 10 * kDeg;
// A raised cut in a trench sinks back at this speed once the tip moves freely.
constexpr double kSinkAgain_mps = 0.1;
constexpr double kEntryTolerance_m = 0.06;  // for the entry into a trench
constexpr double kAngleTolerance_rad = 6 * kDeg;
constexpr double kSlewAtRest_radps = 5 * kDeg;  // slew rate below which it may lower or dump
constexpr double kSwingHeight = 0.6;     // share of the dump height from which the slew may begin
constexpr double kCutLag_m = 0.15;       // lag of the tip beyond which the target stops
constexpr double kStallLift_mps = 0.15;  // speed at which the target of a stalled cut rises
// Share of the struck capacity at which the bucket counts as full.
constexpr double kFullShare = 0.9;
// Maximum duration of the cut, over its duration without resistance.
constexpr double kCutPatience = 1.6;
// Share of the initial load below which the bucket counts as empty.
constexpr double kDumpedShare = 0.05;
// Shares of the cut's length for the descent at its start and the ascent at its end.
constexpr double kRampIn = 0.35, kRampOut = 0.2;
// Share of the ascent at which the cut ends, with the tip still in the ground.
constexpr double kRampEnd = 0.3;
constexpr int kGroundSamples = 24;
// Step and maximum number of steps by which an unreachable target moves inwards.
constexpr double kDrawIn_m = 0.05;
constexpr int kDrawIns = 60;
// Duration of the curl, and the motion of the tip inwards and upwards during it, in bucket lengths.
// Without this motion the back of the bucket would turn into the ground.
constexpr double kCurl_s = 1.3;
// Share of the turn by which the target leads the bucket's angle.
constexpr double kCurlLead = 0.12;
constexpr double kCurlDrag = 0.19, kCurlLift = 0.71;

double Smooth(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * (3 - 2 * s);
}

/// The angle equivalent to `angle_rad` that is nearest to `reference_rad`.
double Nearest(double angle_rad, double reference_rad) {
  return angle_rad + 2 * kPi * std::round((reference_rad - angle_rad) / (2 * kPi));
}

double TipError_m(const PlanarArm::Tip& a, const PlanarArm::Tip& b) {
  return std::hypot(a.r_m - b.r_m, a.z_m - b.z_m);
}

}  // namespace

DigCycle::DigCycle(const MachineModel& model, const DigPlan& plan)
    : plan_(plan),
      arm_(model, plan.joints, plan.tip_frame),
      dig_azimuth_rad_(plan.dig_azimuth_rad),
      dump_azimuth_rad_(plan.dump_azimuth_rad),
      cut_{plan.reach_m, plan.cut_length_m, 0} {
  if (!plan.trench) return;
  trench_.emplace(*plan.trench);
  if (plan.blade >= 0) blade_ = PlacesOfBlade(model, plan.blade);
}

std::vector<double> DigCycle::Levers(const OperatorView& view) {
  std::vector<double> levers(view.model.levers.size(), 0.0);
  if (!started_) {
    started_ = true;
    X_WJ_start_ = SlewFrame(view);
    last_ns_ = view.t_ns;
    if (trench_) {
      stand_m_ = trench_->first_stand_m();
      rim_m_ = trench_->Rim_m(view.ground, AxisStation(view));
    }
    Enter(trench_ ? Phase::kMove : Phase::kApproach, view);
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

  levers_.resize(levers.size(), 0.0);
  dead_zones_.resize(levers.size());
  if (phase_ == Phase::kMove) DriveTracks(view, &levers);
  for (std::size_t i = 0; i < levers.size(); ++i) {
    const int joint = view.model.levers[i].joint;
    if (joint < 0) {
      const double reach = kTrackRate_1ps * dt_s;
      levers[i] = std::clamp(levers[i], levers_[i] - reach, levers_[i] + reach);
      continue;
    }
    const auto servo = [&](double q_rad, double qd_radps) {
      levers[i] = ServoLever(view.model, view.state, joint, q_rad, qd_radps, plan_.servo_gain_1ps);
    };
    if (trench_ && joint == plan_.blade) {
      servo(phase_ == Phase::kMove ? blade_.up_rad : blade_.anchored_rad, 0);
    }
    if (joint == plan_.joints.slew) levers[i] = SlewLever(view, target.slew_rad);
    if (joint == plan_.joints.boom) servo(angles.boom_rad, rate(angles.boom_rad, before.boom_rad));
    if (joint == plan_.joints.arm) servo(angles.arm_rad, rate(angles.arm_rad, before.arm_rad));
    if (joint == plan_.joints.bucket) {
      servo(angles.bucket_rad, rate(angles.bucket_rad, before.bucket_rad));
    }
    levers[i] =
        dead_zones_[i].Lever(levers[i], ShareOfFullRate(view.model, view.state, joint), dt_s);
    const double reach = kLeverRate_1ps * dt_s;
    levers[i] = std::clamp(levers[i], levers_[i] - reach, levers_[i] + reach);
  }
  levers_ = levers;
  return levers;
}

double DigCycle::SlewLever(const OperatorView& view, double target_rad) const {
  // In a trench the walls hold the bucket, so the slew would turn the machine instead.
  const bool is_between_walls =
      trench_ && (phase_ == Phase::kCut || phase_ == Phase::kCurl || phase_ == Phase::kLift);
  if (is_between_walls) return 0;
  const int joint = plan_.joints.slew;
  const double q_rad = view.state.q_rad[joint];
  const double nearest_rad = Nearest(target_rad, q_rad);
  const double lever =
      ServoLever(view.model, view.state, joint, nearest_rad, 0, plan_.servo_gain_1ps);
  if (plan_.slew_braking_radps2 <= 0) return lever;
  const double rate_radps =
      std::sqrt(2 * plan_.slew_braking_radps2 * std::abs(nearest_rad - q_rad));
  const Joint& slew = view.model.joints[joint];
  return std::clamp(lever, -rate_radps / slew.max_rate_negative_radps,
                    rate_radps / slew.max_rate_positive_radps);
}

void DigCycle::Enter(Phase phase, const OperatorView& view) {
  phase_ = phase;
  phase_start_ns_ = view.t_ns;
  phase_tip_ = TipNow(view.state);
  phase_load_kg_ = LoadOf(view).mass_kg;
  if (phase == Phase::kLower) up_W_ = view.state.links[0].X_WB.linear().col(2);
  last_angles_.reset();
  if (trench_ && phase == Phase::kApproach) ChooseCut(view);
  if (trench_ && phase == Phase::kLift) ChooseDump(view);
  drives_ = false;
  if (phase == Phase::kCut) StartCut(view);
}

void DigCycle::StartCut(const OperatorView& view) {
  cut_s_m_ = trench_ ? -kPlunge_m : 0;
  cut_raised_m_ = 0;
  cut_ground_m_.clear();
  for (int k = 0; k <= kGroundSamples; ++k) {
    const double r_m = cut_.reach_m - cut_.length_m * k / kGroundSamples;
    cut_ground_m_.push_back(
        trench_ ? trench_->GroundAt(view.ground, AxisStation(view) - r_m, cut_.offset_m)
                : GroundInPlane(view, DigPlace(view).slew_rad, r_m));
  }
}

void DigCycle::Advance(const OperatorView& view) {
  const Target target = TargetNow(view);
  const PlanarArm::Tip tip = TipNow(view.state);
  const double slew_rad = view.state.q_rad[plan_.joints.slew];
  const bool slewed = std::abs(Nearest(target.slew_rad, slew_rad) - slew_rad) < kAngleTolerance_rad;
  const bool stands =
      slewed && std::abs(view.state.qd_radps[plan_.joints.slew]) < kSlewAtRest_radps;
  const bool placed = ArmError_rad(view, target.tip) < kAngleTolerance_rad;
  const double time_s = PhaseTime_s(view);
  const bool late = time_s > plan_.patience_s;
  const SoilReaction::Load load = LoadOf(view);

  switch (phase_) {
    case Phase::kMove:
      AdvanceMove(view, slewed && placed);
      break;
    case Phase::kApproach:
      if ((stands && placed) || late) Enter(Phase::kLower, view);
      break;
    case Phase::kLower:
      if (TipError_m(tip, target.tip) < (trench_ ? kEntryTolerance_m : kTipTolerance_m) || late)
        Enter(Phase::kCut, view);
      break;
    case Phase::kCut:
      // A tip that is ahead of its target, towards the machine, is not held back.
      AdvanceCut(view, trench_
                           ? IsHeldBack(view, tip, target.tip)
                           : tip.r_m > target.tip.r_m && TipError_m(tip, target.tip) >= kCutLag_m);
      if (cut_s_m_ >= cut_.length_m || (trench_ && Lean_rad(view) > kGiveUpLean_rad) ||
          load.volume_m3 > kFullShare * Capacity_m3(view) ||
          time_s >
              kCutPatience * (cut_.length_m + (trench_ ? kPlunge_m : 0)) / plan_.cut_speed_mps) {
        Enter(Phase::kCurl, view);
      }
      break;
    case Phase::kCurl:
      if (time_s > kCurl_s && (placed || late)) Enter(Phase::kLift, view);
      break;
    case Phase::kLift:
      if (trench_ ? IsLifted(view, tip)
                  : (late || tip.z_m - GroundInPlane(view, slew_rad, tip.r_m) >
                                 kSwingHeight * plan_.dump_height_m)) {
        Enter(Phase::kSwing, view);
      }
      break;
    case Phase::kSwing:
      if (stands || late) Enter(Phase::kDump, view);
      break;
    case Phase::kDump:
      if ((placed && load.mass_kg <= kDumpedShare * phase_load_kg_) || late) {
        ++cycle_;
        dig_azimuth_rad_ += plan_.azimuth_step_rad;
        const bool done = plan_.cycles > 0 && cycle_ >= plan_.cycles;
        const Phase back = plan_.clear_dump_rad > 0 ? Phase::kReturn : Phase::kApproach;
        Enter(done ? Phase::kDone : back, view);
      }
      break;
    case Phase::kReturn:
      if (slewed || late ||
          std::abs(Nearest(DumpPlace(view).slew_rad, slew_rad) - slew_rad) >=
              plan_.clear_dump_rad) {
        Enter(Phase::kApproach, view);
      }
      break;
    case Phase::kDone:
      break;
  }
}

void DigCycle::AdvanceCut(const OperatorView& view, bool held_back) {
  const double dt_s = ToSeconds(view.t_ns - last_ns_);
  if (!held_back) {
    cut_s_m_ += plan_.cut_speed_mps * dt_s;
    if (trench_) cut_raised_m_ = std::max(0.0, cut_raised_m_ - kSinkAgain_mps * dt_s);
  } else {
    cut_raised_m_ += kStallLift_mps * dt_s;
  }
}

Pose DigCycle::SlewFrame(const OperatorView& view) const {
  const Joint& slew = view.model.joints[plan_.joints.slew];
  return view.state.links[slew.parent].X_WB * slew.X_PJ;
}

DigCycle::Place DigCycle::PlaceOf(const OperatorView& view, double azimuth_rad, double r_m) const {
  const Vec3& axis = view.model.joints[plan_.joints.slew].axis_J;
  const Vec3 p_W = X_WJ_start_ * (Eigen::AngleAxisd(azimuth_rad, axis) * Vec3(r_m, 0, 0));
  const Vec3 p_J = SlewFrame(view).inverse() * p_W;
  return {std::atan2(axis.dot(Vec3::UnitX().cross(p_J)), p_J.x()), p_J.head<2>().norm()};
}

DigCycle::Place DigCycle::DumpPlace(const OperatorView& view) const {
  return PlaceOf(view, dump_azimuth_rad_, plan_.dump_reach_m);
}

DigCycle::Place DigCycle::DigPlace(const OperatorView& view) const {
  return {PlaceOf(view, dig_azimuth_rad_, plan_.reach_m).slew_rad, plan_.reach_m};
}

DigCycle::Target DigCycle::TargetNow(const OperatorView& view) const {
  if (trench_) return TrenchTarget(view);
  const Place dump = DumpPlace(view), dig = DigPlace(view);
  const double dump_ground_m = GroundInPlane(view, dump.slew_rad, dump.r_m);
  const PlanarArm::Tip carry = {dump.r_m - kCarryInside_m,
                                dump_ground_m + plan_.dump_height_m + kCarryAbove_m,
                                kCarryPitch_rad};
  const double dig_ground_m = GroundInPlane(view, dig.slew_rad, dig.r_m);
  switch (phase_) {
    case Phase::kApproach:
      return {{dig.r_m, dig_ground_m + kClearance * arm_.bucket_length_m(), kEntryPitch_rad},
              dig.slew_rad};
    case Phase::kLower:
      return {{dig.r_m, dig_ground_m, kEntryPitch_rad}, dig.slew_rad};
    case Phase::kCut:
      return {CutPoint(cut_s_m_), dig.slew_rad};
    case Phase::kCurl:
      return {CurlTip(view, kCurlDrag), dig.slew_rad};
    case Phase::kLift:
      return {carry, dig.slew_rad};
    case Phase::kSwing:
      return {carry, dump.slew_rad};
    case Phase::kDump:
    case Phase::kDone:
      return {{dump.r_m, dump_ground_m + plan_.dump_height_m, kDumpPitch_rad}, dump.slew_rad};
    case Phase::kReturn:
      return {{dump.r_m, carry.z_m, kDumpPitch_rad}, dig.slew_rad};
    case Phase::kMove:
      break;  // occurs only with a trench
  }
  return {};
}

PlanarArm::Tip DigCycle::CurlTip(const OperatorView& view, double drag) const {
  // The target waits for a slow bucket. Otherwise the arm would spill the load.
  const double turned = (TipNow(view.state).pitch_rad - phase_tip_.pitch_rad) /
                        (kCarryPitch_rad - phase_tip_.pitch_rad);
  const double s = std::min(Smooth(PhaseTime_s(view) / kCurl_s), std::max(turned, 0.0) + kCurlLead);
  const double bucket_m = arm_.bucket_length_m() * s;
  return {phase_tip_.r_m - drag * bucket_m, phase_tip_.z_m + kCurlLift * bucket_m,
          Mix(phase_tip_.pitch_rad, kCarryPitch_rad, s)};
}

PlanarArm::Tip DigCycle::CutPoint(double s_m) const {
  const double s = std::clamp(s_m / plan_.cut_length_m, 0.0, 1.0);
  const double depth_m =
      plan_.cut_depth_m * std::min(Smooth(s / kRampIn), Smooth((1.0 - s) / kRampOut + kRampEnd));
  const double at = s * kGroundSamples;
  const int k = std::min(static_cast<int>(at), kGroundSamples - 1);
  const double ground_m = Mix(cut_ground_m_[k], cut_ground_m_[k + 1], at - k);
  return {plan_.reach_m - s * plan_.cut_length_m, ground_m - depth_m + cut_raised_m_,
          Mix(kEntryPitch_rad, kCutEndPitch_rad, s)};
}

double DigCycle::GroundInPlane(const OperatorView& view, double azimuth_rad, double r_m) const {
  const Vec3& axis = view.model.joints[plan_.joints.slew].axis_J;
  const Vec3 p_W = SlewFrame(view) * (Eigen::AngleAxisd(azimuth_rad, axis) * Vec3(r_m, 0, 0));
  // The plane is nearly vertical, so a height difference in W equals one along z of the plane.
  return view.ground.HeightAt(p_W.x(), p_W.y()) - p_W.z();
}

PlanarArm::Angles DigCycle::ReachableAngles(const MachineModel& model,
                                            const PlanarArm::Tip& tip) const {
  PlanarArm::Tip nearer = tip;  // moves inwards until it is reachable
  std::optional<PlanarArm::Angles> angles = arm_.Inverse(nearer);
  for (int k = 0; !angles && k < kDrawIns; ++k) {
    nearer.r_m -= kDrawIn_m;
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

double DigCycle::ArmError_rad(const OperatorView& view, const PlanarArm::Tip& tip) const {
  const PlanarArm::Angles angles = ReachableAngles(view.model, tip);
  const std::vector<double>& q_rad = view.state.q_rad;
  return std::max({std::abs(angles.boom_rad - q_rad[plan_.joints.boom]),
                   std::abs(angles.arm_rad - q_rad[plan_.joints.arm]),
                   std::abs(angles.bucket_rad - q_rad[plan_.joints.bucket])});
}

SoilReaction::Load DigCycle::LoadOf(const OperatorView& view) const {
  const auto& loads = view.state.shovel_load;
  return plan_.shovel < static_cast<int>(loads.size()) ? loads[plan_.shovel] : SoilReaction::Load{};
}

double DigCycle::Capacity_m3(const OperatorView& view) const {
  return view.model.ground_tools.shovels[plan_.shovel].capacity_m3;
}

double DigCycle::PhaseTime_s(const OperatorView& view) const {
  return ToSeconds(view.t_ns - phase_start_ns_);
}

}  // namespace tera
