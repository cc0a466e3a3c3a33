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

/// Writes an MCAP file of profile `ros2`. Messages are in compressed chunks, each with an index.
/// The summary at the end holds schemas, channels, statistics, chunk indexes and offsets.
///
/// Model   A chunk is complete at kChunkBytes. A worker thread compresses it while the next chunks
///         are filled. Memory holds up to two such chunks per thread, and about 40 bytes of index
///         per written chunk. Each chunk, the data section and the summary have a CRC-32.
/// Source  "MCAP file format specification", mcap.dev, version 0.
class McapWriter : public BagWriter {
 public:
  /// Throws InputError if the file cannot be written, like every other function of the class.
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
  /// Times of the first and the last message of a set.
  struct TimeSpan {
    std::uint64_t first_ns = 0, last_ns = 0;
    bool empty = true;
    void Include(std::uint64_t t_ns);
  };
  /// A chunk and its messages.
  struct Chunk {
    std::string records;
    TimeSpan span;
    /// Time and offset of each message, by channel.
    std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>> places;
    // The CRC and the compressed records are set when the chunk is complete.
    std::uint32_t crc = 0;
    std::string packed;  ///< compressed records; empty without compression
  };

  void Append(std::string_view bytes);
  void AppendRecord(std::uint8_t opcode, std::string_view content);
  /// Starts the compression of the current chunk.
  void EndChunk();
  /// Appends a chunk and its message index to the file.
  void AppendChunk(const Chunk& chunk);
  void WriteSummary();
  std::string Statistics() const;
  std::string ChunkIndex(const ChunkEntry& chunk) const;

  CheckedFile file_;
  BagCompression compression_;
  std::uint32_t crc_ = 0;  ///< running CRC-32 since the start of the file, or of the summary
  std::map<std::string_view, std::uint16_t> schemas_;
  std::string schema_records_, channel_records_;
  std::vector<std::uint64_t> messages_;  ///< message count by channel
  Chunk chunk_;                          ///< chunk being filled
  TimeSpan span_;
  std::vector<ChunkEntry> chunks_;
  bool defined_ = false;    ///< schemas and channels are written, in the first chunk
  InOrder<Chunk> packing_;  ///< complete chunks being compressed
};

}  // namespace tera
