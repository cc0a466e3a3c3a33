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

struct StreamedChannel {
  std::string path;
  /// Delay from t_ns to t_available_ns. Records are ordered by t_available_ns.
  TimeNs delay_ns = 0;
};

/// A record of one channel: the numbers of a row, or the time of a frame. The frame's files are
/// read separately.
struct Record {
  std::size_t channel = 0;  ///< index in the list of channels
  TimeNs t_ns = 0;
  TimeNs t_available_ns = 0;
  std::vector<double> values;
};

/// Merges records of several channels in order of t_available_ns. At equal times, records follow
/// the order of the channels. Memory holds one record per channel.
class RecordStream {
 public:
  RecordStream(const Recording& recording, const std::vector<StreamedChannel>& channels);
  RecordStream(const Recording& recording, const std::vector<std::string>& paths);

  /// Reads the next record; returns false at the end. Throws InputError for a malformed file.
  bool Next(Record* record);
  const std::string& path(std::size_t channel) const { return channels_[channel].path; }
  const std::vector<std::string>& columns(std::size_t channel) const {
    return readers_[channel]->columns();
  }
  bool lists_frames(std::size_t channel) const { return readers_[channel]->lists_frames(); }
  /// Throws InputError that names the place of the last record.
  [[noreturn]] void Fail(std::string_view finding) const;
  /// Throws InputError if the channel does not have the columns `needed`.
  void RequireColumns(std::size_t channel, const std::vector<std::string>& needed) const;

 private:
  void Refill(std::size_t channel);

  struct Later {
    bool operator()(const Record& a, const Record& b) const;
  };
  std::vector<StreamedChannel> channels_;
  std::vector<std::unique_ptr<RowScan>> readers_;
  std::optional<std::size_t> given_;  ///< channel of the last record
  std::priority_queue<Record, std::vector<Record>, Later> next_;
};

}  // namespace tera
