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
    fields_.insert(fields_.end(), fields.begin(), fields.end());
    line_of_row_.push_back(line);
  }
  auto sorted = columns_;
  std::sort(sorted.begin(), sorted.end());
  if (const auto twice = std::adjacent_find(sorted.begin(), sorted.end()); twice != sorted.end()) {
    throw InputError(
        fmt::format("{}:1: column '{}' is there twice; rename one", path_.string(), *twice));
  }
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

double CsvFile::Number(std::size_t row, std::size_t column) const {
  double value = 0;
  if (!Parse(Field(row, column), &value) || !std::isfinite(value)) {
    Fail(row, column, "need a finite number");
  }
  return value;
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
