#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dataset/import/bag/message_schema.h"

namespace tera {

/// One field of a message.
struct MessageCell {
  std::optional<double> number;  ///< absent if the message lacks this element
  TimeNs stamp_ns = 0;           ///< exact value of a time or a duration
};

/// Reads fields of messages by path. A path consists of field names separated by dots. Brackets
/// select an element of an array or sequence in one of three ways: by index from 0, by its name in
/// the sequence `name` of the same message, or, for transforms, by its frames. Examples:
/// "linear_acceleration.x", "position[2]", "position[boom]", "header.stamp",
/// "transforms[odom>base_link].transform.translation.x".
class MessageReader {
 public:
  /// Throws BadBytes if a path does not exist in the schema, ends at neither a number nor a time,
  /// or exceeds the length of an array.
  MessageReader(MessageSchema schema, const std::vector<std::string>& paths);
  ~MessageReader();

  /// Reads one cell per path from a message. Throws BadBytes if the bytes do not fit the schema;
  /// never reads beyond their end.
  ///
  /// Model   the encodings of Serializer, and big-endian CDR.
  void Read(std::string_view message, std::vector<MessageCell>* cells) const;
  /// Texts of the sequence `name` of a message. They name the elements of its other sequences.
  std::vector<std::string> Labels(std::string_view message) const;
  /// Frames of the transforms in a message as "odom>base_link". The leading '/' of ROS 1 is
  /// removed.
  std::vector<std::string> FramePairs(std::string_view message) const;
  bool IsStamp(std::size_t path) const { return is_stamp_[path]; }

 private:
  struct Node;
  struct Element;
  class Walk;
  void Add(const std::string& path, std::size_t column);

  MessageSchema schema_;
  std::unique_ptr<Node> root_;
  std::vector<bool> is_stamp_;
};

}  // namespace tera
