#include "dataset/import/bag/message_schema.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <map>
#include <optional>

#include "dataset/import/bag/byte_cursor.h"
#include "dataset/ros/message_definitions.h"

namespace tera {
namespace {

constexpr std::size_t kDeepest = 64;  ///< nesting limit of messages
constexpr std::size_t kMostTypes = 4096;
constexpr std::string_view kBlanks = " \t\r";

constexpr std::array<FieldKindTraits, 16> kTraits = {{{"bool", 1, 1},
                                                      {"int8", 1, 1},
                                                      {"uint8", 1, 1},
                                                      {"int16", 2, 2},
                                                      {"uint16", 2, 2},
                                                      {"int32", 4, 4},
                                                      {"uint32", 4, 4},
                                                      {"int64", 8, 8},
                                                      {"uint64", 8, 8},
                                                      {"float32", 4, 4},
                                                      {"float64", 8, 8},
                                                      {"time", 8, 4},
                                                      {"duration", 8, 4},
                                                      {"string", 0, 0},
                                                      {"wstring", 0, 0},
                                                      {"", 0, 0}}};

std::optional<FieldKind> KindOf(std::string_view name) {
  if (name == "byte" || name == "char") return FieldKind::kUint8;
  if (name == "builtin_interfaces/Time") return FieldKind::kTime;
  if (name == "builtin_interfaces/Duration") return FieldKind::kDuration;
  for (std::size_t k = 0; k < kTraits.size(); ++k) {
    if (!kTraits[k].name.empty() && kTraits[k].name == name) return static_cast<FieldKind>(k);
  }
  return std::nullopt;
}

std::string_view Trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::string_view TakeLine(std::string_view* rest) {
  const std::size_t end = rest->find('\n');
  const std::string_view line = rest->substr(0, end);
  rest->remove_prefix(end == std::string_view::npos ? rest->size() : end + 1);
  return line;
}

/// Parts of a definition: the type itself, and each type after a line "MSG: name".
std::map<std::string, std::string> PartsOf(const std::string& type, std::string_view text) {
  constexpr std::string_view kRule = "=====", kPart = "MSG:";
  std::map<std::string, std::string> parts;
  std::string name = type;
  parts[name];
  while (!text.empty()) {
    const std::string_view line = Trimmed(TakeLine(&text));
    if (line.starts_with(kRule)) continue;
    if (line.starts_with(kPart)) {
      name = ShortTypeName(Trimmed(line.substr(kPart.size())));
      parts[name].clear();
      continue;
    }
    parts[name].append(line).push_back('\n');
  }
  return parts;
}

/// Type of a field as written, such as "float64[9]" or "string<=10[<=3]".
struct WrittenType {
  std::string_view name;
  MessageField::Arity arity = MessageField::Arity::kOne;
  std::uint32_t count = 1;
};

WrittenType ParseWritten(std::string_view text) {
  WrittenType written;
  const std::size_t bracket = text.find('[');
  written.name = text.substr(0, std::min(bracket, text.find("<=")));
  if (bracket == std::string_view::npos) return written;
  const std::string_view inside = text.substr(bracket + 1, text.find(']') - bracket - 1);
  written.arity = MessageField::Arity::kSequence;
  if (inside.empty() || inside.starts_with("<=")) return written;
  written.arity = MessageField::Arity::kArray;
  const auto [stop, status] =
      std::from_chars(inside.data(), inside.data() + inside.size(), written.count);
  if (status != std::errc() || stop != inside.data() + inside.size()) {
    throw BadBytes{fmt::format("its definition has '{}', which is not a type", text)};
  }
  return written;
}

class SchemaParser {
 public:
  SchemaParser(ros::WireForm form, std::map<std::string, std::string> parts)
      : parts_(std::move(parts)) {
    schema_.form = form;
  }

  MessageSchema Parse(const std::string& type) {
    TypeOf(type, 0);
    // The message itself gets index 0, before the types of its fields.
    return std::move(schema_);
  }

 private:
  std::size_t TypeOf(const std::string& name, std::size_t depth) {
    if (const auto known = numbers_.find(name); known != numbers_.end()) {
      if (schema_.types[known->second].name.empty()) {
        throw BadBytes{fmt::format("its definition contains {} in itself", name)};
      }
      RequireDepth(depth + depths_[known->second]);
      return known->second;
    }
    RequireDepth(depth);
    if (schema_.types.size() == kMostTypes) throw BadBytes{"its definition has too many types"};
    const std::size_t number = schema_.types.size();
    numbers_[name] = number;
    schema_.types.emplace_back();
    depths_.push_back(0);
    MessageType type;
    std::string text = DefinitionOf(name);
    std::string_view rest = text;
    while (!rest.empty()) AddField(name, TakeLine(&rest), depth, number, &type);
    if (type.fields.empty() && schema_.form == ros::WireForm::kCdr) {
      // rosidl adds this field to empty types
      type.fields.push_back({"structure_needs_at_least_one_member"});
      type.least_bytes = 1;
    }
    type.name = name;
    schema_.types[number] = std::move(type);
    return number;
  }

  static void RequireDepth(std::size_t depth) {
    if (depth > kDeepest) {
      throw BadBytes{fmt::format("its definition is nested deeper than {} messages", kDeepest)};
    }
  }

  std::string DefinitionOf(const std::string& name) const {
    if (const auto part = parts_.find(name); part != parts_.end()) return part->second;
    if (const auto known = ros::FindDefinition(name)) {
      return ros::OwnDefinition(name, schema_.form);
    }
    throw BadBytes{
        fmt::format("neither the bag nor TERA has a definition of {}; need one, as MCAP "
                    "files and ROS 1 bags carry: 'ros2 bag convert' makes an MCAP file",
                    name)};
  }

  /// Adds the field defined in a line. A constant, a comment or an empty line defines none.
  void AddField(const std::string& owner, std::string_view line, std::size_t depth,
                std::size_t number, MessageType* type) {
    line = Trimmed(line.substr(0, line.find('#')));
    if (line.empty()) return;
    const std::size_t blank = line.find_first_of(kBlanks);
    std::string_view rest = Trimmed(blank == std::string_view::npos ? "" : line.substr(blank));
    const std::string_view name = rest.substr(0, rest.find_first_of(" \t="));
    // A constant has '=' after its name. A field may have a default value, separated by a blank.
    rest = Trimmed(rest.substr(name.size()));
    if (rest.starts_with('=')) return;
    if (name.empty()) throw BadBytes{fmt::format("its definition has the line '{}'", line)};
    const WrittenType written = ParseWritten(line.substr(0, blank));
    MessageField field{std::string(name), FieldKind::kMessage, written.arity, written.count};
    const std::string full = FullName(owner, written.name);
    if (const auto kind = KindOf(full)) {
      const bool is_signed = full == "byte" && schema_.form == ros::WireForm::kRos1;
      field.kind = is_signed ? FieldKind::kInt8 : *kind;
    } else {
      field.type = TypeOf(full, depth + 1);
      depths_[number] = std::max(depths_[number], depths_[field.type] + 1);
    }
    type->least_bytes = Sum(type->least_bytes, LeastBytes(field));
    type->fields.push_back(std::move(field));
  }

  /// Full name of a type. A name without package is in the package of the enclosing message.
  static std::string FullName(const std::string& owner, std::string_view name) {
    if (name == "Header") return "std_msgs/Header";
    if (KindOf(name)) return std::string(name);
    if (name.find('/') != std::string_view::npos) return ShortTypeName(name);
    return owner.substr(0, owner.find('/') + 1) + std::string(name);
  }

  std::uint64_t LeastBytes(const MessageField& field) const {
    constexpr std::uint64_t kLengthBytes = 4;
    if (field.arity == MessageField::Arity::kSequence) return kLengthBytes;
    const std::uint64_t one = field.kind == FieldKind::kMessage
                                  ? schema_.types[field.type].least_bytes
                              : TraitsOf(field.kind).bytes > 0 ? TraitsOf(field.kind).bytes
                                                               : kLengthBytes;
    if (one != 0 && field.count > kUnbounded / one) return kUnbounded;
    return one * field.count;
  }
  static std::uint64_t Sum(std::uint64_t a, std::uint64_t b) {
    return a > kUnbounded - b ? kUnbounded : a + b;
  }
  static constexpr std::uint64_t kUnbounded = std::numeric_limits<std::uint64_t>::max();

  std::map<std::string, std::string> parts_;
  std::map<std::string, std::size_t> numbers_;
  std::vector<std::size_t> depths_;  ///< nesting depth below each type
  MessageSchema schema_;
};

ros::WireForm FormOf(const BagTopic& topic) {
  if (topic.message_encoding == "cdr") return ros::WireForm::kCdr;
  if (topic.message_encoding == "ros1") return ros::WireForm::kRos1;
  throw BadBytes{
      fmt::format("its messages are encoded as '{}', need cdr or ros1", topic.message_encoding)};
}

}  // namespace

const FieldKindTraits& TraitsOf(FieldKind kind) { return kTraits[static_cast<std::size_t>(kind)]; }

bool MessageSchema::HasHeader() const {
  return !root().fields.empty() && root().fields.front().kind == FieldKind::kMessage &&
         root().fields.front().name == "header" &&
         types[root().fields.front().type].name == "std_msgs/Header";
}

MessageSchema SchemaOf(const BagTopic& topic) {
  const ros::WireForm form = FormOf(topic);
  // Some recorders leave the definition empty if they do not know the type.
  const bool is_left_out = topic.definition.empty() && ros::FindDefinition(topic.type);
  const bool readable =
      !is_left_out && (topic.schema_encoding == "ros2msg" || topic.schema_encoding == "ros1msg");
  std::map<std::string, std::string> parts;
  if (readable) {
    parts = PartsOf(topic.type, topic.definition);
  } else if (!ros::FindDefinition(topic.type) && !topic.schema_encoding.empty()) {
    throw BadBytes{fmt::format("its definition is written as '{}', need ros2msg or ros1msg",
                               topic.schema_encoding)};
  }
  return SchemaParser(form, std::move(parts)).Parse(topic.type);
}

}  // namespace tera
