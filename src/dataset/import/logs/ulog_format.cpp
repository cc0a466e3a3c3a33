#include "dataset/import/logs/ulog_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "dataset/import/bag/byte_cursor.h"
#include "dataset/import/logs/number_table.h"

namespace tera {
namespace {

constexpr int kDeepest = 16;
constexpr std::size_t kLongestPath = 512;  // length limit of a field's path
constexpr std::size_t kMostBytes = 65536;  // size limit of a message

struct BasicType {
  std::string_view name;
  std::size_t bytes;
  double (*read)(std::string_view bytes, std::size_t at);
};
template <typename T>
double ReadNumber(std::string_view bytes, std::size_t at) {
  return static_cast<double>(UlogNumberAt<T>(bytes, at));
}
constexpr std::array<BasicType, 12> kTypes = {{{"int8_t", 1, ReadNumber<std::int8_t>},
                                               {"uint8_t", 1, ReadNumber<std::uint8_t>},
                                               {"int16_t", 2, ReadNumber<std::int16_t>},
                                               {"uint16_t", 2, ReadNumber<std::uint16_t>},
                                               {"int32_t", 4, ReadNumber<std::int32_t>},
                                               {"uint32_t", 4, ReadNumber<std::uint32_t>},
                                               {"int64_t", 8, ReadNumber<std::int64_t>},
                                               {"uint64_t", 8, ReadNumber<std::uint64_t>},
                                               {"float", 4, ReadNumber<float>},
                                               {"double", 8, ReadNumber<double>},
                                               {"bool", 1, ReadNumber<std::uint8_t>},
                                               {"char", 1, ReadNumber<std::int8_t>}}};

const BasicType* BasicOf(std::string_view name) {
  const auto found = std::find_if(kTypes.begin(), kTypes.end(),
                                  [&](const BasicType& t) { return t.name == name; });
  return found != kTypes.end() ? &*found : nullptr;
}

bool IsPadding(const std::string& path) {
  return path.starts_with("_padding") || path.find("._padding") != std::string::npos;
}

/// Array length: 3 for "float[3]"; 0 if invalid.
std::size_t LengthOf(std::string_view type, std::size_t bracket) {
  const auto length = WholeNumber(type.substr(bracket + 1, type.find(']') - bracket - 1));
  return length && *length >= 1 && *length <= kMostBytes ? static_cast<std::size_t>(*length) : 0;
}

}  // namespace

/// Numeric fields of a message found so far, and their size in bytes.
struct UlogFormats::Layout {
  std::vector<UlogNumber> numbers;
  std::size_t offset = 0, elements = 0;
};

void UlogFormats::Define(std::string_view text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) throw BadBytes{"has a format without a name"};
  fields_of_[std::string(text.substr(0, colon))] = text.substr(colon + 1);
}

std::vector<UlogNumber> UlogFormats::NumbersOf(const std::string& format) const {
  Layout layout;
  AddFormat(format, "", 0, &layout);
  return std::move(layout.numbers);
}

void UlogFormats::AddFormat(const std::string& format, const std::string& above, int depth,
                            Layout* layout) const {
  const auto fields = fields_of_.find(format);
  if (fields == fields_of_.end()) throw BadBytes{"has no definition of " + format};
  if (depth > kDeepest) throw BadBytes{"has a format that holds itself, " + format};
  for (const std::string_view field : FieldsOf(fields->second, ';')) {
    if (field.empty()) continue;
    const std::size_t blank = field.find(' ');
    if (blank == std::string_view::npos) throw BadBytes{"has a field without a name"};
    AddField(field.substr(0, blank), above + std::string(field.substr(blank + 1)), depth, layout);
  }
}

void UlogFormats::AddField(std::string_view type, const std::string& path, int depth,
                           Layout* layout) const {
  std::size_t count = 1;
  const std::size_t bracket = type.find('[');
  const bool is_array = bracket != std::string_view::npos;
  if (is_array) {
    count = LengthOf(type, bracket);
    if (count == 0) throw BadBytes{"has an array without a length, " + path};
    type = type.substr(0, bracket);
  }
  if (path.size() > kLongestPath) throw BadBytes{"has a field with an invalid name"};
  const BasicType* const basic = BasicOf(type);
  for (std::size_t k = 0; k < count; ++k) {
    const std::string element = is_array ? fmt::format("{}[{}]", path, k) : path;
    if (basic == nullptr) {
      AddFormat(std::string(type), element + ".", depth + 1, layout);
    } else {
      if (!IsPadding(path)) {
        layout->numbers.push_back({element, layout->offset, basic->bytes, basic->read});
      }
      layout->offset += basic->bytes;
    }
    if (layout->offset > kMostBytes || ++layout->elements > kMostBytes) {
      throw BadBytes{"has a format that no message can hold, " + path};
    }
  }
}

}  // namespace tera
