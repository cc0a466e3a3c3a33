#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/types/measurement.h"
#include "dataset/format/channel.h"
#include "dataset/format/dataset_description.h"

namespace tera {

/// Joint positions and rates over time.
struct EncoderRecording {
  std::vector<EncoderAxis> axes;
  std::vector<EncoderSample> samples;
};

/// Poses over time. The reference of a real recording may have no velocities.
struct PoseRecording {
  bool has_velocity = false;
  std::vector<TruthPose> poses;
};

/// Any table with a leading t_ns.
struct TableRecording {
  std::vector<std::string> columns;  ///< without t_ns
  std::vector<TimeNs> t_ns;
  std::vector<std::vector<double>> rows;
};

/// Whether a stopped run wrote this directory: it holds INCOMPLETE.txt and no dataset.yaml.
bool WasStopped(const std::filesystem::path& directory);

/// The complete rows of a table of a stopped recording. Throws InputError if there is no such
/// table.
TableRecording LoadStoppedTable(const std::filesystem::path& directory, const std::string& file);

/// The inputs of a recording, complete or stopped; empty if it does not name them.
std::vector<RecordedInput> LoadInputs(const std::filesystem::path& directory);

/// A complete recording on disk, simulated or real, read channel by channel.
///
/// Any deviation from docs/reference/dataset.md is an InputError with file and line: a missing or
/// renamed column, a truncated or non-finite row, times that do not increase, an empty or truncated
/// image or scan. Measurements have t_available_ns = t_ns, since files hold no other time.
class Recording {
 public:
  explicit Recording(const std::filesystem::path& directory);

  const std::filesystem::path& directory() const { return directory_; }
  const DatasetInfo& info() const { return info_; }
  const std::vector<ChannelDescription>& channels() const { return channels_; }
  bool Has(const std::string& path) const;
  /// Paths of all channels of a type, in order of dataset.yaml.
  std::vector<std::string> ChannelsOf(std::string_view type) const;
  /// Paths of all sensor channels of a form: first the types of channel_types.h in their order,
  /// then others in order of dataset.yaml.
  std::vector<std::string> SensorsOf(ChannelForm form) const;
  /// The channels of SensorsOf(kRows) with numbers over time. Receivers are excluded, since their
  /// numbers are invalid without a fix.
  std::vector<std::string> SeriesChannels() const;
  /// The type of an existing channel.
  std::string_view TypeOf(const std::string& path) const;
  /// Names of machines: folders that hold channels, or have truth. A simulated machine has
  /// commands; what has truth alone is an obstacle.
  std::vector<std::string> Machines() const;

  std::vector<ImuSample> LoadImu(const std::string& folder) const;
  std::vector<GnssSample> LoadGnss(const std::string& folder) const;
  EncoderRecording LoadEncoder(const std::string& folder) const;
  /// Samples of any sensor whose samples are rows.
  TableRecording LoadRows(const std::string& folder) const;
  PoseRecording LoadPose(const std::string& file) const;
  TableRecording LoadTable(const std::string& file) const;
  /// Times of a camera's or lidar's frames.
  std::vector<TimeNs> FrameTimes(const std::string& folder) const;
  /// Missing images are empty.
  CameraFrame LoadFrame(const std::string& folder, TimeNs t_ns) const;
  LidarScan LoadScan(const std::string& folder, TimeNs t_ns) const;

 private:
  std::filesystem::path directory_;
  DatasetInfo info_;
  std::vector<ChannelDescription> channels_;
};

}  // namespace tera
