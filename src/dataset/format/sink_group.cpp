#include "dataset/format/sink_group.h"

#include <utility>

namespace tera {

SinkGroup::SinkGroup(std::vector<MeasurementSink*> sinks) : sinks_(std::move(sinks)) {}

template <typename Add>
ChannelId SinkGroup::AddToAll(const Add& add) {
  std::vector<ChannelId> channels;
  for (MeasurementSink* sink : sinks_) channels.push_back(add(sink));
  channels_.push_back(std::move(channels));
  return static_cast<ChannelId>(channels_.size()) - 1;
}

template <typename Measurement>
void SinkGroup::WriteToAll(ChannelId channel, const Measurement& measurement) {
  for (std::size_t i = 0; i < sinks_.size(); ++i) {
    sinks_[i]->Write(channels_[channel][i], measurement);
  }
}

ChannelId SinkGroup::AddImu(const std::string& folder, const std::string& sensor_yaml) {
  return AddToAll([&](MeasurementSink* sink) { return sink->AddImu(folder, sensor_yaml); });
}

ChannelId SinkGroup::AddGnss(const std::string& folder, const std::string& sensor_yaml) {
  return AddToAll([&](MeasurementSink* sink) { return sink->AddGnss(folder, sensor_yaml); });
}

ChannelId SinkGroup::AddEncoder(const std::string& folder, const std::string& sensor_yaml,
                                const std::vector<EncoderAxis>& axes) {
  return AddToAll(
      [&](MeasurementSink* sink) { return sink->AddEncoder(folder, sensor_yaml, axes); });
}

ChannelId SinkGroup::AddCamera(const std::string& folder, const std::string& sensor_yaml) {
  return AddToAll([&](MeasurementSink* sink) { return sink->AddCamera(folder, sensor_yaml); });
}

ChannelId SinkGroup::AddLidar(const std::string& folder, const std::string& sensor_yaml) {
  return AddToAll([&](MeasurementSink* sink) { return sink->AddLidar(folder, sensor_yaml); });
}

ChannelId SinkGroup::AddTable(const std::string& file, const std::vector<std::string>& columns) {
  return AddToAll([&](MeasurementSink* sink) { return sink->AddTable(file, columns); });
}

ChannelId SinkGroup::AddPose(const std::string& file, bool with_velocity) {
  return AddToAll([&](MeasurementSink* sink) { return sink->AddPose(file, with_velocity); });
}

void SinkGroup::Write(ChannelId channel, const ImuSample& sample) { WriteToAll(channel, sample); }

void SinkGroup::Write(ChannelId channel, const GnssSample& sample) { WriteToAll(channel, sample); }

void SinkGroup::Write(ChannelId channel, const EncoderSample& sample) {
  WriteToAll(channel, sample);
}

void SinkGroup::Write(ChannelId channel, CameraFrame frame) { WriteToAll(channel, frame); }

void SinkGroup::Write(ChannelId channel, LidarScan scan) { WriteToAll(channel, scan); }

void SinkGroup::Write(ChannelId channel, const TruthPose& pose) { WriteToAll(channel, pose); }

void SinkGroup::WriteRow(ChannelId channel, TimeNs t_ns, const std::vector<double>& values) {
  for (std::size_t i = 0; i < sinks_.size(); ++i) {
    sinks_[i]->WriteRow(channels_[channel][i], t_ns, values);
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
