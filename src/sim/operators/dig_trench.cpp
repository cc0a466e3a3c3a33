#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "sim/operators/dig_cycle.h"
#include "sim/operators/dig_poses.h"

// The part of DigCycle that digs along a trench.

namespace tera {
namespace {

using namespace dig;

// Height of the tip above the rim, in bucket lengths; the bucket's back hangs below the tip.
constexpr double kOverRim = 0.75;
// Motion of the tip inwards during the curl in a trench, in bucket lengths.
constexpr double kUprightCurlDrag = 0.1;
constexpr double kLift_mps = 0.7;    // speed of the upright lift out of a trench
constexpr double kLoadShare = 0.95;  // share of the bucket's capacity that a cut is planned to take
// After kMostEmptyPulls consecutive pulls with less than this share of the bucket's capacity, the
// remaining soil counts as out of reach.
constexpr double kEmptyShare = 0.06;
constexpr int kMostEmptyPulls = 3;
constexpr double kHeapSteps_rad[] = {0, 15 * kDeg, -15 * kDeg};
// Driving along the trench's line:
constexpr double kArrived_m = 0.04, kStandsStill_mps = 0.01;
constexpr double kFastestDrive_mps = 0.4, kSlowestDrive_mps = 0.08, kEase_1ps = 1.0;
constexpr double kStandsStill_radps = 0.01;
constexpr double kStraight_rad = 2 * kDeg, kTurnFirst_rad = 12 * kDeg;
constexpr double kMostTowards_rad = 10 * kDeg;
constexpr double kLongestMove_s = 40;
// If pulls have moved or turned the machine by more than this, it drives to its stand again.
constexpr double kMostTurned_rad = 6 * kDeg, kMostDrift_m = 0.25;
// A cut stops and rises if the tip lags by kHeldBack_m, lies kPulledIn_m below its line, or the
// machine tilts by kEaseLean_rad. At kGiveUpLean_rad the cut ends.
constexpr double kHeldBack_m = 0.15, kPulledIn_m = 0.1;
constexpr double kEaseLean_rad = 6 * kDeg;
// The blade as an anchor:
constexpr double kAnchor_m = 0.08, kBladeTolerance_rad = 3 * kDeg;
constexpr int kBladeSteps = 50;
constexpr double kTowardsLine_radpm = 0.6, kTurn_1ps = 1.2, kMostYaw_radps = 0.25;

}  // namespace

double DigCycle::AxisStation(const OperatorView& view) const {
  return trench_->StationOf(SlewFrame(view).translation().head<2>());
}

Vec3 DigCycle::OnLine(const OperatorView& view, double r_m, double z_W_m) const {
  const Vec2 xy_m = trench_->PlaceAt(AxisStation(view) - r_m, cut_.offset_m);
  return {xy_m.x(), xy_m.y(), z_W_m};
}

DigCycle::Target DigCycle::InPlane(const OperatorView& view, const Vec3& p_W_m,
                                   double pitch_rad) const {
  const Vec3& axis = view.model.joints[plan_.joints.slew].axis_J;
  const Vec3 p_J_m = SlewFrame(view).inverse() * p_W_m;
  const PlanarArm::Tip tip{p_J_m.head<2>().norm(), p_J_m.z(), pitch_rad};
  return {WithinLimits(view.model, arm_, plan_.joints, tip).value_or(tip),
          std::atan2(axis.dot(Vec3::UnitX().cross(p_J_m)), p_J_m.x())};
}

PlanarArm::Tip DigCycle::TrenchCarry(const OperatorView& view) const {
  const Place dump = DumpPlace(view);
  const double over_heap_m =
      GroundInPlane(view, dump.slew_rad, dump.r_m) + plan_.dump_height_m + kCarryAbove_m;
  const double over_rim_m = InPlane(view, OnLine(view, trench_->plan().far_m, rim_m_), 0).tip.z_m +
                            kOverRim * arm_.bucket_length_m();
  return {dump.r_m - kCarryInside_m, std::max(over_heap_m, over_rim_m), kCarryPitch_rad};
}

DigCycle::Target DigCycle::TrenchTarget(const OperatorView& view) const {
  const Place dump = DumpPlace(view);
  const PlanarArm::Tip carry = TrenchCarry(view);
  const double far_slew_rad =
      InPlane(view, OnLine(view, trench_->plan().far_m, rim_m_), 0).slew_rad;
  const double entry_station_m = AxisStation(view) - cut_.reach_m;
  switch (phase_) {
    case Phase::kMove:
      return {carry, far_slew_rad};
    case Phase::kApproach:
      return Entry(view, rim_m_ + kClearance * arm_.bucket_length_m());
    case Phase::kLower:
      return Entry(view, trench_->GroundAt(view.ground, entry_station_m, cut_.offset_m));
    case Phase::kCut:
      return CutTarget(view);
    case Phase::kCurl: {
      const PlanarArm::Tip curl = CurlTip(view, kUprightCurlDrag);
      const PlanarArm::Tip tip = WithinLimits(view.model, arm_, plan_.joints, curl).value_or(curl);
      return {tip, InPlane(view, OnLine(view, tip.r_m, rim_m_), 0).slew_rad};
    }
    case Phase::kLift:
      return LiftTarget(view);
    case Phase::kSwing:
      return {carry, dump.slew_rad};
    case Phase::kReturn:
      return {{dump.r_m, carry.z_m, kDumpPitch_rad}, far_slew_rad};
    case Phase::kDump:
    case Phase::kDone:
      break;
  }
  const double dump_ground_m = GroundInPlane(view, dump.slew_rad, dump.r_m);
  return {{dump.r_m, dump_ground_m + plan_.dump_height_m, kDumpPitch_rad}, dump.slew_rad};
}

DigCycle::Target DigCycle::Entry(const OperatorView& view, double z_W_m) const {
  // The slew does not move during the cut. The arm's plane meets the trench's line at the middle of
  // the cut.
  const double middle_m = cut_.reach_m - 0.5 * cut_.length_m;
  return {InPlane(view, OnLine(view, cut_.reach_m, z_W_m), kEntryPitch_rad).tip,
          InPlane(view, OnLine(view, middle_m, z_W_m), kEntryPitch_rad).slew_rad};
}

DigCycle::Target DigCycle::CutTarget(const OperatorView& view) const {
  const double s_m = std::clamp(cut_s_m_, 0.0, cut_.length_m);
  const double r_m = cut_.reach_m - s_m;
  const double depth_m = plan_.cut_depth_m * std::clamp(1 + cut_s_m_ / kPlunge_m, 0.0, 1.0);
  const double last = static_cast<double>(cut_ground_m_.size() - 1);
  const double at = s_m / cut_.length_m * last;
  const auto k = static_cast<std::size_t>(std::clamp(at, 0.0, last - 1));
  const double ground_m = Mix(cut_ground_m_[k], cut_ground_m_[k + 1], at - static_cast<double>(k));
  const double design_m = trench_->DesignAt(AxisStation(view) - r_m, cut_.offset_m);
  const TrenchPlan& trench = trench_->plan();
  const double inwards = (trench.far_m - r_m) / (trench.far_m - trench.near_m);
  return InPlane(view, OnLine(view, r_m, std::max(ground_m - depth_m, design_m) + cut_raised_m_),
                 Mix(kEntryPitch_rad, kCutEndPitch_rad, inwards));
}

double DigCycle::LiftEnd_m(const OperatorView& view) const {
  return InPlane(view, OnLine(view, phase_tip_.r_m, rim_m_), 0).tip.z_m +
         (kOverRim + kClearance) * arm_.bucket_length_m();
}

DigCycle::Target DigCycle::LiftTarget(const OperatorView& view) const {
  const double z_m = std::min(phase_tip_.z_m + kLift_mps * PhaseTime_s(view), LiftEnd_m(view));
  const PlanarArm::Tip lift{phase_tip_.r_m, z_m, kCarryPitch_rad};
  return {WithinLimits(view.model, arm_, plan_.joints, lift).value_or(lift),
          InPlane(view, OnLine(view, phase_tip_.r_m, rim_m_), 0).slew_rad};
}

bool DigCycle::IsLifted(const OperatorView& view, const PlanarArm::Tip& tip) const {
  const double over_rim_m =
      InPlane(view, OnLine(view, tip.r_m, rim_m_), 0).tip.z_m + kOverRim * arm_.bucket_length_m();
  // The time limit counts from the end of the planned lift. A slew below the rim would press the
  // bucket against the walls.
  const double rise_s = (LiftEnd_m(view) - phase_tip_.z_m) / kLift_mps;
  return tip.z_m > over_rim_m || PhaseTime_s(view) > std::max(rise_s, 0.0) + plan_.patience_s;
}

void DigCycle::ChooseCut(const OperatorView& view) {
  if (!StandsAsPlanned(view)) {
    phase_ = Phase::kMove;
    return;
  }
  const double station_m = AxisStation(view);
  rim_m_ = trench_->Rim_m(view.ground, station_m);
  const std::optional<TrenchCut> cut =
      trench_->NextCut(view.ground, station_m, plan_.cut_depth_m, kLoadShare * Capacity_m3(view));
  if (cut && empty_pulls_ < kMostEmptyPulls) {
    cut_ = *cut;
    return;
  }
  empty_pulls_ = 0;
  const std::optional<double> next_m = trench_->NextStand(stand_m_);
  phase_ = next_m ? Phase::kMove : Phase::kDone;
  stand_m_ = next_m.value_or(stand_m_);
}

void DigCycle::ChooseDump(const OperatorView& view) {
  const bool is_empty = LoadOf(view).volume_m3 < kEmptyShare * Capacity_m3(view);
  empty_pulls_ = is_empty ? empty_pulls_ + 1 : 0;
  double lowest_m = std::numeric_limits<double>::infinity();
  for (const double step_rad : kHeapSteps_rad) {
    const double azimuth_rad =
        plan_.dump_azimuth_rad + std::copysign(1.0, plan_.dump_azimuth_rad) * step_rad;
    const Place place = PlaceOf(view, azimuth_rad, plan_.dump_reach_m);
    const double height_m = GroundInPlane(view, place.slew_rad, place.r_m);
    if (height_m >= lowest_m) continue;
    lowest_m = height_m;
    dump_azimuth_rad_ = azimuth_rad;
  }
}

DigCycle::BladePlaces DigCycle::PlacesOfBlade(const MachineModel& model, int joint) {
  const Joint& hinge = model.joints[joint];
  const auto lowest_m = [&](double q_rad) {
    std::vector<double> joints_rad(model.joints.size(), 0.0);
    joints_rad[joint] = q_rad;
    const Pose X_BL = ForwardKinematics(model, Pose::Identity(), joints_rad)[hinge.child];
    double lowest = std::numeric_limits<double>::infinity();
    for (const Shovel& shovel : model.ground_tools.shovels) {
      if (shovel.link != hinge.child) continue;
      for (const Vec2& point : shovel.profile_B_m) {
        lowest = std::min(lowest, (X_BL * Vec3(point.x(), 0, point.y())).z());
      }
    }
    return lowest;
  };
  const bool rises = lowest_m(hinge.upper_rad) > lowest_m(hinge.lower_rad);
  BladePlaces places;
  places.up_rad = rises ? hinge.upper_rad : hinge.lower_rad;
  const double down_rad = rises ? hinge.lower_rad : hinge.upper_rad;
  places.anchored_rad = places.up_rad;
  for (int k = 1; k <= kBladeSteps && lowest_m(places.anchored_rad) > -kAnchor_m; ++k) {
    places.anchored_rad = Mix(places.up_rad, down_rad, static_cast<double>(k) / kBladeSteps);
  }
  return places;
}

double DigCycle::Heading_rad(const OperatorView& view) const {
  const Vec3 x_W = view.state.links[0].X_WB.linear().col(0);
  const Vec2 ahead = -trench_->line().Along();
  return std::remainder(std::atan2(x_W.y(), x_W.x()) - std::atan2(ahead.y(), ahead.x()), 2 * kPi);
}

double DigCycle::Lean_rad(const OperatorView& view) const {
  return std::acos(std::clamp(up_W_.dot(view.state.links[0].X_WB.linear().col(2)), -1.0, 1.0));
}

bool DigCycle::IsHeldBack(const OperatorView& view, const PlanarArm::Tip& tip,
                          const PlanarArm::Tip& target) const {
  return tip.r_m - target.r_m > kHeldBack_m || target.z_m - tip.z_m > kPulledIn_m ||
         Lean_rad(view) > kEaseLean_rad;
}

bool DigCycle::StandsAsPlanned(const OperatorView& view) const {
  return std::abs(Heading_rad(view)) < kMostTurned_rad &&
         std::abs(AxisStation(view) - stand_m_) < kMostDrift_m;
}

void DigCycle::AdvanceMove(const OperatorView& view, bool posed) {
  const bool clear = plan_.blade < 0 ||
                     std::abs(view.state.q_rad[plan_.blade] - blade_.up_rad) < kBladeTolerance_rad;
  drives_ = drives_ || (posed && clear) || PhaseTime_s(view) > plan_.patience_s;
  const bool arrived = std::abs(stand_m_ - AxisStation(view)) < kArrived_m &&
                       std::abs(Heading_rad(view)) < kStraight_rad &&
                       view.state.links[0].v_WB_mps.norm() < kStandsStill_mps &&
                       view.state.links[0].w_WB_radps.norm() < kStandsStill_radps;
  if (!drives_ || !(arrived || PhaseTime_s(view) > kLongestMove_s)) return;
  X_WJ_start_ = SlewFrame(view);
  Enter(Phase::kApproach, view);
}

void DigCycle::DriveTracks(const OperatorView& view, std::vector<double>* levers) const {
  if (!drives_) return;
  const double back_m = stand_m_ - AxisStation(view), heading_rad = Heading_rad(view);
  const bool is_there = std::abs(back_m) < 0.75 * kArrived_m;
  double forward_mps = 0, wanted_rad = 0;
  if (!is_there && std::abs(heading_rad) < kTurnFirst_rad) {
    const double speed_mps =
        std::clamp(kEase_1ps * std::abs(back_m), kSlowestDrive_mps, kFastestDrive_mps);
    forward_mps = std::copysign(speed_mps, -back_m);
    const double left_m = -trench_->OffsetOf(view.state.links[0].X_WB.translation().head<2>());
    wanted_rad = std::clamp(-std::copysign(kTowardsLine_radpm, forward_mps) * left_m,
                            -kMostTowards_rad, kMostTowards_rad);
  } else if (std::abs(heading_rad) < 0.75 * kStraight_rad) {
    return;
  }
  const double yaw_radps =
      std::clamp(kTurn_1ps * (wanted_rad - heading_rad), -kMostYaw_radps, kMostYaw_radps);
  SetSkidSteer(view.model, plan_.tracks, forward_mps, yaw_radps, levers);
}

}  // namespace tera
