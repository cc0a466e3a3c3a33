#include "dataset/format/row_scan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/config/spelling.h"
#include "core/error.h"
#include "core/parse_number.h"
#include "core/split_text.h"
#include "dataset/format/csv_rows.h"

namespace tera {
namespace {

void DropCarriageReturn(std::string* text) {
  if (text->ends_with('\r')) text->pop_back();
}

}  // namespace

RowScan::RowScan(const std::filesystem::path& file) : RowScan(file, {}) {
  on_fault_ = [this](RowFault, int, const std::string& what) { Fail(what); };
}

RowScan::RowScan(const std::filesystem::path& file, OnFault on_fault)
    : file_(file), stream_(file), on_fault_(std::move(on_fault)) {
  std::error_code ignored;
  if (!stream_ || !std::filesystem::is_regular_file(file, ignored)) {
    throw InputError(
        file.string(),
        {FaultKind::kUnreadable,
         "cannot be read, but dataset.yaml lists it; restore the file, or remove its line"});
  }
  if (!std::getline(stream_, text_)) Fail("the file is empty; need a header line");
  DropCarriageReturn(&text_);
  lists_frames_ = text_ == kFrameHeader;
  SplitAt(',', text_, &fields_);
  if (fields_.front() != "t_ns") {
    Fail(fmt::format("the first column is '{}', need t_ns", fields_.front()));
  }
  columns_.assign(fields_.begin() + 1, fields_.end());
  std::vector<std::string> names = columns_;
  std::sort(names.begin(), names.end());
  const auto twice = std::adjacent_find(names.begin(), names.end());
  if (twice != names.end()) Fail(fmt::format("column '{}' occurs twice; rename one", *twice));
}

void RowScan::RequireColumns(const std::vector<std::string>& columns) const {
  if (columns == columns_) return;
  for (const std::string& column : columns) {
    if (std::find(columns_.begin(), columns_.end(), column) != columns_.end()) continue;
    Fail(fmt::format("column '{}' is missing{}", column, DidYouMean(column, columns_)));
  }
  Fail(fmt::format("found the columns '{}', need '{}'", TableHeader(columns_),
                   TableHeader(columns)));
}

bool RowScan::Tell(RowFault fault, const std::string& what) const {
  if (on_fault_) on_fault_(fault, line_, what);
  return false;
}

void RowScan::Fail(std::string_view finding) const {
  throw InputError(fmt::format("{}:{}", file_.string(), line_),
                   {FaultKind::kMalformed, std::string(finding)});
}

bool RowScan::Next(ScannedRow* row) {
  while (std::getline(stream_, text_)) {
    ++line_;
    if (stream_.eof()) {
      return Tell(RowFault::kCutOff,
                  "the last line is cut off; need whole lines, copy or record it again");
    }
    DropCarriageReturn(&text_);
    if (Read(row)) return true;
  }
  if (stream_.bad()) Fail("cannot be read further; check the disk");
  return false;
}

bool RowScan::Read(ScannedRow* row) {
  SplitAt(',', text_, &fields_);
  if (fields_.size() != columns_.size() + 1) {
    return Tell(RowFault::kFields, fmt::format("found {} fields, need {} as in the header",
                                               fields_.size(), columns_.size() + 1));
  }
  const auto t_ns = ParseNumber<TimeNs>(fields_[0]);
  if (!t_ns) {
    return Tell(RowFault::kFields, fmt::format("t_ns is '{}', need whole nanoseconds", fields_[0]));
  }
  row->line = line_;
  row->t_ns = *t_ns;
  row->values.clear();
  if (lists_frames_) {
    row->filename = fields_[1];
  } else {
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      const auto value = ParseNumber<double>(fields_[c + 1]);
      if (!value || !std::isfinite(*value)) {
        return Tell(value ? RowFault::kNotFinite : RowFault::kFields,
                    fmt::format("column '{}': found '{}', need a finite number", columns_[c],
                                fields_[c + 1]));
      }
      row->values.push_back(*value);
    }
  }
  if (before_ns_ && *t_ns <= *before_ns_) {
    return Tell(
        RowFault::kStamp,
        fmt::format("t_ns is {}, need a later time than the previous row, {}", *t_ns, *before_ns_));
  }
  before_ns_ = *t_ns;
  return true;
}

}  // namespace tera
