#include "dataset/lint/row_scan.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "dataset/format/csv_rows.h"

namespace tera {
namespace {

template <typename T>
bool Parse(std::string_view text, T* value) {
  const auto [stop, status] = std::from_chars(text.data(), text.data() + text.size(), *value);
  return status == std::errc() && stop == text.data() + text.size();
}

std::vector<std::string_view> FieldsOf(std::string_view text) {
  std::vector<std::string_view> fields;
  for (;;) {
    const std::size_t comma = text.find(',');
    fields.push_back(text.substr(0, comma));
    if (comma == std::string_view::npos) return fields;
    text.remove_prefix(comma + 1);
  }
}

void DropCarriageReturn(std::string* text) {
  if (text->ends_with('\r')) text->pop_back();
}

}  // namespace

RowScan::RowScan(const std::filesystem::path& file, OnFault on_fault)
    : stream_(file), on_fault_(std::move(on_fault)) {
  std::error_code ignored;
  if (!stream_ || !std::filesystem::is_regular_file(file, ignored)) {
    throw InputError(fmt::format("{}: cannot be read; need the file", file.string()));
  }
  std::getline(stream_, text_);
  DropCarriageReturn(&text_);
  lists_frames_ = text_ == kFrameHeader;
  const std::vector<std::string_view> names = FieldsOf(text_);
  if (names.front() != "t_ns") {
    throw InputError(
        fmt::format("{}:1: the first column is '{}', need t_ns", file.string(), names.front()));
  }
  columns_.assign(names.begin() + 1, names.end());
}

bool RowScan::Tell(RowFault fault, const std::string& what) const {
  if (on_fault_) on_fault_(fault, line_, what);
  return false;
}

bool RowScan::Next(ScannedRow* row) {
  while (std::getline(stream_, text_)) {
    ++line_;
    if (stream_.eof()) {
      Tell(RowFault::kFields, "the last line is cut off");
      return false;
    }
    DropCarriageReturn(&text_);
    if (Read(row)) return true;
  }
  return false;
}

bool RowScan::Read(ScannedRow* row) {
  const std::vector<std::string_view> fields = FieldsOf(text_);
  if (fields.size() != columns_.size() + 1) {
    return Tell(RowFault::kFields, fmt::format("found {} fields, need {} as in the header",
                                               fields.size(), columns_.size() + 1));
  }
  if (!Parse(fields[0], &row->t_ns)) {
    return Tell(RowFault::kFields, fmt::format("t_ns is '{}', need whole nanoseconds", fields[0]));
  }
  row->line = line_;
  row->values.clear();
  if (lists_frames_) {
    row->filename = fields[1];
  } else {
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      double value = 0;
      if (!Parse(fields[c + 1], &value)) {
        return Tell(RowFault::kFields, fmt::format("column {}: found '{}', need a number",
                                                   columns_[c], fields[c + 1]));
      }
      if (!std::isfinite(value)) {
        return Tell(RowFault::kNotFinite,
                    fmt::format("column {} is {}", columns_[c], fields[c + 1]));
      }
      row->values.push_back(value);
    }
  }
  if (has_before_ && row->t_ns <= before_ns_) {
    return Tell(RowFault::kStamp, fmt::format("t_ns is {}, no later than {} of the row before",
                                              row->t_ns, before_ns_));
  }
  has_before_ = true;
  before_ns_ = row->t_ns;
  return true;
}

}  // namespace tera
