#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/time.h"
#include "ros2/lever_input.h"

namespace tera::ros {

/// Relation of simulated time to wall time.
enum class Pace {
  kReal,     ///< wall time, or slower if the simulation is slower
  kFast,     ///< the simulation's maximum speed
  kLockstep  ///< paced by answers to /clock
};

/// Wall clock and waiting, replaceable for tests.
struct Wall {
  using Moment = std::chrono::steady_clock::time_point;
  std::function<Moment()> now = std::chrono::steady_clock::now;
  std::function<void(Moment)> sleep_until =
      &std::this_thread::sleep_until<Moment::clock, Moment::duration>;
};

/// Ties simulated time to the wall clock. A delay beyond kHiccup is not recovered.
class RealTime {
 public:
  using Moment = Wall::Moment;
  static constexpr std::chrono::milliseconds kHiccup{100};

  explicit RealTime(Wall wall = {}) : wall_(std::move(wall)), start_(wall_.now()) {}

  /// Restarts at simulated time `t_ns` and wall time `now`.
  void Restart(TimeNs t_ns, Moment now);
  void Restart(TimeNs t_ns) { Restart(t_ns, wall_.now()); }
  /// Wall time of `t_ns`, which lies in the past after a delay. Restarts after too long a delay.
  Moment Due(TimeNs t_ns, Moment now);
  /// Waits until `t_ns`.
  void WaitFor(TimeNs t_ns);

 private:
  Wall wall_;
  Moment start_;
  TimeNs start_ns_ = 0;
};

/// Waits for the answers to /clock. An answer is a valid lever message with the clock's stamp, from
/// each machine that has a lever publisher. At the start it waits for a first publisher.
///
/// Model   a machine without an answer within the timeout is awaited again only after a message
///         with a later stamp. Without awaited machines, time follows the wall clock.
class Lockstep {
 public:
  /// Actions during the wait.
  struct Ways {
    std::function<void()> take_levers;
    std::function<void(double)> wait_for_levers;  ///< with a maximum number of seconds
    std::function<void()> repeat_clock;           ///< best effort, so a message may be lost
    std::function<bool()> stop;                   ///< true ends all waiting
    std::function<void(const std::string&)> log;  ///< receives missing answers
  };

  /// Keeps references to `scenario` and `levers`.
  Lockstep(const Scenario& scenario, const LeverInput* levers, double timeout_s, Ways ways);

  /// Waits until all machines have answered to /clock at `now_ns`.
  void WaitForAnswers(TimeNs now_ns);
  std::int64_t timeouts() const { return timeouts_; }

 private:
  bool IsAwaited(std::size_t machine) const;
  bool AnybodyAwaited() const;
  /// Awaited machines without an answer.
  std::vector<std::size_t> Owing(TimeNs now_ns) const;
  /// Awaits machines again that have sent a later message.
  void Forgive();
  void GiveUp(const std::vector<std::size_t>& owing, TimeNs now_ns);

  const Scenario& scenario_;
  const LeverInput* levers_;
  double timeout_s_;
  Ways ways_;
  bool met_ = false;  ///< a publisher has appeared, or the first wait is over
  /// Time without an answer, for each machine that is not awaited.
  std::vector<std::optional<TimeNs>> given_up_ns_;
  RealTime real_time_;
  std::int64_t timeouts_ = 0;
};

}  // namespace tera::ros
