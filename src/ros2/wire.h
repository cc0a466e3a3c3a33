#pragma once

#include <dds/dds.h>

#include "dataset/ros/messages.h"

/// Between the plain messages and the structs that Cyclone DDS reads and writes.

namespace tera::ros {

/// The type that topics of the alternative `index` of Message have.
const dds_topic_descriptor_t& TopicTypeOf(std::size_t index);
const dds_topic_descriptor_t& DeltaCanTopicType();

/// Hands `message` to `writer`, whose topic must be of its type.
dds_return_t WriteOnWire(dds_entity_t writer, const Message& message);

/// Takes up to `most` waiting messages of `reader`, oldest first. Negative: Cyclone's error.
dds_return_t TakeFromWire(dds_entity_t reader, int most, std::vector<DeltaCan>* messages);

}  // namespace tera::ros
