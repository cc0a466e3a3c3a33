#pragma once

#include <string>
#include <vector>

#include "dataset/format/measurement_sink.h"
#include "serve/observation.h"
#include "tera/v1/simulation.pb.h"

namespace tera {

/// Keeps the samples of the sensors that a client asked for, as messages, until they are taken.
class SampleKeeper : public MeasurementSink {
 public:
  /// From now on, over a step that ends at `end_ns`; what is kept already is forgotten.
  void Keep(const std::vector<SensorPlan>& sensors, TimeNs end_ns);
  /// Hands over what was kept, in the order of `sensors`.
  void Take(v1::Observation* observation);

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
  void Write(ChannelId, const TruthPose&) override {}
  void WriteRow(ChannelId, TimeNs, const std::vector<double>&) override {}

  bool NeedsFrame(ChannelId channel, TimeNs t_ns, TimeNs next_ns) const override;
  void MarkPresent(ChannelId, TimeNs) override {}

 private:
  struct Channel {
    std::string folder;
    int kept = kNotKept;  ///< index into plans_ and samples_
  };
  static constexpr int kNotKept = -1;

  ChannelId Add(const std::string& folder);
  int PlanOf(const std::string& folder) const;
  /// Where the channel's samples go, or null.
  v1::SensorSamples* Kept(ChannelId channel);

  std::vector<Channel> channels_;
  std::vector<SensorPlan> plans_;
  std::vector<v1::SensorSamples> samples_;
  TimeNs end_ns_ = 0;
};

}  // namespace tera
