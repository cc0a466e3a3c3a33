#pragma once

#include <google/protobuf/message.h>

#include <optional>
#include <string>

namespace tera {

/// A field of `message`, or of a message within it, that this build has no name for, as a newer
/// client sends: "field 9 of Action". What it asks for would be left undone without a word.
std::optional<std::string> UnknownField(const google::protobuf::Message& message);

}  // namespace tera
