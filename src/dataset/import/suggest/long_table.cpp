#include "dataset/import/suggest/long_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "dataset/import/suggest/doubted_numbers.h"

namespace tera {
namespace {

constexpr std::array<std::string_view, 20> kSignalNames = {
    "signal", "signalname", "name",        "variable", "variablename", "channel",  "field",
    "topic",  "metric",     "tag",         "tagname",  "sensor",       "sensorid", "key",
    "param",  "parameter",  "measurement", "item",     "kanal",        "messgröße"};
constexpr std::array<std::string_view, 9> kValueNames = {
    "value", "val", "wert", "messwert", "v", "data", "values", "valeur", "reading"};
constexpr std::array<std::string_view, 4> kUnitNames = {"unit", "units", "einheit", "unité"};

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
  for (const std::string& signal : form.signals) {
    const std::vector<std::size_t> rows = RowsOfSignal(csv, form, signal);
    NumbersOfColumn numbers = NumbersOf(csv, layout, rows).at(form.value);
    if (numbers.values.empty()) continue;
    numbers.name = signal;
    if (form.unit) numbers.unit = std::string(csv.Field(rows.front(), *form.unit));
    std::string name = PlainNameOf(signal);
    if (!names.insert(name).second) name += fmt::format("_{}", names.size() + 1);
    const std::string present =
        numbers.missing == 0
            ? ""
            : fmt::format(", {{column: {}, present: true}}", YamlWord(value_column));
    const std::string head =
        fmt::format("  - name: {}\n    valid_if: [{{column: {}, equals: {}}}{}]\n", name,
                    signal_column, YamlWord(signal), present);
    const std::string joint = JointOfAngle(numbers);
    const AngleGuess angle =
        joint.empty() ? AngleGuess{GuessAnyUnit(numbers)} : GuessAngle(numbers);
    const UnitGuess& unit = angle.unit;
    const std::string wrap = angle.begins_anew ? ", wrap_deg: 360}" : "}";
    const std::string column = ColumnYaml(value_column, unit) + (joint.empty() ? "" : wrap);
    const std::string row =
        joint.empty() ? fmt::format("    columns:\n      {}: {}", name, column)
                      : fmt::format("    joints:\n      - {{name: {}, angle: {}", joint, column);
    (joint.empty() ? tables : encoders) += head + row + DoubtRemark(unit) + "\n";
  }
  return (encoders.empty() ? "" : "encoders:\n" + encoders) +
         (tables.empty() ? "" : "tables:\n" + tables);
}

}  // namespace tera
