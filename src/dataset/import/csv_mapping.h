#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/config/config.h"
#include "core/time.h"
#include "dataset/import/bag/topic_table.h"
#include "dataset/import/column_mapping.h"
#include "dataset/import/csv_file.h"
#include "dataset/import/row_time.h"

/// The file and rows of a channel, and their values.

namespace tera {

/// Condition for a row to count.
struct RowRule {
  enum class Test { kAbove, kBelow, kEquals, kChanges, kPresent, kNumber };
  std::string column;
  Test test = Test::kAbove;
  double value = 0;      ///< as in the file, without unit conversion
  std::string text;      ///< for kEquals, as written
  bool is_text = false;  ///< `text` is not a number
};

/// Selection of rows in a file, and their times.
struct RowSource {
  std::filesystem::path file;                ///< the first if there are several
  std::vector<std::filesystem::path> files;  ///< text tables, joined in this order
  CsvForm form;
  std::optional<BagTopic> topic;  ///< topic, if the file is a bag
  /// Path of the transform in a topic with many: "transforms[odom>base_link]."
  std::string element;
  UnpackedFiles* unpacked = nullptr;  ///< the import's unpacked bags
  std::string log_type;               ///< for a log of known form (foreign_log.h), else empty
  std::string log_topic;              ///< topic in a ULog
  std::string talker;                 ///< selected NMEA talker, or empty
  std::filesystem::path pose_times;   ///< file with the times of poses in KITTI's form, if any
  RowTime time;
  std::vector<RowRule> rules;
};

/// Reads a channel's `file:`, `topic:`, `parent:` and `child:` of transforms, `form:` and `times:`
/// of poses, `talker:`, `csv:`, `time:` and `valid_if:`. `file`, `talker`, `csv` and `time` default
/// to the mapping's top level. The time of a topic defaults to its header's stamp, or to the
/// recording time of its messages. The time of a log of known form defaults to its column `time`.
/// If the file is the channel's own, neither inherits a text table's time from the top level. Looks
/// the topic up in its bag.
RowSource ReadRowSource(const ConfigMap& channel, const ConfigMap& top, UnpackedFiles* unpacked);

/// The topic of a bag that `key` names. Faults, as an unknown name, go to `channel`.
std::optional<BagTopic> ReadNamedTopic(const ConfigMap& channel, std::string_view key,
                                       const std::filesystem::path& bag, UnpackedFiles* unpacked);

/// A table's syntax from the keys of `csv:`.
CsvForm ReadCsvForm(const ConfigMap& config);

/// One valid row: its time and the values of the requested columns.
struct MappedRow {
  TimeNs t_ns = 0;
  RowPlace line;
  std::vector<double> values;
};

/// All valid rows, with times relative to `zero_ns`. Throws InputError for a missing column. Also
/// throws for an invalid or forbidden number and for times that do not increase, unless `left_out`
/// is given, which then gets such rows.
std::vector<MappedRow> ReadRows(const RowSource& source, const std::vector<ColumnMapping>& columns,
                                TimeNs zero_ns = 0, LeftOutRows* left_out = nullptr);

/// The type of a topic's or a log's rows; empty if only the mapping knows it.
std::string TypeOf(const RowSource& source);

/// "log.csv:12", "log.mcap: /imu message 12".
std::string PlaceOf(const RowSource& source, const RowPlace& line);

}  // namespace tera
