#include <array>
#include <optional>
#include <sstream>
#include <vector>

#include "core/parse_number.h"
#include "dataset/import/cloud/cloud_bytes.h"

// Vertices of PLY files.

namespace tera {
namespace {

enum class Scalar { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

struct ScalarName {
  std::string_view name;
  Scalar scalar;
  std::uint64_t bytes;
};

constexpr std::array<ScalarName, 16> kScalars = {{{"char", Scalar::kInt8, 1},
                                                  {"int8", Scalar::kInt8, 1},
                                                  {"uchar", Scalar::kUint8, 1},
                                                  {"uint8", Scalar::kUint8, 1},
                                                  {"short", Scalar::kInt16, 2},
                                                  {"int16", Scalar::kInt16, 2},
                                                  {"ushort", Scalar::kUint16, 2},
                                                  {"uint16", Scalar::kUint16, 2},
                                                  {"int", Scalar::kInt32, 4},
                                                  {"int32", Scalar::kInt32, 4},
                                                  {"uint", Scalar::kUint32, 4},
                                                  {"uint32", Scalar::kUint32, 4},
                                                  {"float", Scalar::kFloat, 4},
                                                  {"float32", Scalar::kFloat, 4},
                                                  {"double", Scalar::kDouble, 8},
                                                  {"float64", Scalar::kDouble, 8}}};

double ValueAt(Scalar scalar, const char* bytes, bool swapped) {
  switch (scalar) {
    case Scalar::kInt8:
      return NumberAt<std::int8_t>(bytes);
    case Scalar::kUint8:
      return NumberAt<std::uint8_t>(bytes);
    case Scalar::kInt16:
      return NumberAt<std::int16_t>(bytes, swapped);
    case Scalar::kUint16:
      return NumberAt<std::uint16_t>(bytes, swapped);
    case Scalar::kInt32:
      return NumberAt<std::int32_t>(bytes, swapped);
    case Scalar::kUint32:
      return NumberAt<std::uint32_t>(bytes, swapped);
    case Scalar::kFloat:
      return NumberAt<float>(bytes, swapped);
    case Scalar::kDouble:
      break;
  }
  return NumberAt<double>(bytes, swapped);
}

/// The header's description of the vertices.
struct Vertices {
  std::string form;  ///< ascii, binary_little_endian or binary_big_endian
  std::uint64_t count = 0, properties = 0, record_bytes = 0;
  struct Axis {
    Scalar scalar = Scalar::kFloat;
    std::uint64_t offset = 0, column = 0;
  };
  std::array<std::optional<Axis>, 3> axes;
  std::size_t body = 0;  ///< offset in the file
};

class PlyHeaderReader {
 public:
  PlyHeaderReader(const std::filesystem::path& file, std::string_view bytes)
      : file_(file), bytes_(bytes) {}

  Vertices Read() {
    if (NextLine() != "ply") Refuse("does not begin as a PLY file does; need 'ply'");
    for (std::string line = NextLine(); line != "end_header"; line = NextLine()) Take(line);
    vertices_.body = at_;
    if (element_ == 0) Refuse("has no element vertex");
    for (int axis = 0; axis < 3; ++axis) {
      if (!vertices_.axes[static_cast<std::size_t>(axis)]) {
        Refuse(fmt::format("its vertices have no property '{}'; need x, y and z", "xyz"[axis]));
      }
    }
    return vertices_;
  }

 private:
  static constexpr std::size_t kLongestHeader = 1 << 16;

  [[noreturn]] void Refuse(const std::string& finding) const { RefuseCloud(file_, finding); }

  std::string NextLine() {
    const std::size_t end = bytes_.find('\n', at_);
    if (end == std::string_view::npos || at_ > kLongestHeader) {
      Refuse(
          "need a PLY header that ends in a line end_header; it may be another format or cut "
          "off");
    }
    std::string line(bytes_.substr(at_, end - at_));
    at_ = end + 1;
    if (line.ends_with('\r')) line.pop_back();
    return line;
  }

  void Take(const std::string& line) {
    std::istringstream words(line);
    std::string key, first, second;
    words >> key >> first >> second;
    if (key == "format") vertices_.form = first;
    if (key == "element") {
      if (element_ == 0 && first != "vertex") {
        Refuse(fmt::format("element '{}' comes before its vertices; write vertices first", first));
      }
      if (++element_ == 1) vertices_.count = Whole(second);
    }
    if (key == "property" && element_ == 1) TakeProperty(first, second);
  }

  std::uint64_t Whole(const std::string& word) const {
    const auto value = ParseNumber<std::uint64_t>(word);
    if (!value) {
      Refuse(fmt::format("found '{}' as the number of its vertices", word));
    }
    RequirePointCount(file_, *value);
    return *value;
  }

  void TakeProperty(const std::string& type, const std::string& name) {
    const auto scalar = std::find_if(kScalars.begin(), kScalars.end(),
                                     [&](const ScalarName& known) { return known.name == type; });
    if (scalar == kScalars.end()) {
      Refuse(fmt::format("its vertices have a property of type '{}', need numbers", type));
    }
    const std::size_t axis = std::string_view("xyz").find(name);
    if (name.size() == 1 && axis != std::string_view::npos) {
      vertices_.axes[axis] = {scalar->scalar, vertices_.record_bytes, vertices_.properties};
    }
    vertices_.record_bytes += scalar->bytes;
    ++vertices_.properties;
  }

  const std::filesystem::path& file_;
  std::string_view bytes_;
  std::size_t at_ = 0;
  int element_ = 0;
  Vertices vertices_;
};

void ReadBinary(const std::filesystem::path& file, const Vertices& vertices, std::string_view body,
                PointCloud* cloud) {
  const bool swapped = vertices.form == "binary_big_endian";
  const std::uint64_t need = vertices.count * vertices.record_bytes;
  if (body.size() < need) {
    RefuseCloud(file, fmt::format("cut off: its vertices need {} bytes, {} are there; copy the "
                                  "file again",
                                  need, body.size()));
  }
  for (std::uint64_t k = 0; k < vertices.count; ++k) {
    const char* record = body.data() + k * vertices.record_bytes;
    Vec3 p_m;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Vertices::Axis& of = *vertices.axes[axis];
      p_m[static_cast<int>(axis)] = ValueAt(of.scalar, record + of.offset, swapped);
    }
    AddPoint(p_m, cloud);
  }
}

void ReadAscii(const std::filesystem::path& file, const Vertices& vertices, std::string_view body,
               PointCloud* cloud) {
  std::istringstream words{std::string(body)};
  std::vector<std::string> row(vertices.properties);
  for (std::uint64_t k = 0; k < vertices.count; ++k) {
    for (std::string& word : row) {
      if (words >> word) continue;
      RefuseCloud(file, fmt::format("cut off: {} vertices declared, {} are there; copy the file "
                                    "again",
                                    vertices.count, k));
    }
    Vec3 p_m;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::string& word = row[vertices.axes[axis]->column];
      char* end = nullptr;
      p_m[static_cast<int>(axis)] = std::strtod(word.c_str(), &end);
      if (*end != '\0') {
        RefuseCloud(file, fmt::format("vertex {} has '{}' where a number is needed", k + 1, word));
      }
    }
    AddPoint(p_m, cloud);
  }
}

}  // namespace

PointCloud ParsePly(const std::filesystem::path& file, std::string_view bytes) {
  const Vertices vertices = PlyHeaderReader(file, bytes).Read();
  const std::string_view body = bytes.substr(vertices.body);
  PointCloud cloud;
  if (vertices.form == "ascii") {
    ReadAscii(file, vertices, body, &cloud);
  } else if (vertices.form == "binary_little_endian" || vertices.form == "binary_big_endian") {
    ReadBinary(file, vertices, body, &cloud);
  } else {
    RefuseCloud(file, fmt::format("its format is '{}', need ascii, binary_little_endian or "
                                  "binary_big_endian",
                                  vertices.form));
  }
  return cloud;
}

}  // namespace tera
