#include "dataset/export/record_stream.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <tuple>
#include <utility>

#include "core/check.h"
#include "core/error.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

std::vector<StreamedChannel> WithoutDelay(const std::vector<std::string>& paths) {
  std::vector<StreamedChannel> channels;
  for (const std::string& path : paths) channels.push_back({path, 0});
  return channels;
}

fs::path RowsOf(const Recording& recording, const std::string& channel) {
  const std::string_view type = recording.TypeOf(channel);
  const fs::path path = recording.directory() / channel;
  return type == kTableChannel || type == kPoseChannel ? path : path / "data.csv";
}

}  // namespace

bool RecordStream::Later::operator()(const Record& a, const Record& b) const {
  return std::tie(a.t_available_ns, a.channel) > std::tie(b.t_available_ns, b.channel);
}

RecordStream::RecordStream(const Recording& recording, const std::vector<std::string>& paths)
    : RecordStream(recording, WithoutDelay(paths)) {}

RecordStream::RecordStream(const Recording& recording, const std::vector<StreamedChannel>& channels)
    : channels_(channels) {
  for (std::size_t c = 0; c < channels_.size(); ++c) {
    readers_.push_back(std::make_unique<RowScan>(RowsOf(recording, channels_[c].path)));
    Refill(c);
  }
}

void RecordStream::Refill(std::size_t channel) {
  ScannedRow row;
  if (!readers_[channel]->Next(&row)) return;
  Record record;
  record.channel = channel;
  record.t_ns = row.t_ns;
  record.values = std::move(row.values);
  record.t_available_ns = row.t_ns + channels_[channel].delay_ns;
  next_.push(std::move(record));
}

bool RecordStream::Next(Record* record) {
  if (given_) Refill(*given_);
  given_.reset();
  if (next_.empty()) return false;
  *record = next_.top();
  next_.pop();
  given_ = record->channel;
  return true;
}

void RecordStream::Fail(std::string_view finding) const {
  TERA_CHECK(given_);
  readers_[*given_]->Fail(finding);
}

void RecordStream::RequireColumns(std::size_t channel,
                                  const std::vector<std::string>& needed) const {
  if (columns(channel) == needed) return;
  throw InputError(path(channel) + ":1",
                   fmt::format("found the columns '{}' after t_ns, need '{}'",
                               fmt::join(columns(channel), ","), fmt::join(needed, ",")));
}

}  // namespace tera
