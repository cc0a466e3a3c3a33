#include <string_view>

#include "dataset/import/bag/byte_cursor.h"
#include "dataset/import/bag/message_reader.h"
#include "untrusted_file.h"

// A message and its definition. The input's first byte chooses the form, the definition ends with a
// 0, the message follows.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  const std::string_view text(reinterpret_cast<const char*>(data + 1), size - 1);
  const std::size_t end = text.find('\0');
  if (end == std::string_view::npos) return 0;
  const bool ros1 = data[0] % 2 == 1;
  const tera::BagTopic topic = {"/t", "a/B", ros1 ? "ros1" : "cdr", ros1 ? "ros1msg" : "ros2msg",
                                std::string(text.substr(0, end))};
  try {
    const tera::MessageSchema schema = tera::SchemaOf(topic);
    std::vector<std::string> paths;
    for (const tera::MessageField& field : schema.root().fields) {
      if (field.kind == tera::FieldKind::kString || field.kind == tera::FieldKind::kWideString) {
        continue;
      }
      const bool several = field.arity != tera::MessageField::Arity::kOne;
      std::string path = field.name + (several ? "[0]" : "");
      if (field.kind == tera::FieldKind::kMessage) {
        const tera::MessageType& below = schema.types.at(field.type);
        if (below.fields.empty()) continue;
        path += "." + below.fields.front().name;
      }
      paths.push_back(path);
    }
    const tera::MessageReader reader(schema, paths);
    std::vector<tera::MessageCell> cells;
    reader.Read(text.substr(end + 1), &cells);
    reader.Labels(text.substr(end + 1));
  } catch (const tera::BadBytes&) {
  }
  return 0;
}
