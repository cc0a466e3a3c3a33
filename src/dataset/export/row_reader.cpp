#include "dataset/export/row_reader.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "core/error.h"
#include "dataset/format/csv_rows.h"

namespace tera {
namespace {

constexpr std::string_view kTimeColumn = "t_ns";

/// The field at the beginning of `rest`, which then begins after its comma; `ended` after the last.
std::string_view TakeField(std::string_view* rest, bool* ended) {
  const std::size_t comma = rest->find(',');
  const std::string_view field = rest->substr(0, comma);
  *ended = comma == std::string_view::npos;
  rest->remove_prefix(*ended ? rest->size() : comma + 1);
  return field;
}

template <typename T>
bool Parse(std::string_view text, T* value) {
  const auto [stop, status] = std::from_chars(text.data(), text.data() + text.size(), *value);
  return status == std::errc() && stop == text.data() + text.size();
}

}  // namespace

RowReader::RowReader(const std::filesystem::path& file) : path_(file), stream_(file) {
  std::error_code ignored;
  if (!stream_ || !std::filesystem::is_regular_file(file, ignored)) {
    throw InputError(fmt::format(
        "{}: cannot be read, though dataset.yaml lists it; need the file, or its line taken out",
        file.string()));
  }
  if (!NextLine()) {
    throw InputError(fmt::format("{}:1: the file is empty; need a header line", file.string()));
  }
  lists_frames_ = text_ == kFrameHeader;
  std::string_view rest = text_;
  bool ended = false;
  const std::string_view first = TakeField(&rest, &ended);
  if (first != kTimeColumn) Fail(fmt::format("the first column is '{}', need t_ns", first));
  while (!ended) {
    const std::string_view name = TakeField(&rest, &ended);
    if (!lists_frames_) columns_.emplace_back(name);
  }
}

bool RowReader::NextLine() {
  ++line_;
  if (!std::getline(stream_, text_)) {
    if (stream_.bad()) Fail("cannot be read further; look at the disk");
    return false;
  }
  if (stream_.eof()) Fail("the last line is cut off; need whole lines, copy or record it again");
  if (text_.ends_with('\r')) text_.pop_back();
  return true;
}

bool RowReader::Next(TimeNs* t_ns, std::vector<double>* values) {
  values->clear();
  if (!NextLine()) return false;
  std::string_view rest = text_;
  bool ended = false;
  const std::string_view time = TakeField(&rest, &ended);
  if (!Parse(time, t_ns)) Fail(fmt::format("t_ns is '{}', need whole nanoseconds", time));
  if (has_before_ && *t_ns <= before_ns_) {
    Fail(fmt::format("t_ns is {}, need a later time than the row before has, {}", *t_ns,
                     before_ns_));
  }
  has_before_ = true;
  before_ns_ = *t_ns;
  if (lists_frames_) return true;
  while (!ended) {
    const std::string_view field = TakeField(&rest, &ended);
    if (values->size() == columns_.size()) {
      Fail(fmt::format("found more than {} fields, need as many as in the header",
                       columns_.size() + 1));
    }
    double value = 0;
    if (!Parse(field, &value) || !std::isfinite(value)) {
      Fail(fmt::format("column '{}': found '{}', need a finite number", columns_[values->size()],
                       field));
    }
    values->push_back(value);
  }
  if (values->size() != columns_.size()) {
    Fail(fmt::format("found {} fields, need {} as in the header", values->size() + 1,
                     columns_.size() + 1));
  }
  return true;
}

void RowReader::Fail(std::string_view finding) const {
  throw InputError(fmt::format("{}:{}: {}", path_.string(), line_, finding));
}

}  // namespace tera
