#pragma once

#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace tera {

/// A number within the messages of a format.
struct UlogNumber {
  std::string path;  ///< "gyro_rad[0]", "esc[2].rpm"
  std::size_t offset = 0, bytes = 0;
  double (*read)(std::string_view bytes, std::size_t at) = nullptr;
};

/// A number in bytes, low byte first; `bytes` must be long enough.
template <typename T>
T UlogNumberAt(std::string_view bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

/// The formats that a log defines: "name:type field;type[length] field;...", where a type may be
/// another format.
class UlogFormats {
 public:
  /// Throws BadBytes for a definition without a name.
  void Define(std::string_view text);
  /// All numbers of a format at any nesting, without padding. Throws BadBytes for an unknown or
  /// recursive format, and for one larger than a message.
  std::vector<UlogNumber> NumbersOf(const std::string& format) const;

 private:
  struct Layout;
  void AddFormat(const std::string& format, const std::string& above, int depth,
                 Layout* layout) const;
  void AddField(std::string_view type, const std::string& path, int depth, Layout* layout) const;

  std::map<std::string, std::string, std::less<>> fields_of_;
};

}  // namespace tera
