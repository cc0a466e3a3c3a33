#include "dataset/import/scans/point_topic.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

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

constexpr std::string_view kLivoxTypes[] = {
    "livox_ros_driver/CustomMsg", "livox_ros_driver2/CustomMsg", "livox_interfaces/CustomMsg"};

bool IsLivox(std::string_view type) {
  return std::find(std::begin(kLivoxTypes), std::end(kLivoxTypes), type) != std::end(kLivoxTypes);
}

/// Points of a CustomMsg behind its header. CDR aligns each point to four bytes, and leaves out the
/// padding after the last, which is added here.
PointRecords LivoxRecords(MessageCursor* cursor, bool is_cdr, std::string* padded) {
  constexpr std::size_t kPoint_bytes = 19;
  cursor->Number<std::uint64_t>();  // timebase, the header's stamp once more
  cursor->Number<std::uint32_t>();  // number of points, declared again before them
  cursor->Number<std::uint8_t>();   // number of the lidar
  for (int k = 0; k < 3; ++k) cursor->Number<std::uint8_t>();
  PointRecords records{.fields = {{"offset_time", 'U', 4, 0},
                                  {"x", 'F', 4, 4},
                                  {"y", 'F', 4, 8},
                                  {"z", 'F', 4, 12},
                                  {"reflectivity", 'U', 1, 16},
                                  {"line", 'U', 1, 18}},
                       .step = is_cdr ? kPoint_bytes + 1 : kPoint_bytes,
                       .count = cursor->Number<std::uint32_t>()};
  const std::size_t padding = records.step - kPoint_bytes;
  if (records.count > 0) *padded = cursor->Bytes(records.count * records.step - padding);
  padded->append(padding, '\0');
  records.bytes = *padded;
  return records;
}

PointRecords PointCloudRecords(MessageCursor* cursor_of_message) {
  MessageCursor& cursor = *cursor_of_message;
  const auto height = cursor.Number<std::uint32_t>();
  const auto width = cursor.Number<std::uint32_t>();
  PointRecords records;
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
  return records;
}

}  // namespace

bool HoldsPoints(std::string_view type) { return type == kPointCloudType || IsLivox(type); }

UnitScan ReadPointMessage(const BagTopic& topic, const BagMessage& message,
                          const std::string& place, const PointForm& form, bool by_log_time) {
  MessageCursor cursor(topic.message_encoding, message.bytes);
  const TimeNs stamp_ns = cursor.HeaderStamp();
  std::string padded;
  PointRecords records = IsLivox(topic.type)
                             ? LivoxRecords(&cursor, topic.message_encoding != "ros1", &padded)
                             : PointCloudRecords(&cursor);
  records.place = place;
  return RecordReader(records, form).Read(by_log_time ? message.log_ns : stamp_ns);
}

}  // namespace tera
