#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "dataset/format/measurement_sink.h"
#include "serve/observation.h"
#include "tera/v1/simulation.pb.h"

namespace tera {

/// True if this type of row sensor has its own message type. Others use RowSample.
bool HasOwnMessage(std::string_view kind);

/// Collects samples of the requested sensors as messages.
class SampleKeeper : public MeasurementSink {
 public:
  /// Clears the collected samples. Collects samples of `sensors` for a step that ends at `end_ns`.
  void Keep(const std::vector<SensorPlan>& sensors, TimeNs end_ns);
  /// Moves the collected samples to `observation`, in the order of the requested sensors.
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
