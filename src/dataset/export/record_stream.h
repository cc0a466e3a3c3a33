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

/// A channel that is streamed.
struct StreamedChannel {
  std::string path;
  /// How long after it was valid a reader could have had a measurement: the order of records is
  /// that in which they were available.
  TimeNs delay_ns = 0;
};

/// One record of one channel: the numbers of a row, or the time of a frame, whose files whoever
/// needs them reads.
struct Record {
  std::size_t channel = 0;  ///< index into the stream's channels
  TimeNs t_ns = 0;
  TimeNs t_available_ns = 0;
  std::vector<double> values;
};

/// The records of some channels of a recording, in the order of the times at which they were
/// available; of equal times, in the order of the channels. One record of each channel is in
/// memory.
class RecordStream {
 public:
  RecordStream(const Recording& recording, const std::vector<StreamedChannel>& channels);
  RecordStream(const Recording& recording, const std::vector<std::string>& paths);

  /// False at the end. Throws InputError where a file is not as it must be.
  bool Next(Record* record);
  const std::string& path(std::size_t channel) const { return channels_[channel].path; }
  const std::vector<std::string>& columns(std::size_t channel) const {
    return readers_[channel]->columns();
  }
  bool lists_frames(std::size_t channel) const { return readers_[channel]->lists_frames(); }
  /// About the record that Next gave last.
  [[noreturn]] void Fail(std::string_view finding) const;
  /// Throws InputError where the columns of a channel are others.
  void RequireColumns(std::size_t channel, const std::vector<std::string>& needed) const;

 private:
  void Refill(std::size_t channel);

  struct Later {
    bool operator()(const Record& a, const Record& b) const;
  };
  std::vector<StreamedChannel> channels_;
  std::vector<std::unique_ptr<RowScan>> readers_;
  std::optional<std::size_t> given_;  ///< whose reader stands at the record that Next gave last
  std::priority_queue<Record, std::vector<Record>, Later> next_;
};

}  // namespace tera
