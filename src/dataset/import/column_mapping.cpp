#include "dataset/import/column_mapping.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "core/config/spelling.h"
#include "core/units.h"

namespace tera {
namespace {

constexpr double kMinute_s = 60.0, kHour_s = 3600.0, kDay_s = 86400.0;

constexpr const char* kDegreesAndMinutes = "ddmm";

constexpr Unit kUnits[] = {
    {"s", Dimension::kTime, 1},
    {"ms", Dimension::kTime, 1e-3},
    {"us", Dimension::kTime, 1e-6},
    {"ns", Dimension::kTime, 1e-9},
    {"min", Dimension::kTime, kMinute_s},
    {"h", Dimension::kTime, kHour_s},
    {"day", Dimension::kTime, kDay_s},
    {"m", Dimension::kLength, 1},
    {"cm", Dimension::kLength, 1e-2},
    {"mm", Dimension::kLength, 1e-3},
    {"rad", Dimension::kAngle, 1},
    {"deg", Dimension::kAngle, kDeg},
    {kDegreesAndMinutes, Dimension::kAngle, kDeg},
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

struct Spelling {
  std::string_view text;  ///< in lower case, without blanks and brackets
  const char* unit;
  double scale = 1.0;
};

constexpr double kDegreesOfGon = 0.9;
constexpr double kFoot_m = 0.3048, kInch_m = 0.0254, kMile_m = 1609.344, kPsi_Pa = 6894.757293168;
constexpr double kPoundForce_N = 4.4482216152605;

constexpr Spelling kSpellings[] = {
    {"sec", "s"},
    {"secs", "s"},
    {"second", "s"},
    {"seconds", "s"},
    {"sek", "s"},
    {"sekunden", "s"},
    {"msec", "ms"},
    {"msecs", "ms"},
    {"millis", "ms"},
    {"milliseconds", "ms"},
    {"usec", "us"},
    {"usecs", "us"},
    {"µs", "us"},
    {"μs", "us"},
    {"micros", "us"},
    {"microseconds", "us"},
    {"nsec", "ns"},
    {"nsecs", "ns"},
    {"nanos", "ns"},
    {"nanosec", "ns"},
    {"nanosecs", "ns"},
    {"nanoseconds", "ns"},
    {"mins", "min"},
    {"minute", "min"},
    {"minutes", "min"},
    {"hr", "h"},
    {"hrs", "h"},
    {"hour", "h"},
    {"hours", "h"},
    {"d", "day"},
    {"days", "day"},
    {"meter", "m"},
    {"meters", "m"},
    {"metre", "m"},
    {"metres", "m"},
    {"km", "m", 1e3},
    {"ft", "m", kFoot_m},
    {"feet", "m", kFoot_m},
    {"in", "m", kInch_m},
    {"inch", "m", kInch_m},
    {"degree", "deg"},
    {"degrees", "deg"},
    {"°", "deg"},
    {"º", "deg"},
    {"grad", "deg"},
    {"gon", "deg", kDegreesOfGon},
    {"mgon", "deg", 1e-3 * kDegreesOfGon},
    {"gon/s", "deg/s", kDegreesOfGon},
    {"kft", "m", 1e3 * kFoot_m},
    {"foot", "m", kFoot_m},
    {"radian", "rad"},
    {"radians", "rad"},
    {"mrad", "rad", 1e-3},
    {"mps", "m/s"},
    {"m_s", "m/s"},
    {"ms^-1", "m/s"},
    {"ms-1", "m/s"},
    {"m/sec", "m/s"},
    {"mm/s", "m/s", 1e-3},
    {"cm/s", "m/s", 1e-2},
    {"kph", "km/h"},
    {"kmh", "km/h"},
    {"kmph", "km/h"},
    {"km_h", "km/h"},
    {"mph", "m/s", kMile_m / kHour_s},
    {"radps", "rad/s"},
    {"rad_s", "rad/s"},
    {"rads^-1", "rad/s"},
    {"rads-1", "rad/s"},
    {"rad/sec", "rad/s"},
    {"mrad/s", "rad/s", 1e-3},
    {"rps", "rpm", 60},
    {"dps", "deg/s"},
    {"degps", "deg/s"},
    {"deg_s", "deg/s"},
    {"degs^-1", "deg/s"},
    {"deg/sec", "deg/s"},
    {"degrees/s", "deg/s"},
    {"°/s", "deg/s"},
    {"°/sec", "deg/s"},
    {"º/s", "deg/s"},
    {"mdps", "deg/s", 1e-3},
    {"1/min", "rpm"},
    {"u/min", "rpm"},
    {"min^-1", "rpm"},
    {"min-1", "rpm"},
    {"tr/min", "rpm"},
    {"r/min", "rpm"},
    {"m/s^2", "m/s2"},
    {"m/s²", "m/s2"},
    {"mps2", "m/s2"},
    {"m_s2", "m/s2"},
    {"ms^-2", "m/s2"},
    {"ms-2", "m/s2"},
    {"m/s/s", "m/s2"},
    {"m/ss", "m/s2"},
    {"m/sec2", "m/s2"},
    {"m/sec^2", "m/s2"},
    {"mg", "g", 1e-3},
    {"gs", "g"},
    {"m^2", "m2"},
    {"m²", "m2"},
    {"newton", "N"},
    {"lbf", "N", kPoundForce_N},
    {"mn", "kN", 1e3},
    {"nm", "N m"},
    {"n*m", "N m"},
    {"n·m", "N m"},
    {"knm", "N m", 1e3},
    {"hpa", "Pa", 1e2},
    {"mbar", "Pa", 1e2},
    {"psi", "Pa", kPsi_Pa},
    {"bars", "bar"},
    {"percent", "%"},
    {"pct", "%"},
    {"prozent", "%"},
    {"‰", "1", 1e-3},
};

/// The text without brackets, quotes and blanks.
std::string BareUnit(std::string_view text) {
  std::string bare;
  for (const char c : text) {
    if (std::string_view(" []()<>\"'").find(c) == std::string_view::npos) bare += c;
  }
  return bare;
}

std::string OutOfRange(double value, const Range& need) {
  const std::string limits = std::isfinite(need.max)
                                 ? fmt::format("{:.6g} to {:.6g}", need.min, need.max)
                                 : fmt::format("at least {:.6g}", need.min);
  return fmt::format("which gives {:.6g} {}, need {} {}", value, need.unit, limits, need.unit);
}

}  // namespace

const Unit* FindUnit(std::string_view name) {
  const auto unit = std::find_if(std::begin(kUnits), std::end(kUnits),
                                 [&](const Unit& u) { return name == u.name; });
  return unit == std::end(kUnits) ? nullptr : &*unit;
}

std::optional<WrittenUnit> UnitOfText(std::string_view text, Dimension dimension) {
  const auto fits = [&](const Unit& unit) {
    return dimension == Dimension::kAny || unit.dimension == dimension;
  };
  const std::string bare = BareUnit(text), lower = LowerCase(bare);
  if (const Unit* unit = FindUnit(bare); unit != nullptr && fits(*unit)) return WrittenUnit{unit};
  for (const Spelling& spelling : kSpellings) {
    const Unit* unit = FindUnit(spelling.unit);
    if (lower == spelling.text && fits(*unit)) return WrittenUnit{unit, spelling.scale};
  }
  for (const Unit& unit : kUnits) {
    // Case is ignored unless it distinguishes units, as in mPa and MPa.
    if (lower == LowerCase(unit.name) && unit.dimension != Dimension::kPressure && fits(unit)) {
      return WrittenUnit{&unit};
    }
  }
  return std::nullopt;
}

double ReadUnitFactor(const ConfigMap& config, Dimension dimension) {
  const std::string name = config.Text("unit");
  const Unit* unit = FindUnit(name);
  if (unit != nullptr && (dimension == Dimension::kAny || unit->dimension == dimension)) {
    return unit->factor;
  }
  std::vector<std::string> fitting;
  for (const Unit& u : kUnits) {
    if (dimension == Dimension::kAny || u.dimension == dimension) fitting.push_back(u.name);
  }
  config.Fault("unit",
               {FaultKind::kNoSuchName, fmt::format("'{}' does not fit here, need one of: {}", name,
                                                    fmt::join(fitting, ", "))});
  return 1.0;
}

void ColumnMapping::MultiplyBy(double scale) {
  factor *= scale;
  offset *= scale;
  for (ColumnTerm& term : further) term.factor *= scale;
}

std::vector<ColumnTerm> ColumnMapping::Terms() const {
  std::vector<ColumnTerm> terms = further;
  if (!column.empty()) {
    terms.insert(terms.begin(), ColumnTerm{column, factor, 0, in_minutes, hemisphere});
  }
  // A unit of time that is a whole number of nanoseconds is applied without rounding.
  for (ColumnTerm& term : terms) {
    const double unit_ns = term.factor * static_cast<double>(kNsPerSecond);
    const double whole_ns = std::round(unit_ns);
    const bool is_whole = whole_ns >= 1 && std::abs(unit_ns / whole_ns - 1) < 1e-12;
    term.factor_ns =
        is_whole && whole_ns <= kDay_s * kNsPerSecond ? static_cast<TimeNs>(whole_ns) : 0;
  }
  return terms;
}

MappedColumn::MappedColumn(const RowTable& table, const ColumnMapping& mapping)
    : table_(table), mapping_(mapping), terms_(mapping.Terms()) {
  for (const ColumnTerm& term : terms_) {
    places_.push_back(table.Column(term.column));
    sides_.push_back(term.hemisphere.empty() ? 0 : table.Column(term.hemisphere));
  }
}

double MappedColumn::NumberOf(std::size_t row, std::size_t term) const {
  constexpr double kHundred = 100, kMinutes = 60;
  double number = table_.Number(row, places_[term]);
  if (terms_[term].in_minutes) {
    const double degrees = std::trunc(number / kHundred), minutes = number - degrees * kHundred;
    if (std::abs(minutes) >= kMinutes) {
      table_.Fail(row, places_[term], {FaultKind::kOutOfRange, "need minutes below 60, ddmm.mmmm"});
    }
    number = degrees + minutes / kMinutes;
  }
  if (terms_[term].hemisphere.empty()) return number;
  const std::string side = LowerCase(std::string(table_.Text(row, sides_[term]).value_or("")));
  if (side != "n" && side != "e" && side != "s" && side != "w") {
    table_.Fail(row, sides_[term], {FaultKind::kNoSuchName, "need N, S, E or W"});
  }
  return side == "s" || side == "w" ? -number : number;
}

double MappedColumn::At(std::size_t row) const {
  double value = mapping_.offset;
  for (std::size_t k = 0; k < terms_.size(); ++k) {
    if (!table_.IsPresent(row, places_[k])) {
      if (mapping_.may_lack) return std::numeric_limits<double>::quiet_NaN();
      table_.Fail(row, places_[k],
                  {FaultKind::kMissing, fmt::format("which is not a number; exclude such rows with "
                                                    "valid_if: [{{column: {}, present: true}}]",
                                                    terms_[k].column)});
    }
    value += terms_[k].factor * NumberOf(row, k);
  }
  if (!terms_.empty() && (value < mapping_.allowed.min || value > mapping_.allowed.max)) {
    table_.Fail(row, places_.front(),
                {FaultKind::kOutOfRange, OutOfRange(value, mapping_.allowed)});
  }
  return value;
}

ColumnMapping ReadColumnMapping(const ConfigMap& config, Dimension dimension,
                                const Range& allowed) {
  ColumnMapping mapping;
  mapping.allowed = allowed;
  if (const auto constant = config.OptionalNumber("constant", allowed)) {
    mapping.offset = *constant;
    return mapping;
  }
  if (config.Has("sum")) {
    for (const ConfigMap& item : config.List("sum")) {
      const ColumnMapping part = ReadColumnMapping(item, dimension);
      mapping.offset += part.offset;
      for (const ColumnTerm& term : part.Terms()) mapping.further.push_back(term);
    }
    if (mapping.further.empty())
      config.Fault("sum", {FaultKind::kMissing, "need at least one column"});
    if (mapping.further.empty()) return mapping;
    mapping.column = mapping.further.front().column;
    mapping.factor = mapping.further.front().factor;
    mapping.in_minutes = mapping.further.front().in_minutes;
    mapping.hemisphere = mapping.further.front().hemisphere;
    mapping.further.erase(mapping.further.begin());
    return mapping;
  }
  mapping.column = config.Text("column");
  if (config.Has("hemisphere")) mapping.hemisphere = config.Text("hemisphere");
  mapping.in_minutes = dimension == Dimension::kAngle && config.Has("unit") &&
                       config.Text("unit") == kDegreesAndMinutes;
  mapping.factor = ReadUnitFactor(config, dimension) * config.Number("scale", Any(""), 1.0);
  mapping.offset = config.Number("offset", Any(""), 0.0);
  return mapping;
}

}  // namespace tera
