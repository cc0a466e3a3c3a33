#include "ros2/pace.h"

#include <fmt/format.h>

#include <utility>

namespace tera::ros {
namespace {

using WallClock = std::chrono::steady_clock;

/// Interval after which /clock is repeated.
constexpr double kPatience_s = 0.05;

}  // namespace

void RealTime::Restart(TimeNs t_ns, Moment now) {
  start_ = now;
  start_ns_ = t_ns;
}

RealTime::Moment RealTime::Due(TimeNs t_ns, Moment now) {
  const Moment due = start_ + std::chrono::nanoseconds(t_ns - start_ns_);
  if (now <= due + kHiccup) return due;
  Restart(t_ns, now);
  return now;
}

void RealTime::WaitFor(TimeNs t_ns) { wall_.sleep_until(Due(t_ns, wall_.now())); }

Lockstep::Lockstep(const Scenario& scenario, const LeverInput* levers, double timeout_s, Ways ways)
    : scenario_(scenario),
      levers_(levers),
      timeout_s_(timeout_s),
      ways_(std::move(ways)),
      given_up_ns_(scenario.machines.size()) {}

void Lockstep::WaitForAnswers(TimeNs now_ns) {
  const auto patience = std::chrono::nanoseconds(FromSeconds(kPatience_s));
  const auto deadline = WallClock::now() + std::chrono::nanoseconds(FromSeconds(timeout_s_));
  auto repeat = WallClock::now() + patience;
  std::vector<std::size_t> owing;
  while (!ways_.stop()) {
    ways_.take_levers();
    Forgive();
    met_ = met_ || AnybodyAwaited();
    owing = Owing(now_ns);
    if (met_ && owing.empty()) break;
    if (WallClock::now() > deadline) {
      GiveUp(owing, now_ns);
      break;
    }
    ways_.wait_for_levers(kPatience_s);
    if (WallClock::now() < repeat) continue;
    ways_.repeat_clock();
    repeat = WallClock::now() + patience;
  }
  AnybodyAwaited() ? real_time_.Restart(now_ns) : real_time_.WaitFor(now_ns);
}

bool Lockstep::IsAwaited(std::size_t machine) const {
  return !given_up_ns_[machine] && levers_->HasPublisher(machine);
}

bool Lockstep::AnybodyAwaited() const {
  for (std::size_t m = 0; m < given_up_ns_.size(); ++m) {
    if (IsAwaited(m)) return true;
  }
  return false;
}

std::vector<std::size_t> Lockstep::Owing(TimeNs now_ns) const {
  std::vector<std::size_t> owing;
  for (std::size_t m = 0; m < given_up_ns_.size(); ++m) {
    if (IsAwaited(m) && !levers_->Answered(m, now_ns)) owing.push_back(m);
  }
  return owing;
}

void Lockstep::Forgive() {
  for (std::size_t m = 0; m < given_up_ns_.size(); ++m) {
    if (given_up_ns_[m] && levers_->HeardOf(m) > *given_up_ns_[m]) given_up_ns_[m].reset();
  }
}

void Lockstep::GiveUp(const std::vector<std::size_t>& owing, TimeNs now_ns) {
  if (!met_) {
    met_ = true;
    ways_.log(
        fmt::format("nobody has published levers within {} s; time goes by as on the wall "
                    "until somebody does",
                    timeout_s_));
  }
  for (const std::size_t m : owing) {
    given_up_ns_[m] = now_ns;
    ++timeouts_;
    ways_.log(
        fmt::format("{}: no levers for /clock {:.3f} s within {} s; not waiting until they "
                    "answer again",
                    scenario_.machines[m].placement.name, ToSeconds(now_ns), timeout_s_));
  }
}

}  // namespace tera::ros
