#include "ros2/live.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "core/error.h"
#include "core/stopwatch.h"
#include "ros2/names.h"
#include "ros2/sample_publisher.h"
#include "ros2/state_publisher.h"

namespace tera::ros {
namespace {

void RequireRate(double rate_hz, double physics_rate_hz) {
  if (rate_hz <= physics_rate_hz) return;
  throw InputError("--rate",
                   {FaultKind::kOutOfRange,
                    fmt::format("{} Hz is beyond the scenario's physics_rate_hz {}; need a "
                                "lower rate, or a faster physics",
                                rate_hz, physics_rate_hz)});
}

/// Time at which a run ends; it may be infinite.
TimeNs EndOf(double duration_s) {
  constexpr TimeNs kNever_ns = std::numeric_limits<TimeNs>::max();
  return duration_s < ToSeconds(kNever_ns) ? FromSeconds(duration_s) : kNever_ns;
}

class Session {
 public:
  Session(std::shared_ptr<const Scenario> scenario, const std::string& resolved_yaml,
          const LiveRosOptions& options)
      : options_(options),
        participant_(options.dds),
        samples_(*scenario, &participant_),
        run_(std::move(scenario), resolved_yaml, options.live, {&samples_}),
        states_(run_.scenario(), now(), &participant_),
        levers_(run_.scenario(), &participant_,
                options.pace == Pace::kLockstep ? Obey::kAnswers : Obey::kLast, options.log),
        lockstep_(run_.scenario(), &levers_, options.answer_timeout_s, WaysOfWaiting()),
        real_time_(options.wall) {}

  LiveRosReport Run() {
    LiveRosReport report;
    {
      const Stopwatch watch(&report.wall_s);
      const SampleClock clock{options_.rate_hz};
      const TimeNs end_ns = EndOf(options_.duration_s);
      if (options_.started) options_.started();
      Say();
      for (std::int64_t tick = 1; !options_.stop() && now().t_ns < end_ns; ++tick) {
        Listen();
        while (now().t_ns < std::min(clock.Due(tick), end_ns)) {
          run_.Step();
          samples_.PublishDue(now().t_ns);
        }
        Say();
      }
      report.simulated_s = ToSeconds(now().t_ns);
      run_.Finish();
    }
    report.published = participant_.published();
    report.dropped = participant_.dropped();
    report.levers_received = levers_.received();
    report.levers_refused = levers_.refused();
    report.levers_unasked = levers_.unasked();
    report.timeouts = lockstep_.timeouts();
    return report;
  }

 private:
  const WorldState& now() const { return run_.simulation().state(); }

  void Say() {
    samples_.PublishDue(now().t_ns);
    states_.Publish(now());
  }

  void TakeLevers() {
    levers_.Take(now().t_ns, [this](std::size_t machine, const ControlMessage& message) {
      run_.Command(machine, message);
    });
  }

  void Listen() {
    if (options_.pace == Pace::kLockstep) return lockstep_.WaitForAnswers(now().t_ns);
    if (options_.pace == Pace::kReal) real_time_.WaitFor(now().t_ns);
    TakeLevers();
  }

  Lockstep::Ways WaysOfWaiting() {
    return {[this] { TakeLevers(); },
            [this](double timeout_s) { participant_.WaitForLevers(timeout_s); },
            [this] { states_.RepeatClock(); }, options_.stop, options_.log};
  }

  const LiveRosOptions& options_;
  Participant participant_;
  SamplePublisher samples_;
  LiveRun run_;
  StatePublisher states_;
  LeverInput levers_;
  Lockstep lockstep_;
  RealTime real_time_;
};

}  // namespace

LiveRosReport RunForRos(std::shared_ptr<const Scenario> scenario, const std::string& resolved_yaml,
                        const LiveRosOptions& options) {
  RequireRosNames(*scenario);
  RequireRate(options.rate_hz, scenario->physics_rate_hz);
  return Session(std::move(scenario), resolved_yaml, options).Run();
}

}  // namespace tera::ros
