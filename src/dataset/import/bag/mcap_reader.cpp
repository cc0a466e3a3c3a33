#include <fmt/format.h>
#include <zlib.h>

#include <limits>
#include <map>
#include <optional>
#include <set>

#include "dataset/import/bag/bag_file.h"
#include "dataset/import/bag/bag_source.h"
#include "dataset/import/bag/unpack.h"

// Source  "MCAP file format specification", mcap.dev, version 0.

namespace tera {
namespace {

constexpr std::string_view kMagic{"\x89MCAP0\r\n", 8};
constexpr std::uint64_t kRecordHeadBytes = 1 + 8;

enum Opcode : std::uint8_t {
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06
};

class McapReader {
 public:
  McapReader(const std::filesystem::path& file, BagVisitor* visitor)
      : file_(file), visitor_(visitor) {}

  bool Read() {
    std::uint64_t at = 0;
    try {
      if (file_.Read(0, kMagic.size()) != kMagic)
        throw BadBytes{"the file does not begin with the magic bytes of MCAP"};
      at = kMagic.size();
      while (true) {
        ByteCursor head(HeadAt(at));
        const auto opcode = head.Number<std::uint8_t>();
        const auto length = head.Number<std::uint64_t>();
        file_.Require(at + kRecordHeadBytes, length);
        if (!TakeRecordAt(opcode, at + kRecordHeadBytes, length)) return false;
        at += kRecordHeadBytes + length;
        if (opcode == kFooter) break;
      }
      if (file_.Read(at, kMagic.size()) != kMagic)
        throw BadBytes{"the file does not end with the magic bytes of MCAP"};
      return true;
    } catch (const BadBytes& bad) {
      throw BagDamage(fmt::format(
          "{0}: byte {1}: {2}; need a complete MCAP file: copy it again, repair it with 'mcap "
          "recover {0} -o whole.mcap', or read the part before with --skip-bad-rows",
          file_.path().string(), at, bad.finding));
    }
  }

 private:
  struct Schema {
    std::string type, encoding, definition;
  };

  std::string_view HeadAt(std::uint64_t at) {
    if (at == file_.size()) {
      throw BadBytes{
          "the file ends without its footer and index, as after a crash of the recorder"};
    }
    head_ = file_.Read(at, kRecordHeadBytes);
    return head_;
  }

  /// Reads only the start of a record, because messages of unwanted topics may be large.
  bool TakeRecordAt(std::uint8_t opcode, std::uint64_t at, std::uint64_t length) {
    if (opcode == kMessage) {
      ByteCursor id(record_ = file_.Read(at, std::min<std::uint64_t>(length, 2)));
      if (!IsWanted(id.Number<std::uint16_t>())) return true;
    } else if (opcode != kSchema && opcode != kChannel && opcode != kChunk) {
      return true;
    }
    record_ = file_.Read(at, length);
    return opcode == kChunk ? TakeChunk(ByteCursor(record_))
                            : TakeRecord(opcode, ByteCursor(record_));
  }

  bool TakeChunk(ByteCursor chunk) {
    chunk.Number<std::uint64_t>();  // first and last time
    chunk.Number<std::uint64_t>();
    const auto size = chunk.Number<std::uint64_t>();
    const auto crc = chunk.Number<std::uint32_t>();
    const std::string_view compression = chunk.Text();
    const std::string_view packed = chunk.Bytes(chunk.Number<std::uint64_t>());
    std::string_view bytes = packed;
    if (compression == "zstd") {
      bytes = chunk_ = UnpackedZstd(packed, size);
    } else if (compression == "lz4") {
      bytes = chunk_ = UnpackedLz4(packed, size);
    } else if (!compression.empty()) {
      throw BadBytes{
          fmt::format("a chunk is compressed by '{}', need zstd, lz4 or none", compression)};
    } else if (packed.size() != size) {
      throw BadBytes{fmt::format("a chunk declares {} bytes and has {}", size, packed.size())};
    }
    RequireCrc(bytes, crc);
    ByteCursor records(bytes);
    while (records.remaining() > 0) {
      const auto opcode = records.Number<std::uint8_t>();
      const std::string_view content = records.Bytes(records.Number<std::uint64_t>());
      if (!TakeRecord(opcode, ByteCursor(content))) return false;
    }
    return true;
  }

  static void RequireCrc(std::string_view bytes, std::uint32_t crc) {
    if (crc == 0) return;  // the writer did not compute it
    const auto found = crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
    if (found == crc) return;
    throw BadBytes{"the checksum of a chunk does not match its bytes"};
  }

  bool TakeRecord(std::uint8_t opcode, ByteCursor record) {
    if (opcode == kSchema) TakeSchema(record);
    if (opcode == kChannel) return TakeChannel(record);
    if (opcode == kMessage) return TakeMessage(record);
    return true;
  }

  void TakeSchema(ByteCursor record) {
    const auto id = record.Number<std::uint16_t>();
    Schema schema{ShortTypeName(record.Text()), std::string(record.Text()),
                  std::string(record.Text())};
    schemas_.emplace(id, std::move(schema));
  }

  bool TakeChannel(ByteCursor record) {
    const auto id = record.Number<std::uint16_t>();
    const auto schema_id = record.Number<std::uint16_t>();
    if (channels_.contains(id)) return true;  // the summary repeats the channels
    BagTopic topic{.name = std::string(record.Text())};
    topic.message_encoding = record.Text();
    const auto schema = schemas_.find(schema_id);
    if (schema_id != 0 && schema == schemas_.end()) {
      throw BadBytes{fmt::format("topic {} refers to schema {}, which the file has not declared",
                                 topic.name, schema_id)};
    }
    if (schema_id != 0) {
      topic.type = schema->second.type;
      topic.schema_encoding = schema->second.encoding;
      topic.definition = schema->second.definition;
    }
    const BagVisitor::Wish wish = visitor_->Wants(topic);
    channels_[id] = Channel{asked_++, wish == BagVisitor::Wish::kTake};
    return wish != BagVisitor::Wish::kEnough;
  }

  bool IsWanted(std::uint16_t id) const {
    const auto channel = channels_.find(id);
    if (channel == channels_.end()) {
      throw BadBytes{
          fmt::format("a message refers to channel {}, which the file has not declared", id)};
    }
    return channel->second.wanted;
  }

  bool TakeMessage(ByteCursor record) {
    const auto id = record.Number<std::uint16_t>();
    if (!IsWanted(id)) return true;
    record.Number<std::uint32_t>();  // sequence
    const auto log_ns = record.Number<std::uint64_t>();
    record.Number<std::uint64_t>();  // time of publication
    if (log_ns > static_cast<std::uint64_t>(std::numeric_limits<TimeNs>::max())) {
      throw BadBytes{fmt::format("a message's time is {} ns", log_ns)};
    }
    return visitor_->Take(channels_[id].number,
                          {static_cast<TimeNs>(log_ns), record.Bytes(record.remaining())});
  }

  struct Channel {
    std::size_t number = 0;  ///< index of the topic for BagVisitor::Take
    bool wanted = false;
  };

  BagFile file_;
  BagVisitor* visitor_;
  std::map<std::uint16_t, Schema> schemas_;
  std::map<std::uint16_t, Channel> channels_;
  std::size_t asked_ = 0;
  std::string head_, record_, chunk_;
};

}  // namespace

bool ReadMcapFile(const std::filesystem::path& file, BagVisitor* visitor) {
  return McapReader(file, visitor).Read();
}

}  // namespace tera
