#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/config/config.h"
#include "core/time.h"
#include "dataset/import/bag/topic_table.h"
#include "dataset/import/csv_file.h"

/// How columns of a foreign CSV file or fields of a bag's messages become numbers in SI units and
/// rows become times.

namespace tera {

/// Physical dimension that a value must have; kAny for tables, whose columns may be anything.
enum class Dimension {
  kAny,
  kTime,
  kLength,
  kAngle,
  kSpeed,
  kRate,
  kAcceleration,
  kVariance,
  kForce,
  kTorque,
  kPressure,
  kNone
};

/// value = field * factor + offset, or a constant.
struct ColumnMapping {
  std::string column;  ///< empty: the constant `offset`
  double factor = 1.0, offset = 0.0;
  Range allowed;         ///< of the value
  TimeNs factor_ns = 0;  ///< of a time in whole nanoseconds, microseconds, ...: one of its unit
  /// A field without a number is taken as it is, as NaN: the channel knows what to make of it.
  bool may_lack = false;
};

/// Reads `{column:, unit:, scale:, offset:}` or `{constant:}`. The offset is in SI units. An
/// unknown unit, or one of another dimension, is a fault; so is, when rows are read, a value that
/// is not `allowed`.
ColumnMapping ReadColumnMapping(const ConfigMap& config, Dimension dimension,
                                const Range& allowed = {});

/// A row counts when this holds.
struct RowRule {
  enum class Test { kAbove, kBelow, kEquals, kChanges, kPresent };
  std::string column;
  Test test = Test::kAbove;
  double value = 0;  ///< as in the file, before any unit
};

/// Which rows of which file, and when they were.
struct RowSource {
  std::filesystem::path file;
  CsvForm form;
  std::optional<BagTopic> topic;      ///< of the bag that the file is
  UnpackedFiles* unpacked = nullptr;  ///< of the import, for bags
  std::string log_type;               ///< of a log of known form (foreign_log.h), else empty
  std::string log_topic;              ///< of a ULog
  ColumnMapping time;                 ///< gives seconds
  /// Where rows have no time: from each to the next, left out ones too; `time` is the first one's.
  std::optional<double> interval_s;
  std::vector<RowRule> rules;
};

/// Reads `file:`, `topic:`, `csv:`, `time:` and `valid_if:` of a channel; `file`, `csv` and `time`
/// default to those of the mapping's top level. A time is a column or `{interval:, unit:,
/// offset:}`; of a topic it defaults to its header's stamp, or to when its messages were recorded,
/// of a log of known form to its own column `time`.
/// Looks the topic up in its bag.
RowSource ReadRowSource(const ConfigMap& channel, const ConfigMap& top, UnpackedFiles* unpacked);

/// One valid row: its time and the values of the columns asked for.
struct MappedRow {
  TimeNs t_ns = 0;
  int line = 0;  ///< in its file; of a topic, the message's number
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
std::string PlaceOf(const RowSource& source, int line);

}  // namespace tera
