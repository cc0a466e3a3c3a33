#include "dataset/import/suggest/table_layout.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>

#include "dataset/import/calendar_time.h"
#include "dataset/import/column_mapping.h"
#include "dataset/import/csv_mapping.h"
#include "dataset/import/suggest/guess.h"
#include "dataset/import/table_text.h"

namespace tera {
namespace {

constexpr std::size_t kHeadLines = 400;

/// Kind of content of a field.
enum class FieldKind { kNothing, kNumber, kCalendar, kText };

FieldKind KindOfField(std::string_view field, const NumberForm& numbers) {
  if (SaysNothing(field)) return FieldKind::kNothing;
  if (NumberOfField(field, numbers)) return FieldKind::kNumber;
  const bool is_calendar =
      CalendarTimeOf(field, DateOrder::kDayFirst) || NeedsDateOrder(field) || ClockTimeOf(field);
  return is_calendar ? FieldKind::kCalendar : FieldKind::kText;
}
bool IsValue(FieldKind kind) { return kind == FieldKind::kNumber || kind == FieldKind::kCalendar; }

/// A non-empty line, split by one separator.
struct SplitLine {
  int number = 0;  ///< line number in the file
  bool is_remark = false;
  std::vector<std::string_view> fields;  ///< without empty fields at the end
  std::size_t field_count = 0;           ///< including empty fields at the end
  std::vector<FieldKind> kinds;
};

struct HeadLine {
  int number = 0;
  bool is_remark = false;
  std::string_view text;  ///< without the comment sign
};

std::vector<HeadLine> HeadOf(std::string_view text, int skipped) {
  std::vector<HeadLine> head;
  for (int number = 1, lines = 1; !text.empty() && head.size() < kHeadLines; number += lines) {
    const std::string_view line = TrimmedText(TakeRecord(&text, &lines));
    if (number <= skipped || line.empty()) continue;
    const bool is_remark = IsRemark(line);
    head.push_back({number, is_remark, is_remark ? line.substr(1) : line});
  }
  return head;
}

bool IsUnitWord(std::string_view field) {
  constexpr std::array<std::string_view, 37> kOthers = {
      "-",    "°C",   "degC",   "deg C", "C",     "K",     "V",      "mV",  "A",   "mA",
      "W",    "kW",   "Hz",     "kHz",   "l/min", "l/h",   "L/h",    "l",   "kg",  "t",
      "bool", "text", "string", "none",  "n/a",   "count", "counts", "ohm", "Ohm", "Smp",
      "Avg",  "Max",  "Min",    "Std",   "Tot",   "TS",    "RN"};
  if (UnitOfText(field, Dimension::kAny)) return true;
  std::string bare;
  for (const char c : field) {
    if (std::string_view("[]()").find(c) == std::string_view::npos) bare += c;
  }
  return std::find(kOthers.begin(), kOthers.end(), bare) != kOthers.end();
}

/// True if all fields may be units and some are known units.
bool AreUnits(const std::vector<std::string_view>& fields) {
  std::size_t named = 0, known = 0;
  for (const std::string_view field : fields) {
    if (field.empty()) continue;
    ++named;
    if (IsUnitWord(field)) ++known;
  }
  return named > 0 && 2 * known >= named;
}

/// True if no field is a value. A unit "1" among words is allowed.
bool HasWordsOnly(const SplitLine& line) {
  for (std::size_t k = 0; k < line.fields.size(); ++k) {
    if (IsValue(line.kinds[k]) && (line.fields[k] != "1" || !AreUnits(line.fields))) return false;
  }
  return true;
}

/// One way to read the head of a table: separator, notation, and block of rows.
struct Reading {
  char separator = ',';
  NumberForm numbers;
  std::vector<SplitLine> lines;
  std::size_t first = 0, end = 0;  ///< first line and end of the block
  double worth = 0;

  Reading(const std::vector<HeadLine>& head, char by, const NumberForm& as)
      : separator(by), numbers(as) {
    for (const HeadLine& line : head) {
      SplitLine split{line.number, line.is_remark, FieldsOfRecord(line.text, by), 0, {}};
      split.field_count = split.fields.size();
      while (split.fields.size() > 1 && split.fields.back().empty()) split.fields.pop_back();
      for (const auto field : split.fields) split.kinds.push_back(KindOfField(field, as));
      lines.push_back(std::move(split));
    }
    FindBlock();
  }

  /// Number of fields per row, with and without the last fields that are empty in every row.
  std::size_t most_fields() const { return FieldsOf(/*with_empty_end=*/true); }
  std::size_t least_fields() const { return FieldsOf(/*with_empty_end=*/false); }

 private:
  struct Block {
    std::size_t first, end;
  };

  std::size_t FieldsOf(bool with_empty_end) const {
    std::size_t most = 0;
    for (std::size_t k = first; k < end; ++k) {
      if (lines[k].is_remark) continue;
      most = std::max(most, with_empty_end ? lines[k].field_count : lines[k].fields.size());
    }
    return most;
  }

  static bool HasValue(const SplitLine& line) {
    return !line.is_remark && std::any_of(line.kinds.begin(), line.kinds.end(), IsValue);
  }

  /// Number of columns in which two lines have the same kind of content.
  static std::size_t Agreeing(const SplitLine& a, const SplitLine& b) {
    std::size_t agreeing = 0;
    for (std::size_t k = 0; k < std::max(a.kinds.size(), b.kinds.size()); ++k) {
      const FieldKind in_a = k < a.kinds.size() ? a.kinds[k] : FieldKind::kNothing;
      const FieldKind in_b = k < b.kinds.size() ? b.kinds[k] : FieldKind::kNothing;
      if (in_a == in_b || in_a == FieldKind::kNothing || in_b == FieldKind::kNothing) ++agreeing;
    }
    return agreeing;
  }
  static bool AreAlike(const SplitLine& a, const SplitLine& b) {
    const std::size_t columns = std::max(a.kinds.size(), b.kinds.size());
    return a.field_count == b.field_count && Agreeing(a, b) == columns;
  }

  void FindBlock() {
    std::vector<Block> blocks;
    for (std::size_t begin = 0; begin < lines.size();) {
      std::size_t next = begin + 1, last = begin;
      if (HasValue(lines[begin])) {
        for (; next < lines.size(); ++next) {
          if (lines[next].is_remark) continue;
          if (!AreAlike(lines[last], lines[next])) break;
          last = next;
        }
        blocks.push_back({begin, last + 1});
        Weigh(begin, last + 1);
      }
      begin = std::max(last + 1, begin + 1);
    }
    TakeRowsWithWords();
    PreferRowsBelowNames(blocks);
  }

  /// Extends the block upwards by rows that hold a word instead of a number.
  void TakeRowsWithWords() {
    while (first > 0 && end > first && HasValue(lines[first - 1])) {
      const SplitLine &above = lines[first - 1], &row = lines[first];
      const std::size_t columns = std::max(above.kinds.size(), row.kinds.size());
      if (above.field_count != row.field_count || 2 * Agreeing(above, row) <= columns ||
          above.kinds.front() != row.kinds.front()) {
        break;
      }
      --first;
    }
  }

  /// True if the line directly above the row has as many words as the row has fields.
  bool HasNames(std::size_t row) const {
    for (std::size_t k = row; k-- > 0;) {
      const std::size_t fields = lines[k].fields.size();
      const bool fits = fields >= lines[row].fields.size() && fields <= lines[row].field_count;
      if (fits && HasWordsOnly(lines[k])) return true;
      if (!lines[k].is_remark) return false;
    }
    return false;
  }

  /// A row with another number of fields splits a table into blocks. If the largest block has no
  /// names above it, uses instead the first block with names, or a block of its form at the top of
  /// the file.
  void PreferRowsBelowNames(const std::vector<Block>& blocks) {
    if (end == first || HasNames(first)) return;
    constexpr std::size_t kFewRows = 3;
    for (const Block& block : blocks) {
      if (block.first >= first) return;
      const bool is_alike = AreAlike(lines[block.first], lines[first]);
      const bool has_names =
          HasNames(block.first) && (is_alike || block.end - block.first >= kFewRows);
      if (!has_names && (block.first > 0 || !is_alike)) continue;
      first = block.first;
      end = block.end;
      return;
    }
  }

  /// Texts among values are a sign of a wrong separator and lower the score.
  void Weigh(std::size_t begin, std::size_t block_end) {
    double sum = 0;
    for (std::size_t k = begin; k < block_end; ++k) {
      if (lines[k].is_remark) continue;
      for (const FieldKind kind : lines[k].kinds) {
        sum += IsValue(kind) ? 1.0 : kind == FieldKind::kText ? -0.5 : 0.0;
      }
    }
    if (sum <= worth) return;
    worth = sum;
    first = begin;
    end = block_end;
  }
};

std::optional<Reading> BestReading(const std::vector<HeadLine>& head, const GivenForm& given) {
  std::vector<char> separators = {'\t', ';', '|', ',', ' '};
  if (given.form.separator != 0) separators = {given.form.separator};
  std::vector<NumberForm> forms = {{'.', 0},   {',', 0},   {'.', ','}, {',', '.'},
                                   {',', ' '}, {'.', ' '}, {'.', '\''}};
  std::erase_if(forms, [&](const NumberForm& form) {
    return (given.keys.contains("decimal") && form.decimal != given.form.numbers.decimal) ||
           (given.keys.contains("thousands") && form.thousands != given.form.numbers.thousands);
  });
  std::optional<Reading> best;
  for (const NumberForm& form : forms) {
    for (const char separator : separators) {
      Reading reading(head, separator, form);
      if (!best || reading.worth > best->worth) best = std::move(reading);
    }
  }
  return best;
}

/// Lines of words above the block, in order: names, possibly followed by units.
std::vector<std::size_t> HeaderLines(const Reading& reading) {
  std::vector<std::size_t> lines;
  constexpr std::size_t kMost = 4;
  for (std::size_t k = reading.first; k-- > 0 && lines.size() < kMost;) {
    const SplitLine& line = reading.lines[k];
    const bool fits = line.fields.size() >= reading.least_fields() &&
                      line.fields.size() <= reading.most_fields() && HasWordsOnly(line);
    if (!fits && line.is_remark) continue;
    if (!fits) break;
    lines.insert(lines.begin(), k);
  }
  return lines;
}

std::string NumbersYaml(const NumberForm& numbers) {
  std::string yaml;
  if (numbers.decimal == ',') yaml += ", decimal: \",\"";
  if (numbers.thousands != 0) {
    const std::string sign(1, numbers.thousands);
    yaml += fmt::format(", thousands: {}", sign == " " ? "blank" : "\"" + sign + "\"");
  }
  return yaml;
}

}  // namespace

std::string TableLayout::Yaml() const {
  std::string yaml;
  if (form.separator != found_separator) {
    const std::string sign(1, form.separator);
    yaml += fmt::format(", separator: {}", sign == " "    ? "blank"
                                           : sign == "\t" ? "tab"
                                                          : "\"" + sign + "\"");
  }
  yaml += NumbersYaml(form.numbers);
  if (form.skipped_lines > 0) yaml += fmt::format(", skip_lines: {}", form.skipped_lines);
  if (form.unit_lines > 0) yaml += fmt::format(", unit_lines: {}", form.unit_lines);
  if (form.first_line > 0) yaml += fmt::format(", first_line: {}", form.first_line);
  if (form.last_line > 0) yaml += fmt::format(", last_line: {}", form.last_line);
  if (!form.has_header) yaml += ", header: false";
  if (yaml.empty()) return "";
  return fmt::format("csv: {{{}}}{}\n", yaml.substr(2),
                     form.has_header ? "" : "   # guessed: no line names its columns");
}

std::optional<TableLayout> FindTableLayout(std::string_view text, const GivenForm& given) {
  const std::vector<HeadLine> head = HeadOf(text, given.form.skipped_lines);
  const auto reading = BestReading(head, given);
  if (!reading || reading->worth <= 0) return std::nullopt;
  TableLayout layout{given.form, {}, ','};
  CsvForm& form = layout.form;
  form.separator = reading->separator;
  form.numbers = reading->numbers;
  std::vector<std::size_t> header = HeaderLines(*reading);
  // The names are in the last line that holds no units.
  std::size_t names = header.empty() ? 0 : header.size() - 1;
  while (names > 0 && AreUnits(reading->lines[header[names]].fields)) --names;
  header.erase(header.begin(), header.begin() + static_cast<std::ptrdiff_t>(names));
  if (!given.keys.contains("header")) form.has_header = !header.empty();
  const std::size_t top = form.has_header && !header.empty() ? header.front() : reading->first;
  const bool has_text_above =
      std::any_of(reading->lines.begin(), reading->lines.begin() + static_cast<std::ptrdiff_t>(top),
                  [&](const SplitLine& line) { return form.has_header || !line.is_remark; });
  if (!given.keys.contains("skip_lines") && has_text_above) {
    form.skipped_lines = reading->lines[top].number - 1;
  }
  if (form.has_header && !header.empty()) {
    const auto first = reading->lines.begin() + static_cast<std::ptrdiff_t>(top) + 1;
    const auto end = reading->lines.begin() + static_cast<std::ptrdiff_t>(reading->first);
    if (!given.keys.contains("unit_lines") && first < end) {
      form.unit_lines = static_cast<int>(
          std::count_if(first, end, [](const SplitLine& line) { return !line.is_remark; }));
    }
    if (header.size() > 1) {
      const auto& units = reading->lines[header[1]].fields;
      layout.units.assign(units.begin(), units.end());
    }
  }
  layout.found_separator = SeparatorOfLine(head[top].text);
  return layout;
}

std::vector<NumbersOfColumn> NumbersOf(const CsvFile& csv, const TableLayout& layout,
                                       const std::vector<std::size_t>& rows) {
  std::vector<NumbersOfColumn> columns;
  constexpr std::size_t kDigestFactor = 1'000'003;
  for (std::size_t c = 0; c < csv.columns().size(); ++c) {
    NumbersOfColumn numbers{.name = csv.columns()[c]};
    if (c < layout.units.size()) numbers.unit = layout.units[c];
    for (const std::size_t row : rows) {
      if (const auto value = csv.NumberIfAny(row, c)) {
        numbers.values.push_back(*value);
        continue;
      }
      ++(csv.IsPresent(row, c) ? numbers.words : numbers.missing);
      numbers.gaps = numbers.gaps * kDigestFactor + row + 1;
    }
    // If most fields are words, the few numbers are treated as words too.
    if (numbers.words > numbers.values.size()) numbers.values.clear();
    columns.push_back(std::move(numbers));
  }
  return columns;
}

GivenForm GivenFormOf(const std::vector<std::string>& overrides) {
  const Config config = Config::FromText("csv: {}\n", "--suggest", overrides);
  const ConfigMap csv = config.root().Map("csv");
  GivenForm given{ReadCsvForm(csv), {}};
  for (const std::string& key : csv.Keys()) given.keys.insert(key);
  config.Finish();
  return given;
}

}  // namespace tera
