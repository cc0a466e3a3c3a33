#include "dataset/format/sink_group.h"

#include <utility>

namespace tera {

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

}  // namespace tera
