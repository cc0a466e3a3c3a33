#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/time.h"
#include "dataset/export/json_lists.h"
#include "dataset/export/webdataset/dataset_card.h"
#include "dataset/export/webdataset/tar_writer.h"

namespace tera {

/// A part of a sample: what its file's name ends in, "rgb.png", and its bytes.
struct SamplePart {
  std::string ending, bytes;
};

/// Samples of one sensor in tar archives of about one size, NAME-000000.tar and on, and their list,
/// NAME.json, as WIDS reads it. One sample is in memory.
///
/// Source  "The WebDataset Format"; `wids` of the same project.
class Shards {
 public:
  /// NAME is the sensor's FlatName. Archives that an export which was stopped has left whole are
  /// counted in.
  Shards(const std::filesystem::path& folder, const std::string& sensor, std::int64_t most_bytes);

  /// Parts are NAME/<t_ns in 20 digits>.ENDING. A sample is never split: one that is larger than an
  /// archive may be has one of its own.
  void Add(TimeNs t_ns, const std::vector<SamplePart>& parts);
  /// Whether the sample of this time is in such an archive. Samples come in order of time.
  bool Has(TimeNs t_ns) const { return last_ns_ && t_ns <= *last_ns_; }
  void Commit();
  /// What was committed.
  const SensorArchives& archives() const { return archives_; }

 private:
  std::string FileName() const;
  void CommitShard();
  void AddEnding(const std::string& ending);
  /// Counts an archive of these files in; false where they are not named as samples are.
  bool TakeArchive(const std::vector<std::string>& names);

  std::filesystem::path folder_;
  std::int64_t most_bytes_;
  SensorArchives archives_;
  std::unique_ptr<TarWriter> shard_;
  std::int64_t samples_ = 0;       ///< in the shard that is open
  std::optional<TimeNs> last_ns_;  ///< of the archives that were there
};

}  // namespace tera
