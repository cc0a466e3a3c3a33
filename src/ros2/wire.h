#pragma once

#include <dds/dds.h>

#include <string>
#include <string_view>
#include <vector>

#include "dataset/ros/messages.h"

/// Passes messages to and from Cyclone DDS as bytes. Cyclone knows only the names of the message
/// types; message_fields.h defines their content.
///
/// Source  rmw_cyclonedds, which works the same way.

namespace tera::ros {

/// Creates a topic such as "rt/clock" with a type such as "rosgraph_msgs/Clock". A negative result
/// is an error of Cyclone.
dds_entity_t CreateTopic(dds_entity_t participant, const std::string& name, std::string_view type);
/// Type name of the alternative `index` of Message.
std::string_view TypeOf(std::size_t index);

/// Writes `message`. Its type must be that of the writer's topic.
dds_return_t WriteOnWire(dds_entity_t writer, const Message& message);

/// Takes up to `most` messages from `reader`, oldest first. Incomplete messages have been rejected
/// on arrival. A negative result is an error of Cyclone.
dds_return_t TakeFromWire(dds_entity_t reader, int most, std::vector<DeltaCan>* messages);

}  // namespace tera::ros
