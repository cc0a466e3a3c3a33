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

/// How simulated time goes by.
enum class Pace {
  kReal,     ///< as on the wall, or slower where the simulation is
  kFast,     ///< as fast as the simulation can
  kLockstep  ///< as the answers to /clock come
};

/// The clock on the wall, and how to wait for it.
struct Wall {
  using Moment = std::chrono::steady_clock::time_point;
  std::function<Moment()> now = std::chrono::steady_clock::now;
  std::function<void(Moment)> sleep_until =
      &std::this_thread::sleep_until<Moment::clock, Moment::duration>;
};

/// Holds simulated time to the clock on the wall. What is lost by more than a hiccup is not caught
/// up with.
class RealTime {
 public:
  using Moment = Wall::Moment;
  static constexpr std::chrono::milliseconds kHiccup{100};

  explicit RealTime(Wall wall = {}) : wall_(std::move(wall)), start_(wall_.now()) {}

  /// From `now` on, or from now on, which is `t_ns`.
  void Restart(TimeNs t_ns, Moment now);
  void Restart(TimeNs t_ns) { Restart(t_ns, wall_.now()); }
  /// When it is to be `t_ns`; past where time was lost. Begins anew where that was too much.
  Moment Due(TimeNs t_ns, Moment now);
  /// Until `t_ns`.
  void WaitFor(TimeNs t_ns);

 private:
  Wall wall_;
  Moment start_;
  TimeNs start_ns_ = 0;
};

/// Waits for the answers to /clock: a good lever message with its stamp for each machine whose
/// levers somebody publishes; at the start, for a first publisher.
///
/// Model   a machine whose answer has not come within the timeout is not waited for again until a
///         message stamped after that time has come. With nobody to wait for, time goes by as on
///         the wall.
class Lockstep {
 public:
  /// What it does while it waits.
  struct Ways {
    std::function<void()> take_levers;
    std::function<void(double)> wait_for_levers;  ///< so many seconds at most
    std::function<void()> repeat_clock;           ///< which is best effort and may have been lost
    std::function<bool()> stop;                   ///< whether to give up waiting altogether
    std::function<void(const std::string&)> log;  ///< told of answers that did not come
  };

  /// Keeps references to `scenario` and `levers`.
  Lockstep(const Scenario& scenario, const LeverInput* levers, double timeout_s, Ways ways);

  /// Until all have answered to /clock at `now_ns`.
  void WaitForAnswers(TimeNs now_ns);
  std::int64_t timeouts() const { return timeouts_; }

 private:
  bool IsAwaited(std::size_t machine) const;
  bool AnybodyAwaited() const;
  /// Awaited machines without an answer.
  std::vector<std::size_t> Owing(TimeNs now_ns) const;
  /// Awaits those again who have been heard of since they were given up.
  void Forgive();
  void GiveUp(const std::vector<std::size_t>& owing, TimeNs now_ns);

  const Scenario& scenario_;
  const LeverInput* levers_;
  double timeout_s_;
  Ways ways_;
  bool met_ = false;  ///< somebody has been there, or the first wait is over
  /// For each machine that is not waited for, the time to which no answer came.
  std::vector<std::optional<TimeNs>> given_up_ns_;
  RealTime real_time_;
  std::int64_t timeouts_ = 0;
};

}  // namespace tera::ros
