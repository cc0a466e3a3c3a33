#include "dataset/import/logs/number_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/check.h"
#include "core/config/spelling.h"
#include "core/error.h"
#include "core/parse_number.h"
#include "core/split_text.h"
#include "dataset/files/checked_file.h"
#include "dataset/import/table_text.h"

namespace tera {
namespace {

constexpr std::size_t kTimeColumn = 0;

}  // namespace

NumberTable::NumberTable(std::filesystem::path file, std::vector<std::string> columns)
    : file_(std::move(file)), names_{"time"} {
  names_.insert(names_.end(), columns.begin(), columns.end());
  for (std::size_t c = 0; c < names_.size(); ++c) place_of_[names_[c]] = c;
}

void NumberTable::AddRow(int line, TimeNs t_ns, const std::vector<Cell>& cells) {
  lines_.push_back(line);
  t_ns_.push_back(t_ns);
  const std::size_t begin = numbers_.size();
  numbers_.resize(begin + names_.size() - 1, std::numeric_limits<double>::quiet_NaN());
  for (const Cell& cell : cells) {
    const auto place = place_of_.find(cell.column);
    TERA_CHECK(place != place_of_.end() && place->second != kTimeColumn);
    if (std::isfinite(cell.value)) numbers_[begin + place->second - 1] = cell.value;
  }
}

std::size_t NumberTable::Column(const std::string& name) const {
  const auto found = place_of_.find(name);
  if (found != place_of_.end()) return found->second;
  throw InputError(file_.string(),
                   {FaultKind::kNoSuchName,
                    fmt::format("has no column '{}'{}", name, DidYouMean(name, names_))});
}

std::optional<double> NumberTable::NumberIfAny(std::size_t row, std::size_t column) const {
  if (column == kTimeColumn) return ToSeconds(t_ns_[row]);
  const double value = numbers_[row * (names_.size() - 1) + column - 1];
  return std::isnan(value) ? std::nullopt : std::optional(value);
}

double NumberTable::Number(std::size_t row, std::size_t column) const {
  const std::optional<double> value = NumberIfAny(row, column);
  if (!value) Fail(row, column, {FaultKind::kMissing, "need a number"});
  return *value;
}

std::optional<TimeNs> NumberTable::Stamp(std::size_t row, std::size_t column) const {
  return column == kTimeColumn ? std::optional(t_ns_[row]) : std::nullopt;
}

bool NumberTable::IsPresent(std::size_t row, std::size_t column) const {
  return NumberIfAny(row, column).has_value();
}

bool NumberTable::Repeats(std::size_t row, std::size_t column) const {
  return NumberIfAny(row, column) == NumberIfAny(row - 1, column);
}

void NumberTable::Fail(std::size_t row, std::size_t column, const InputFault& fault) const {
  const std::optional<double> value = NumberIfAny(row, column);
  throw InputError(
      fmt::format("{}:{}: '{}'", file_.string(), lines_[row], names_[column]),
      {fault.kind,
       fmt::format("found {}, {}", value ? fmt::format("{}", *value) : "nothing", fault.finding)});
}

LogLines::LogLines(const std::filesystem::path& file, FrameBytes frame_bytes)
    : file_(file), text_(ReadWholeFile(file)), frame_bytes_(frame_bytes) {}

std::size_t LogLines::EndOfLine() const {
  const std::string_view text = text_;
  const std::size_t end = std::min(text.find('\n', at_), text.size());
  for (std::size_t k = at_ + 1; k < end && frame_bytes_ != nullptr; ++k) {
    const bool is_text = static_cast<unsigned char>(text[k]) < 0x80;
    if (!is_text && frame_bytes_(text.substr(k)) > 0) return k;
  }
  return end;
}

bool LogLines::Next(std::string* line) {
  const std::string_view text = text_;
  while (frame_bytes_ != nullptr) {
    const std::size_t frame = frame_bytes_(text.substr(at_));
    if (frame == 0) break;
    const std::string_view bytes = text.substr(at_, frame);
    ended_ += static_cast<int>(std::count(bytes.begin(), bytes.end(), '\n'));
    at_ += frame;
  }
  if (at_ >= text.size()) return false;
  const std::size_t end = EndOfLine();
  *line = text.substr(at_, end - at_);
  if (line->ends_with('\r')) line->pop_back();
  number_ = ended_ + 1;
  const bool has_end = end < text.size() && text[end] == '\n';
  if (has_end) ++ended_;
  at_ = has_end ? end + 1 : end;
  return true;
}

void LogLines::Fault(const std::string& finding, LeftOutRows* left_out) const {
  const std::string place = fmt::format("{}:{}", file_.string(), number_);
  if (left_out == nullptr) {
    throw InputError(place, {FaultKind::kMalformed,
                             finding + "; repair it, or skip such lines with --skip-bad-rows"});
  }
  left_out->Add(place + ": " + finding);
}

std::optional<double> WholeNumber(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  return ParseFinite(text);
}

std::vector<std::string_view> FieldsOf(std::string_view line, char separator) {
  return separator == ' ' ? FieldsOfRecord(line, ' ') : PartsOf(line, separator);
}

}  // namespace tera
