#include "dataset/import/cloud/ply_header.h"

#include <algorithm>
#include <array>
#include <sstream>

#include "core/error.h"
#include "core/parse_number.h"
#include "dataset/import/cloud/cloud_bytes.h"

namespace tera {
namespace {

struct ScalarName {
  std::string_view name;
  char type;
  std::size_t bytes;
};

constexpr std::array<ScalarName, 16> kScalars = {{{"char", 'I', 1},
                                                  {"int8", 'I', 1},
                                                  {"uchar", 'U', 1},
                                                  {"uint8", 'U', 1},
                                                  {"short", 'I', 2},
                                                  {"int16", 'I', 2},
                                                  {"ushort", 'U', 2},
                                                  {"uint16", 'U', 2},
                                                  {"int", 'I', 4},
                                                  {"int32", 'I', 4},
                                                  {"uint", 'U', 4},
                                                  {"uint32", 'U', 4},
                                                  {"float", 'F', 4},
                                                  {"float32", 'F', 4},
                                                  {"double", 'F', 8},
                                                  {"float64", 'F', 8}}};

class PlyHeaderReader {
 public:
  PlyHeaderReader(const std::filesystem::path& file, std::string_view bytes)
      : file_(file), bytes_(bytes) {}

  PlyVertices Read() {
    if (NextLine() != "ply") Refuse("does not begin with 'ply', the signature of PLY");
    for (std::string line = NextLine(); line != "end_header"; line = NextLine()) Take(line);
    vertices_.body = at_;
    if (std::ranges::find(kForms, vertices_.form) == kForms.end()) {
      Refuse(
          fmt::format("its format is '{}', need ascii, binary_little_endian or "
                      "binary_big_endian",
                      vertices_.form));
    }
    if (element_ == 0) Refuse("has no element vertex");
    for (const char* axis : {"x", "y", "z"}) {
      if (std::none_of(vertices_.properties.begin(), vertices_.properties.end(),
                       [&](const PlyProperty& one) { return one.name == axis; })) {
        Refuse(fmt::format("its vertices have no property '{}'; need x, y and z", axis));
      }
    }
    return vertices_;
  }

 private:
  static constexpr std::size_t kLongestHeader = 1 << 16;
  static constexpr std::array<std::string_view, 3> kForms = {"ascii", "binary_little_endian",
                                                             "binary_big_endian"};

  [[noreturn]] void Refuse(const std::string& finding) const {
    throw InputError(file_.string(), {FaultKind::kMalformed, finding});
  }

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
    vertices_.properties.push_back({name, scalar->type, scalar->bytes, vertices_.record_bytes});
    vertices_.record_bytes += scalar->bytes;
  }

  const std::filesystem::path& file_;
  std::string_view bytes_;
  std::size_t at_ = 0;
  int element_ = 0;
  PlyVertices vertices_;
};

}  // namespace

PlyVertices ReadPlyHeader(const std::filesystem::path& file, std::string_view bytes) {
  return PlyHeaderReader(file, bytes).Read();
}

}  // namespace tera
