#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tera {

/// A numeric property of a vertex.
struct PlyProperty {
  std::string name;
  char type = 'F';  ///< F floating, U unsigned, I signed
  std::size_t bytes = 4, at = 0;
};

/// Vertices of a PLY file, as described by the header.
struct PlyVertices {
  std::string form;  ///< ascii, binary_little_endian or binary_big_endian
  std::uint64_t count = 0;
  std::size_t record_bytes = 0;
  std::vector<PlyProperty> properties;
  std::size_t body = 0;  ///< offset of the vertices in the file
};

/// Reads the header of a PLY file. Throws InputError if there is no valid header, if vertices are
/// not the first element, if they have list properties, or if they lack x, y or z.
PlyVertices ReadPlyHeader(const std::filesystem::path& file, std::string_view bytes);

}  // namespace tera
