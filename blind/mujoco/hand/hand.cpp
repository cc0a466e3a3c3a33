#include "blind/mujoco/hand/hand.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tera::blind::mujoco {
namespace {

constexpr double kTau = 2 * std::numbers::pi;
constexpr double kHome_m = 9;       ///< beyond which the next way leads back
constexpr double kReacts_s = 0.45;  ///< within which a joint may go on towards its stop
constexpr double kOffStop_rad = 0.1;
constexpr double kSlewChange = 0.06;  ///< of a lever, from message to message
constexpr double kStep = 0.004;       ///< of what a lever reports

/// Rises within `ramp_s`, falls as fast before `length_s`.
double Trapezoid(double since_s, double length_s, double ramp_s) {
  return std::clamp(std::min(since_s, length_s - since_s) / ramp_s, 0.0, 1.0);
}

double HeadingOf(const Instant& seen) {
  const Vec3 ahead = seen.q_WB * Vec3::UnitX();
  return std::atan2(ahead.y(), ahead.x());
}

}  // namespace

bool IsReserved(Manoeuvre kind) {
  return (kind >= Manoeuvre::kDigging && kind <= Manoeuvre::kGrading) ||
         (kind >= Manoeuvre::kShunting && kind <= Manoeuvre::kInching);
}

bool IsOfTracks(Manoeuvre kind) {
  return kind >= Manoeuvre::kStraight && kind <= Manoeuvre::kInching;
}

std::vector<Manoeuvre> ManoeuvresOf(bool tracks, bool reserve) {
  std::vector<Manoeuvre> kinds;
  for (int k = 0; k < static_cast<int>(Manoeuvre::kRest); ++k) {
    const auto kind = static_cast<Manoeuvre>(k);
    if (IsOfTracks(kind) == tracks && IsReserved(kind) == reserve) kinds.push_back(kind);
  }
  return kinds;
}

Hand::Hand(const MachineNumbers& numbers, const Habit& habit, const Stream& stream)
    : numbers_(numbers), habit_(habit), stream_(stream) {
  piece_ = {Between(0.8, 2), [](double, const Instant&) { return Levers{}; }};
}

double Hand::Between(double low, double high) {
  return low + (high - low) * stream_.Uniform(draw_++);
}

std::size_t Hand::AnyJoint() {
  const double n = static_cast<double>(habit_.joints.size());
  return habit_.joints[std::min(habit_.joints.size() - 1, static_cast<std::size_t>(Between(0, n)))];
}

double Hand::InwardSign(std::size_t axis, const Instant& seen) {
  const JointNumbers& joint = numbers_.joints[axis];
  if (!joint.has_stops) return Between(0, 1) < 0.5 ? -1 : 1;
  return seen.angle_rad[axis] > (joint.lower_rad + joint.upper_rad) / 2 ? -1 : 1;
}

double Hand::FullSpeed_mps() const {
  return numbers_.full_rate_radps[kLeftTrack] * numbers_.radius_m;
}

/// Ahead or back: towards the origin where that is far, else either.
double Hand::TravelSign(const Instant& seen) {
  const Vec3 ahead = seen.q_WB * Vec3::UnitX();
  if (seen.p_WB_m.head<2>().norm() < kHome_m) return Between(0, 1) < 0.4 ? -1 : 1;
  return ahead.dot(seen.p_WB_m) > 0 ? -1 : 1;
}

PerAxis<double> Hand::operator()(double t_s, const Instant& seen) {
  if (t_s - began_s_ >= piece_.length_s) {
    began_s_ = t_s;
    piece_ = Next(seen);
  }
  Levers levers = OffStops(piece_.levers(t_s - began_s_, seen), seen);
  slew_ = std::clamp(levers[kSlew], slew_ - kSlewChange, slew_ + kSlewChange);
  levers[kSlew] = slew_;
  for (double& lever : levers) {
    lever = std::round(std::clamp(lever, -habit_.largest, habit_.largest) / kStep) * kStep;
  }
  return levers;
}

Hand::Levers Hand::OffStops(Levers levers, const Instant& seen) const {
  for (std::size_t i = kBoom; i < kAxisCount; ++i) {
    const JointNumbers& joint = numbers_.joints[i];
    const double margin_rad =
        kOffStop_rad + kReacts_s * std::abs(levers[i]) * numbers_.full_rate_radps[i];
    if (levers[i] > 0 && seen.angle_rad[i] > joint.upper_rad - margin_rad) levers[i] = 0;
    if (levers[i] < 0 && seen.angle_rad[i] < joint.lower_rad + margin_rad) levers[i] = 0;
  }
  return levers;
}

Hand::Piece Hand::Next(const Instant& seen) {
  rests_ = !rests_;
  if (rests_ || habit_.kinds.empty()) {
    return {Between(0.4, 1.6), [](double, const Instant&) { return Levers{}; }};
  }
  const Manoeuvre kind = habit_.kinds[turn_++ % habit_.kinds.size()];
  return IsOfTracks(kind) ? OfTracks(kind, seen) : OfJoints(kind, seen);
}

Hand::Piece Hand::OfJoints(Manoeuvre kind, const Instant& seen) {
  if (habit_.full_steps_only) return Reversals(seen);
  switch (kind) {
    case Manoeuvre::kLadder:
      return Ladder(seen);
    case Manoeuvre::kSines:
      return Waves(0.12, 0.12, 3, seen);
    case Manoeuvre::kChirp:
      return Waves(0.1, 1.1, 1, seen);
    case Manoeuvre::kCycle:
      return Cycle(seen);
    case Manoeuvre::kReversals:
      return Reversals(seen);
    case Manoeuvre::kSteps:
      return Steps(seen);
    case Manoeuvre::kDigging:
      return Digging(seen);
    case Manoeuvre::kTelegraph:
      return Telegraph(seen);
    case Manoeuvre::kGrading:
      return Grading(seen);
    default:
      return {1, [](double, const Instant&) { return Levers{}; }};
  }
}

/// Each level one way and back; the first way is inwards.
Hand::Piece Hand::Ladder(const Instant& seen) {
  const std::size_t axis = AnyJoint();
  const double sign = InwardSign(axis, seen), hold_s = Between(0.9, 1.6);
  const double low = Between(0.06, 0.2), high = Between(0.5, 1);
  const int levels = 4;
  return {2 * levels * hold_s, [=](double since_s, const Instant&) {
            const int part = std::min(2 * levels - 1, static_cast<int>(since_s / hold_s));
            const double level = low + (high - low) * (part / 2) / (levels - 1);
            Levers out{};
            out[axis] = sign * (part % 2 == 0 ? 1 : -1) * level *
                        Trapezoid(since_s - part * hold_s, hold_s, 0.12);
            return out;
          }};
}

/// Waves on up to `most` joints, each with its own rhythm.
Hand::Piece Hand::Waves(double from_hz, double to_hz, std::size_t most, const Instant& seen) {
  struct Wave {
    std::size_t axis;
    double size, from_hz, to_hz;
  };
  const double length_s = Between(7, 12);
  std::vector<Wave> waves;
  for (std::size_t k = 0; k < std::min(most, habit_.joints.size()); ++k) {
    const std::size_t axis = k == 0 ? AnyJoint() : habit_.joints[k];
    const double faster = from_hz == to_hz ? Between(1, 4) : 1;
    waves.push_back(
        {axis, InwardSign(axis, seen) * Between(0.2, 0.9), from_hz * faster, to_hz * faster});
  }
  return {length_s, [=](double since_s, const Instant&) {
            Levers out{};
            for (const Wave& w : waves) {
              const double turns =
                  since_s * (w.from_hz + (w.to_hz - w.from_hz) * since_s / (2 * length_s));
              out[w.axis] = w.size * std::sin(kTau * turns);
            }
            return out;
          }};
}

Hand::Piece Hand::Steps(const Instant& seen) {
  const std::size_t axis = AnyJoint(), other = AnyJoint();
  Levers goal{};
  goal[axis] = InwardSign(axis, seen) * Between(0.1, 1);
  if (other != axis) goal[other] = InwardSign(other, seen) * Between(0.1, 1);
  const double length_s = Between(0.8, 2.6), ramp_s = Between(0.03, 0.3);
  return {length_s, [=](double since_s, const Instant&) {
            Levers out = goal;
            for (double& lever : out) lever *= Trapezoid(since_s, length_s, ramp_s);
            return out;
          }};
}

/// Goals one after another, levers by what is left of the way.
Hand::Piece Hand::Cycle(const Instant& seen) {
  constexpr double kPhase_s = 2.2;
  const auto at = [&](std::size_t axis, double share) {
    const JointNumbers& joint = numbers_.joints[axis];
    return joint.lower_rad + share * (joint.upper_rad - joint.lower_rad);
  };
  const double side = Between(0.5, 1.3) * (Between(0, 1) < 0.5 ? -1 : 1);
  const double home = seen.angle_rad[kSlew];
  const double phases[6][4] = {
      {home, at(kBoom, 0.4), at(kArm, 0.8), at(kBucket, 0.7)},           // reach
      {home, at(kBoom, 0.35), at(kArm, 0.35), at(kBucket, 0.5)},         // draw in
      {home, at(kBoom, 0.45), at(kArm, 0.3), at(kBucket, 0.2)},          // curl
      {home + side, at(kBoom, 0.7), at(kArm, 0.35), at(kBucket, 0.2)},   // lift and slew
      {home + side, at(kBoom, 0.65), at(kArm, 0.6), at(kBucket, 0.75)},  // dump
      {home, at(kBoom, 0.5), at(kArm, 0.6), at(kBucket, 0.6)}};          // return
  std::vector<std::array<double, 4>> goals;
  for (const auto& phase : phases) goals.push_back({phase[0], phase[1], phase[2], phase[3]});
  const double eager = Between(1.4, 2.4);
  const std::vector<std::size_t> joints = habit_.joints;
  const PerAxis<double> full = numbers_.full_rate_radps;
  return {6 * kPhase_s, [=](double since_s, const Instant& now) {
            const auto phase =
                std::min<std::size_t>(5, static_cast<std::size_t>(since_s / kPhase_s));
            Levers out{};
            for (const std::size_t axis : joints) {
              const double left = goals[phase][axis - kSlew] - now.angle_rad[axis];
              if (std::abs(left) < 0.03) continue;
              out[axis] = std::clamp(eager * left / full[axis], -0.95, 0.95) *
                          std::min(1.0, (since_s - phase * kPhase_s) / 0.25);
            }
            return out;
          }};
}

Hand::Piece Hand::Reversals(const Instant& seen) {
  const std::size_t axis = AnyJoint();
  const double level = habit_.full_steps_only ? 1 : Between(0.25, 1);
  const double sign = InwardSign(axis, seen), half_s = Between(0.7, 1.3);
  return {4 * half_s, [=](double since_s, const Instant&) {
            Levers out{};
            out[axis] = sign * level * (static_cast<int>(since_s / half_s) % 2 == 0 ? 1 : -1);
            return out;
          }};
}

Hand::Piece Hand::OfTracks(Manoeuvre kind, const Instant& seen) {
  const double sign = TravelSign(seen), level = Between(0.25, 0.95) * sign;
  const double side = Between(0, 1) < 0.5 ? -1 : 1;
  // Far away and across the way home: turn first.
  const double heading = HeadingOf(seen);
  const double home = std::atan2(-seen.p_WB_m.y(), -seen.p_WB_m.x());
  const bool is_across =
      seen.p_WB_m.head<2>().norm() > kHome_m && std::abs(std::cos(home - heading)) < 0.5;
  double outer = level, inner = level, length_s = Between(3, 7);
  if (is_across || kind == Manoeuvre::kSpot) {
    outer = Between(0.25, 0.6) * (is_across ? std::copysign(1, std::sin(home - heading)) : side);
    inner = -outer;
    length_s = is_across ? 2.2 / (2 * std::abs(outer) * FullSpeed_mps() / numbers_.gauge_m) * 0.7
                         : Between(2, 5);
    return {length_s, [=](double since_s, const Instant&) {
              const double share = Trapezoid(since_s, length_s, 0.9);
              return Levers{inner * share, outer * share};
            }};
  }
  if (kind == Manoeuvre::kShunting) return Shunting(level, side);
  if (kind == Manoeuvre::kSpiral) return Spiral(level, side);
  if (kind == Manoeuvre::kInching) return Inching(level);
  if (kind == Manoeuvre::kArc) inner = level * Between(0.3, 0.85);
  double beat_hz = 0;
  if (kind == Manoeuvre::kEight) {
    inner = level * 0.35;
    length_s = 2 * kTau * numbers_.gauge_m / (0.65 * std::abs(level) * FullSpeed_mps());
    length_s = std::min(length_s, 26.0);
  } else if (kind == Manoeuvre::kSlalom) {
    inner = level * 0.5;
    length_s = Between(6, 10);
    beat_hz = Between(0.15, 0.4);
  }
  const bool changes = kind == Manoeuvre::kEight;
  return {length_s, [=](double since_s, const Instant&) {
            const double share = Trapezoid(since_s, length_s, 0.5);
            double a = inner * share, b = outer * share;
            if (beat_hz > 0) {
              const double wave = std::sin(kTau * beat_hz * since_s);
              a = share * level * (1 - 0.25 * (1 + wave)),
              b = share * level * (1 - 0.25 * (1 - wave));
            }
            const bool is_left = (side > 0) != (changes && since_s > length_s / 2);
            return is_left ? Levers{a, b} : Levers{b, a};
          }};
}

}  // namespace tera::blind::mujoco
