#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/measurement.h"

namespace tera {

/// What dataset.yaml says about the whole recording.
struct DatasetInfo {
  std::string scenario_name;
  bool simulated = true;
  std::uint64_t seed = 0;
  double duration_s = 0;
  double origin_lat_deg = 0, origin_lon_deg = 0, origin_height_m = 0;
  std::string resolved_scenario_yaml;  ///< goes to scenario.yaml
  struct Instance {
    std::uint16_t id;
    std::string name;
    std::string label;
  };
  std::vector<Instance> instances;
};

/// Handle of one channel (a CSV file with, for cameras and lidars, files beside it).
using ChannelId = int;

/// What an encoder reads: an angle, or the travel of a prismatic joint.
struct EncoderAxis {
  std::string name;
  bool linear = false;

  bool operator==(const EncoderAxis&) const = default;
};

struct WriterOptions {
  int threads = 2;        ///< encoding threads
  int queue_length = 64;  ///< frames waiting before Write blocks
  bool resume = false;
};

/// Pose (and velocity) truth of a machine's root link.
struct TruthPose {
  TimeNs t_ns = 0;
  Pose X_WB = Pose::Identity();
  Vec3 v_WB_mps = Vec3::Zero();
  Vec3 w_WB_B_radps = Vec3::Zero();
};

/// Writes a recording. Frames are encoded on worker threads behind a bounded queue; rows are
/// written in order by the caller's thread. Everything goes to `<directory>.incomplete` and is
/// renamed to
/// `<directory>` by Finish; every file appears under its name only when whole.
///
/// Throws InputError: directory not empty, not writable, disk full; on resume, a partial dataset of
/// another scenario, seed or version.
class DatasetWriter {
 public:
  DatasetWriter(const std::filesystem::path& directory, const DatasetInfo& info,
                const WriterOptions& options);
  /// Without Finish, leaves the incomplete directory for a later resume.
  ~DatasetWriter();

  /// Gives a recording its name that an earlier run had finished but for that. False where there is
  /// none. Throws InputError where it is of another scenario, seed or version.
  static bool FinishWhole(const std::filesystem::path& directory, const DatasetInfo& info);

  // Channels. `folder` is relative, "excavator1/imu_boom"; `sensor_yaml` goes to sensor.yaml.
  ChannelId AddImu(const std::string& folder, const std::string& sensor_yaml);
  ChannelId AddGnss(const std::string& folder, const std::string& sensor_yaml);
  ChannelId AddEncoder(const std::string& folder, const std::string& sensor_yaml,
                       const std::vector<EncoderAxis>& axes);
  ChannelId AddCamera(const std::string& folder, const std::string& sensor_yaml);
  ChannelId AddLidar(const std::string& folder, const std::string& sensor_yaml);
  /// Any table with a leading t_ns: commands.csv, truth/<machine>/joints.csv.
  ChannelId AddTable(const std::string& file, const std::vector<std::string>& columns);
  /// truth/<machine>/pose.csv. A real reference without velocities leaves their columns out.
  ChannelId AddPose(const std::string& file, bool with_velocity = true);

  void Write(ChannelId channel, const ImuSample& sample);
  void Write(ChannelId channel, const GnssSample& sample);
  void Write(ChannelId channel, const EncoderSample& sample);
  void Write(ChannelId channel, CameraFrame frame);
  void Write(ChannelId channel, LidarScan scan);
  void Write(ChannelId channel, const TruthPose& pose);
  void WriteRow(ChannelId channel, TimeNs t_ns, const std::vector<double>& values);

  /// False when resuming and the files of this channel's frame at `t_ns` are whole already; the
  /// caller then only calls MarkPresent instead of measuring and writing it.
  bool NeedsFrame(ChannelId channel, TimeNs t_ns) const;
  void MarkPresent(ChannelId channel, TimeNs t_ns);

  /// Where to put a file of another kind (truth/terrain/*.tif); its folder exists.
  std::filesystem::path PathFor(const std::string& relative);

  std::int64_t frames_written() const;
  std::int64_t bytes_written() const;

  /// Goes on with a recording that an earlier run began.
  bool resumed() const;
  /// Where everything is until Finish.
  const std::filesystem::path& incomplete_directory() const;

  /// What dataset.yaml says in place of the duration that was given at the start.
  void SetDuration(double duration_s);
  /// Waits for the queue, closes everything and renames the directory into place.
  void Finish();
  /// Gives up: removes the incomplete directory. Nothing may be called after it.
  void Discard();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tera
