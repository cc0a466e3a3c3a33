#include "dataset/import/csv_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/config/spelling.h"
#include "core/error.h"
#include "dataset/files/checked_file.h"

namespace tera {
namespace {

std::vector<std::string_view> Split(std::string_view line) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t comma = line.find(',');
    fields.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

constexpr std::string_view kBlanks = " \t", kByteOrderMark = "\xef\xbb\xbf";

std::string_view Trimmed(std::string_view text, std::string_view blanks) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// Without blanks around it, and without quotes.
std::string_view BareField(std::string_view field) {
  field = Trimmed(field, kBlanks);
  if (field.size() >= 2 && field.front() == '"' && field.back() == '"') {
    field = field.substr(1, field.size() - 2);
  }
  return field;
}

/// A foreign line's fields; separators within quotes are none. Blanks separate in any number.
std::vector<std::string_view> SplitForeign(std::string_view line, char separator) {
  const bool by_blanks = separator == ' ';
  if (by_blanks) line = Trimmed(line, kBlanks);
  std::vector<std::string_view> fields;
  std::size_t begin = 0;
  bool quoted = false;
  for (std::size_t k = 0; k <= line.size(); ++k) {
    if (k < line.size() && line[k] == '"') quoted = !quoted;
    const bool ends =
        k == line.size() || (!quoted && (line[k] == separator || (by_blanks && line[k] == '\t')));
    if (!ends) continue;
    if (!by_blanks || k > begin) fields.push_back(BareField(line.substr(begin, k - begin)));
    begin = k + 1;
  }
  return fields;
}

char SeparatorOf(std::string_view line) {
  for (const char separator : {'\t', ';', ','}) {
    if (line.find(separator) != std::string_view::npos) return separator;
  }
  return ' ';
}

/// The next line of `rest`, without its end.
std::string_view TakeLine(std::string_view* rest) {
  const std::size_t end = rest->find('\n');
  std::string_view line = rest->substr(0, end);
  rest->remove_prefix(end == std::string_view::npos ? rest->size() : end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

template <typename T>
bool Parse(std::string_view text, T* value) {
  const auto [stop, status] = std::from_chars(text.data(), text.data() + text.size(), *value);
  return status == std::errc() && stop == text.data() + text.size();
}

}  // namespace

CsvFile::CsvFile(const std::filesystem::path& path, LastLine last_line)
    : path_(path), text_(std::make_unique<const std::string>(ReadWholeFile(path))) {
  if (text_->empty()) {
    throw InputError(fmt::format("{}:1: the file is empty; need a header line", path_.string()));
  }
  std::string_view rest = *text_;
  for (int line = 1; !rest.empty(); ++line) {
    const std::size_t end = rest.find('\n');
    if (end == std::string_view::npos && last_line == LastLine::kIsLeftOutIfCut) break;
    std::string_view row = rest.substr(0, end);
    if (end == std::string_view::npos && last_line == LastLine::kMustEnd) {
      throw InputError(
          fmt::format("{}:{}: the last line is cut off; need whole lines, copy or "
                      "record the file again",
                      path_.string(), line));
    }
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    if (row.ends_with('\r')) row.remove_suffix(1);
    const std::vector<std::string_view> fields = Split(row);
    if (line == 1) {
      columns_.assign(fields.begin(), fields.end());
      continue;
    }
    if (fields.size() != columns_.size()) {
      throw InputError(fmt::format("{}:{}: found {} fields, need {} as in the header",
                                   path_.string(), line, fields.size(), columns_.size()));
    }
    AddRow(fields, line);
  }
  NameColumns(columns_, 1);
}

void CsvFile::AddRow(const std::vector<std::string_view>& fields, int line) {
  if (fields_.empty()) {  // room for all at once: growing would need twice as much
    const auto lines = static_cast<std::size_t>(std::count(text_->begin(), text_->end(), '\n'));
    // Each field takes a byte at least, its separator or the end of its line.
    fields_.reserve(std::min((lines + 1) * columns_.size(), text_->size() + 1));
    line_of_row_.reserve(lines + 1);
  }
  for (const std::string_view field : fields) {
    constexpr std::size_t kLongestField = (1 << 24) - 1;
    if (field.size() > kLongestField) {
      throw InputError(fmt::format("{}:{}: a field of {} bytes; need at most {}", path_.string(),
                                   line, field.size(), kLongestField));
    }
    const auto begin = field.empty() ? 0 : static_cast<std::uint64_t>(field.data() - text_->data());
    fields_.push_back({begin, field.size()});
  }
  line_of_row_.push_back(line);
}

void CsvFile::NameColumns(std::vector<std::string> names, int line) {
  columns_ = names;
  std::sort(names.begin(), names.end());
  if (const auto twice = std::adjacent_find(names.begin(), names.end()); twice != names.end()) {
    throw InputError(
        fmt::format("{}:{}: column '{}' is there twice; rename one", path_.string(), line, *twice));
  }
}

CsvFile::CsvFile(const std::filesystem::path& path, const CsvForm& form, LeftOutRows* left_out)
    : path_(path), text_(std::make_unique<const std::string>(ReadWholeFile(path))) {
  std::string_view rest = *text_;
  if (rest.starts_with(kByteOrderMark)) rest.remove_prefix(kByteOrderMark.size());
  char separator = form.separator;
  std::size_t ordinal = 0;
  for (int number = 1; !rest.empty(); ++number) {
    const bool is_last = rest.find('\n') == std::string_view::npos;
    std::string_view line = TakeLine(&rest);
    if (number <= form.skipped_lines) continue;
    const std::string_view bare = Trimmed(line, kBlanks);
    if (bare.empty()) continue;
    const bool is_header = columns_.empty() && form.has_header;
    if (bare.front() == '#') {
      if (!is_header) continue;
      line = bare.substr(1);
    }
    if (separator == 0) separator = SeparatorOf(line);
    const std::vector<std::string_view> fields = SplitForeign(line, separator);
    if (is_header) {
      NameColumns({fields.begin(), fields.end()}, number);
      continue;
    }
    if (columns_.empty()) {
      for (std::size_t k = 1; k <= fields.size(); ++k) columns_.push_back(std::to_string(k));
    }
    ++ordinal;
    if (fields.size() == columns_.size()) {
      ordinals_.push_back(ordinal - 1);
      AddRow(fields, number);
      continue;
    }
    const std::string fault =
        fmt::format("{}:{}: found {} fields, need {} as in the {}{}", path_.string(), number,
                    fields.size(), columns_.size(), form.has_header ? "header" : "first row",
                    is_last ? "; this last line seems to be cut off" : "");
    if (left_out == nullptr) {
      throw InputError(fault + "; mend it, or leave such rows out by --skip-bad-rows");
    }
    left_out->Add(fault);
  }
  if (columns_.empty()) {
    throw InputError(fmt::format("{}:1: holds no line of {}", path_.string(),
                                 form.has_header ? "column names" : "numbers"));
  }
}

bool CsvFile::IsPresent(std::size_t row, std::size_t column) const {
  const std::string_view field = Field(row, column);
  for (const std::string_view none : {"", "nan", "NaN", "NAN", "-nan", "null", "NULL", "N/A"}) {
    if (field == none) return false;
  }
  return true;
}

std::size_t CsvFile::Column(const std::string& name) const {
  const auto found = std::find(columns_.begin(), columns_.end(), name);
  if (found == columns_.end()) {
    throw InputError(fmt::format("{}:1: column '{}' is missing{}", path_.string(), name,
                                 DidYouMean(name, columns_)));
  }
  return static_cast<std::size_t>(found - columns_.begin());
}

void CsvFile::Fail(std::size_t row, std::size_t column, const std::string& finding) const {
  throw InputError(fmt::format("{}:{}: column '{}': found '{}', {}", path_.string(),
                               line_of_row_[row], columns_[column], Field(row, column), finding));
}

std::optional<double> CsvFile::NumberIfAny(std::size_t row, std::size_t column) const {
  double value = 0;
  std::string_view field = Field(row, column);
  if (field.starts_with('+')) field.remove_prefix(1);
  if (!Parse(field, &value) || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<TimeNs> CsvFile::WholeNanoseconds(std::size_t row, std::size_t column,
                                                TimeNs unit_ns) const {
  std::string_view field = Field(row, column);
  constexpr TimeNs kFarthest_ns = 9'000'000'000 * kNsPerSecond;
  const bool is_negative = field.starts_with('-');
  if (is_negative || field.starts_with('+')) field.remove_prefix(1);
  if (field.empty() || field == ".") return std::nullopt;
  TimeNs sum_ns = 0, digit_ns = unit_ns;
  bool after_point = false;
  for (const char c : field) {
    if (c == '.' && !after_point) {
      after_point = true;
      continue;
    }
    if (c < '0' || c > '9') return std::nullopt;
    if (after_point) {
      digit_ns /= 10;  // what is finer than a nanosecond is cut off
      sum_ns += (c - '0') * digit_ns;
    } else {
      if (sum_ns > kFarthest_ns / 10) return std::nullopt;
      sum_ns = 10 * sum_ns + (c - '0') * unit_ns;
    }
  }
  return is_negative ? -sum_ns : sum_ns;
}

double CsvFile::Number(std::size_t row, std::size_t column) const {
  const std::optional<double> value = NumberIfAny(row, column);
  if (value) return *value;
  const bool has_comma = Field(row, column).find(',') != std::string_view::npos;
  Fail(row, column,
       has_comma ? "need a finite number, with a decimal point in place of the comma"
                 : "need a finite number");
}

TimeNs CsvFile::Time(std::size_t row) const {
  TimeNs t_ns = 0;
  if (!Parse(Field(row, 0), &t_ns)) Fail(row, 0, "need a whole number of nanoseconds");
  if (row > 0) {
    TimeNs before_ns = 0;
    Parse(Field(row - 1, 0), &before_ns);
    if (t_ns <= before_ns)
      Fail(row, 0, fmt::format("need a later time than that of the row before, {}", before_ns));
  }
  return t_ns;
}

}  // namespace tera
