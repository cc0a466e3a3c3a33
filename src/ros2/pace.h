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
  kReal,     ///< wall time, or slower if the computer is too slow
  kFast,     ///< as fast as possible
  kLockstep  ///< waits for answers to /clock
};

/// Wall clock and sleep function. Tests replace them.
struct Wall {
  using Moment = std::chrono::steady_clock::time_point;
  std::function<Moment()> now = std::chrono::steady_clock::now;
  std::function<void(Moment)> sleep_until =
      &std::this_thread::sleep_until<Moment::clock, Moment::duration>;
};

/// Keeps simulated time equal to wall time. If the simulation falls behind by more than kHiccup,
/// the delay is not caught up.
class RealTime {
 public:
  using Moment = Wall::Moment;
  static constexpr std::chrono::milliseconds kHiccup{100};

  explicit RealTime(Wall wall = {}) : wall_(std::move(wall)), start_(wall_.now()) {}

  /// Makes simulated time `t_ns` correspond to wall time `now`.
  void Restart(TimeNs t_ns, Moment now);
  void Restart(TimeNs t_ns) { Restart(t_ns, wall_.now()); }
  /// Wall time at which `t_ns` is due. If that is more than kHiccup in the past, restarts and
  /// returns `now`.
  Moment Due(TimeNs t_ns, Moment now);
  /// Sleeps until `t_ns` is due.
  void WaitFor(TimeNs t_ns);

 private:
  Wall wall_;
  Moment start_;
  TimeNs start_ns_ = 0;
};

/// Lockstep mode: after each /clock message, waits for answers. An answer is a valid lever message
/// whose stamp is the time in /clock. Every machine with a lever publisher must answer. Before the
/// first step, waits for at least one publisher.
///
/// Model   If a machine does not answer within the timeout, the simulation stops waiting for it. It
///         waits for the machine again after a message with a later stamp. While there is no
///         machine to wait for, simulated time follows the wall clock.
class Lockstep {
 public:
  /// Functions used while waiting.
  struct Ways {
    std::function<void()> take_levers;
    std::function<void(double)> wait_for_levers;  ///< waits for lever messages, at most the given
                                                  ///< number of seconds
    std::function<void()> repeat_clock;  ///< sends /clock again, because delivery is best effort
    std::function<bool()> stop;          ///< returns true to end the waiting
    std::function<void(const std::string&)> log;  ///< receives a message for each missing answer
  };

  /// Keeps references to `scenario` and `levers`.
  Lockstep(const Scenario& scenario, const LeverInput* levers, double timeout_s, Ways ways);

  /// Waits until all machines have answered the /clock message of `now_ns`.
  void WaitForAnswers(TimeNs now_ns);
  std::int64_t timeouts() const { return timeouts_; }

 private:
  bool IsAwaited(std::size_t machine) const;
  bool AnybodyAwaited() const;
  /// Machines that have not yet answered.
  std::vector<std::size_t> Owing(TimeNs now_ns) const;
  /// Waits again for machines that have sent a message with a later stamp.
  void Forgive();
  void GiveUp(const std::vector<std::size_t>& owing, TimeNs now_ns);

  const Scenario& scenario_;
  const LeverInput* levers_;
  double timeout_s_;
  Ways ways_;
  bool met_ = false;  ///< a publisher has appeared, or the first timeout has passed
  /// Per machine, the time to which it did not answer; absent if the simulation waits for it.
  std::vector<std::optional<TimeNs>> given_up_ns_;
  RealTime real_time_;
  std::int64_t timeouts_ = 0;
};

}  // namespace tera::ros
