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
  std::optional<double> number;  ///< none where the message lacks the element
  TimeNs stamp_ns = 0;           ///< exact value of a time or a duration
};

/// Reads fields by path: names between points, and an element of an array or a sequence in
/// brackets. The element is given by its index from 0, by its text in the sequence `name` of the
/// same message, or for transforms by their frames. Examples: "linear_acceleration.x",
/// "position[2]", "position[boom]", "header.stamp",
/// "transforms[odom>base_link].transform.translation.x".
class MessageReader {
 public:
  /// Throws BadBytes for a path that is not in the schema, that leads to neither number nor time,
  /// or that exceeds an array.
  MessageReader(MessageSchema schema, const std::vector<std::string>& paths);
  ~MessageReader();

  /// Reads the cells of a message, one for each path. Throws BadBytes where the bytes violate the
  /// schema, and never reads beyond their end.
  ///
  /// Model   the wire forms of Serializer, and big-endian CDR.
  void Read(std::string_view message, std::vector<MessageCell>* cells) const;
  /// Texts of the sequence `name` of a message, which label its other sequences.
  std::vector<std::string> Labels(std::string_view message) const;
  /// Frames of a message's transforms, "odom>base_link", without the leading '/' of ROS 1.
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
