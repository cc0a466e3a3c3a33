#include "dataset/export/webdataset/shards.h"

#include <fmt/format.h>

#include <utility>

namespace tera {

Shards::Shards(const std::filesystem::path& folder, std::string name, std::int64_t most_bytes)
    : folder_(folder), name_(std::move(name)), most_bytes_(most_bytes) {}

std::string Shards::FileName() const { return fmt::format("{}-{:06}.tar", name_, shards_); }

void Shards::Add(TimeNs t_ns, const std::vector<SamplePart>& parts) {
  std::int64_t bytes = 0;
  for (const SamplePart& part : parts) bytes += static_cast<std::int64_t>(part.bytes.size());
  if (shard_ && shard_->bytes() + bytes > most_bytes_) CommitShard();
  if (!shard_) shard_ = std::make_unique<TarWriter>(folder_ / FileName());
  for (const SamplePart& part : parts) {
    shard_->Add(name_, fmt::format("{:020}.{}", t_ns, part.ending), part.bytes);
  }
  ++samples_;
}

void Shards::CommitShard() {
  if (!shard_) return;
  list_.push_back({{"url", FileName()}, {"nsamples", samples_}, {"filesize", shard_->bytes()}});
  shard_->Commit();
  shard_.reset();
  ++shards_;
  samples_ = 0;
}

void Shards::Commit() {
  CommitShard();
  const OrderedJson index = {{"__kind__", "wids-shard-index-v1"},
                             {"wids_version", 1},
                             {"name", name_},
                             {"shardlist", list_}};
  WriteWholeFile(folder_ / (name_ + ".json"), index.dump(1) + "\n");
}

}  // namespace tera
