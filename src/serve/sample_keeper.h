#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "dataset/format/measurement_sink.h"
#include "serve/observation.h"
#include "tera/v1/simulation.pb.h"

namespace tera {

/// True if samples of a kind of rows have their own message type; all others use RowSample.
bool HasOwnMessage(std::string_view kind);

/// Collects the requested sensors' samples as messages.
class SampleKeeper : public MeasurementSink {
 public:
  /// Discards collected samples and collects those of a step that ends at `end_ns`.
  void Keep(const std::vector<SensorPlan>& sensors, TimeNs end_ns);
  /// Moves the collected samples to `observation`, in the order of `sensors`.
  void Take(v1::Observation* observation);

  ChannelId AddChannel(const ChannelInfo& info) override;
  void Write(ChannelId channel, Measurement measurement) override;

  bool NeedsFrame(ChannelId channel, TimeNs t_ns, TimeNs next_ns) const override;
  void MarkPresent(ChannelId, TimeNs) override {}

 private:
  struct Channel {
    std::string folder, type;
    int kept = kNotKept;  ///< index into plans_ and samples_
  };
  static constexpr int kNotKept = -1;

  int PlanOf(const std::string& folder) const;

  std::vector<Channel> channels_;
  std::vector<SensorPlan> plans_;
  std::vector<v1::SensorSamples> samples_;
  TimeNs end_ns_ = 0;
};

}  // namespace tera
