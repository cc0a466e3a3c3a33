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

/// An MCAP file of profile `ros2`: messages in compressed chunks with an index of each, and at the
/// end schemas, channels, statistics and the index of the chunks, found by offsets.
///
/// Model   a chunk ends when it holds kChunkBytes, and is compressed on another thread while the
///         next ones are filled; only these, two for each thread, and 40 bytes or so of each
///         earlier one for the index, are in memory. CRC-32 of each chunk, of the data and of the
///         summary.
/// Source  "MCAP file format specification", mcap.dev, version 0.
class McapWriter : public BagWriter {
 public:
  /// Throws InputError where the file cannot be written, as every call does.
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
  /// First and last time of some messages.
  struct TimeSpan {
    std::uint64_t first_ns = 0, last_ns = 0;
    bool empty = true;
    void Include(std::uint64_t t_ns);
  };
  /// Messages on their way into the file.
  struct Chunk {
    std::string records;
    TimeSpan span;
    /// By channel: time and place of each message.
    std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>> places;
    // When it has ended.
    std::uint32_t crc = 0;
    std::string packed;  ///< the records compressed, where they are
  };

  void Append(std::string_view bytes);
  void AppendRecord(std::uint8_t opcode, std::string_view content);
  /// Begins to compress the chunk that has been filled.
  void EndChunk();
  /// With its index.
  void AppendChunk(const Chunk& chunk);
  void WriteSummary();
  std::string Statistics() const;
  std::string ChunkIndex(const ChunkEntry& chunk) const;

  CheckedFile file_;
  BagCompression compression_;
  std::uint32_t crc_ = 0;  ///< of everything since the start of the file or of the summary
  std::map<std::string_view, std::uint16_t> schemas_;
  std::string schema_records_, channel_records_;
  std::vector<std::uint64_t> messages_;  ///< by channel, so far
  Chunk chunk_;                          ///< being filled
  TimeSpan span_;
  std::vector<ChunkEntry> chunks_;
  bool defined_ = false;    ///< schemas and channels stand in the first chunk
  InOrder<Chunk> packing_;  ///< the chunks before it
};

}  // namespace tera
