#pragma once

#include <dds/dds.h>

#include <string>
#include <string_view>
#include <vector>

#include "dataset/ros/messages.h"

/// Plain messages as bytes for Cyclone DDS. Cyclone knows only the names of their types;
/// message_fields.h defines their content.
///
/// Source  rmw_cyclonedds, which uses the same approach.

namespace tera::ros {

/// Creates a participant's topic, "rt/clock", for messages of a type, "rosgraph_msgs/Clock". A
/// negative result is Cyclone's error.
dds_entity_t CreateTopic(dds_entity_t participant, const std::string& name, std::string_view type);
/// Type of the alternative `index` of Message.
std::string_view TypeOf(std::size_t index);

/// Passes `message` to `writer`, whose topic must have its type.
dds_return_t WriteOnWire(dds_entity_t writer, const Message& message);

/// Takes up to `most` waiting messages of `reader`, oldest first. Incomplete messages are rejected
/// earlier. A negative result is Cyclone's error.
dds_return_t TakeFromWire(dds_entity_t reader, int most, std::vector<DeltaCan>* messages);

}  // namespace tera::ros
