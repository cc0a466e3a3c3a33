#include "dataset/export/bag/mcap_writer.h"

#include <libdeflate.h>

#include <algorithm>

#include "core/check.h"
#include "dataset/export/bag/bag_metadata.h"
#include "dataset/export/bag/little_endian.h"
#include "dataset/format/dataset_description.h"
#include "dataset/ros/message_definitions.h"

namespace tera {
namespace {

constexpr std::string_view kMagic{"\x89MCAP0\r\n", 8};

enum Opcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0B,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F
};

/// Opcode and length, which precede the content of a record.
std::string RecordHead(std::uint8_t opcode, std::size_t content_bytes) {
  std::string head;
  AppendNumber(opcode, &head);
  AppendNumber(static_cast<std::uint64_t>(content_bytes), &head);
  return head;
}

std::string RecordBytes(std::uint8_t opcode, std::string_view content) {
  std::string record = RecordHead(opcode, content.size());
  record.append(content);
  return record;
}

std::uint32_t Crc(std::uint32_t crc, std::string_view bytes) {
  return libdeflate_crc32(crc, bytes.data(), bytes.size());
}

/// Appends a map: its length in bytes, then its entries.
void AppendMap(const std::string& entries, std::string* bytes) { AppendText(entries, bytes); }

}  // namespace

void McapWriter::TimeSpan::Include(std::uint64_t t_ns) {
  first_ns = empty ? t_ns : std::min(first_ns, t_ns);
  last_ns = empty ? t_ns : std::max(last_ns, t_ns);
  empty = false;
}

McapWriter::McapWriter(const std::filesystem::path& file, BagCompression compression, int threads)
    : file_(file),
      compression_(compression),
      packing_(threads, [this](const Chunk& chunk) { AppendChunk(chunk); }) {
  Append(kMagic);
  std::string header;
  AppendText("ros2", &header);
  AppendText("tera " + std::string(TeraVersion()), &header);
  AppendRecord(kHeader, header);
}

void McapWriter::Append(std::string_view bytes) {
  file_.Append(bytes);
  crc_ = Crc(crc_, bytes);
}

void McapWriter::AppendRecord(std::uint8_t opcode, std::string_view content) {
  Append(RecordBytes(opcode, content));
}

std::size_t McapWriter::AddTopic(const Topic& topic) {
  TERA_CHECK(!defined_);
  const auto next_schema = static_cast<std::uint16_t>(schemas_.size() + 1);  // 0: no schema
  const auto [schema, is_new] = schemas_.emplace(topic.type, next_schema);
  if (is_new) {
    std::string content;
    AppendNumber(schema->second, &content);
    AppendText(ros::FullTypeName(topic.type, form()), &content);
    AppendText("ros2msg", &content);
    AppendText(ros::FullDefinition(topic.type, form()), &content);
    schema_records_ += RecordBytes(kSchema, content);
  }
  std::string metadata;
  AppendText("offered_qos_profiles", &metadata);
  AppendText(QosProfiles(topic.quality), &metadata);
  std::string content;
  AppendNumber(static_cast<std::uint16_t>(messages_.size()), &content);
  AppendNumber(schema->second, &content);
  AppendText(topic.name, &content);
  AppendText("cdr", &content);
  AppendMap(metadata, &content);
  channel_records_ += RecordBytes(kChannel, content);
  messages_.push_back(0);
  return messages_.size() - 1;
}

void McapWriter::Write(std::size_t topic, TimeNs t_ns, std::string_view message) {
  TERA_CHECK(t_ns >= 0, t_ns);
  if (!defined_) chunk_.records = schema_records_ + channel_records_;
  defined_ = true;
  const auto id = static_cast<std::uint16_t>(topic);
  const auto log_ns = static_cast<std::uint64_t>(t_ns);
  std::string& records = chunk_.records;
  chunk_.places[id].emplace_back(log_ns, records.size());
  // The message is copied once, directly into the chunk.
  constexpr std::uint64_t kFieldBytes = 2 + 4 + 8 + 8;
  AppendNumber(static_cast<std::uint8_t>(kMessage), &records);
  AppendNumber(kFieldBytes + message.size(), &records);
  AppendNumber(id, &records);
  AppendNumber(static_cast<std::uint32_t>(messages_.at(topic)), &records);
  AppendNumber(log_ns, &records);
  AppendNumber(log_ns, &records);  // publish time
  records.append(message);
  ++messages_[topic];
  chunk_.span.Include(log_ns);
  span_.Include(log_ns);
  if (records.size() >= kChunkBytes) EndChunk();
}

void McapWriter::EndChunk() {
  if (chunk_.records.empty()) return;
  packing_.Give([compression = compression_, chunk = std::move(chunk_)]() mutable {
    chunk.crc = Crc(0, chunk.records);
    if (compression != BagCompression::kNone) {
      chunk.packed = Compressed(compression, chunk.records);
    }
    return std::move(chunk);
  });
  chunk_ = {};
}

void McapWriter::AppendChunk(const Chunk& chunk) {
  const std::string& packed = compression_ == BagCompression::kNone ? chunk.records : chunk.packed;
  ChunkEntry entry;
  entry.first_ns = chunk.span.first_ns;
  entry.last_ns = chunk.span.last_ns;
  entry.offset = static_cast<std::uint64_t>(file_.bytes());
  entry.packed_bytes = packed.size();
  entry.bytes = chunk.records.size();
  std::string content;
  AppendNumber(entry.first_ns, &content);
  AppendNumber(entry.last_ns, &content);
  AppendNumber(entry.bytes, &content);
  AppendNumber(chunk.crc, &content);
  AppendText(NameOf(compression_), &content);
  AppendNumber(entry.packed_bytes, &content);
  // Written in pieces to avoid a copy of the large last piece.
  Append(RecordHead(kChunk, content.size() + packed.size()));
  Append(content);
  Append(packed);
  const auto after_chunk = static_cast<std::uint64_t>(file_.bytes());
  entry.length = after_chunk - entry.offset;
  for (const auto& [id, places] : chunk.places) {
    entry.index_offsets[id] = static_cast<std::uint64_t>(file_.bytes());
    std::string entries, index;
    for (const auto& [t_ns, offset] : places) {
      AppendNumber(t_ns, &entries);
      AppendNumber(offset, &entries);
    }
    AppendNumber(id, &index);
    AppendMap(entries, &index);
    AppendRecord(kMessageIndex, index);
  }
  entry.index_length = static_cast<std::uint64_t>(file_.bytes()) - after_chunk;
  chunks_.push_back(std::move(entry));
}

std::string McapWriter::Statistics() const {
  std::uint64_t messages = 0;
  std::string counts, content;
  for (std::size_t c = 0; c < messages_.size(); ++c) {
    messages += messages_[c];
    AppendNumber(static_cast<std::uint16_t>(c), &counts);
    AppendNumber(messages_[c], &counts);
  }
  AppendNumber(messages, &content);
  AppendNumber(static_cast<std::uint16_t>(schemas_.size()), &content);
  AppendNumber(static_cast<std::uint32_t>(messages_.size()), &content);
  AppendNumber(std::uint32_t{0}, &content);  // attachments
  AppendNumber(std::uint32_t{0}, &content);  // metadata
  AppendNumber(static_cast<std::uint32_t>(chunks_.size()), &content);
  AppendNumber(span_.first_ns, &content);
  AppendNumber(span_.last_ns, &content);
  AppendMap(counts, &content);
  return content;
}

std::string McapWriter::ChunkIndex(const ChunkEntry& chunk) const {
  std::string offsets, content;
  for (const auto& [channel, offset] : chunk.index_offsets) {
    AppendNumber(channel, &offsets);
    AppendNumber(offset, &offsets);
  }
  AppendNumber(chunk.first_ns, &content);
  AppendNumber(chunk.last_ns, &content);
  AppendNumber(chunk.offset, &content);
  AppendNumber(chunk.length, &content);
  AppendMap(offsets, &content);
  AppendNumber(chunk.index_length, &content);
  AppendText(NameOf(compression_), &content);
  AppendNumber(chunk.packed_bytes, &content);
  AppendNumber(chunk.bytes, &content);
  return content;
}

void McapWriter::WriteSummary() {
  const auto summary_start = static_cast<std::uint64_t>(file_.bytes());
  crc_ = 0;
  std::string offsets;
  const auto write_group = [&](std::uint8_t opcode, std::string_view records) {
    if (records.empty()) return;
    std::string content;
    AppendNumber(opcode, &content);
    AppendNumber(static_cast<std::uint64_t>(file_.bytes()), &content);
    AppendNumber(static_cast<std::uint64_t>(records.size()), &content);
    offsets += RecordBytes(kSummaryOffset, content);
    Append(records);
  };
  write_group(kSchema, schema_records_);
  write_group(kChannel, channel_records_);
  write_group(kStatistics, RecordBytes(kStatistics, Statistics()));
  std::string chunk_indexes;
  for (const ChunkEntry& chunk : chunks_)
    chunk_indexes += RecordBytes(kChunkIndex, ChunkIndex(chunk));
  write_group(kChunkIndex, chunk_indexes);
  const auto offset_start = static_cast<std::uint64_t>(file_.bytes());
  Append(offsets);
  // The CRC of the summary covers the footer up to the CRC field.
  constexpr std::uint64_t kFooterBytes = 8 + 8 + 4;
  std::string footer;
  AppendNumber(static_cast<std::uint8_t>(kFooter), &footer);
  AppendNumber(kFooterBytes, &footer);
  AppendNumber(summary_start, &footer);
  AppendNumber(offset_start, &footer);
  Append(footer);
  std::string crc;
  AppendNumber(crc_, &crc);
  Append(crc);
}

void McapWriter::Finish() {
  EndChunk();
  packing_.Finish();
  std::string data_end;
  AppendNumber(crc_, &data_end);
  AppendRecord(kDataEnd, data_end);
  WriteSummary();
  Append(kMagic);
  file_.Commit();
}

}  // namespace tera
