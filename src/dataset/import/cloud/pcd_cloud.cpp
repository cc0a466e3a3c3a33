#include <liblzf/lzf.h>

#include <array>
#include <map>
#include <sstream>
#include <vector>

#include "core/parse_number.h"
#include "dataset/import/cloud/cloud_bytes.h"

// Reads PCD files with any fields.

namespace tera {
namespace {

constexpr std::uint64_t kMostExpanded =
    264;  // largest expansion of LZF: 264 equal bytes compress to three

struct Field {
  std::string name;
  char type = 'F';
  std::uint64_t size = 0, count = 1;
  std::uint64_t offset = 0;  ///< within the record of a point
};

struct Header {
  std::vector<Field> fields;
  std::uint64_t points = 0, record_bytes = 0, columns = 0;
  std::string data;
  std::size_t body = 0;  ///< offset of the points in the file
};

class PcdHeaderReader {
 public:
  PcdHeaderReader(const std::filesystem::path& file, std::string_view bytes)
      : file_(file), bytes_(bytes) {}

  Header Read() {
    std::map<std::string, std::vector<std::string>> entries;
    std::size_t at = 0;
    while (!entries.contains("DATA")) {
      const std::size_t end = bytes_.find('\n', at);
      if (end == std::string_view::npos || at > kLongestHeader) {
        Refuse("need a PCD header that ends in a line DATA; it may be another format or cut off");
      }
      std::istringstream line(std::string(bytes_.substr(at, end - at)));
      at = end + 1;
      std::string key;
      if (!(line >> key) || key.starts_with("#")) continue;
      for (std::string word; line >> word;) entries[key].push_back(word);
      if (!entries.contains(key)) entries[key] = {};
    }
    Header header;
    header.body = at;
    header.data = entries["DATA"].empty() ? "" : entries["DATA"][0];
    ReadFields(entries, &header);
    header.points = PointsOf(entries);
    return header;
  }

 private:
  using Entries = std::map<std::string, std::vector<std::string>>;
  static constexpr std::size_t kLongestHeader = 1 << 16;
  static constexpr std::uint64_t kMostOfAField = 1 << 16;

  [[noreturn]] void Refuse(const std::string& finding) const { RefuseCloud(file_, finding); }

  std::uint64_t Whole(const std::string& key, const std::string& word) const {
    const auto value = ParseNumber<std::uint64_t>(word);
    if (!value) {
      Refuse(fmt::format("found '{}' after {} in its header, need a whole number", word, key));
    }
    return *value;
  }

  void ReadFields(const Entries& entries, Header* header) const {
    const auto of = [&](const char* key) {
      const auto found = entries.find(key);
      return found == entries.end() ? std::vector<std::string>{} : found->second;
    };
    const auto names = of("FIELDS"), sizes = of("SIZE"), types = of("TYPE");
    auto counts = of("COUNT");
    if (counts.empty()) counts.assign(names.size(), "1");
    if (names.empty() || sizes.size() != names.size() || types.size() != names.size() ||
        counts.size() != names.size()) {
      Refuse(
          fmt::format("{} FIELDS, {} SIZE, {} TYPE and {} COUNT in its header, need as many of "
                      "each",
                      names.size(), sizes.size(), types.size(), counts.size()));
    }
    for (std::size_t f = 0; f < names.size(); ++f) {
      Field field{names[f], types[f][0], Whole("SIZE", sizes[f]), Whole("COUNT", counts[f])};
      if (field.size > sizeof(double) || field.count > kMostOfAField) {
        Refuse(fmt::format("field '{}' has {} numbers of {} bytes, need at most {} of 8",
                           field.name, field.count, field.size, kMostOfAField));
      }
      field.offset = header->record_bytes;
      header->record_bytes += field.size * field.count;
      header->columns += field.count;
      header->fields.push_back(field);
    }
  }

  std::uint64_t PointsOf(const Entries& entries) const {
    const auto number = [&](const char* key) -> std::uint64_t {
      const auto found = entries.find(key);
      if (found == entries.end() || found->second.empty()) {
        Refuse(fmt::format("its header has no {}", key));
      }
      return Whole(key, found->second[0]);
    };
    const std::uint64_t width = number("WIDTH"), height = number("HEIGHT");
    RequirePointCount(file_, width);
    RequirePointCount(file_, height);
    const std::uint64_t points = entries.contains("POINTS") ? number("POINTS") : width * height;
    if (points != width * height) {
      Refuse(fmt::format("{} POINTS are not WIDTH {} times HEIGHT {}", points, width, height));
    }
    RequirePointCount(file_, points);
    return points;
  }

  const std::filesystem::path& file_;
  std::string_view bytes_;
};

std::array<Field, 3> PlacesOf(const std::filesystem::path& file, const Header& header) {
  std::array<Field, 3> axes;
  for (int axis = 0; axis < 3; ++axis) {
    const std::string name(1, "xyz"[axis]);
    const auto found = std::find_if(header.fields.begin(), header.fields.end(),
                                    [&](const Field& field) { return field.name == name; });
    if (found == header.fields.end()) {
      RefuseCloud(file, fmt::format("has no field '{}'; need x, y and z", name));
    }
    if (found->type != 'F' || found->count != 1 || (found->size != 4 && found->size != 8)) {
      RefuseCloud(file, fmt::format("field '{}' is {} times {}{}, need one F of 4 or 8 bytes", name,
                                    found->count, found->type, found->size));
    }
    axes[static_cast<std::size_t>(axis)] = *found;
  }
  return axes;
}

double Coordinate(const Field& field, const char* bytes) {
  return field.size == 4 ? static_cast<double>(NumberAt<float>(bytes)) : NumberAt<double>(bytes);
}

void RequireBytes(const std::filesystem::path& file, std::uint64_t found, std::uint64_t need) {
  if (found >= need) return;
  RefuseCloud(file, fmt::format("cut off: its points need {} bytes, {} are there; copy the file "
                                "again",
                                need, found));
}

void ReadBinary(const std::filesystem::path& file, const Header& header, std::string_view body,
                PointCloud* cloud) {
  const auto axes = PlacesOf(file, header);
  RequireBytes(file, body.size(), header.points * header.record_bytes);
  for (std::uint64_t k = 0; k < header.points; ++k) {
    const char* record = body.data() + k * header.record_bytes;
    Vec3 p_m;
    for (int axis = 0; axis < 3; ++axis) {
      const Field& field = axes[static_cast<std::size_t>(axis)];
      p_m[axis] = Coordinate(field, record + field.offset);
    }
    AddPoint(p_m, cloud);
  }
}

/// Reads binary_compressed data: two 32-bit lengths, then LZF data, field by field.
void ReadCompressed(const std::filesystem::path& file, const Header& header, std::string_view body,
                    PointCloud* cloud) {
  const auto axes = PlacesOf(file, header);
  RequireBytes(file, body.size(), 2 * sizeof(std::uint32_t));
  const auto packed = NumberAt<std::uint32_t>(body.data());
  const auto plain = NumberAt<std::uint32_t>(body.data() + sizeof(std::uint32_t));
  body.remove_prefix(2 * sizeof(std::uint32_t));
  RequireBytes(file, body.size(), packed);
  if (plain != header.points * header.record_bytes) {
    RefuseCloud(file, fmt::format("{} points need {} bytes of data, it holds {}; write the file "
                                  "again",
                                  header.points, header.points * header.record_bytes, plain));
  }
  if (plain == 0) return;
  if (plain > kMostExpanded * packed) {
    RefuseCloud(file, "its packed data are damaged; copy the file again");
  }
  std::string columns(plain, '\0');
  if (lzf_decompress(body.data(), packed, columns.data(), plain) != plain) {
    RefuseCloud(file, "its packed data are damaged; copy the file again");
  }
  for (std::uint64_t k = 0; k < header.points; ++k) {
    Vec3 p_m;
    for (int axis = 0; axis < 3; ++axis) {
      const Field& field = axes[static_cast<std::size_t>(axis)];
      p_m[axis] = Coordinate(field, columns.data() + header.points * field.offset + k * field.size);
    }
    AddPoint(p_m, cloud);
  }
}

/// Reads ascii data: one line per point, with one word per number in the order of the fields.
void ReadAscii(const std::filesystem::path& file, const Header& header, std::string_view body,
               PointCloud* cloud) {
  const auto axes = PlacesOf(file, header);
  std::array<std::uint64_t, 3> column{};
  std::uint64_t before = 0;
  for (const Field& field : header.fields) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (axes[axis].offset == field.offset && axes[axis].name == field.name) column[axis] = before;
    }
    before += field.count;
  }
  std::istringstream lines{std::string(body)};
  std::string line;
  for (std::uint64_t k = 0; k < header.points; ++k) {
    if (!std::getline(lines, line)) {
      RefuseCloud(file,
                  fmt::format("cut off: {} points declared, {} are there; copy the file again",
                              header.points, k));
    }
    std::istringstream words(line);
    std::vector<std::string> row;
    for (std::string word; words >> word;) row.push_back(word);
    if (row.size() != header.columns) {
      RefuseCloud(
          file, fmt::format("point {} has {} numbers, need {}", k + 1, row.size(), header.columns));
    }
    Vec3 p_m;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      char* end = nullptr;
      p_m[static_cast<int>(axis)] = std::strtod(row[column[axis]].c_str(), &end);
      if (*end != '\0') {
        RefuseCloud(file, fmt::format("point {} has '{}' where a number is needed", k + 1,
                                      row[column[axis]]));
      }
    }
    AddPoint(p_m, cloud);
  }
}

}  // namespace

PointCloud ParsePcd(const std::filesystem::path& file, std::string_view bytes) {
  const Header header = PcdHeaderReader(file, bytes).Read();
  const std::string_view body = bytes.substr(header.body);
  PointCloud cloud;
  if (header.data == "binary") {
    ReadBinary(file, header, body, &cloud);
  } else if (header.data == "binary_compressed") {
    ReadCompressed(file, header, body, &cloud);
  } else if (header.data == "ascii") {
    ReadAscii(file, header, body, &cloud);
  } else {
    RefuseCloud(file,
                fmt::format("DATA is '{}', need ascii, binary or binary_compressed", header.data));
  }
  return cloud;
}

}  // namespace tera
