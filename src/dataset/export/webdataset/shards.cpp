#include "dataset/export/webdataset/shards.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/parse_number.h"
#include "dataset/export/sensor_names.h"
#include "dataset/export/webdataset/tar_names.h"

namespace tera {

Shards::Shards(const std::filesystem::path& folder, const std::string& sensor,
               std::int64_t most_bytes)
    : folder_(folder), most_bytes_(most_bytes), archives_{sensor, FlatName(sensor), {}, {}} {
  while (const auto names = NamesInTar(folder_ / FileName())) {
    if (!TakeArchive(*names)) return;
  }
}

void Shards::AddEnding(const std::string& ending) {
  std::vector<std::string>& endings = archives_.endings;
  if (std::find(endings.begin(), endings.end(), ending) == endings.end()) {
    endings.push_back(ending);
  }
}

bool Shards::TakeArchive(const std::vector<std::string>& names) {
  std::vector<TimeNs> times_ns;
  for (const std::string& name : names) {
    const std::size_t point = name.find('.');
    const auto t_ns = ParseNumber<TimeNs>(std::string_view(name).substr(0, point));
    if (!t_ns || point == std::string::npos) return false;
    times_ns.push_back(*t_ns);
  }
  std::int64_t samples = 0;
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (last_ns_ != times_ns[k]) ++samples;
    last_ns_ = times_ns[k];
    AddEnding(names[k].substr(names[k].find('.') + 1));
  }
  const auto bytes = static_cast<std::int64_t>(std::filesystem::file_size(folder_ / FileName()));
  archives_.archives.push_back({FileName(), samples, bytes});
  return true;
}

std::string Shards::FileName() const {
  return fmt::format("{}-{:06}.tar", archives_.name, archives_.archives.size());
}

void Shards::Add(TimeNs t_ns, const std::vector<SamplePart>& parts, const std::string& episode) {
  std::int64_t bytes = 0;
  for (const SamplePart& part : parts) bytes += TarWriter::SpaceOf(part.bytes.size());
  if (shard_ && shard_->bytes() + bytes > most_bytes_) CommitShard();
  if (!shard_) shard_ = std::make_unique<TarWriter>(folder_ / FileName());
  for (const SamplePart& part : parts) {
    shard_->Add(archives_.name, fmt::format("{}{:020}.{}", episode, t_ns, part.ending), part.bytes);
  }
  ++samples_;
  for (const SamplePart& part : parts) AddEnding(part.ending);
}

void Shards::CommitShard() {
  if (!shard_) return;
  archives_.archives.push_back({FileName(), samples_, shard_->bytes()});
  shard_->Commit();
  shard_.reset();
  samples_ = 0;
}

void Shards::Commit() {
  CommitShard();
  OrderedJson list = OrderedJson::array();
  for (const SensorArchives::Archive& archive : archives_.archives) {
    list.push_back(
        {{"url", archive.file}, {"nsamples", archive.samples}, {"filesize", archive.bytes}});
  }
  const OrderedJson index = {{"__kind__", "wids-shard-index-v1"},
                             {"wids_version", 1},
                             {"name", archives_.name},
                             {"shardlist", list}};
  WriteWholeFile(folder_ / (archives_.name + ".json"), index.dump(1) + "\n");
}

}  // namespace tera
