#pragma once

#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace tera {

/// A numeric field in the messages of a ULog format.
struct UlogNumber {
  std::string path;  ///< such as "gyro_rad[0]" or "esc[2].rpm"
  std::size_t offset = 0, bytes = 0;
  double (*read)(std::string_view bytes, std::size_t at) = nullptr;
};

/// Number at byte `at`, low byte first. `bytes` must be long enough.
template <typename T>
T UlogNumberAt(std::string_view bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

/// Message formats that a log defines, such as "name:type field;type[length] field;...". A type may
/// be another format.
class UlogFormats {
 public:
  /// Throws BadBytes for a definition without a name.
  void Define(std::string_view text);
  /// All numeric fields of a format, including those of nested formats, without padding. Throws
  /// BadBytes for an unknown or recursive format, and for a format larger than a message.
  std::vector<UlogNumber> NumbersOf(const std::string& format) const;

 private:
  struct Layout;
  void AddFormat(const std::string& format, const std::string& above, int depth,
                 Layout* layout) const;
  void AddField(std::string_view type, const std::string& path, int depth, Layout* layout) const;

  std::map<std::string, std::string, std::less<>> fields_of_;
};

}  // namespace tera
