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

/// One file of a sample: the ending of its name, such as "rgb.png", and its bytes.
struct SamplePart {
  std::string ending, bytes;
};

/// Writes samples of one sensor to tar archives (shards) of similar size, NAME-000000.tar onwards.
/// NAME.json lists them in WIDS format. Memory holds one sample.
///
/// Source  "The WebDataset Format"; `wids` of the same project.
class Shards {
 public:
  /// NAME is the FlatName of the sensor. Complete archives left by a stopped export are reused.
  Shards(const std::filesystem::path& folder, const std::string& sensor, std::int64_t most_bytes);

  /// Adds the files NAME/<t_ns in 20 digits>.ENDING. A sample is never split; a sample larger than
  /// the archive size gets its own archive. If several recordings share the archives, names contain
  /// the `episode`: NAME/000012_<t_ns>.ENDING. Shared archives are not reused after a stop.
  void Add(TimeNs t_ns, const std::vector<SamplePart>& parts, const std::string& episode = "");
  /// True if a reused archive contains the sample at `t_ns`. Samples are added in order of time.
  bool Has(TimeNs t_ns) const { return last_ns_ && t_ns <= *last_ns_; }
  void Commit();
  const SensorArchives& archives() const { return archives_; }

 private:
  std::string FileName() const;
  void CommitShard();
  void AddEnding(const std::string& ending);
  /// Reuses an existing archive that contains `names`. Returns false if these are not names of
  /// samples.
  bool TakeArchive(const std::vector<std::string>& names);

  std::filesystem::path folder_;
  std::int64_t most_bytes_;
  SensorArchives archives_;
  std::unique_ptr<TarWriter> shard_;
  std::int64_t samples_ = 0;       ///< samples in the open archive
  std::optional<TimeNs> last_ns_;  ///< time of the last sample in the reused archives
};

}  // namespace tera
