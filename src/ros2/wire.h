#pragma once

#include <dds/dds.h>

#include <string>
#include <string_view>
#include <vector>

#include "dataset/ros/messages.h"

/// Plain messages as bytes that Cyclone DDS carries. It learns no more of their types than their
/// names: message_fields.h alone describes what is in them.
///
/// Source  rmw_cyclonedds, which does the same.

namespace tera::ros {

/// A topic of a participant, "rt/clock", whose messages are of a type, "rosgraph_msgs/Clock".
/// Negative: Cyclone's error.
dds_entity_t CreateTopic(dds_entity_t participant, const std::string& name, std::string_view type);
/// The type of the alternative `index` of Message.
std::string_view TypeOf(std::size_t index);

/// Hands `message` to `writer`, whose topic must be of its type.
dds_return_t WriteOnWire(dds_entity_t writer, const Message& message);

/// Takes up to `most` waiting messages of `reader`, oldest first. Bytes that are no whole message
/// do not come that far. Negative: Cyclone's error.
dds_return_t TakeFromWire(dds_entity_t reader, int most, std::vector<DeltaCan>* messages);

}  // namespace tera::ros
