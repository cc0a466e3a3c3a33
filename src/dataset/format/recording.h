#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/types/measurement.h"
#include "dataset/format/channel.h"
#include "dataset/format/dataset_description.h"

namespace tera {

struct EncoderRecording {
  std::vector<EncoderAxis> axes;
  std::vector<EncoderSample> samples;
};

/// Poses over time. A reference trajectory of a real recording may have no velocities.
struct PoseRecording {
  bool has_velocity = false;
  std::vector<TruthPose> poses;
};

/// A table whose first column is t_ns.
struct TableRecording {
  std::vector<std::string> columns;  ///< without t_ns
  std::vector<TimeNs> t_ns;
  std::vector<std::vector<double>> rows;
};

/// True if a run was stopped before it completed this directory. The directory then holds
/// INCOMPLETE.txt but no dataset.yaml.
bool WasStopped(const std::filesystem::path& directory);

/// All complete rows of a table in a stopped recording. Throws InputError if the table does not
/// exist.
TableRecording LoadStoppedTable(const std::filesystem::path& directory, const std::string& file);

/// Inputs of a complete or stopped recording; empty if the recording lists none.
std::vector<RecordedInput> LoadInputs(const std::filesystem::path& directory);

/// A complete recording on disk, simulated or real. Channels are read on request.
///
/// Throws InputError with file and line for any deviation from docs/reference/dataset.md. Examples
/// are missing or renamed columns, truncated or non-finite rows, times that do not increase, and
/// empty or truncated images or scans. Files store no t_available_ns, so measurements have
/// t_available_ns = t_ns.
class Recording {
 public:
  explicit Recording(const std::filesystem::path& directory);

  const std::filesystem::path& directory() const { return directory_; }
  const DatasetInfo& info() const { return info_; }
  const std::vector<ChannelDescription>& channels() const { return channels_; }
  bool Has(const std::string& path) const;
  /// Paths of all channels of the type, in the order of dataset.yaml.
  std::vector<std::string> ChannelsOf(std::string_view type) const;
  /// Paths of all sensor channels of the form. Types declared in channel_types.h come first, in the
  /// order declared there; other types follow in the order of dataset.yaml.
  std::vector<std::string> SensorsOf(ChannelForm form) const;
  /// Channels of SensorsOf(kRows) that are valid time series. GNSS receivers are excluded, because
  /// their values are invalid without a fix.
  std::vector<std::string> SeriesChannels() const;
  std::string_view TypeOf(const std::string& path) const;
  /// Names of machines: folders that hold channels, and names under truth/. In a simulated
  /// recording, a name under truth/ counts only if it has a table of commands; otherwise it is an
  /// obstacle.
  std::vector<std::string> Machines() const;

  std::vector<ImuSample> LoadImu(const std::string& folder) const;
  std::vector<GnssSample> LoadGnss(const std::string& folder) const;
  EncoderRecording LoadEncoder(const std::string& folder) const;
  /// Samples of any sensor that records rows.
  TableRecording LoadRows(const std::string& folder) const;
  PoseRecording LoadPose(const std::string& file) const;
  TableRecording LoadTable(const std::string& file) const;
  std::vector<TimeNs> FrameTimes(const std::string& folder) const;
  /// Images absent on disk stay empty.
  CameraFrame LoadFrame(const std::string& folder, TimeNs t_ns) const;
  LidarScan LoadScan(const std::string& folder, TimeNs t_ns) const;

 private:
  std::filesystem::path directory_;
  DatasetInfo info_;
  std::vector<ChannelDescription> channels_;
};

}  // namespace tera
