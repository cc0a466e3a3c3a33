#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tera {

/// One number of a vertex.
struct PlyProperty {
  std::string name;
  char type = 'F';  ///< F floating, U unsigned, I signed
  std::size_t bytes = 4, at = 0;
};

/// The vertices of a PLY file, as its header describes them.
struct PlyVertices {
  std::string form;  ///< ascii, binary_little_endian or binary_big_endian
  std::uint64_t count = 0;
  std::size_t record_bytes = 0;
  std::vector<PlyProperty> properties;
  std::size_t body = 0;  ///< offset in the file
};

/// Reads a PLY file's header. Throws InputError if it has none, if its format is another, or if its
/// vertices do not come first, have other than numbers, or lack x, y or z.
PlyVertices ReadPlyHeader(const std::filesystem::path& file, std::string_view bytes);

}  // namespace tera
