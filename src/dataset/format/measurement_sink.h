#pragma once

#include <string>
#include <vector>

#include "core/motion.h"
#include "core/time.h"
#include "core/types/measurement.h"

namespace tera {

/// Handle of one channel of a sink.
using ChannelId = int;

/// What an encoder reads: an angle, or the travel of a prismatic joint.
struct EncoderAxis {
  std::string name;
  bool linear = false;

  bool operator==(const EncoderAxis&) const = default;
};

/// Pose (and velocity) truth of a machine's root link.
struct TruthPose {
  TimeNs t_ns = 0;
  Pose X_WB = Pose::Identity();
  Vec3 v_WB_mps = Vec3::Zero();
  Vec3 w_WB_B_radps = Vec3::Zero();
};

/// Where the measurements of a run go: a dataset, or whoever listens. Channels are added before
/// the first measurement; those of one channel come in the order of their times.
class MeasurementSink {
 public:
  virtual ~MeasurementSink() = default;

  // Channels. `folder` is relative, "excavator1/imu_boom"; `sensor_yaml` is SensorYaml's text.
  virtual ChannelId AddImu(const std::string& folder, const std::string& sensor_yaml) = 0;
  virtual ChannelId AddGnss(const std::string& folder, const std::string& sensor_yaml) = 0;
  virtual ChannelId AddEncoder(const std::string& folder, const std::string& sensor_yaml,
                               const std::vector<EncoderAxis>& axes) = 0;
  virtual ChannelId AddCamera(const std::string& folder, const std::string& sensor_yaml) = 0;
  virtual ChannelId AddLidar(const std::string& folder, const std::string& sensor_yaml) = 0;
  /// Any table with a leading t_ns: commands.csv, truth/<machine>/joints.csv.
  virtual ChannelId AddTable(const std::string& file, const std::vector<std::string>& columns) = 0;
  /// truth/<machine>/pose.csv. A real reference without velocities leaves their columns out.
  virtual ChannelId AddPose(const std::string& file, bool with_velocity = true) = 0;

  virtual void Write(ChannelId channel, const ImuSample& sample) = 0;
  virtual void Write(ChannelId channel, const GnssSample& sample) = 0;
  virtual void Write(ChannelId channel, const EncoderSample& sample) = 0;
  virtual void Write(ChannelId channel, CameraFrame frame) = 0;
  virtual void Write(ChannelId channel, LidarScan scan) = 0;
  virtual void Write(ChannelId channel, const TruthPose& pose) = 0;
  virtual void WriteRow(ChannelId channel, TimeNs t_ns, const std::vector<double>& values) = 0;

  /// False where the sink can do without this channel's frame of time stamp `t_ns`; the caller then
  /// only calls MarkPresent instead of measuring and writing it. `next_ns` is when the channel's
  /// next frame will truly come, whatever the sensor's clock says.
  virtual bool NeedsFrame(ChannelId channel, TimeNs t_ns, TimeNs next_ns) const = 0;
  virtual void MarkPresent(ChannelId channel, TimeNs t_ns) = 0;
};

}  // namespace tera
