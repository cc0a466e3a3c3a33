#include "serve/live_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <exception>
#include <future>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "core/beside.h"
#include "core/error.h"
#include "core/workers.h"
#include "dataset/files/checked_file.h"
#include "serve/action.h"
#include "serve/description.h"
#include "serve/observation.h"
#include "serve/sample_keeper.h"
#include "serve/session.h"

namespace tera {
namespace {

namespace fs = std::filesystem;

/// Limit that rejects a mistyped step.
constexpr double kLongestStep_s = 3600;
/// Interval in simulated time after which a command is repeated. It is below the timeout of
/// commands.
constexpr double kRepeat_s = 0.5 * RemoteOperator::kTimeout_s;

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

/// Folder for the next recorded episode: its number is `ahead` above the highest existing number.
/// Returns nullopt if episodes are not recorded.
std::optional<fs::path> NextEpisode(const std::optional<fs::path>& folder, int ahead = 1) {
  if (!folder) return std::nullopt;
  int last = 0;
  std::error_code none_there;
  for (const auto& entry : fs::directory_iterator(*folder, none_there)) {
    int number = 0;
    if (std::sscanf(entry.path().filename().c_str(), "episode_%d", &number) == 1) {
      last = std::max(last, number);
    }
  }
  return *folder / fmt::format("episode_{:04}", last + ahead);
}

/// Sum of the power of all joints and gears with positive power. Braking power is not subtracted.
double DrivingPower_w(const MachineState& machine) {
  double power_w = 0;
  for (std::size_t j = 0; j < machine.effort_nm.size(); ++j) {
    power_w += std::max(0.0, machine.effort_nm[j] * machine.qd_radps[j]);
  }
  for (std::size_t g = 0; g < machine.gear_torque_nm.size(); ++g) {
    power_w += std::max(0.0, machine.gear_torque_nm[g] * machine.gear_rate_radps[g]);
  }
  return power_w;
}

/// A run at its start, with the collector of its samples.
struct Episode {
  std::unique_ptr<SampleKeeper> keeper;  ///< must outlive the run
  std::unique_ptr<LiveRun> run;
};

/// The episode that a Reset requests.
struct ResetPlan {
  SeededScenario seeded;
  ObservationPlan observation;
};

/// Throws InputError if the observations of a batch may not fit into one message.
void RequireFits(double bytes) {
  if (bytes <= static_cast<double>(kLargestBatch_bytes)) return;
  throw InputError(
      "", {FaultKind::kOutOfRange,
           fmt::format("samples and terrain of a batch may take {:.0f} MB, need at most {:.0f} MB; "
                       "ask for the latest pictures and scans alone, fewer patches, shorter steps, "
                       "or fewer environments in a batch",
                       1e-6 * bytes, 1e-6 * static_cast<double>(kLargestBatch_bytes))});
}

/// State that all environments of a session share.
struct Shared {
  ScenarioSource source;
  StageOptions options;
  Server::Log log;
  std::function<bool()> ended;
};

/// Consecutive episodes, driven by Reset and Step.
class Environment {
 public:
  Environment(const Shared& shared, const v1::Description& description)
      : shared_(shared), description_(description) {}

  ~Environment() {
    try {
      FinishEpisode();
    } catch (const std::exception& error) {
      shared_.log(fmt::format("the recording is left incomplete: {}", error.what()));
    }
  }

  const v1::Description& description() const { return description_; }

  ResetPlan Plan(const v1::Reset& request) const {
    SeededScenario seeded =
        shared_.source(request.has_seed() ? std::optional(request.seed()) : std::nullopt);
    ObservationPlan observation = PlanObservation(request.observe(), *seeded.scenario, 0);
    return {std::move(seeded), std::move(observation)};
  }

  ObservationPlan Plan(const v1::Step& request) const {
    if (!run_) throw InputError("there is no episode, or a fault has ended it; need Reset");
    const double rate_hz = run_->scenario().physics_rate_hz;
    return PlanObservation(request.observe(), run_->scenario(),
                           static_cast<double>(StepsOf(request, rate_hz)) / rate_hz);
  }

  /// Starts an episode. With `record`, it is recorded in that folder.
  v1::Observation Reset(const v1::Reset& request, const ResetPlan& plan,
                        const std::optional<fs::path>& record) {
    FinishEpisode();
    Episode episode = TakePrepared(request);
    if (!episode.run) episode = Begin(shared_.options, plan, record);
    keeper_ = std::move(episode.keeper);
    run_ = std::move(episode.run);
    steps_ = 0;
    driven_.clear();
    work_j_.assign(run_->scenario().machines.size(), 0);
    touched_.assign(run_->scenario().machines.size(), {});
    v1::Observation observation = Observe(plan.observation);
    observation.set_described_anew(DescribeAnew());
    PrepareNext(request);
    return observation;
  }

  /// Returns nullopt if the session ends during the step.
  std::optional<v1::Observation> Step(const v1::Step& request) {
    const ObservationPlan plan = Plan(request);
    const double rate_hz = run_->scenario().physics_rate_hz;
    const std::int64_t steps = StepsOf(request, rate_hz);
    const Commands commands = CommandsOf(request, run_->scenario());
    keeper_->Keep(plan.sensors, SampleClock{.rate_hz = rate_hz}.Due(steps_ + steps));
    try {
      if (!Run(commands, steps)) return std::nullopt;
    } catch (const InputError& error) {
      run_.reset();
      throw InputError("the episode ends here", error.AsFinding());
    }
    return Observe(plan);
  }

  bool InEpisode() const { return run_ != nullptr; }

 private:
  using Commands = std::map<std::size_t, ControlMessage>;

  /// The next episode, created in parallel with the steps of the current one. A Reset uses it if
  /// seed and observation match.
  struct Prepared {
    std::uint64_t seed;
    std::string observe;
    std::future<Episode> episode;
  };

  static Episode Begin(const StageOptions& options, const ResetPlan& plan,
                       const std::optional<fs::path>& record) {
    Episode episode{std::make_unique<SampleKeeper>(), nullptr};
    episode.keeper->Keep(plan.observation.sensors, 0);
    episode.run = std::make_unique<LiveRun>(
        plan.seeded.scenario, plan.seeded.resolved_yaml,
        LiveOptions{.threads = options.threads, .egl = options.egl, .record = record},
        std::vector<MeasurementSink*>{episode.keeper.get()});
    return episode;
  }

  /// Returns the prepared episode if it fits the request; otherwise an episode without a run.
  Episode TakePrepared(const v1::Reset& request) {
    std::optional<Prepared> prepared = std::exchange(prepared_, std::nullopt);
    if (!prepared) return {};
    Episode episode;
    try {
      episode = prepared->episode.get();
    } catch (const InputError&) {
      return {};  // the Reset creates the episode itself and reports the fault
    }
    const bool fits = request.has_seed() && request.seed() == prepared->seed &&
                      request.observe().SerializeAsString() == prepared->observe;
    return fits ? std::move(episode) : Episode();
  }

  /// Starts to create the next episode if the client announced its seed. Recorded episodes are not
  /// prepared, because the folder must not appear before its episode begins.
  void PrepareNext(const v1::Reset& request) {
    if (!request.has_next_seed() || shared_.options.record) return;
    v1::Reset next = request;
    next.set_seed(request.next_seed());
    prepared_ =
        Prepared{next.seed(), next.observe().SerializeAsString(),
                 Beside([this, next] { return Begin(shared_.options, Plan(next), std::nullopt); })};
  }

  /// Returns false if the session ends during the steps.
  bool Run(const Commands& commands, std::int64_t steps) {
    const auto repeat = std::max<std::int64_t>(
        1, static_cast<std::int64_t>(kRepeat_s * run_->scenario().physics_rate_hz));
    for (std::int64_t k = 0; k < steps; ++k) {
      if (shared_.ended()) return false;
      if (k % repeat == 0) Command(commands);
      run_->Step();
      CountWork();
      CollectTouched();
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

  void CountWork() {
    const double dt_s = 1 / run_->scenario().physics_rate_hz;
    for (std::size_t m = 0; m < work_j_.size(); ++m) {
      work_j_[m] += DrivingPower_w(run_->simulation().state().machines[m]) * dt_s;
    }
  }

  void CollectTouched() {
    for (std::size_t m = 0; m < touched_.size(); ++m) {
      for (std::string& name : run_->events().Touched(m)) touched_[m].insert(std::move(name));
    }
  }

  /// Returns true if the description of the episode differs from the previous one.
  bool DescribeAnew() {
    v1::Description description = Describe(run_->scenario());
    description.set_seed(description_.seed());
    const bool is_new = description.SerializeAsString() != description_.SerializeAsString();
    description_ = std::move(description);
    return is_new;
  }

  v1::Observation Observe(const ObservationPlan& plan) {
    v1::Observation observation;
    const Simulation& simulation = run_->simulation();
    PutState(simulation.state(), run_->scenario(), plan.patches, &observation);
    CollectTouched();
    for (std::size_t m = 0; m < work_j_.size(); ++m) {
      v1::MachineState& machine = *observation.mutable_machines(static_cast<int>(m));
      machine.set_work_j(work_j_[m]);
      for (const std::string& name : std::exchange(touched_[m], {})) machine.add_touches(name);
    }
    keeper_->Take(&observation);
    return observation;
  }

  void FinishEpisode() {
    const std::unique_ptr<LiveRun> run = std::move(run_);
    if (run) run->Finish();
  }

  const Shared& shared_;
  v1::Description description_;
  std::unique_ptr<SampleKeeper> keeper_;  ///< must outlive the run
  std::unique_ptr<LiveRun> run_;
  std::int64_t steps_ = 0;        ///< physics steps since the start of the episode
  std::set<std::size_t> driven_;  ///< machines that a step has commanded
  std::vector<double> work_j_;    ///< driving work per machine
  /// Bodies that each machine has touched since the last observation.
  std::vector<std::set<std::string>> touched_;
  std::optional<Prepared> prepared_;
};

class LiveStage : public Stage {
 public:
  LiveStage(const v1::Description& description, Shared shared)
      : description_(description), shared_(std::move(shared)), workers_(shared_.options.threads) {
    Grow(1);
  }

  v1::Description Describe(std::uint32_t environment) override {
    RequireEnvironment(environment);
    return environment < environments_.size() ? environments_[environment]->description()
                                              : description_;
  }

  std::optional<v1::Observation> Reset(const v1::Reset& request) override {
    return environments_[0]->Reset(request, environments_[0]->Plan(request),
                                   NextEpisode(shared_.options.record));
  }

  std::optional<v1::Observation> Step(const v1::Step& request) override {
    return environments_[0]->Step(request);
  }

  std::optional<v1::Outcomes> Do(const v1::Batch& request) override {
    std::set<std::uint32_t> named;
    for (const v1::Turn& turn : request.turns()) {
      RequireEnvironment(turn.environment());
      if (!named.insert(turn.environment()).second) {
        throw InputError("", {FaultKind::kRepeated,
                              fmt::format("environment {} has two turns in one batch; need one",
                                          turn.environment())});
      }
    }
    if (!named.empty()) Grow(*named.rbegin() + 1);
    const std::vector<TurnPlan> plans = PlanTurns(request);
    v1::Outcomes outcomes;
    for (int k = 0; k < request.turns_size(); ++k) outcomes.add_outcomes();
    std::atomic<bool> ended = false;
    ForTurns(request, [&](int k) {
      if (!Take(request.turns(k), plans[k], outcomes.mutable_outcomes(k))) ended = true;
    });
    if (ended) return std::nullopt;
    return outcomes;
  }

  bool InEpisode() const override { return environments_[0]->InEpisode(); }

 private:
  /// A turn of a batch. All turns are planned before any is executed.
  struct TurnPlan {
    std::exception_ptr fault;  ///< an InputError with which the turn is answered
    std::optional<ResetPlan> reset;
    std::optional<fs::path> record;
    double bytes = 0;  ///< upper bound of the observation
  };

  static void RequireEnvironment(std::uint32_t environment) {
    if (environment < kMostEnvironments) return;
    throw InputError("", {FaultKind::kOutOfRange, fmt::format("environment {}; need 0 to {}",
                                                              environment, kMostEnvironments - 1)});
  }

  void Grow(std::size_t count) {
    while (environments_.size() < count) {
      environments_.push_back(std::make_unique<Environment>(shared_, description_));
    }
  }

  void ForTurns(const v1::Batch& request, const std::function<void(int)>& work) {
    workers_.ForRanges(request.turns_size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) work(static_cast<int>(k));
    });
  }

  /// Plans all turns; recordings are numbered in the order of turns. Throws InputError if the
  /// observations are too large.
  std::vector<TurnPlan> PlanTurns(const v1::Batch& request) {
    std::vector<TurnPlan> plans(request.turns_size());
    ForTurns(request, [&](int k) {
      const v1::Turn& turn = request.turns(k);
      const Environment& environment = *environments_[turn.environment()];
      try {
        if (turn.has_reset()) plans[k].reset = environment.Plan(turn.reset());
        plans[k].bytes = plans[k].reset    ? plans[k].reset->observation.bytes
                         : turn.has_step() ? environment.Plan(turn.step()).bytes
                                           : 0;
      } catch (const InputError&) {
        plans[k].fault = std::current_exception();
      }
    });
    int resets = 0;
    double bytes = 0;
    for (int k = 0; k < request.turns_size(); ++k) {
      if (plans[k].reset) plans[k].record = NextEpisode(shared_.options.record, ++resets);
      bytes += plans[k].bytes;
    }
    RequireFits(bytes);
    return plans;
  }

  /// Executes a turn. Returns false if the session ends during it.
  bool Take(const v1::Turn& turn, const TurnPlan& plan, v1::Outcome* outcome) {
    Environment& environment = *environments_[turn.environment()];
    const bool was_in_episode = environment.InEpisode();
    try {
      if (plan.fault) std::rethrow_exception(plan.fault);
      if (turn.has_reset()) {
        *outcome->mutable_observation() = environment.Reset(turn.reset(), *plan.reset, plan.record);
        return true;
      }
      if (!turn.has_step()) throw InputError("a turn of no kind; need Reset or Step");
      std::optional<v1::Observation> observation = environment.Step(turn.step());
      if (!observation) return false;
      *outcome->mutable_observation() = std::move(*observation);
    } catch (const InputError& error) {
      outcome->mutable_refusal()->set_message(error.what());
      outcome->mutable_refusal()->set_episode_over(was_in_episode && !environment.InEpisode());
    }
    return true;
  }

  const v1::Description description_;
  const Shared shared_;
  std::vector<std::unique_ptr<Environment>> environments_;  ///< by environment number
  Workers workers_;  ///< its threads execute the turns of a batch
};

}  // namespace

Server::MakeStage LiveStages(const Scenario& scenario, ScenarioSource source,
                             const StageOptions& options, Server::Log log) {
  if (options.record) MakeWritableFolder(*options.record);
  return [description = Describe(scenario), source = std::move(source), options,
          log = std::move(log)](std::function<bool()> ended) {
    return std::make_unique<LiveStage>(description, Shared{source, options, log, std::move(ended)});
  };
}

}  // namespace tera
