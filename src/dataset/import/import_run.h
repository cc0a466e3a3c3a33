#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/config/config.h"
#include "dataset/format/dataset_description.h"
#include "dataset/format/writer.h"
#include "dataset/import/csv_mapping.h"
#include "dataset/import/import_options.h"
#include "dataset/import/left_out_rows.h"

namespace tera {

class ImportRun {
 public:
  ImportRun(const ImportOptions& options, DatasetWriter* writer, TimeNs zero_ns)
      : options_(options), writer_(writer), zero_ns_(zero_ns) {}

  /// Checks a row; throws InputError for physically impossible values.
  using RowCheck = std::function<void(const MappedRow& row)>;

  /// Reads all rows of a channel and adds the channel to the report.
  std::vector<MappedRow> Read(const std::string& path, const RowSource& source,
                              const std::vector<ColumnMapping>& columns,
                              const RowCheck& check = nullptr);
  /// Adds a channel of frames to the report. The caller has read the frames; `t_ns` are their times
  /// in the recording.
  ImportedChannel* AddFrames(const std::string& path, const std::string& file,
                             const std::vector<TimeNs>& t_ns, const LeftOutRows& left_out);
  /// Report entry of the channel that was read last.
  ImportedChannel* last() { return &report_.channels.back(); }
  /// Adds the motion series of the channel last read, for the comparison of clocks.
  void AddMotion(const RowSource& source, std::vector<MotionSeries> series);
  /// Null for a check that writes nothing.
  DatasetWriter* writer() const { return writer_; }
  const ImportOptions& options() const { return options_; }
  /// Time 0 of the recording, in the time of the files.
  TimeNs zero_ns() const { return zero_ns_; }
  /// Time scale common to all clocks read so far; kUnknown if they differ or any is unknown.
  ClockScale Clock() const;
  /// Compares the clocks and returns the report.
  ImportReport TakeReport();

 private:
  const ImportOptions& options_;
  DatasetWriter* writer_;
  TimeNs zero_ns_;
  ImportReport report_;
  std::vector<ChannelMotion> motions_;
  std::set<ClockScale> clocks_;
};

/// Imports one channel. It is created while the mapping is read, and runs after the mapping has
/// proved valid.
using ImportJob = std::function<void(ImportRun*)>;

struct Mapping {
  DatasetInfo info;
  std::string machine;
  std::set<std::string> paths;  ///< paths of the channels
  std::vector<ImportJob> jobs;
  bool starts_at_zero = false;          ///< time 0 of the recording is the first measurement
  std::optional<RecordingEpoch> epoch;  ///< date at which the time of the files is 0; absent if the
                                        ///< mapping does not give it
  const ImportOptions& options;
  UnpackedFiles* unpacked;
};

/// Path of a channel: the machine's folder, the value of `name`, and `ending`.
std::string ReadPath(const ConfigMap& config, const std::string& ending, Mapping* mapping);

/// Columns of a channel, from its key `columns`. A column that is absent there is taken from the
/// standard fields of the topic's message type or the log's format.
class ColumnKeys {
 public:
  /// `makes` is a message type that can form this kind of channel. Standard fields are used only if
  /// this message type has a standard field for `key`.
  ColumnKeys(const ConfigMap& channel, const RowSource& source, std::string_view makes,
             std::string_view key);

  ColumnMapping Read(const char* key, Dimension dimension, const Range& allowed = {}) const;
  /// Mapping of the key, if the channel gives one.
  std::optional<ConfigMap> Given(const char* key) const;

 private:
  std::optional<ConfigMap> given_;
  std::string type_;     ///< type of the topic or log
  std::string element_;  ///< path prefix within a message, as in RowSource::element
};

/// Content of sensor.yaml for an imported sensor.
struct ImportedSensor {
  std::string type, name;
  std::string link;  ///< link that carries the sensor; empty if unknown
  Pose X_LS = Pose::Identity();
};
/// Reads the keys `name` and `mount` of a channel.
ImportedSensor ReadSensorMount(const ConfigMap& config, const std::string& type);
std::string SensorText(const ImportedSensor& sensor, const RowSource& source,
                       const std::vector<MappedRow>& rows);

// One function per key of the mapping.
ImportJob ReadImu(const ConfigMap& config, const ConfigMap& top, Mapping* mapping);
ImportJob ReadGyro(const ConfigMap& config, const ConfigMap& top, Mapping* mapping);
ImportJob ReadGnss(const ConfigMap& config, const ConfigMap& top, Mapping* mapping);
ImportJob ReadEncoder(const ConfigMap& config, const ConfigMap& top, Mapping* mapping);
ImportJob ReadPose(const ConfigMap& config, const ConfigMap& top, Mapping* mapping);
ImportJob ReadTable(const ConfigMap& config, const ConfigMap& top, Mapping* mapping);

}  // namespace tera
