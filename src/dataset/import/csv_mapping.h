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

/// Selection of a channel's file and rows, and conversion of their values.

namespace tera {

/// Condition that a valid row must satisfy.
struct RowRule {
  enum class Test { kAbove, kBelow, kEquals, kChanges, kPresent, kNumber };
  std::string column;
  Test test = Test::kAbove;
  double value = 0;      ///< in the unit of the file
  std::string text;      ///< for kEquals: text as written in the file
  bool is_text = false;  ///< `text` is not a number
};

/// File and rows that form a channel, and the source of their times.
struct RowSource {
  std::filesystem::path file;                ///< the first file if there are several
  std::vector<std::filesystem::path> files;  ///< text tables to concatenate, in this order
  CsvForm form;
  std::optional<BagTopic> topic;  ///< set if the file is a bag
  /// Path prefix of the selected transform in a topic with many: "transforms[odom>base_link]."
  std::string element;
  UnpackedFiles* unpacked = nullptr;  ///< cache of decompressed bags
  std::string log_type;               ///< type of foreign_log.h; empty for other files
  std::string log_topic;              ///< topic of a ULog
  std::string talker;                 ///< selected NMEA talker; empty for all
  std::filesystem::path pose_times;   ///< file with the times of KITTI poses; empty if none
  RowTime time;
  std::vector<RowRule> rules;
};

/// Reads the keys of a channel: `file`, `topic`, `parent` and `child` (transforms), `form` and
/// `times` (poses), `talker`, `csv`, `time` and `valid_if`. The keys `file`, `talker`, `csv` and
/// `time` default to those of the mapping's top level. The default time of a topic is the header's
/// stamp, or else the recording time of the messages. The default time of a log with known format
/// is its column `time`. A channel that names its own bag or log does not inherit a `time` that is
/// meant for text tables. Looks up the topic in its bag.
RowSource ReadRowSource(const ConfigMap& channel, const ConfigMap& top, UnpackedFiles* unpacked);

/// The topic that `key` names. An unknown name and other faults are reported at `channel`.
std::optional<BagTopic> ReadNamedTopic(const ConfigMap& channel, std::string_view key,
                                       const std::filesystem::path& bag, UnpackedFiles* unpacked);

/// Syntax of a text table from the key `csv`.
CsvForm ReadCsvForm(const ConfigMap& config);

/// A valid row: its time and the values of the requested columns.
struct MappedRow {
  TimeNs t_ns = 0;
  RowPlace line;
  std::vector<double> values;
};

/// All valid rows, with times relative to `zero_ns`. Throws InputError for a missing column. An
/// invalid or forbidden number, or a time that does not increase, throws too; with `left_out`, such
/// a row is added there instead.
std::vector<MappedRow> ReadRows(const RowSource& source, const std::vector<ColumnMapping>& columns,
                                TimeNs zero_ns = 0, LeftOutRows* left_out = nullptr);

/// Type of the rows of a topic or log; empty for a text table.
std::string TypeOf(const RowSource& source);

/// Place of a row for messages, such as "log.csv:12" or "log.mcap: /imu message 12".
std::string PlaceOf(const RowSource& source, const RowPlace& line);

}  // namespace tera
