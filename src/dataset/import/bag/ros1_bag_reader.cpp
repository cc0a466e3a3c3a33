#include <fmt/format.h>

#include <map>
#include <optional>

#include "dataset/import/bag/bag_file.h"
#include "dataset/import/bag/bag_source.h"
#include "dataset/import/bag/unpack.h"

// Source  "Bags/Format/2.0" of the ROS 1 wiki.

namespace tera {
namespace {

constexpr std::string_view kFirstLine = "#ROSBAG V2.0\n";
constexpr std::uint64_t kLengthBytes = 4;

enum Operation : std::uint8_t {
  kMessageRecord = 0x02,
  kBagHeader = 0x03,
  kChunkRecord = 0x05,
  kChunkInfo = 0x06,
  kConnection = 0x07
};

/// Fields of a record header. Each is a length and "name=value".
class Fields {
 public:
  explicit Fields(std::string_view bytes) {
    ByteCursor cursor(bytes);
    while (cursor.remaining() > 0) {
      const std::string_view field = cursor.Text();
      const std::size_t equals = field.find('=');
      if (equals == std::string_view::npos) throw BadBytes{"a header's field has no '='"};
      fields_[std::string(field.substr(0, equals))] = field.substr(equals + 1);
    }
  }

  std::string_view Text(const std::string& name) const {
    const auto found = fields_.find(name);
    if (found == fields_.end()) throw BadBytes{fmt::format("a header lacks '{}'", name)};
    return found->second;
  }
  template <typename T>
  T Number(const std::string& name) const {
    ByteCursor cursor(Text(name));
    const T value = cursor.Number<T>();
    if (cursor.remaining() > 0) throw BadBytes{fmt::format("a header's '{}' is too long", name)};
    return value;
  }
  TimeNs Time(const std::string& name) const {
    ByteCursor cursor(Text(name));
    const TimeNs seconds = cursor.Number<std::uint32_t>();
    return seconds * kNsPerSecond + cursor.Number<std::uint32_t>();
  }

 private:
  std::map<std::string, std::string_view> fields_;
};

class Ros1BagReader {
 public:
  Ros1BagReader(const std::filesystem::path& file, BagVisitor* visitor)
      : file_(file), visitor_(visitor) {}

  bool Read() {
    std::uint64_t at = 0;
    try {
      if (file_.Read(0, kFirstLine.size()) != kFirstLine) {
        throw BadBytes{"the file does not begin with the line of a ROS 1 bag of format 2.0"};
      }
      for (at = kFirstLine.size(); at < file_.size();) {
        const std::string header = file_.Read(at + kLengthBytes, LengthAt(at));
        const std::uint64_t data_at = at + kLengthBytes + header.size();
        const std::uint64_t data_bytes = LengthAt(data_at);
        file_.Require(data_at + kLengthBytes, data_bytes);
        if (!TakeRecordAt(Fields(header), data_at + kLengthBytes, data_bytes)) return false;
        at = data_at + kLengthBytes + data_bytes;
      }
      RequireEnd();
      return true;
    } catch (const BadBytes& bad) {
      throw BagDamage(
          fmt::format("{0}: byte {1}: {2}; need a complete bag: copy it again, repair it with "
                      "'rosbag reindex {0}', or read the part before with --skip-bad-rows",
                      file_.path().string(), at, bad.finding));
    }
  }

 private:
  struct Connection {
    std::size_t number = 0;  ///< index of the topic for BagVisitor::Take
    bool wanted = false;
  };

  std::uint64_t LengthAt(std::uint64_t at) {
    const std::string bytes = file_.Read(at, kLengthBytes);
    return ByteCursor(bytes).Number<std::uint32_t>();
  }

  void RequireEnd() const {
    if (!chunk_count_) throw BadBytes{"the bag has no header"};
    if (index_position_ == 0)
      throw BadBytes{
          "the bag was not closed and has no index, as after a crash of the recorder "
          "(.bag.active)"};
    if (chunks_ != *chunk_count_ || chunk_infos_ != *chunk_count_) {
      throw BadBytes{
          fmt::format("the file ends after {} chunks and the index of {}, its header "
                      "declares {}",
                      chunks_, chunk_infos_, *chunk_count_)};
    }
  }

  bool TakeRecordAt(const Fields& header, std::uint64_t at, std::uint64_t bytes) {
    const auto operation = header.Number<std::uint8_t>("op");
    switch (operation) {
      case kBagHeader:
        index_position_ = header.Number<std::uint64_t>("index_pos");
        chunk_count_ = header.Number<std::uint32_t>("chunk_count");
        return true;
      case kChunkInfo:
        ++chunk_infos_;
        return true;
      case kChunkRecord:
        ++chunks_;
        return TakeChunk(header, file_.Read(at, bytes));
      case kConnection:
      case kMessageRecord:
        return TakeRecord(header, file_.Read(at, bytes));
      default:
        return true;
    }
  }

  bool TakeChunk(const Fields& header, const std::string& packed) {
    const std::string_view compression = header.Text("compression");
    const auto size = header.Number<std::uint32_t>("size");
    std::string unpacked;
    if (compression == "lz4") {
      unpacked = UnpackedLz4(packed, size);
    } else if (compression == "bz2") {
      unpacked = UnpackedBzip2(packed, size);
    } else if (compression != "none") {
      throw BadBytes{
          fmt::format("a chunk is compressed by '{}', need none, lz4 or bz2", compression)};
    }
    ByteCursor records(compression == "none" ? packed : unpacked);
    while (records.remaining() > 0) {
      const std::string_view fields = records.Text();
      if (!TakeRecord(Fields(fields), records.Text())) return false;
    }
    return true;
  }

  bool TakeRecord(const Fields& header, std::string_view data) {
    const auto operation = header.Number<std::uint8_t>("op");
    if (operation == kConnection) return TakeConnection(header, data);
    if (operation != kMessageRecord) return true;
    const auto id = header.Number<std::uint32_t>("conn");
    const auto connection = connections_.find(id);
    if (connection == connections_.end()) {
      throw BadBytes{
          fmt::format("a message refers to connection {}, which the bag has not declared", id)};
    }
    if (!connection->second.wanted) return true;
    return visitor_->Take(connection->second.number, {header.Time("time"), data});
  }

  bool TakeConnection(const Fields& header, std::string_view data) {
    const auto id = header.Number<std::uint32_t>("conn");
    if (connections_.contains(id)) return true;  // the index repeats the connections
    const Fields fields(data);
    const BagVisitor::Wish wish =
        visitor_->Wants({.name = std::string(header.Text("topic")),
                         .type = ShortTypeName(fields.Text("type")),
                         .message_encoding = "ros1",
                         .schema_encoding = "ros1msg",
                         .definition = std::string(fields.Text("message_definition"))});
    connections_[id] = Connection{asked_++, wish == BagVisitor::Wish::kTake};
    return wish != BagVisitor::Wish::kEnough;
  }

  BagFile file_;
  BagVisitor* visitor_;
  std::map<std::uint32_t, Connection> connections_;
  std::size_t asked_ = 0;
  std::uint64_t index_position_ = 0;
  std::optional<std::uint32_t> chunk_count_;
  std::uint32_t chunks_ = 0, chunk_infos_ = 0;
};

}  // namespace

bool ReadRos1BagFile(const std::filesystem::path& file, BagVisitor* visitor) {
  return Ros1BagReader(file, visitor).Read();
}

}  // namespace tera
