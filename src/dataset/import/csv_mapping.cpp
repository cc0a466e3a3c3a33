#include "dataset/import/csv_mapping.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/config/spelling.h"
#include "core/units.h"

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
  if (tests != 1) config.Fault("", "need exactly one of above, below, equals and changes: true");
  return rule;
}

bool Holds(const CsvFile& csv, const RowRule& rule, std::size_t row) {
  const std::size_t column = csv.Column(rule.column);
  switch (rule.test) {
    case RowRule::Test::kAbove:
      return csv.Number(row, column) > rule.value;
    case RowRule::Test::kBelow:
      return csv.Number(row, column) < rule.value;
    case RowRule::Test::kEquals:
      return csv.Number(row, column) == rule.value;
    case RowRule::Test::kChanges:
      return row == 0 || csv.Field(row, column) != csv.Field(row - 1, column);
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

RowSource ReadRowSource(const ConfigMap& channel, const ConfigMap& top) {
  RowSource source;
  source.file = channel.Has("file") ? channel.File("file") : top.File("file");
  const ConfigMap time = channel.Has("time") ? channel.Map("time") : top.Map("time");
  if (const auto interval = time.OptionalNumber("interval", Positive(""))) {
    source.interval_s = *interval * UnitFactor(time, Dimension::kTime);
    source.time.offset = time.Number("offset", Any("s"), 0.0);
  } else {
    source.time = ReadColumnMapping(time, Dimension::kTime);
  }
  for (const ConfigMap& rule : channel.List("valid_if")) source.rules.push_back(ReadRule(rule));
  return source;
}

std::vector<MappedRow> ReadRows(const RowSource& source,
                                const std::vector<ColumnMapping>& columns) {
  const CsvFile csv(source.file, CsvFile::LastLine::kMayLackItsEnd);
  const auto value = [&](const ColumnMapping& mapping, std::size_t row) {
    if (mapping.column.empty()) return mapping.offset;
    const std::size_t column = csv.Column(mapping.column);
    const double value = mapping.factor * csv.Number(row, column) + mapping.offset;
    if (value < mapping.allowed.min || value > mapping.allowed.max) {
      csv.Fail(row, column, OutOfRange(value, mapping.allowed));
    }
    return value;
  };
  std::vector<MappedRow> rows;
  for (std::size_t row = 0; row < csv.row_count(); ++row) {
    const bool valid = std::all_of(source.rules.begin(), source.rules.end(),
                                   [&](const RowRule& rule) { return Holds(csv, rule, row); });
    if (!valid) continue;
    const double late_s = static_cast<double>(row) * source.interval_s.value_or(0);
    MappedRow mapped{FromSeconds(value(source.time, row) + late_s), csv.Line(row), {}};
    if (!rows.empty() && mapped.t_ns <= rows.back().t_ns) {
      csv.Fail(row, csv.Column(source.time.column), "need a later time than in the row before");
    }
    for (const ColumnMapping& column : columns) mapped.values.push_back(value(column, row));
    rows.push_back(std::move(mapped));
  }
  return rows;
}

}  // namespace tera
