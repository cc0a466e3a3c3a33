#include "dataset/export/bag/ros1_bag_writer.h"

#include "core/check.h"
#include "dataset/export/bag/little_endian.h"
#include "dataset/ros/message_definitions.h"

namespace tera {
namespace {

constexpr std::string_view kFirstLine = "#ROSBAG V2.0\n";
constexpr std::size_t kFirstRecordBytes = 4096;  ///< padded with blanks to this size
constexpr std::size_t kChunkBytes = 768 * 1024;  ///< default of rosbag

enum Operation : std::uint8_t {
  kMessageRecord = 0x02,
  kBagHeader = 0x03,
  kIndex = 0x04,
  kChunkRecord = 0x05,
  kChunkInfo = 0x06,
  kConnection = 0x07
};

/// Fields of a record header. Each field is a length and "name=value".
class Fields {
 public:
  Fields& Text(std::string_view name, std::string_view value) {
    AppendText(std::string(name) + "=" + std::string(value), &bytes_);
    return *this;
  }
  template <typename T>
  Fields& Number(std::string_view name, T value) {
    std::string bytes;
    AppendNumber(value, &bytes);
    return Text(name, bytes);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

std::string TimeBytes(TimeNs t_ns) {
  std::string bytes;
  AppendNumber(static_cast<std::uint32_t>(t_ns / kNsPerSecond), &bytes);
  AppendNumber(static_cast<std::uint32_t>(t_ns % kNsPerSecond), &bytes);
  return bytes;
}

std::string RecordBytes(Operation operation, Fields fields, std::string_view data) {
  fields.Number("op", static_cast<std::uint8_t>(operation));
  std::string bytes;
  AppendText(fields.bytes(), &bytes);
  AppendText(data, &bytes);
  return bytes;
}

}  // namespace

std::size_t Ros1BagWriter::AddTopic(const Topic& topic) {
  Fields data;
  data.Text("topic", topic.name)
      .Text("type", ros::FullTypeName(topic.type, form()))
      .Text("md5sum", ros::Md5Sum(topic.type))
      .Text("message_definition", ros::FullDefinition(topic.type, form()));
  if (topic.quality.latched) data.Text("latching", "1");
  Fields fields;
  fields.Number("conn", topics_).Text("topic", topic.name);
  connections_ += RecordBytes(kConnection, fields, data.bytes());
  return topics_++;
}

void Ros1BagWriter::Append(const std::string& bytes) {
  file_.Append(bytes);
  bytes_ += bytes.size();
}

void Ros1BagWriter::Write(std::size_t topic, TimeNs t_ns, std::string_view message) {
  TERA_CHECK(t_ns >= 0 && topic < topics_, t_ns, topic);
  const auto connection = static_cast<std::uint32_t>(topic);
  if (chunk_.empty()) {
    // Every chunk repeats the connections, so a chunk can be read on its own.
    chunk_ = connections_;
    current_.first_ns = t_ns;
  }
  current_.last_ns = t_ns;
  ++current_.counts[connection];
  std::string& index = index_[connection];
  index += TimeBytes(t_ns);
  AppendNumber(static_cast<std::uint32_t>(chunk_.size()), &index);
  Fields fields;
  fields.Number("conn", connection).Text("time", TimeBytes(t_ns));
  chunk_ += RecordBytes(kMessageRecord, fields, message);
  if (chunk_.size() >= kChunkBytes) EndChunk();
}

void Ros1BagWriter::EndChunk() {
  if (chunk_.empty()) return;
  constexpr std::uint32_t kVersion = 1;
  current_.position = kFirstLine.size() + kFirstRecordBytes + bytes_;
  Fields fields;
  fields.Text("compression", "none").Number("size", static_cast<std::uint32_t>(chunk_.size()));
  Append(RecordBytes(kChunkRecord, fields, chunk_));
  for (const auto& [connection, places] : index_) {
    Fields of_connection;
    of_connection.Number("ver", kVersion)
        .Number("conn", connection)
        .Number("count", current_.counts[connection]);
    Append(RecordBytes(kIndex, of_connection, places));
  }
  chunks_.push_back(current_);
  current_ = {};
  index_.clear();
  chunk_.clear();
}

void Ros1BagWriter::Finish() {
  constexpr std::uint32_t kVersion = 1;
  EndChunk();
  const std::uint64_t connections_at = kFirstLine.size() + kFirstRecordBytes + bytes_;
  Append(connections_);
  for (const Chunk& chunk : chunks_) {
    std::string counts;
    for (const auto& [connection, count] : chunk.counts) {
      AppendNumber(connection, &counts);
      AppendNumber(count, &counts);
    }
    Fields fields;
    fields.Number("ver", kVersion)
        .Number("chunk_pos", chunk.position)
        .Text("start_time", TimeBytes(chunk.first_ns))
        .Text("end_time", TimeBytes(chunk.last_ns))
        .Number("count", static_cast<std::uint32_t>(chunk.counts.size()));
    Append(RecordBytes(kChunkInfo, fields, counts));
  }
  Fields fields;
  fields.Number("index_pos", connections_at)
      .Number("conn_count", topics_)
      .Number("chunk_count", static_cast<std::uint32_t>(chunks_.size()));
  const std::size_t unpadded = RecordBytes(kBagHeader, fields, "").size();
  const std::string blanks(kFirstRecordBytes - unpadded, ' ');
  file_.Commit(std::string(kFirstLine) + RecordBytes(kBagHeader, fields, blanks));
}

}  // namespace tera
