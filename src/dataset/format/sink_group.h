#pragma once

#include <vector>

#include "dataset/format/measurement_sink.h"

namespace tera {

/// Several sinks as one: each gets every channel and every measurement. A frame is needed when any
/// of them needs it, and then goes to all; none comes late.
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
  std::vector<std::vector<ChannelId>> channels_;  ///< of each sink, for each of the group's own
};

}  // namespace tera
