#include "dataset/import/csv_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/config/spelling.h"
#include "core/error.h"
#include "dataset/files/checked_file.h"
#include "dataset/import/foreign_file.h"

namespace tera {
void CsvFile::AddRow(const std::vector<std::string_view>& fields, int line) {
  if (fields_.empty()) {  // a single allocation, because growth would need twice the memory
    const auto lines = static_cast<std::size_t>(std::count(text_->begin(), text_->end(), '\n'));
    // Each field occupies at least one byte: its separator or the end of its line.
    fields_.reserve(std::min((lines + 1) * columns_.size(), text_->size() + 1));
    line_of_row_.reserve(lines + 1);
  }
  for (const std::string_view field : fields) {
    constexpr std::size_t kLongestField = (1 << 24) - 1;
    if (field.size() > kLongestField) {
      FailAtLine(line, {FaultKind::kOutOfRange, fmt::format("a field of {} bytes; need at most {}",
                                                            field.size(), kLongestField)});
    }
    const auto begin = field.empty() ? 0 : static_cast<std::uint64_t>(field.data() - text_->data());
    fields_.push_back({begin, field.size()});
  }
  line_of_row_.push_back(line);
}

void CsvFile::NameColumns(const std::vector<std::string_view>& names) {
  std::map<std::string_view, std::size_t> count, before;
  for (const std::string_view name : names) ++count[name];
  for (std::size_t c = 0; c < names.size(); ++c) {
    std::string name = names[c].empty() ? std::to_string(c + 1) : std::string(names[c]);
    // A name with two lines usually has its unit on the second. A doubled quote within quotes is
    // one quote.
    std::replace(name.begin(), name.end(), '\n', ' ');
    for (std::size_t at = 0; (at = name.find("\"\"", at)) != std::string::npos; ++at) {
      name.erase(at, 1);
    }
    if (count[names[c]] > 1 && !names[c].empty()) name += fmt::format("#{}", ++before[names[c]]);
    columns_.push_back(std::move(name));
  }
}

CsvFile::CsvFile(const std::filesystem::path& path, const CsvForm& form, LeftOutRows* left_out)
    : path_(path), numbers_(form.numbers) {
  RefuseForeignFile(path, "a text table, a bag or another supported log");
  text_ = std::make_unique<const std::string>(DecodedTable(ReadWholeFile(path)));
  if (text_->empty()) {
    throw InputError(path.string(), {FaultKind::kMissing,
                                     "is empty; need a table with rows, copy or record it again"});
  }
  ReadRows(*text_, form, left_out);
  if (columns_.empty()) {
    FailAtLine(1, {FaultKind::kMissing, fmt::format("holds no line of {}",
                                                    form.has_header ? "column names" : "numbers")});
  }
}

void CsvFile::FailAtLine(int line, const InputFault& fault) const {
  throw InputError(fmt::format("{}:{}", path_.string(), line), fault);
}

void CsvFile::ReadRows(std::string_view rest, const CsvForm& form, LeftOutRows* left_out) {
  header_line_ = 0;
  int number = 1;
  for (; number <= form.skipped_lines && !rest.empty(); ++number) {
    rest.remove_prefix(std::min(rest.find('\n'), rest.size() - 1) + 1);
  }
  char separator = form.separator;
  int unit_lines = form.has_header ? form.unit_lines : 0;
  for (int lines = 1; !rest.empty(); number += lines) {
    const bool is_last = rest.find('\n') == std::string_view::npos;
    std::string_view line = TakeRecord(&rest, &lines);
    const std::string_view bare = TrimmedText(line);
    if (bare.empty()) continue;
    const bool is_header = columns_.empty() && form.has_header;
    if (IsRemark(bare)) {
      if (!is_header) continue;
      line = bare.substr(1);
    } else if (!is_header && unit_lines > 0) {
      --unit_lines;
      continue;
    }
    if (form.last_line > 0 && number > form.last_line) break;
    if (!is_header && number < form.first_line) continue;
    if (separator == 0) separator = SeparatorOfLine(line);
    std::vector<std::string_view> fields = FieldsOfRecord(line, separator);
    if (is_header) {
      while (fields.size() > 1 && fields.back().empty()) fields.pop_back();
      NameColumns(fields);
      header_line_ = number;
      continue;
    }
    if (columns_.empty()) {
      for (std::size_t k = 1; k <= fields.size(); ++k) columns_.push_back(std::to_string(k));
    }
    const std::size_t ordinal = ordinal_count_++;
    DropEmptyEnd(&fields);
    if (fields.size() == columns_.size()) {
      ordinals_.push_back(ordinal);
      AddRow(fields, number);
      continue;
    }
    const std::string fault = WrongFieldCount(fields.size(), is_last);
    if (left_out == nullptr) {
      FailAtLine(number, {FaultKind::kMalformed,
                          fault + "; repair it, or skip such rows with --skip-bad-rows"});
    }
    left_out->Add(fmt::format("{}:{}: {}", path_.string(), number, fault));
  }
}

void CsvFile::DropEmptyEnd(std::vector<std::string_view>* fields) const {
  while (fields->size() > columns_.size() && fields->back().empty()) fields->pop_back();
}

std::string CsvFile::WrongFieldCount(std::size_t found, bool is_last) const {
  std::string fault =
      fmt::format("found {} fields, need {} as in the {}", found, columns_.size(),
                  header_line_ > 0 ? fmt::format("header in line {}", header_line_) : "first row");
  if (header_line_ > 0 && found == 2 * columns_.size() && columns_.size() > 1) {
    fault += "; are commas decimal signs and separators at once? then write it with semicolons";
  }
  return fault + (is_last ? "; this last line seems truncated" : "");
}

std::size_t CsvFile::Column(const std::string& name) const {
  const auto found = std::find(columns_.begin(), columns_.end(), name);
  if (found != columns_.end()) return static_cast<std::size_t>(found - columns_.begin());
  if (const auto first = std::find(columns_.begin(), columns_.end(), name + "#1");
      first != columns_.end()) {
    FailAtLine(
        std::max(header_line_, 1),
        {FaultKind::kRepeated, fmt::format("column '{0}' occurs more than once; name one of them: "
                                           "'{0}#1' is field {1}, '{0}#2' the next of that name",
                                           name, first - columns_.begin() + 1)});
  }
  FailAtLine(std::max(header_line_, 1),
             {FaultKind::kNoSuchName,
              fmt::format("column '{}' is missing{}", name, DidYouMean(name, columns_))});
}

void CsvFile::Fail(std::size_t row, std::size_t column, const InputFault& fault) const {
  throw InputError(
      fmt::format("{}:{}: column '{}'", path_.string(), line_of_row_[row], columns_[column]),
      {fault.kind, fmt::format("found '{}', {}", Field(row, column), fault.finding)});
}

std::optional<TimeNs> CsvFile::WholeNanoseconds(std::size_t row, std::size_t column,
                                                TimeNs unit_ns) const {
  std::string room;
  std::string_view field = PlainNumberText(Field(row, column), numbers_, &room);
  constexpr TimeNs kFarthest_ns = 9'000'000'000 * kNsPerSecond;
  const bool is_negative = field.starts_with('-');
  if (is_negative) field.remove_prefix(1);
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
      digit_ns /= 10;  // truncates below a nanosecond
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
  const std::string_view field = Field(row, column);
  if (field.find(',') != std::string_view::npos && numbers_.decimal == '.') {
    Fail(row, column,
         {FaultKind::kMistyped,
          "need a finite number; for decimal commas set csv: {decimal: \",\"}, for commas between "
          "thousands csv: {thousands: \",\"}"});
  }
  if (row == 0 && header_line_ > 0) {
    Fail(row, column,
         {FaultKind::kMistyped,
          "need a finite number; if this line holds units, set csv: {unit_lines: 1}"});
  }
  Fail(row, column, {FaultKind::kMistyped, "need a finite number"});
}

}  // namespace tera
