#include "sim/run/live_run.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>
#include <vector>

#include "core/check.h"
#include "core/error.h"
#include "dataset/format/measurement_sink.h"
#include "dataset/format/writer.h"
#include "sim/run/run.h"
#include "sim/run/terrain_log.h"

namespace tera {
namespace {

/// Forwards channels and measurements to several sinks. A frame is rendered if any sink needs it;
/// all sinks then receive it. Frames are never late.
class SinkGroup : public MeasurementSink {
 public:
  /// The sinks must outlive the group.
  explicit SinkGroup(std::vector<MeasurementSink*> sinks);

  ChannelId AddChannel(const ChannelInfo& info) override;
  void Write(ChannelId channel, Measurement measurement) override;
  bool NeedsFrame(ChannelId channel, TimeNs t_ns, TimeNs next_ns) const override;
  void MarkPresent(ChannelId channel, TimeNs t_ns) override;

 private:
  std::vector<MeasurementSink*> sinks_;
  std::vector<std::vector<ChannelId>> channels_;  ///< [sink][channel of the group]
};

SinkGroup::SinkGroup(std::vector<MeasurementSink*> sinks) : sinks_(std::move(sinks)) {}

ChannelId SinkGroup::AddChannel(const ChannelInfo& info) {
  std::vector<ChannelId> channels;
  for (MeasurementSink* sink : sinks_) channels.push_back(sink->AddChannel(info));
  channels_.push_back(std::move(channels));
  return static_cast<ChannelId>(channels_.size()) - 1;
}

void SinkGroup::Write(ChannelId channel, Measurement measurement) {
  for (std::size_t i = 0; i < sinks_.size(); ++i) {
    const bool last = i + 1 == sinks_.size();
    sinks_[i]->Write(channels_[channel][i], last ? std::move(measurement) : measurement);
  }
}

bool SinkGroup::NeedsFrame(ChannelId channel, TimeNs t_ns, TimeNs next_ns) const {
  for (std::size_t i = 0; i < sinks_.size(); ++i) {
    if (sinks_[i]->NeedsFrame(channels_[channel][i], t_ns, next_ns)) return true;
  }
  return false;
}

void SinkGroup::MarkPresent(ChannelId channel, TimeNs t_ns) {
  for (std::size_t i = 0; i < sinks_.size(); ++i) {
    sinks_[i]->MarkPresent(channels_[channel][i], t_ns);
  }
}

/// Wraps each machine's operator in a RemoteOperator. `remote` receives the wrappers.
Operators TakeOver(Operators operators, std::vector<RemoteOperator*>* remote) {
  for (std::unique_ptr<Operator>& own : operators) {
    auto before = std::make_unique<RemoteOperator>(std::move(own));
    remote->push_back(before.get());
    own = std::move(before);
  }
  return operators;
}

/// Simulated time between two flushes to the disk.
constexpr double kFlush_s = 1.0;

constexpr char kRemedy[] =
    "simulate its commands again (tera replay DIRECTORY --out NEW), or delete it";

std::unique_ptr<DatasetWriter> RecorderOf(const Scenario& scenario,
                                          const std::string& resolved_yaml, const SceneModel& scene,
                                          const LiveOptions& options) {
  if (!options.record) return nullptr;
  return std::make_unique<DatasetWriter>(
      *options.record, InfoOf(scenario, resolved_yaml, scene),
      WriterOptions{.threads = options.threads, .kind = "live recording", .remedy = kRemedy});
}

}  // namespace

struct LiveRun::Impl {
  Impl(std::shared_ptr<const Scenario> given, const std::string& resolved_yaml,
       const LiveOptions& options, std::vector<MeasurementSink*> sinks)
      : scenario(std::move(given)),
        assembly(*scenario),
        recorder(RecorderOf(*scenario, resolved_yaml, assembly.model(), options)),
        group(AllSinks(std::move(sinks))) {
    try {
      run = std::make_unique<Run>(*scenario, TakeOver(OperatorsOf(*scenario), &operators), assembly,
                                  options.egl, options.threads, &group);
      if (recorder) {
        terrain = std::make_unique<TerrainLog>(*scenario, run->simulation().state().ground(),
                                               recorder.get());
      }
    } catch (const InputError&) {
      if (recorder) recorder->Discard();
      throw;
    }
  }

  std::vector<MeasurementSink*> AllSinks(std::vector<MeasurementSink*> sinks) {
    if (recorder) sinks.push_back(recorder.get());
    return sinks;
  }

  /// Advances by one step. Once per second it flushes the recording, together with the first levers
  /// of the next step. A killed run can thus be replayed up to that time.
  void Step() {
    run->Step();
    if (terrain) terrain->Write(run->simulation().state().t_ns);
    const auto steps_per_flush =
        static_cast<std::int64_t>(std::ceil(kFlush_s * scenario->physics_rate_hz));
    if (recorder && ++steps % steps_per_flush == 1) recorder->Flush();
  }

  void Finish() {
    const double duration_s = ToSeconds(run->simulation().state().t_ns);
    if (terrain) terrain->Finish();
    if (recorder && run->task().HasTask()) {
      run->task().WriteMap(recorder->PathFor(kDeviationMap));
    }
    if (recorder) run->WriteEvents(recorder.get());
    run->Finish();
    if (!recorder) return;
    recorder->SetDuration(duration_s);
    recorder->Finish();
  }

  /// Calls `act`. If it throws, the message also names the part of the recording that is kept.
  template <typename Act>
  void Recording(const Act& act) {
    try {
      act();
    } catch (const InputError& error) {
      if (!recorder) throw;
      auto faults = error.faults();
      faults.emplace_back(fmt::format("the incomplete recording is kept in {}: {}",
                                      recorder->incomplete_directory().string(), kRemedy));
      throw InputError(std::move(faults));
    }
  }

  std::shared_ptr<const Scenario> scenario;
  std::vector<RemoteOperator*> operators;  ///< one per machine
  SceneAssembly assembly;
  std::unique_ptr<DatasetWriter> recorder;
  SinkGroup group;
  std::unique_ptr<Run> run;
  std::unique_ptr<TerrainLog> terrain;  ///< set if the run is recorded
  std::int64_t steps = 0;
};

LiveRun::LiveRun(std::shared_ptr<const Scenario> scenario, const std::string& resolved_yaml,
                 const LiveOptions& options, std::vector<MeasurementSink*> sinks)
    : impl_(std::make_unique<Impl>(std::move(scenario), resolved_yaml, options, std::move(sinks))) {
}

LiveRun::~LiveRun() = default;

void LiveRun::Command(std::size_t machine, const ControlMessage& message) {
  TERA_CHECK(machine < impl_->operators.size(), machine);
  const auto fault = FaultOf(message, impl_->scenario->machines[machine].placement.model);
  TERA_CHECK(!fault, fault.value_or(""));
  impl_->operators[machine]->Receive(simulation().state().t_ns, message);
}

void LiveRun::Step() {
  impl_->Recording([this] { impl_->Step(); });
}

void LiveRun::Finish() {
  impl_->Recording([this] { impl_->Finish(); });
}

const Scenario& LiveRun::scenario() const { return *impl_->scenario; }

const Simulation& LiveRun::simulation() const { return impl_->run->simulation(); }

const EventLog& LiveRun::events() const { return impl_->run->events(); }

}  // namespace tera
