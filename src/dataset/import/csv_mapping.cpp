#include "dataset/import/csv_mapping.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>

#include "core/config/listed_folder.h"
#include "core/config/spelling.h"
#include "core/error.h"
#include "core/units.h"
#include "dataset/import/logs/foreign_log.h"
#include "dataset/import/logs/ulog.h"

namespace tera {
namespace {

struct Unit {
  const char* name;
  Dimension dimension;
  double factor;  ///< SI units in one of it
};

constexpr double kMinute_s = 60.0, kHour_s = 3600.0;

constexpr Unit kUnits[] = {
    {"s", Dimension::kTime, 1},
    {"ms", Dimension::kTime, 1e-3},
    {"us", Dimension::kTime, 1e-6},
    {"ns", Dimension::kTime, 1e-9},
    {"m", Dimension::kLength, 1},
    {"cm", Dimension::kLength, 1e-2},
    {"mm", Dimension::kLength, 1e-3},
    {"rad", Dimension::kAngle, 1},
    {"deg", Dimension::kAngle, kDeg},
    {"m/s", Dimension::kSpeed, 1},
    {"km/h", Dimension::kSpeed, 1000 / kHour_s},
    {"rad/s", Dimension::kRate, 1},
    {"deg/s", Dimension::kRate, kDeg},
    {"rpm", Dimension::kRate, 2 * kPi / kMinute_s},
    {"m/s2", Dimension::kAcceleration, 1},
    {"g", Dimension::kAcceleration, kStandardGravity_mps2},
    {"m2", Dimension::kVariance, 1},
    {"N", Dimension::kForce, 1},
    {"kN", Dimension::kForce, 1e3},
    {"N m", Dimension::kTorque, 1},
    {"Pa", Dimension::kPressure, 1},
    {"kPa", Dimension::kPressure, 1e3},
    {"MPa", Dimension::kPressure, 1e6},
    {"bar", Dimension::kPressure, 1e5},
    {"1", Dimension::kNone, 1},
    {"%", Dimension::kNone, 1e-2},
};

double UnitFactor(const ConfigMap& config, Dimension dimension) {
  const std::string name = config.Text("unit");
  const auto unit = std::find_if(std::begin(kUnits), std::end(kUnits),
                                 [&](const Unit& u) { return name == u.name; });
  std::vector<std::string> fitting;
  for (const Unit& u : kUnits) {
    if (dimension == Dimension::kAny || u.dimension == dimension) fitting.push_back(u.name);
  }
  if (unit != std::end(kUnits) && (dimension == Dimension::kAny || unit->dimension == dimension)) {
    return unit->factor;
  }
  config.Fault("unit", fmt::format("'{}' does not fit here, need one of: {}", name,
                                   fmt::join(fitting, ", ")));
  return 1.0;
}

RowRule ReadRule(const ConfigMap& config) {
  RowRule rule;
  rule.column = config.Text("column");
  int tests = 0;
  const auto read = [&](const char* key, RowRule::Test test) {
    if (const auto value = config.OptionalNumber(key, Any(""))) {
      rule.test = test;
      rule.value = *value;
      ++tests;
    }
  };
  read("above", RowRule::Test::kAbove);
  read("below", RowRule::Test::kBelow);
  read("equals", RowRule::Test::kEquals);
  if (config.Boolean("changes", false)) {
    rule.test = RowRule::Test::kChanges;
    ++tests;
  }
  if (config.Boolean("present", false)) {
    rule.test = RowRule::Test::kPresent;
    ++tests;
  }
  if (tests != 1) {
    config.Fault("", "need exactly one of above, below, equals, changes: true and present: true");
  }
  return rule;
}

bool Holds(const RowTable& table, const RowRule& rule, std::size_t row) {
  const std::size_t column = table.Column(rule.column);
  const std::optional<double> number = table.NumberIfAny(row, column);
  switch (rule.test) {
    case RowRule::Test::kAbove:
      return number && *number > rule.value;
    case RowRule::Test::kBelow:
      return number && *number < rule.value;
    case RowRule::Test::kEquals:
      return number && *number == rule.value;
    case RowRule::Test::kChanges:
      return row == 0 || !table.Repeats(row, column);
    case RowRule::Test::kPresent:
      return table.IsPresent(row, column);
  }
  return false;
}

std::string OutOfRange(double value, const Range& need) {
  const std::string limits = std::isfinite(need.max)
                                 ? fmt::format("{:.6g} to {:.6g}", need.min, need.max)
                                 : fmt::format("at least {:.6g}", need.min);
  return fmt::format("which gives {:.6g} {}, need {} {}", value, need.unit, limits, need.unit);
}

}  // namespace

ColumnMapping ReadColumnMapping(const ConfigMap& config, Dimension dimension,
                                const Range& allowed) {
  ColumnMapping mapping;
  mapping.allowed = allowed;
  if (const auto constant = config.OptionalNumber("constant", allowed)) {
    mapping.offset = *constant;
    return mapping;
  }
  mapping.column = config.Text("column");
  mapping.factor = UnitFactor(config, dimension) * config.Number("scale", Any(""), 1.0);
  mapping.offset = config.Number("offset", Any(""), 0.0);
  return mapping;
}

namespace {

CsvForm ReadCsvForm(const ConfigMap& config) {
  constexpr double kMostSkipped = 1e6;
  CsvForm form;
  const std::string separator =
      config.Choice("separator", {"auto", ",", ";", "tab", "blank"}, "auto");
  form.separator = separator == "tab"     ? '\t'
                   : separator == "blank" ? ' '
                   : separator == "auto"  ? '\0'
                                          : separator.front();
  form.has_header = config.Boolean("header", true);
  form.skipped_lines =
      static_cast<int>(config.Integer("skip_lines", Between(0, kMostSkipped, ""), 0));
  return form;
}

/// A time of a bag, or of a log of known form, has a form of its own and needs no unit.
ColumnMapping ReadTime(const ConfigMap& time, bool has_stamps) {
  if (has_stamps && !time.Has("unit")) {
    return {.column = time.Text("column"), .offset = time.Number("offset", Any("s"), 0.0)};
  }
  constexpr double kFarthest_s = 9e9;  // beyond, nanoseconds do not fit into 64 bits
  ColumnMapping mapping =
      ReadColumnMapping(time, Dimension::kTime, Between(-kFarthest_s, kFarthest_s, "s"));
  const double unit_ns = mapping.factor * static_cast<double>(kNsPerSecond);
  for (const TimeNs whole_ns : {1, 1'000, 1'000'000, 1'000'000'000}) {
    if (std::abs(unit_ns / static_cast<double>(whole_ns) - 1) < 1e-12) mapping.factor_ns = whole_ns;
  }
  return mapping;
}

/// The topic that a channel names, as its bag describes it.
std::optional<BagTopic> ReadTopic(const ConfigMap& channel, const std::filesystem::path& file,
                                  UnpackedFiles* unpacked) {
  if (!channel.Has("topic")) {
    if (LooksLikeBag(file)) channel.Fault("topic", "is missing; need one of the bag's topics");
    return std::nullopt;
  }
  BagTopic unknown{.name = channel.Text("topic")};
  if (file.empty()) return unknown;
  for (const std::filesystem::path& part : FilesOfBag(file)) channel.AlsoReads(part);
  const FoundTopic found = FindTopic(file, unknown.name, unpacked);
  if (found.topic) return found.topic;
  channel.Fault(
      "topic",
      fmt::format("{} has no topic '{}'{}; it has {}", file.string(), unknown.name,
                  DidYouMean(unknown.name, found.names),
                  found.names.empty() ? "none" : fmt::format("{}", fmt::join(found.names, ", "))));
  return unknown;
}

}  // namespace

RowSource ReadRowSource(const ConfigMap& channel, const ConfigMap& top, UnpackedFiles* unpacked) {
  RowSource source{.unpacked = unpacked};
  source.file = FileOrList(channel.Has("file") ? channel : top, "file", kBagMetadata);
  source.log_type = TypeOfLog(source.file);
  if (source.log_type == kUlogType) {
    source.log_topic = channel.Text("topic");
  } else {
    source.topic = ReadTopic(channel, source.file, unpacked);
  }
  if (source.log_type == kKittiType) {
    for (const auto& frame :
         std::filesystem::directory_iterator(source.file.parent_path() / "data")) {
      channel.AlsoReads(frame.path());
    }
  }
  if (const auto form = (channel.Has("csv") ? channel : top).OptionalMap("csv")) {
    source.form = ReadCsvForm(*form);
  }
  for (const ConfigMap& rule : channel.List("valid_if")) source.rules.push_back(ReadRule(rule));
  if (source.topic && !channel.Has("time") && !top.Has("time")) {
    source.time.column = HasHeader(*source.topic) ? kHeaderStamp : kLogTime;
    return source;
  }
  if (!source.log_type.empty() && !channel.Has("time") && !top.Has("time")) {
    source.time.column = kLogTimeColumn;
    return source;
  }
  const ConfigMap time = channel.Has("time") ? channel.Map("time") : top.Map("time");
  if (const auto interval = time.OptionalNumber("interval", Positive(""))) {
    source.interval_s = *interval * UnitFactor(time, Dimension::kTime);
    source.time.offset = time.Number("offset", Any("s"), 0.0);
  } else {
    source.time = ReadTime(time, !TypeOf(source).empty() || source.topic);
  }
  return source;
}

namespace {

/// Numbers of the rows of one file.
class MappedRows {
 public:
  MappedRows(const RowTable& table, const RowSource& source,
             const std::vector<ColumnMapping>& columns, TimeNs zero_ns)
      : table_(table), source_(source), columns_(columns), zero_ns_(zero_ns) {
    // A missing column is a fault of the mapping, also where no row is read.
    for (const ColumnMapping& column : columns) places_.push_back(PlaceOf(column));
    time_place_ = PlaceOf(source.time);
    for (const RowRule& rule : source.rules) table.Column(rule.column);
  }

  bool IsValid(std::size_t row) const {
    return std::all_of(source_.rules.begin(), source_.rules.end(),
                       [&](const RowRule& rule) { return Holds(table_, rule, row); });
  }

  MappedRow At(std::size_t row, const MappedRow* before) const {
    MappedRow mapped{TimeOf(row) - zero_ns_, table_.Line(row), {}};
    if (before != nullptr && mapped.t_ns <= before->t_ns) {
      table_.Fail(row, time_place_.value_or(0),
                  "need a later time than in the row before; leave such rows out by valid_if or "
                  "--skip-bad-rows");
    }
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      mapped.values.push_back(Value(columns_[k], places_[k], row));
    }
    return mapped;
  }

 private:
  using Place = std::optional<std::size_t>;  ///< of a column; none of a constant

  Place PlaceOf(const ColumnMapping& mapping) const {
    if (mapping.column.empty()) return std::nullopt;
    return table_.Column(mapping.column);
  }

  /// Of a bag's times and of times written with digits alone exactly, of others as far as doubles
  /// hold them.
  TimeNs TimeOf(std::size_t row) const {
    const auto stamp_ns = time_place_ ? table_.Stamp(row, *time_place_) : std::nullopt;
    if (stamp_ns) {
      if (source_.time.factor != 1.0) {
        table_.Fail(row, *time_place_, "which is a time already; leave out its unit and scale");
      }
      return *stamp_ns + FromSeconds(source_.time.offset);
    }
    if (time_place_ && source_.time.factor_ns > 0) {
      const auto exact_ns = table_.WholeNanoseconds(row, *time_place_, source_.time.factor_ns);
      if (exact_ns) return *exact_ns + FromSeconds(source_.time.offset);
    }
    const double late_s = static_cast<double>(table_.Ordinal(row)) * source_.interval_s.value_or(0);
    return FromSeconds(Value(source_.time, time_place_, row) + late_s);
  }

  double Value(const ColumnMapping& mapping, const Place& column, std::size_t row) const {
    if (!column) return mapping.offset;
    if (!table_.IsPresent(row, *column)) {
      if (mapping.may_lack) return std::numeric_limits<double>::quiet_NaN();
      table_.Fail(row, *column,
                  fmt::format("which is no number; leave such rows out by valid_if: [{{column: {}, "
                              "present: true}}]",
                              mapping.column));
    }
    const double value = mapping.factor * table_.Number(row, *column) + mapping.offset;
    if (value < mapping.allowed.min || value > mapping.allowed.max) {
      table_.Fail(row, *column, OutOfRange(value, mapping.allowed));
    }
    return value;
  }

  const RowTable& table_;
  const RowSource& source_;
  const std::vector<ColumnMapping>& columns_;
  TimeNs zero_ns_;
  std::vector<Place> places_;
  Place time_place_;
};

/// Of columns, time and rules, each once.
std::vector<std::string> PathsOf(const RowSource& source,
                                 const std::vector<ColumnMapping>& columns) {
  std::vector<std::string> paths;
  const auto add = [&](const std::string& path) {
    if (!path.empty() && std::find(paths.begin(), paths.end(), path) == paths.end()) {
      paths.push_back(path);
    }
  };
  for (const ColumnMapping& column : columns) add(column.column);
  add(source.time.column);
  for (const RowRule& rule : source.rules) add(rule.column);
  return paths;
}

std::unique_ptr<const RowTable> TableOf(const RowSource& source,
                                        const std::vector<ColumnMapping>& columns,
                                        LeftOutRows* left_out) {
  if (source.log_type == kUlogType) {
    std::vector<std::string> paths = PathsOf(source, columns);
    std::erase(paths, kLogTimeColumn);
    return ReadUlog(source.file, source.log_topic, paths, left_out);
  }
  if (!source.log_type.empty()) return ReadLog(source.file, source.log_type, left_out);
  if (!source.topic) return std::make_unique<CsvFile>(source.file, source.form, left_out);
  return std::make_unique<TopicTable>(source.file, *source.topic, PathsOf(source, columns),
                                      source.unpacked, left_out);
}

}  // namespace

std::string TypeOf(const RowSource& source) {
  return source.topic ? source.topic->type : source.log_type;
}

std::string PlaceOf(const RowSource& source, int line) {
  return source.topic ? MessagePlace(source.file, *source.topic, line)
                      : fmt::format("{}:{}", source.file.string(), line);
}

std::vector<MappedRow> ReadRows(const RowSource& source, const std::vector<ColumnMapping>& columns,
                                TimeNs zero_ns, LeftOutRows* left_out) {
  const std::unique_ptr<const RowTable> table = TableOf(source, columns, left_out);
  const MappedRows reader(*table, source, columns, zero_ns);
  std::vector<MappedRow> rows;
  for (std::size_t row = 0; row < table->row_count(); ++row) {
    try {
      if (!reader.IsValid(row)) continue;
      rows.push_back(reader.At(row, rows.empty() ? nullptr : &rows.back()));
    } catch (const InputError& fault) {
      if (left_out == nullptr) throw;
      left_out->Add(fault.what());
    }
  }
  return rows;
}

}  // namespace tera
