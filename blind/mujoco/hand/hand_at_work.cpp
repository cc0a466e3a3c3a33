#include <algorithm>
#include <cmath>
#include <numbers>

#include "blind/mujoco/hand/hand.h"

// Manoeuvres of operators at work, who move several levers at once and ease them in and out.

namespace tera::blind::mujoco {

double Eased(double since_s, double length_s, double share) {
  const double ramp = std::min(since_s, length_s - since_s) / (share * length_s);
  return 0.5 - 0.5 * std::cos(std::numbers::pi * std::clamp(ramp, 0.0, 1.0));
}

/// The pins' velocity is L1 b' (-sin b, cos b) + L2 a' (-sin a, cos a), b the boom's slope and a
/// the arm's: solved for a level one.
PerAxis<double> LevelLevers(const MachineNumbers& numbers, const PerAxis<double>& angle_rad,
                            double ahead_mps) {
  const double boom_m = numbers.joints[kArm].pin_m.norm();
  const double arm_m = numbers.joints[kBucket].pin_m.norm();
  const double boom_rad = angle_rad[kBoom], arm_rad = boom_rad + angle_rad[kArm];
  const double both_m = boom_m * arm_m * std::sin(angle_rad[kArm]);
  const double boom_radps = ahead_mps * arm_m * std::cos(arm_rad) / both_m;
  const double arm_radps = -ahead_mps * boom_m * std::cos(boom_rad) / both_m;  // of its slope
  PerAxis<double> levers{};
  levers[kBoom] = boom_radps / numbers.full_rate_radps[kBoom];
  levers[kArm] = (arm_radps - boom_radps) / numbers.full_rate_radps[kArm];
  levers[kBucket] = -arm_radps / numbers.full_rate_radps[kBucket];
  return levers;
}

/// Moves that are planned beforehand, from angle to angle, some begun before others end.
Hand::Piece Hand::Digging(const Instant& seen) {
  struct Move {
    std::size_t axis;
    double from_s, length_s, to;  ///< share of travel; of the slew, of the swing
  };
  const double pace_s = Between(0.9, 1.3),
               swing_rad = Between(0.4, 1) * (Between(0, 1) < 0.5 ? -1 : 1);
  const std::vector<Move> moves = {
      {kArm, 0, 2.6, 0.7},   {kBoom, 0.2, 2.2, 0.4},   {kBucket, 0.6, 1.8, 0.65},  // reach
      {kArm, 2.9, 3, 0.35},  {kBucket, 3.6, 2.6, 0.3}, {kBoom, 4.6, 2.4, 0.6},     // dig, lift
      {kSlew, 5.8, 3.2, 1},  {kArm, 7, 2, 0.6},        {kBucket, 8.6, 1.6, 0.7},   // swing, dump
      {kSlew, 10.2, 3.2, 0}, {kBoom, 10.8, 2.4, 0.45}};
  constexpr double kEase = 0.35, kMost = 0.95;
  PerAxis<double> planned = seen.angle_rad;
  std::vector<std::pair<Move, double>> levels;
  for (const Move& move : moves) {
    const JointNumbers& joint = numbers_.joints[move.axis];
    const double goal_rad = move.axis == kSlew
                                ? seen.angle_rad[kSlew] + move.to * swing_rad
                                : joint.lower_rad + move.to * (joint.upper_rad - joint.lower_rad);
    const double full_rad =
        numbers_.full_rate_radps[move.axis] * pace_s * move.length_s * (1 - kEase);
    const double level = std::clamp((goal_rad - planned[move.axis]) / full_rad, -kMost, kMost);
    planned[move.axis] += level * full_rad;
    levels.emplace_back(move, level);
  }
  return {13.4 * pace_s, [=, joints = habit_.joints](double since_s, const Instant&) {
            Levers out{};
            for (const auto& [move, level] : levels) {
              const double own_s = since_s / pace_s - move.from_s;
              if (own_s <= 0 || own_s >= move.length_s) continue;
              if (std::find(joints.begin(), joints.end(), move.axis) == joints.end()) continue;
              out[move.axis] += level * Eased(own_s, move.length_s, kEase);
            }
            return out;
          }};
}

/// A level at a time, as long as a decay lasts, there and back so that it stays about the place.
Hand::Piece Hand::Telegraph(const Instant& seen) {
  struct Level {
    double until_s, lever;
  };
  const double length_s = Between(7, 12), mean_s = Between(0.4, 0.9);
  std::vector<std::pair<std::size_t, std::vector<Level>>> all;
  const std::size_t axis = AnyJoint(), other = AnyJoint();
  for (const std::size_t moved : {axis, other}) {
    std::vector<Level> levels;
    double sign = InwardSign(moved, seen);
    for (double t_s = 0; t_s < length_s; sign = -sign) {
      t_s += 0.15 - mean_s * std::log(Between(0, 1));
      levels.push_back({t_s, Between(0, 1) < 0.25 ? 0 : sign * Between(0.15, 1)});
    }
    all.emplace_back(moved, levels);
    if (other == axis) break;
  }
  return {length_s, [=](double since_s, const Instant&) {
            Levers out{};
            for (const auto& [moved, levels] : all) {
              const auto now = std::find_if(levels.begin(), levels.end(), [&](const Level& level) {
                return since_s < level.until_s;
              });
              out[moved] = now == levels.end() ? 0 : now->lever;
            }
            return out;
          }};
}

/// There and back, once or twice, levers by where the pins are now.
Hand::Piece Hand::Grading(const Instant& seen) {
  constexpr double kMost = 0.9, kEase = 0.3;
  const double stroke_s = Between(3, 5), level = Between(0.35, 0.8);
  const double speed_mps = level * numbers_.full_rate_radps[kArm] *
                           numbers_.joints[kBucket].pin_m.norm() * InwardSign(kArm, seen);
  return {2 * stroke_s, [=, this](double since_s, const Instant& now) {
            const bool back = since_s > stroke_s;
            const double eased = Eased(since_s - (back ? stroke_s : 0), stroke_s, kEase);
            const Levers all =
                LevelLevers(numbers_, now.angle_rad, speed_mps * (back ? -eased : eased));
            double largest = kMost;
            for (const double lever : all) largest = std::max(largest, std::abs(lever));
            Levers out{};
            for (const std::size_t axis : habit_.joints) out[axis] = all[axis] * kMost / largest;
            return out;
          }};
}

Hand::Piece Hand::Shunting(double level, double side) {
  const double part_s = Between(2.2, 3.6), inner = level * Between(0.2, 0.6);
  return {3 * part_s, [=](double since_s, const Instant&) {
            const int part = std::min(2, static_cast<int>(since_s / part_s));
            const double eased = Eased(since_s - part * part_s, part_s, 0.3);
            const double way = part == 1 ? -eased : eased;
            const bool is_left = (side > 0) != (part == 1);
            Levers out{};
            out[kLeftTrack] = way * (is_left ? inner : level);
            out[kRightTrack] = way * (is_left ? level : inner);
            return out;
          }};
}

Hand::Piece Hand::Spiral(double level, double side) {
  const double length_s = Between(6, 11), last = Between(0, 0.4);
  return {length_s, [=](double since_s, const Instant&) {
            const double share = since_s / length_s;
            const double eased = level * Eased(since_s, length_s, 0.15);
            const double inner = eased * (1 + (last - 1) * share);
            Levers out{};
            out[kLeftTrack] = side > 0 ? inner : eased;
            out[kRightTrack] = side > 0 ? eased : inner;
            return out;
          }};
}

Hand::Piece Hand::Inching(double level) {
  const double push_s = Between(0.6, 1.1), rest_s = Between(0.4, 0.9);
  const int pushes = 5;
  return {pushes * (push_s + rest_s), [=](double since_s, const Instant&) {
            const double own_s = std::fmod(since_s, push_s + rest_s);
            Levers out{};
            if (own_s < push_s) {
              out[kLeftTrack] = out[kRightTrack] = level * Eased(own_s, push_s, 0.25);
            }
            return out;
          }};
}

}  // namespace tera::blind::mujoco
