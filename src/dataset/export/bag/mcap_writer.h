#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dataset/export/bag/bag_writer.h"
#include "dataset/export/bag/compression.h"
#include "dataset/files/checked_file.h"
#include "dataset/files/in_order.h"

namespace tera {

/// Writes an MCAP file of profile `ros2`: messages in compressed chunks, each with an index, and a
/// summary at the end. The summary has schemas, channels, statistics, the chunk index and offsets.
///
/// Model   a chunk ends at kChunkBytes and is compressed on another thread while the next ones
///         fill. Memory holds these chunks, two per thread, and about 40 bytes of index for each
///         earlier one. CRC-32 of each chunk, of the data and of the summary.
/// Source  "MCAP file format specification", mcap.dev, version 0.
class McapWriter : public BagWriter {
 public:
  /// Throws InputError if the file cannot be written, as every call does.
  McapWriter(const std::filesystem::path& file, BagCompression compression, int threads);

  ros::WireForm form() const override { return ros::WireForm::kCdr; }
  std::size_t AddTopic(const Topic& topic) override;
  void Write(std::size_t topic, TimeNs t_ns, std::string_view message) override;
  void Finish() override;

  static constexpr std::size_t kChunkBytes = 4 * 1024 * 1024;

 private:
  struct ChunkEntry {
    std::uint64_t first_ns = 0, last_ns = 0, offset = 0, length = 0;
    std::map<std::uint16_t, std::uint64_t> index_offsets;
    std::uint64_t index_length = 0, packed_bytes = 0, bytes = 0;
  };
  /// First and last time of a set of messages.
  struct TimeSpan {
    std::uint64_t first_ns = 0, last_ns = 0;
    bool empty = true;
    void Include(std::uint64_t t_ns);
  };
  /// Messages of one chunk.
  struct Chunk {
    std::string records;
    TimeSpan span;
    /// Time and offset of each message, by channel.
    std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>> places;
    // Set when the chunk ends.
    std::uint32_t crc = 0;
    std::string packed;  ///< the compressed records, if compressed
  };

  void Append(std::string_view bytes);
  void AppendRecord(std::uint8_t opcode, std::string_view content);
  /// Starts the compression of the full chunk.
  void EndChunk();
  /// Appends the chunk and its index.
  void AppendChunk(const Chunk& chunk);
  void WriteSummary();
  std::string Statistics() const;
  std::string ChunkIndex(const ChunkEntry& chunk) const;

  CheckedFile file_;
  BagCompression compression_;
  std::uint32_t crc_ = 0;  ///< since the start of the file or of the summary
  std::map<std::string_view, std::uint16_t> schemas_;
  std::string schema_records_, channel_records_;
  std::vector<std::uint64_t> messages_;  ///< count per channel so far
  Chunk chunk_;                          ///< current chunk
  TimeSpan span_;
  std::vector<ChunkEntry> chunks_;
  bool defined_ = false;    ///< the first chunk has the schemas and channels
  InOrder<Chunk> packing_;  ///< earlier chunks
};

}  // namespace tera
