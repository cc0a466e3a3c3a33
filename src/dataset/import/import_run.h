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

/// An import that goes on.
class ImportRun {
 public:
  ImportRun(const ImportOptions& options, DatasetWriter* writer, TimeNs zero_ns)
      : options_(options), writer_(writer), zero_ns_(zero_ns) {}

  /// Throws InputError for a row that cannot be what it should be.
  using RowCheck = std::function<void(const MappedRow& row)>;

  /// The rows of a channel, which the report tells of from then on.
  std::vector<MappedRow> Read(const std::string& path, const RowSource& source,
                              const std::vector<ColumnMapping>& columns,
                              const RowCheck& check = nullptr);
  /// Tells of a channel of frames that were read elsewhere, by their times in the recording.
  ImportedChannel* AddFrames(const std::string& path, const std::string& file,
                             const std::vector<TimeNs>& t_ns, const LeftOutRows& left_out);
  /// The channel that Read told of last.
  ImportedChannel* last() { return &report_.channels.back(); }
  /// Adds the motion series of the latest channel from Read, for the comparison of clocks.
  void AddMotion(const RowSource& source, std::vector<MotionSeries> series);
  /// None where nothing is to be written.
  DatasetWriter* writer() const { return writer_; }
  const ImportOptions& options() const { return options_; }
  /// The recording's zero in the files' times.
  TimeNs zero_ns() const { return zero_ns_; }
  /// The time scale of all clocks that were read, where they are known to share one.
  ClockScale Clock() const;
  /// With the clocks compared.
  ImportReport TakeReport();

 private:
  const ImportOptions& options_;
  DatasetWriter* writer_;
  TimeNs zero_ns_;
  ImportReport report_;
  std::vector<ChannelMotion> motions_;
  std::set<ClockScale> clocks_;
};

/// Writes one channel; made while the mapping is read, run when it is known to be sound.
using ImportJob = std::function<void(ImportRun*)>;

struct Mapping {
  DatasetInfo info;
  std::string machine;
  std::set<std::string> paths;  ///< of channels
  std::vector<ImportJob> jobs;
  bool starts_at_zero = false;          ///< times are counted from the first measurement
  std::optional<RecordingEpoch> epoch;  ///< when the files' times are 0, where the mapping says so
  const ImportOptions& options;
  UnpackedFiles* unpacked;
};

/// The machine's folder or file for the channel that `name` names, with `ending`.
std::string ReadPath(const ConfigMap& config, const std::string& ending, Mapping* mapping);

/// The columns of a channel: from its `columns:`, and those that are not there, of a topic of a
/// standard type or a log of known form, from its fields.
class ColumnKeys {
 public:
  /// `makes` names the type whose fields such channels are made of, as far as it has one for `key`.
  ColumnKeys(const ConfigMap& channel, const RowSource& source, std::string_view makes,
             std::string_view key);

  ColumnMapping Read(const char* key, Dimension dimension, const Range& allowed = {}) const;
  /// The key's mapping where the channel has it.
  std::optional<ConfigMap> Given(const char* key) const;

 private:
  std::optional<ConfigMap> given_;
  std::string type_;     ///< of the topic or the log
  std::string element_;  ///< of the source
};

/// Content of sensor.yaml for a sensor that was not simulated.
struct ImportedSensor {
  std::string type, name;
  std::string link;  ///< empty where the mapping does not say where the sensor was
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
