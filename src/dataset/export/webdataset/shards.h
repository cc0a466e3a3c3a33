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

/// A part of a sample: the ending of its file's name, "rgb.png", and its bytes.
struct SamplePart {
  std::string ending, bytes;
};

/// Writes samples of one sensor to tar archives of similar size, NAME-000000.tar and on, and their
/// list in WIDS format, NAME.json. Memory holds one sample.
///
/// Source  "The WebDataset Format"; `wids` of the same project.
class Shards {
 public:
  /// NAME is the sensor's FlatName. Complete archives of a stopped export are reused.
  Shards(const std::filesystem::path& folder, const std::string& sensor, std::int64_t most_bytes);

  /// Parts are NAME/<t_ns in 20 digits>.ENDING. A sample is never split: one that exceeds the
  /// archive size gets its own archive. Samples of several recordings in one set of archives have
  /// the `episode` before their time, NAME/000012_<t_ns>.ENDING; such archives are not reused.
  void Add(TimeNs t_ns, const std::vector<SamplePart>& parts, const std::string& episode = "");
  /// Whether a reused archive has the sample of this time. Samples come in order of time.
  bool Has(TimeNs t_ns) const { return last_ns_ && t_ns <= *last_ns_; }
  void Commit();
  /// The committed archives.
  const SensorArchives& archives() const { return archives_; }

 private:
  std::string FileName() const;
  void CommitShard();
  void AddEnding(const std::string& ending);
  /// Adds an existing archive with these files; false if they are not named as samples.
  bool TakeArchive(const std::vector<std::string>& names);

  std::filesystem::path folder_;
  std::int64_t most_bytes_;
  SensorArchives archives_;
  std::unique_ptr<TarWriter> shard_;
  std::int64_t samples_ = 0;       ///< in the open shard
  std::optional<TimeNs> last_ns_;  ///< last sample in the reused archives
};

}  // namespace tera
