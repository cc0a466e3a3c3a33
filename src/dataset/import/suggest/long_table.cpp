#include "dataset/import/suggest/long_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <set>

#include "dataset/import/suggest/doubted_numbers.h"
#include "dataset/import/suggest/rate_guess.h"

namespace tera {
namespace {

constexpr std::array<std::string_view, 20> kSignalNames = {
    "signal", "signalname", "name",        "variable", "variablename", "channel",  "field",
    "topic",  "metric",     "tag",         "tagname",  "sensor",       "sensorid", "key",
    "param",  "parameter",  "measurement", "item",     "kanal",        "messgröße"};
constexpr std::array<std::string_view, 15> kValueNames = {
    "value",   "val", "wert",   "messwert", "v",   "data",     "values", "valeur",
    "reading", "raw", "counts", "count",    "adc", "rawvalue", "rohwert"};
constexpr std::array<std::string_view, 4> kUnitNames = {"unit", "units", "einheit", "unité"};

/// Unit of a signal whose rows have different units.
constexpr std::string_view kChangingUnit = "-?-";

template <std::size_t n>
bool IsNamed(const std::string& stem, const std::array<std::string_view, n>& names) {
  return std::find(names.begin(), names.end(), stem) != names.end();
}

}  // namespace

std::optional<LongForm> FindLongForm(const CsvFile& csv,
                                     const std::vector<NumbersOfColumn>& columns) {
  LongForm form;
  std::optional<std::size_t> signal, value;
  const std::size_t rows = csv.row_count();
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const std::string stem = StemOfName(columns[c].name);
    const bool is_text = columns[c].words == rows;
    if (is_text && IsNamed(stem, kSignalNames)) signal = c;
    if (is_text && IsNamed(stem, kUnitNames)) form.unit = c;
    if (2 * columns[c].values.size() > rows && IsNamed(stem, kValueNames)) value = c;
  }
  if (!signal || !value || rows == 0) return std::nullopt;
  form.signal = *signal;
  form.value = *value;
  constexpr std::size_t kMostSignals = 200;
  std::set<std::string_view> seen;
  for (std::size_t row = 0; row < rows && seen.size() <= kMostSignals; ++row) {
    const std::string_view name = csv.Field(row, form.signal);
    if (seen.insert(name).second) form.signals.emplace_back(name);
  }
  return seen.size() <= kMostSignals ? std::optional(form) : std::nullopt;
}

std::optional<SourceGuess> FindSources(const std::vector<NumbersOfColumn>& columns) {
  constexpr std::size_t kMostSources = 8;
  for (const NumbersOfColumn& column : columns) {
    const std::vector<std::string> words = WordsOfName(column.name);
    const bool names_id = std::any_of(words.begin(), words.end(), [](const std::string& word) {
      return word == "id" || word == "sensor" || word == "device" || word == "node";
    });
    const std::set<double> ids(column.values.begin(), column.values.end());
    if (!names_id || ids.size() < 2 || ids.size() > kMostSources) continue;
    return SourceGuess{
        column.name, fmt::format("{{column: {}, equals: {}}}", YamlWord(column.name), *ids.begin()),
        fmt::format("# rows are of several sources, by '{}' {}: valid_if takes the first\n",
                    PlainNameOf(column.name), fmt::join(ids, ", ")),
        *ids.begin()};
  }
  return std::nullopt;
}

std::vector<std::size_t> RowsOfSignal(const CsvFile& csv, const LongForm& form,
                                      const std::string& signal) {
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < csv.row_count(); ++row) {
    if (csv.Field(row, form.signal) == signal) rows.push_back(row);
  }
  return rows;
}

std::string SignalsYaml(const CsvFile& csv, const TableLayout& layout, const LongForm& form) {
  std::string encoders, tables;
  std::set<std::string> names;
  const std::string signal_column = YamlWord(csv.columns()[form.signal]);
  const std::string value_column = csv.columns()[form.value];
  std::vector<NumbersOfColumn> all;
  for (const std::string& signal : form.signals) {
    const std::vector<std::size_t> rows = RowsOfSignal(csv, form, signal);
    all.push_back(NumbersOf(csv, layout, rows).at(form.value));
    all.back().name = signal;
    if (!form.unit) continue;
    const std::string_view unit = csv.Field(rows.front(), *form.unit);
    const bool is_one = std::all_of(rows.begin(), rows.end(), [&](std::size_t row) {
      return csv.Field(row, *form.unit) == unit;
    });
    all.back().unit = is_one ? unit : kChangingUnit;
  }
  std::vector<const NumbersOfColumn*> angles;
  for (const NumbersOfColumn& numbers : all) {
    if (!JointOfAngle(numbers).empty()) angles.push_back(&numbers);
  }
  for (const NumbersOfColumn& numbers : all) {
    const std::string& signal = numbers.name;
    if (numbers.values.empty()) continue;
    std::string name = PlainNameOf(signal);
    if (!names.insert(name).second) name += fmt::format("_{}", names.size() + 1);
    const std::string present =
        numbers.missing == 0
            ? ""
            : fmt::format(", {{column: {}, present: true}}", YamlWord(value_column));
    const std::string head =
        fmt::format("  - name: {}\n    valid_if: [{{column: {}, equals: {}}}{}]\n", name,
                    signal_column, YamlWord(signal), present);
    const bool is_count = NamesCounts(value_column) || NamesCounts(signal);
    const AngleGuess angle = GuessAngle(numbers, angles);
    const std::string turning = is_count && !angle.begins_anew ? "" : JointOfAngle(numbers);
    const std::string rated = is_count ? "" : JointOfRate(numbers);
    if (!turning.empty()) {
      encoders += head + "    joints:\n" + JointYaml(turning, value_column, angle);
    } else if (!rated.empty()) {
      encoders +=
          head + "    joints:\n" + JointYaml(rated, {value_column, GuessRateUnit({&numbers})});
    } else {
      UnitGuess unit = GuessAnyUnit(numbers);
      if (numbers.unit == kChangingUnit) unit = {kUnknownUnit, 1.0, "its unit changes"};
      if (is_count) unit.doubt = "counts by the name, " + unit.doubt;
      tables += head + fmt::format("    columns:\n      {}: {}{}\n", name,
                                   ColumnYaml(value_column, unit), DoubtRemark(unit));
    }
  }
  return (encoders.empty() ? "" : "encoders:\n" + encoders) +
         (tables.empty() ? "" : "tables:\n" + tables);
}

}  // namespace tera
