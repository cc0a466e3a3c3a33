#include "serve/unknown_field.h"

#include <fmt/format.h>

#include <vector>

namespace tera {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

std::optional<std::string> UnknownField(const Message& message) {
  const google::protobuf::Reflection& reflection = *message.GetReflection();
  const auto& unknown = reflection.GetUnknownFields(message);
  if (!unknown.empty()) {
    return fmt::format("field {} of {}", unknown.field(0).number(),
                       message.GetDescriptor()->name());
  }
  std::vector<const FieldDescriptor*> fields;
  reflection.ListFields(message, &fields);
  for (const FieldDescriptor* field : fields) {
    if (field->cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE) continue;
    const int count = field->is_repeated() ? reflection.FieldSize(message, field) : 1;
    for (int k = 0; k < count; ++k) {
      const Message& inner = field->is_repeated() ? reflection.GetRepeatedMessage(message, field, k)
                                                  : reflection.GetMessage(message, field);
      if (auto found = UnknownField(inner)) return found;
    }
  }
  return std::nullopt;
}

}  // namespace tera
