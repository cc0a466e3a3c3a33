#include "dataset/import/bag/message_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>
#include <utility>

#include "core/config/spelling.h"
#include "dataset/import/bag/byte_cursor.h"

namespace tera {

/// Requested parts of one element of a field. A field that is not an array has one element.
struct MessageReader::Element {
  std::optional<std::uint32_t> index;
  std::string label;  ///< selects the element by name instead of index; for a transform, its frames
  std::vector<std::size_t> columns;
  std::unique_ptr<Node> below;  ///< requested parts of a nested message
};

struct MessageReader::Node {
  std::vector<std::vector<Element>> fields;  ///< one list per field
  bool has_labels = false;
};

namespace {

constexpr const char* kLabels = "name";

/// A part of a path, such as "position[boom]".
struct Step {
  std::string name, inside;
  bool has_brackets = false;
};

std::vector<Step> StepsOf(const std::string& path) {
  std::vector<Step> steps(1);
  bool inside = false;
  for (const char c : path) {
    Step& step = steps.back();
    if (inside && c != ']') {
      step.inside += c;
    } else if (c == '[' || c == ']') {
      inside = c == '[';
      step.has_brackets = true;
    } else if (c == '.') {
      steps.emplace_back();
    } else {
      step.name += c;
    }
  }
  if (inside) throw BadBytes{fmt::format("'{}' lacks its ']'", path)};
  return steps;
}

std::size_t FieldOf(const MessageType& type, const std::string& name) {
  std::vector<std::string> names;
  for (std::size_t f = 0; f < type.fields.size(); ++f) {
    if (type.fields[f].name == name) return f;
    names.push_back(type.fields[f].name);
  }
  throw BadBytes{fmt::format("{} has no field '{}'{}", type.name, name, DidYouMean(name, names))};
}

bool HasLabels(const MessageType& type, std::size_t before) {
  for (std::size_t f = 0; f < before; ++f) {
    const MessageField& field = type.fields[f];
    if (field.name == kLabels && field.kind == FieldKind::kString &&
        field.arity == MessageField::Arity::kSequence) {
      return true;
    }
  }
  return false;
}

constexpr const char *kParentFrame = "frame_id", *kChildFrame = "child_frame_id";

bool IsTransform(const MessageType& type) {
  return std::any_of(type.fields.begin(), type.fields.end(), [](const MessageField& field) {
    return field.name == kChildFrame && field.kind == FieldKind::kString;
  });
}

/// Joins "/odom" and "/base_link" to "odom>base_link".
std::string PairOf(std::string_view parent, std::string_view child) {
  const auto bare = [](std::string_view frame) {
    return std::string(frame.substr(frame.starts_with('/') ? 1 : 0));
  };
  return bare(parent) + ">" + bare(child);
}

/// Determines how a step of a path selects an element: by `index` or by `label`.
void RequireElement(const MessageSchema& schema, const MessageType& type, std::size_t f,
                    const Step& step, std::optional<std::uint32_t>* index, std::string* label) {
  const MessageField& field = type.fields[f];
  const bool has_elements = field.arity != MessageField::Arity::kOne;
  if (has_elements != step.has_brackets) {
    throw BadBytes{fmt::format("'{}' of {} has {}", field.name, type.name,
                               has_elements ? "elements, need one of them in brackets: an index "
                                              "from 0, or a name if the message has names"
                                            : "no elements, need it without brackets")};
  }
  if (!has_elements) return;
  std::uint32_t value = 0;
  const char* const end = step.inside.data() + step.inside.size();
  const auto [stop, status] = std::from_chars(step.inside.data(), end, value);
  if (status == std::errc() && stop == end && !step.inside.empty()) {
    *index = value;
    if (field.arity == MessageField::Arity::kArray && value >= field.count) {
      throw BadBytes{fmt::format("'{}' of {} has {} elements, from 0 to {}; found {}", field.name,
                                 type.name, field.count, field.count - 1, value)};
    }
    return;
  }
  const std::size_t arrow = step.inside.find('>');
  if (arrow != std::string::npos && field.kind == FieldKind::kMessage &&
      IsTransform(schema.types[field.type])) {
    *label = PairOf(step.inside.substr(0, arrow), step.inside.substr(arrow + 1));
    return;
  }
  if (!HasLabels(type, f) || step.inside.empty()) {
    throw BadBytes{
        fmt::format("'{}' of {} has no names of its elements, need an index from 0, "
                    "found '{}'",
                    field.name, type.name, step.inside)};
  }
  *label = step.inside;
}

}  // namespace

MessageReader::MessageReader(MessageSchema schema, const std::vector<std::string>& paths)
    : schema_(std::move(schema)), root_(std::make_unique<Node>()), is_stamp_(paths.size()) {
  for (std::size_t k = 0; k < paths.size(); ++k) Add(paths[k], k);
}

MessageReader::~MessageReader() = default;

void MessageReader::Add(const std::string& path, std::size_t column) {
  Node* node = root_.get();
  const MessageType* type = &schema_.root();
  const std::vector<Step> steps = StepsOf(path);
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const std::size_t f = FieldOf(*type, steps[k].name);
    const MessageField& field = type->fields[f];
    Element element;
    RequireElement(schema_, *type, f, steps[k], &element.index, &element.label);
    node->has_labels = node->has_labels || (!element.label.empty() && HasLabels(*type, f));
    node->fields.resize(type->fields.size());
    auto& elements = node->fields[f];
    const auto same = std::find_if(elements.begin(), elements.end(), [&](const Element& e) {
      return e.index == element.index && e.label == element.label;
    });
    const auto place = same - elements.begin();
    if (same == elements.end()) elements.push_back(std::move(element));
    Element& wanted = elements[static_cast<std::size_t>(place)];
    const bool is_last = k + 1 == steps.size(), is_message = field.kind == FieldKind::kMessage;
    if (is_last == is_message || field.kind == FieldKind::kString ||
        field.kind == FieldKind::kWideString) {
      throw BadBytes{fmt::format(
          "'{}' is {}, need a number or a time", path,
          is_message ? schema_.types[field.type].name : std::string(TraitsOf(field.kind).name))};
    }
    if (is_last) {
      wanted.columns.push_back(column);
      is_stamp_[column] = field.kind == FieldKind::kTime || field.kind == FieldKind::kDuration;
      return;
    }
    if (!wanted.below) wanted.below = std::make_unique<Node>();
    node = wanted.below.get();
    type = &schema_.types[field.type];
  }
}

/// Parses one message from start to end.
class MessageReader::Walk {
 public:
  Walk(const MessageSchema& schema, std::string_view message, std::vector<MessageCell>* cells)
      : schema_(schema), is_cdr_(schema.form == ros::WireForm::kCdr), cells_(cells) {
    if (is_cdr_) message = TakeCdrHead(message);
    bytes_ = message;
  }

  /// Reads the message and returns the texts of its sequence `name`.
  std::vector<std::string_view> Message(const MessageType& type, const Node* node) {
    std::vector<std::string_view> labels;
    for (std::size_t f = 0; f < type.fields.size(); ++f) {
      const MessageField& field = type.fields[f];
      const bool is_labels = node != nullptr && node->has_labels && field.name == kLabels;
      const std::vector<Element>* wanted =
          node == nullptr || node->fields.empty() ? nullptr : &node->fields[f];
      Field(field, wanted, labels, is_labels ? &labels : nullptr);
    }
    return labels;
  }

  /// Requests the frames of all transforms in the message.
  void CollectPairs(std::vector<std::string>* pairs) { pairs_ = pairs; }

  void RequireEnd() const {
    // Some writers pad messages to a multiple of four bytes.
    const std::size_t most = is_cdr_ ? 3 : 0;
    if (bytes_.size() - at_ <= most) return;
    throw BadBytes{
        fmt::format("it has {} bytes, but its definition reads {}: their types or versions differ",
                    bytes_.size(), at_)};
  }

 private:
  std::string_view TakeCdrHead(std::string_view message) {
    constexpr std::size_t kHeadBytes = 4;
    if (message.size() < kHeadBytes) throw BadBytes{"it lacks the four bytes at the start of CDR"};
    if (message[0] != 0 || (message[1] != 0 && message[1] != 1)) {
      throw BadBytes{fmt::format(
          "it begins with the bytes {} and {}, need plain CDR (0 and 0 or 1)",
          static_cast<unsigned char>(message[0]), static_cast<unsigned char>(message[1]))};
    }
    is_big_endian_ = message[1] == 0;
    return message.substr(kHeadBytes);
  }

  void Align(std::size_t size) {
    if (!is_cdr_) return;
    const std::size_t aligned = (at_ + size - 1) / size * size;
    if (aligned > bytes_.size()) throw BadBytes{"it ends too early"};
    at_ = aligned;
  }
  std::string_view Bytes(std::uint64_t count) {
    if (count > bytes_.size() - at_) {
      throw BadBytes{
          fmt::format("it declares {} bytes, but {} are left", count, bytes_.size() - at_)};
    }
    const std::string_view bytes = bytes_.substr(at_, count);
    at_ += count;
    return bytes;
  }
  template <typename T>
  T Scalar() {
    Align(sizeof(T));
    char copy[sizeof(T)];
    std::memcpy(copy, Bytes(sizeof(T)).data(), sizeof(T));
    if (is_big_endian_) std::reverse(copy, copy + sizeof(T));
    static_assert(std::endian::native == std::endian::little);
    T value;
    std::memcpy(&value, copy, sizeof(T));
    return value;
  }
  std::string_view Text() {
    std::string_view text = Bytes(Scalar<std::uint32_t>());
    if (is_cdr_ && text.ends_with('\0')) text.remove_suffix(1);
    return text;
  }

  void Field(const MessageField& field, const std::vector<Element>* wanted,
             const std::vector<std::string_view>& labels, std::vector<std::string_view>* texts) {
    std::uint64_t count = field.count;
    if (field.arity == MessageField::Arity::kSequence) count = Scalar<std::uint32_t>();
    if (count == 0) return;
    const std::uint32_t bytes = TraitsOf(field.kind).bytes;
    if (bytes > 0) {
      Plain(field.kind, count, wanted, labels);
      return;
    }
    RequireRoom(field, count);
    if (LeastOf(field) == 0) return;  // a message type without fields
    for (std::uint64_t k = 0; k < count; ++k) {
      if (field.kind == FieldKind::kMessage) {
        const MessageType& type = schema_.types[field.type];
        std::string frames;
        if ((wanted != nullptr || pairs_ != nullptr) && IsTransform(type)) frames = FramesAt(type);
        if (pairs_ != nullptr && !frames.empty()) pairs_->push_back(frames);
        Message(type, BelowOf(wanted, k, labels, frames));
      } else if (field.kind == FieldKind::kString) {
        const std::string_view text = Text();
        if (texts != nullptr) texts->push_back(text);
        if (frames_ != nullptr && field.name == kParentFrame) frames_->first = text;
        if (frames_ != nullptr && field.name == kChildFrame) frames_->second = text;
      } else {
        throw BadBytes{fmt::format("'{}' is a wstring, which has no common layout", field.name)};
      }
    }
  }

  std::uint64_t LeastOf(const MessageField& field) const {
    constexpr std::uint64_t kLengthBytes = 4;
    return field.kind == FieldKind::kMessage ? schema_.types[field.type].least_bytes : kLengthBytes;
  }
  void RequireRoom(const MessageField& field, std::uint64_t count) const {
    const std::uint64_t least = LeastOf(field);
    if (least == 0 || count <= (bytes_.size() - at_) / least) return;
    throw BadBytes{fmt::format("'{}' declares {} elements, but {} bytes are left", field.name,
                               count, bytes_.size() - at_)};
  }

  /// Frames of the transform at the current position, which does not advance.
  std::string FramesAt(const MessageType& type) {
    std::pair<std::string_view, std::string_view> frames;
    const std::size_t begin = at_;
    const auto pairs = std::exchange(pairs_, nullptr);
    frames_ = &frames;
    Message(type, nullptr);
    frames_ = nullptr;
    pairs_ = pairs;
    at_ = begin;
    return PairOf(frames.first, frames.second);
  }

  static bool IsElement(const Element& element, std::uint64_t k,
                        const std::vector<std::string_view>& labels, std::string_view frames) {
    if (!element.label.empty() && !frames.empty()) return element.label == frames;
    if (!element.label.empty()) return k < labels.size() && labels[k] == element.label;
    return !element.index || *element.index == k;
  }
  static const Node* BelowOf(const std::vector<Element>* wanted, std::uint64_t k,
                             const std::vector<std::string_view>& labels, std::string_view frames) {
    if (wanted == nullptr) return nullptr;
    for (const Element& element : *wanted) {
      if (IsElement(element, k, labels, frames)) return element.below.get();
    }
    return nullptr;
  }

  /// Reads requested numbers and times, and skips all others.
  void Plain(FieldKind kind, std::uint64_t count, const std::vector<Element>* wanted,
             const std::vector<std::string_view>& labels) {
    const FieldKindTraits& traits = TraitsOf(kind);
    Align(traits.alignment);
    const std::size_t begin = at_;
    Bytes(count * traits.bytes);
    const std::size_t end = at_;
    if (wanted != nullptr) {
      for (const Element& element : *wanted) {
        std::uint64_t k = element.index.value_or(0);
        if (!element.label.empty()) {
          k = static_cast<std::uint64_t>(std::find(labels.begin(), labels.end(), element.label) -
                                         labels.begin());
          if (k == labels.size()) continue;
        }
        if (k >= count) continue;
        at_ = begin + k * traits.bytes;
        const MessageCell cell = Cell(kind);
        for (const std::size_t column : element.columns) (*cells_)[column] = cell;
      }
    }
    at_ = end;
  }

  MessageCell Cell(FieldKind kind) {
    switch (kind) {
      case FieldKind::kBool:
      case FieldKind::kUint8:
        return Of(Scalar<std::uint8_t>());
      case FieldKind::kInt8:
        return Of(Scalar<std::int8_t>());
      case FieldKind::kInt16:
        return Of(Scalar<std::int16_t>());
      case FieldKind::kUint16:
        return Of(Scalar<std::uint16_t>());
      case FieldKind::kInt32:
        return Of(Scalar<std::int32_t>());
      case FieldKind::kUint32:
        return Of(Scalar<std::uint32_t>());
      case FieldKind::kInt64:
        return Of(Scalar<std::int64_t>());
      case FieldKind::kUint64:
        return Of(Scalar<std::uint64_t>());
      case FieldKind::kFloat32:
        return Of(Scalar<float>());
      case FieldKind::kFloat64:
        return Of(Scalar<double>());
      default:
        return Time(kind);
    }
  }
  template <typename T>
  static MessageCell Of(T value) {
    return {static_cast<double>(value), 0};
  }
  MessageCell Time(FieldKind kind) {
    const auto raw = Scalar<std::uint32_t>();
    const bool is_signed = is_cdr_ || kind == FieldKind::kDuration;
    const TimeNs seconds = is_signed ? TimeNs{static_cast<std::int32_t>(raw)} : TimeNs{raw};
    const auto nanoseconds = static_cast<std::int32_t>(Scalar<std::uint32_t>());
    if (std::abs(static_cast<TimeNs>(nanoseconds)) >= kNsPerSecond) {
      throw BadBytes{fmt::format("it has a time of {} s and {} ns", seconds, nanoseconds)};
    }
    const TimeNs stamp_ns = seconds * kNsPerSecond + nanoseconds;
    return {ToSeconds(stamp_ns), stamp_ns};
  }

  const MessageSchema& schema_;
  bool is_cdr_, is_big_endian_ = false;
  std::string_view bytes_;
  std::size_t at_ = 0;
  std::vector<MessageCell>* cells_;
  /// receives the frames of a transform
  std::pair<std::string_view, std::string_view>* frames_ = nullptr;
  std::vector<std::string>* pairs_ = nullptr;
};

void MessageReader::Read(std::string_view message, std::vector<MessageCell>* cells) const {
  cells->assign(is_stamp_.size(), MessageCell{});
  Walk walk(schema_, message, cells);
  walk.Message(schema_.root(), root_.get());
  walk.RequireEnd();
}

std::vector<std::string> MessageReader::Labels(std::string_view message) const {
  std::vector<MessageCell> none;
  Node labelled;
  labelled.has_labels = true;
  const auto labels = Walk(schema_, message, &none).Message(schema_.root(), &labelled);
  return {labels.begin(), labels.end()};
}

std::vector<std::string> MessageReader::FramePairs(std::string_view message) const {
  std::vector<MessageCell> none;
  std::vector<std::string> pairs;
  Walk walk(schema_, message, &none);
  walk.CollectPairs(&pairs);
  walk.Message(schema_.root(), nullptr);
  return pairs;
}

}  // namespace tera
