#include "serve/live_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <map>
#include <set>
#include <utility>

#include "core/error.h"
#include "dataset/files/checked_file.h"
#include "serve/action.h"
#include "serve/description.h"
#include "serve/observation.h"
#include "serve/sample_keeper.h"
#include "serve/session.h"

namespace tera {
namespace {

namespace fs = std::filesystem;

/// Upper bound that detects a mistyped step.
constexpr double kLongestStep_s = 3600;
/// Interval in simulated time at which a command is repeated, well below its timeout.
constexpr double kRepeat_s = 0.5 * RemoteOperator::kTimeout_s;

/// Number of physics steps in a request.
std::int64_t StepsOf(const v1::Step& step, double rate_hz) {
  double steps = step.physics_steps();
  if (step.has_duration_s()) {
    if (!(step.duration_s() > 0)) {
      throw InputError("", {FaultKind::kOutOfRange,
                            fmt::format("a step of {} s; need more than 0", step.duration_s())});
    }
    steps = std::max(1.0, std::round(step.duration_s() * rate_hz));
  }
  if (!(steps >= 1))
    throw InputError(
        "", {FaultKind::kOutOfRange, "a step of no duration; need at least one physics step"});
  if (steps > kLongestStep_s * rate_hz) {
    throw InputError("", {FaultKind::kOutOfRange, fmt::format("a step of {} s; need at most {} s",
                                                              steps / rate_hz, kLongestStep_s)});
  }
  return static_cast<std::int64_t>(steps);
}

/// The episode folder after the highest existing number.
fs::path NextEpisode(const fs::path& folder) {
  int last = 0;
  std::error_code none_there;
  for (const auto& entry : fs::directory_iterator(folder, none_there)) {
    int number = 0;
    if (std::sscanf(entry.path().filename().c_str(), "episode_%d", &number) == 1) {
      last = std::max(last, number);
    }
  }
  return folder / fmt::format("episode_{:04}", last + 1);
}

class LiveStage : public Stage {
 public:
  LiveStage(const v1::Description& description, const ScenarioSource& source,
            const StageOptions& options, const Server::Log& log, std::function<bool()> ended)
      : description_(description),
        source_(source),
        options_(options),
        log_(log),
        ended_(std::move(ended)) {}

  ~LiveStage() override {
    try {
      FinishEpisode();
    } catch (const std::exception& error) {
      log_(fmt::format("the recording is left incomplete: {}", error.what()));
    }
  }

  v1::Description Describe() override { return description_; }

  std::optional<v1::Observation> Reset(const v1::Reset& request) override {
    SeededScenario seeded =
        source_(request.has_seed() ? std::optional(request.seed()) : std::nullopt);
    const ObservationPlan plan = PlanObservation(request.observe(), *seeded.scenario, 0);
    FinishEpisode();
    LiveOptions options{.threads = options_.threads, .egl = options_.egl, .record = std::nullopt};
    if (options_.record) options.record = NextEpisode(*options_.record);
    auto keeper = std::make_unique<SampleKeeper>();
    keeper->Keep(plan.sensors, 0);
    run_ = std::make_unique<LiveRun>(std::move(seeded.scenario), seeded.resolved_yaml, options,
                                     std::vector<MeasurementSink*>{keeper.get()});
    keeper_ = std::move(keeper);
    steps_ = 0;
    driven_.clear();
    return Observe(plan);
  }

  std::optional<v1::Observation> Step(const v1::Step& request) override {
    if (!run_) throw InputError("the episode was ended by a fault; need Reset");
    const double rate_hz = run_->scenario().physics_rate_hz;
    const std::int64_t steps = StepsOf(request, rate_hz);
    const Commands commands = CommandsOf(request, run_->scenario());
    const ObservationPlan plan =
        PlanObservation(request.observe(), run_->scenario(), static_cast<double>(steps) / rate_hz);
    keeper_->Keep(plan.sensors, SampleClock{.rate_hz = rate_hz}.Due(steps_ + steps));
    try {
      if (!Run(commands, steps)) return std::nullopt;
    } catch (const InputError& error) {
      run_.reset();
      throw InputError("the episode ends here", error.AsFinding());
    }
    return Observe(plan);
  }

  bool InEpisode() const override { return run_ != nullptr; }

 private:
  using Commands = std::map<std::size_t, ControlMessage>;

  /// Returns false if the session ends during the steps.
  bool Run(const Commands& commands, std::int64_t steps) {
    const auto repeat = std::max<std::int64_t>(
        1, static_cast<std::int64_t>(kRepeat_s * run_->scenario().physics_rate_hz));
    for (std::int64_t k = 0; k < steps; ++k) {
      if (ended_()) return false;
      if (k % repeat == 0) Command(commands);
      run_->Step();
      ++steps_;
    }
    return true;
  }

  void Command(const Commands& commands) {
    for (const auto& [machine, message] : commands) {
      run_->Command(machine, message);
      driven_.insert(machine);
    }
    for (const std::size_t machine : driven_) {
      if (commands.contains(machine)) continue;
      run_->Command(machine, Neutral(run_->scenario().machines[machine].placement.model));
    }
  }

  v1::Observation Observe(const ObservationPlan& plan) {
    v1::Observation observation;
    const Simulation& simulation = run_->simulation();
    PutState(simulation.state(), run_->scenario(), plan.patches, &observation);
    keeper_->Take(&observation);
    return observation;
  }

  void FinishEpisode() {
    const std::unique_ptr<LiveRun> run = std::move(run_);
    if (run) run->Finish();
  }

  const v1::Description description_;
  const ScenarioSource source_;
  const StageOptions options_;
  const Server::Log log_;
  const std::function<bool()> ended_;
  std::unique_ptr<SampleKeeper> keeper_;  ///< must outlive the run
  std::unique_ptr<LiveRun> run_;
  std::int64_t steps_ = 0;        ///< physics steps since the start
  std::set<std::size_t> driven_;  ///< machines that a step has named
};

}  // namespace

Server::MakeStage LiveStages(const Scenario& scenario, ScenarioSource source,
                             const StageOptions& options, Server::Log log) {
  if (options.record) MakeWritableFolder(*options.record);
  return [description = Describe(scenario), source = std::move(source), options,
          log = std::move(log)](std::function<bool()> ended) {
    return std::make_unique<LiveStage>(description, source, options, log, std::move(ended));
  };
}

}  // namespace tera
