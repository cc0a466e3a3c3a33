#pragma once

#include <functional>
#include <set>

#include "blind/mujoco/plant/course.h"

namespace tera::blind::mujoco {

/// Manoeuvres of an operator.
enum class Manoeuvre {
  kLadder,     ///< one joint, rising levels, each forth and back
  kSines,      ///< several joints at once
  kSteps,      ///< one or two joints, any level for any time
  kCycle,      ///< reach, curl, lift, slew, dump and return, in the air
  kChirp,      ///< a sine of rising frequency
  kReversals,  ///< one level, back and forth with sharp edges
  kDigging,    ///< dig, lift, swing, dump and return, levers that ease in and out and overlap
  kTelegraph,  ///< levers that jump from level to level at random times
  kGrading,    ///< boom and arm together, so that the bucket moves level
  kStraight,
  kArc,
  kSpot,   ///< a turn on the spot
  kEight,  ///< a circle to the left, one to the right
  kSlalom,
  kShunting,  ///< forward to one side, back to the other, forward
  kSpiral,    ///< an arc that tightens
  kInching,   ///< short pushes, as along a trench
  kRest
};

/// Kinds for `--reserve` alone.
bool IsReserved(Manoeuvre kind);
bool IsOfTracks(Manoeuvre kind);
/// All manoeuvres with joints or with tracks: the regular ones, or the reserved ones.
std::vector<Manoeuvre> ManoeuvresOf(bool tracks, bool reserve);

/// Rises from 0 to 1 and falls to 0 again, each by a half cosine over `share` of `length_s`; its
/// mean is 1 - share.
double Eased(double since_s, double length_s, double share);

/// Levers of boom, arm and bucket that move the bucket's pin at `ahead_mps` away from the machine,
/// level and with a constant bucket angle. Uses the true positions of the pins.
PerAxis<double> LevelLevers(const MachineNumbers& numbers, const PerAxis<double>& angle_rad,
                            double ahead_mps);

/// An operator's way of working.
struct Habit {
  std::vector<Manoeuvre> kinds;     ///< in turn, repeated
  std::vector<std::size_t> joints;  ///< axes that are used
  double largest = 1;               ///< largest lever
  bool full_steps_only = false;     ///< only full levers
};

/// An operator who sees angles and position. Keeps joints off their stops and the machine within
/// some 20 m of the origin, and rests between manoeuvres. Eases the slew in and out, since
/// otherwise the whole machine would turn on its tracks.
///
/// Frames  positive levers turn joints about their axes and drive tracks forward.
class Hand {
 public:
  Hand(const MachineNumbers& numbers, const Habit& habit, const Stream& stream);
  PerAxis<double> operator()(double t_s, const Instant& seen);

 private:
  using Levers = PerAxis<double>;
  /// Levers as a function of the time since the piece began.
  struct Piece {
    double length_s = 1;
    std::function<Levers(double since_s, const Instant& seen)> levers;
  };

  double Between(double low, double high);
  std::size_t AnyJoint();
  /// Sign of motion towards the middle of the travel.
  double InwardSign(std::size_t axis, const Instant& seen);
  double TravelSign(const Instant& seen);
  Piece Next(const Instant& seen);
  Piece OfJoints(Manoeuvre kind, const Instant& seen);
  Piece OfTracks(Manoeuvre kind, const Instant& seen);
  Piece Ladder(const Instant& seen);
  Piece Waves(double from_hz, double to_hz, std::size_t most, const Instant& seen);
  Piece Steps(const Instant& seen);
  Piece Cycle(const Instant& seen);
  Piece Reversals(const Instant& seen);
  Piece Digging(const Instant& seen);
  Piece Telegraph(const Instant& seen);
  Piece Grading(const Instant& seen);
  Piece Shunting(double level, double side);
  Piece Spiral(double level, double side);
  Piece Inching(double level);
  double FullSpeed_mps() const;
  Levers OffStops(Levers levers, const Instant& seen) const;

  const MachineNumbers& numbers_;
  Habit habit_;
  Stream stream_;
  std::uint64_t draw_ = 0;
  std::size_t turn_ = 0;
  bool rests_ = true;
  double began_s_ = 0;
  Piece piece_;
  double slew_ = 0;  ///< lever
};

}  // namespace tera::blind::mujoco
