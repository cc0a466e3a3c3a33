#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "dataset/import/bag/bag_source.h"
#include "dataset/ros/serializer.h"

/// Structure of a ROS message, from the message definition in its bag.

namespace tera {

enum class FieldKind : std::uint8_t {
  kBool,
  kInt8,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kInt64,
  kUint64,
  kFloat32,
  kFloat64,
  kTime,      ///< seconds and nanoseconds
  kDuration,  ///< likewise
  kString,
  kWideString,
  kMessage
};

/// Name (such as "float64"), size and alignment of a field type in bytes. Size and alignment are 0
/// for types of variable size.
struct FieldKindTraits {
  std::string_view name;
  std::uint32_t bytes = 0, alignment = 0;
};
const FieldKindTraits& TraitsOf(FieldKind kind);

struct MessageField {
  enum class Arity : std::uint8_t { kOne, kArray, kSequence };
  std::string name;
  FieldKind kind = FieldKind::kUint8;
  Arity arity = Arity::kOne;
  std::uint32_t count = 1;  ///< number of elements of an array
  std::size_t type = 0;     ///< for kMessage: index in MessageSchema::types
};

struct MessageType {
  std::string name;  ///< such as "geometry_msgs/Vector3"
  std::vector<MessageField> fields;
  std::uint64_t least_bytes = 0;  ///< smallest encoded size: no padding, all texts and sequences
                                  ///< empty
};

struct MessageSchema {
  ros::WireForm form = ros::WireForm::kCdr;
  std::vector<MessageType> types;  ///< the message itself is first

  const MessageType& root() const { return types.front(); }
  bool HasHeader() const;
};

/// Schema of a topic. Uses the definition in the bag if its encoding is `ros2msg` or `ros1msg`, and
/// otherwise TERA's own definition of the type. Throws BadBytes for a type without either, and for
/// a definition that is unreadable, recursive or nested too deeply.
///
/// Source  "ROS 2 message definitions (.msg)" and "msg" of the ROS 1 wiki.
MessageSchema SchemaOf(const BagTopic& topic);

}  // namespace tera
