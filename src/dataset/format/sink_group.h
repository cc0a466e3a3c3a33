#pragma once

#include <vector>

#include "dataset/format/measurement_sink.h"

namespace tera {

/// Several sinks as one: each gets every channel and every measurement. A frame is needed when any
/// of them needs it, and then goes to all.
class SinkGroup : public MeasurementSink {
 public:
  /// The sinks must outlive the group.
  explicit SinkGroup(std::vector<MeasurementSink*> sinks);

  ChannelId AddImu(const std::string& folder, const std::string& sensor_yaml) override;
  ChannelId AddGnss(const std::string& folder, const std::string& sensor_yaml) override;
  ChannelId AddEncoder(const std::string& folder, const std::string& sensor_yaml,
                       const std::vector<EncoderAxis>& axes) override;
  ChannelId AddCamera(const std::string& folder, const std::string& sensor_yaml) override;
  ChannelId AddLidar(const std::string& folder, const std::string& sensor_yaml) override;
  ChannelId AddTable(const std::string& file, const std::vector<std::string>& columns) override;
  ChannelId AddPose(const std::string& file, bool with_velocity) override;

  void Write(ChannelId channel, const ImuSample& sample) override;
  void Write(ChannelId channel, const GnssSample& sample) override;
  void Write(ChannelId channel, const EncoderSample& sample) override;
  void Write(ChannelId channel, CameraFrame frame) override;
  void Write(ChannelId channel, LidarScan scan) override;
  void Write(ChannelId channel, const TruthPose& pose) override;
  void WriteRow(ChannelId channel, TimeNs t_ns, const std::vector<double>& values) override;

  bool NeedsFrame(ChannelId channel, TimeNs t_ns, TimeNs next_ns) const override;
  void MarkPresent(ChannelId channel, TimeNs t_ns) override;

 private:
  /// Adds a channel to every sink by `add(sink)`.
  template <typename Add>
  ChannelId AddToAll(const Add& add);
  template <typename Measurement>
  void WriteToAll(ChannelId channel, const Measurement& measurement);

  std::vector<MeasurementSink*> sinks_;
  std::vector<std::vector<ChannelId>> channels_;  ///< of each sink, for each of the group's own
};

}  // namespace tera
