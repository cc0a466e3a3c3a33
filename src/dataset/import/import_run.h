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

/// A running import.
class ImportRun {
 public:
  ImportRun(const ImportOptions& options, DatasetWriter* writer, TimeNs zero_ns)
      : options_(options), writer_(writer), zero_ns_(zero_ns) {}

  /// Throws InputError for an impossible row.
  using RowCheck = std::function<void(const MappedRow& row)>;

  /// Reads the rows of a channel and adds the channel to the report.
  std::vector<MappedRow> Read(const std::string& path, const RowSource& source,
                              const std::vector<ColumnMapping>& columns,
                              const RowCheck& check = nullptr);
  /// Adds a channel of frames read elsewhere to the report, by their times in the recording.
  ImportedChannel* AddFrames(const std::string& path, const std::string& file,
                             const std::vector<TimeNs>& t_ns, const LeftOutRows& left_out);
  /// The report's entry of the channel that was read last.
  ImportedChannel* last() { return &report_.channels.back(); }
  /// Adds the motion series of the latest channel from Read, for the comparison of clocks.
  void AddMotion(const RowSource& source, std::vector<MotionSeries> series);
  /// Null for an import that writes nothing.
  DatasetWriter* writer() const { return writer_; }
  const ImportOptions& options() const { return options_; }
  /// The recording's zero in the files' times.
  TimeNs zero_ns() const { return zero_ns_; }
  /// The time scale common to all clocks read, where known.
  ClockScale Clock() const;
  /// With the comparison of clocks.
  ImportReport TakeReport();

 private:
  const ImportOptions& options_;
  DatasetWriter* writer_;
  TimeNs zero_ns_;
  ImportReport report_;
  std::vector<ChannelMotion> motions_;
  std::set<ClockScale> clocks_;
};

/// Writes one channel; created while the mapping is read, run once the mapping is sound.
using ImportJob = std::function<void(ImportRun*)>;

struct Mapping {
  DatasetInfo info;
  std::string machine;
  std::set<std::string> paths;  ///< of channels
  std::vector<ImportJob> jobs;
  bool starts_at_zero = false;          ///< times count from the first measurement
  std::optional<RecordingEpoch> epoch;  ///< instant at which the files' times are 0, if the mapping
                                        ///< has it
  const ImportOptions& options;
  UnpackedFiles* unpacked;
};

/// The path of the channel named by `name`, in the machine's folder, with `ending`.
std::string ReadPath(const ConfigMap& config, const std::string& ending, Mapping* mapping);

/// The columns of a channel: from its `columns:`. Missing ones come from the fields of the topic's
/// standard type or of the log's known form.
class ColumnKeys {
 public:
  /// `makes` is the type whose fields form such channels, if it has one for `key`.
  ColumnKeys(const ConfigMap& channel, const RowSource& source, std::string_view makes,
             std::string_view key);

  ColumnMapping Read(const char* key, Dimension dimension, const Range& allowed = {}) const;
  /// The key's mapping, if the channel has it.
  std::optional<ConfigMap> Given(const char* key) const;

 private:
  std::optional<ConfigMap> given_;
  std::string type_;     ///< of the topic or the log
  std::string element_;  ///< of the source
};

/// Content of sensor.yaml for an imported sensor.
struct ImportedSensor {
  std::string type, name;
  std::string link;  ///< empty if the mapping does not name the sensor's link
  Pose X_LS = Pose::Identity();
};
/// Reads a channel's `name` and `mount`.
ImportedSensor ReadSensorMount(const ConfigMap& config, const std::string& type);
std::string SensorText(const ImportedSensor& sensor, const RowSource& source,
                       const std::vector<MappedRow>& rows);

// Channels by the keys of the mapping.
ImportJob ReadImu(const ConfigMap& config, const ConfigMap& top, Mapping* mapping);
ImportJob ReadGyro(const ConfigMap& config, const ConfigMap& top, Mapping* mapping);
ImportJob ReadGnss(const ConfigMap& config, const ConfigMap& top, Mapping* mapping);
ImportJob ReadEncoder(const ConfigMap& config, const ConfigMap& top, Mapping* mapping);
ImportJob ReadPose(const ConfigMap& config, const ConfigMap& top, Mapping* mapping);
ImportJob ReadTable(const ConfigMap& config, const ConfigMap& top, Mapping* mapping);

}  // namespace tera
