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
  std::optional<double> number;  ///< none where the message has no such element
  TimeNs stamp_ns = 0;           ///< of a time or a duration, exactly
};

/// A field by its path: names between points, an element of an array or a sequence in brackets, by
/// its index from 0, by what the text at the same place of the sequence `name` beside it says, or
/// of transforms by their frames: "linear_acceleration.x", "position[2]", "position[boom]",
/// "header.stamp", "transforms[odom>base_link].transform.translation.x".
class MessageReader {
 public:
  /// BadBytes for a path that the schema has not, that leads to no number and no time, or to an
  /// element beyond an array.
  MessageReader(MessageSchema schema, const std::vector<std::string>& paths);
  ~MessageReader();

  /// The cells of a message, as many as there are paths. BadBytes where its bytes are not as the
  /// schema says; no more of them is read than there is.
  ///
  /// Model   the forms of Serializer, of CDR also the big-endian one.
  void Read(std::string_view message, std::vector<MessageCell>* cells) const;
  /// What the sequence `name` of a message says, which labels its other sequences.
  std::vector<std::string> Labels(std::string_view message) const;
  /// The frames of a message's transforms, "odom>base_link", without the '/' that ROS 1 put first.
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
