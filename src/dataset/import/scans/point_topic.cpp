#include "dataset/import/scans/point_topic.h"

#include <fmt/format.h>

#include "dataset/import/scans/message_cursor.h"

namespace tera {
namespace {

/// Field with a datatype number of sensor_msgs/PointField.
RecordField FieldOfDatatype(std::string_view name, std::uint8_t datatype, std::uint32_t offset) {
  struct Kind {
    char type;
    std::size_t bytes;
  };
  constexpr Kind kKinds[] = {{'I', 1}, {'U', 1}, {'I', 2}, {'U', 2},
                             {'I', 4}, {'U', 4}, {'F', 4}, {'F', 8}};
  if (datatype < 1 || datatype > std::size(kKinds)) {
    throw BadBytes{fmt::format("its field '{}' is of the type {}, need 1 to 8", name, datatype)};
  }
  const Kind& kind = kKinds[datatype - 1];
  return {std::string(name), kind.type, kind.bytes, offset};
}

}  // namespace

UnitScan ReadPointCloudMessage(const BagTopic& topic, const BagMessage& message,
                               const std::string& place, const PointForm& form, bool by_log_time) {
  MessageCursor cursor(topic.message_encoding, message.bytes);
  const TimeNs stamp_ns = cursor.HeaderStamp();
  const auto height = cursor.Number<std::uint32_t>();
  const auto width = cursor.Number<std::uint32_t>();
  PointRecords records{.place = place};
  const auto fields = cursor.Number<std::uint32_t>();
  for (std::uint32_t k = 0; k < fields; ++k) {
    const std::string_view name = cursor.Text();
    const auto offset = cursor.Number<std::uint32_t>();
    const auto datatype = cursor.Number<std::uint8_t>();
    cursor.Number<std::uint32_t>();  // count, which is 1 for every field in use
    // Some writers declare padding as unnamed fields.
    if (!name.empty()) records.fields.push_back(FieldOfDatatype(name, datatype, offset));
  }
  records.is_big_endian = cursor.Number<std::uint8_t>() != 0;
  records.step = cursor.Number<std::uint32_t>();
  const auto row_step = cursor.Number<std::uint32_t>();
  const auto bytes = cursor.Number<std::uint32_t>();
  records.bytes = cursor.Bytes(bytes);
  if (height > 1 && row_step != std::uint64_t{width} * records.step) {
    throw BadBytes{fmt::format("its rows of {} points take {} bytes, need {} without gaps", width,
                               row_step, std::uint64_t{width} * records.step)};
  }
  records.count = std::size_t{height} * width;
  return RecordReader(records, form).Read(by_log_time ? message.log_ns : stamp_ns);
}

}  // namespace tera
