#pragma once

#include <memory>
#include <optional>
#include <queue>
#include <string>
#include <string_view>
#include <vector>

#include "core/time.h"
#include "dataset/format/recording.h"
#include "dataset/format/row_scan.h"

namespace tera {

/// A channel of the stream.
struct StreamedChannel {
  std::string path;
  /// Delay from the time of validity to that of availability; records are ordered by availability.
  TimeNs delay_ns = 0;
};

/// One record of one channel: the numbers of a row, or the time of a frame. The user of a frame
/// reads its files.
struct Record {
  std::size_t channel = 0;  ///< index into the stream's channels
  TimeNs t_ns = 0;
  TimeNs t_available_ns = 0;
  std::vector<double> values;
};

/// Streams records of several channels in the order of availability; at equal times, in the order
/// of the channels. Memory holds one record of each channel.
class RecordStream {
 public:
  RecordStream(const Recording& recording, const std::vector<StreamedChannel>& channels);
  RecordStream(const Recording& recording, const std::vector<std::string>& paths);

  /// Returns false at the end. Throws InputError for a malformed file.
  bool Next(Record* record);
  const std::string& path(std::size_t channel) const { return channels_[channel].path; }
  const std::vector<std::string>& columns(std::size_t channel) const {
    return readers_[channel]->columns();
  }
  bool lists_frames(std::size_t channel) const { return readers_[channel]->lists_frames(); }
  /// Throws InputError about the last record.
  [[noreturn]] void Fail(std::string_view finding) const;
  /// Throws InputError if a channel has other columns.
  void RequireColumns(std::size_t channel, const std::vector<std::string>& needed) const;

 private:
  void Refill(std::size_t channel);

  struct Later {
    bool operator()(const Record& a, const Record& b) const;
  };
  std::vector<StreamedChannel> channels_;
  std::vector<std::unique_ptr<RowScan>> readers_;
  std::optional<std::size_t> given_;  ///< channel whose reader is at the last record
  std::priority_queue<Record, std::vector<Record>, Later> next_;
};

}  // namespace tera
