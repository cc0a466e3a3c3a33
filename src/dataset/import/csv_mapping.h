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

/// The file and the rows that make a channel, and their values.

namespace tera {

/// A row counts when this holds.
struct RowRule {
  enum class Test { kAbove, kBelow, kEquals, kChanges, kPresent, kNumber };
  std::string column;
  Test test = Test::kAbove;
  double value = 0;      ///< as in the file, before any unit
  std::string text;      ///< of kEquals, as it is written
  bool is_text = false;  ///< and is no number
};

/// Which rows of which file, and when they were.
struct RowSource {
  std::filesystem::path file;                ///< the first where there are several
  std::vector<std::filesystem::path> files;  ///< of tables in text, joined in this order
  CsvForm form;
  std::optional<BagTopic> topic;  ///< of the bag that the file is
  /// The path of the transform that is read, in a topic of many: "transforms[odom>base_link]."
  std::string element;
  UnpackedFiles* unpacked = nullptr;  ///< of the import, for bags
  std::string log_type;               ///< of a log of known form (foreign_log.h), else empty
  std::string log_topic;              ///< of a ULog
  std::string talker;                 ///< of NMEA, where one is chosen
  std::filesystem::path pose_times;   ///< of poses in KITTI's form, where a file has them
  RowTime time;
  std::vector<RowRule> rules;
};

/// Reads `file:`, `topic:`, `parent:` and `child:` of transforms, `form:` and `times:` of poses,
/// `talker:`, `csv:`, `time:` and `valid_if:` of a channel; `file`, `talker`, `csv` and `time`
/// default to those of the mapping's top level. The time of a topic defaults to its header's stamp,
/// or to when its messages were recorded. The time of a log of known form defaults to its own
/// column `time`. Where the file is the channel's own, neither takes a time of the top level that
/// is one of text tables. Looks the topic up in its bag.
RowSource ReadRowSource(const ConfigMap& channel, const ConfigMap& top, UnpackedFiles* unpacked);

/// How the keys of `csv:` say that a table is written.
CsvForm ReadCsvForm(const ConfigMap& config);

/// One valid row: its time and the values of the columns asked for.
struct MappedRow {
  TimeNs t_ns = 0;
  RowPlace line;
  std::vector<double> values;
};

/// All valid rows, their times counted from `zero_ns`. Throws InputError for a missing column; also
/// for a number that is none or not allowed and for times that do not increase, unless `left_out`
/// is given, to which such rows are added.
std::vector<MappedRow> ReadRows(const RowSource& source, const std::vector<ColumnMapping>& columns,
                                TimeNs zero_ns = 0, LeftOutRows* left_out = nullptr);

/// What its rows are, of a topic's type or a log's; empty where only the mapping knows.
std::string TypeOf(const RowSource& source);

/// "log.csv:12", "log.mcap: /imu message 12".
std::string PlaceOf(const RowSource& source, const RowPlace& line);

}  // namespace tera
