#include <array>
#include <sstream>
#include <vector>

#include "dataset/import/cloud/cloud_bytes.h"
#include "dataset/import/cloud/ply_header.h"

// Reads vertices of PLY files.

namespace tera {
namespace {

double ValueAt(const PlyProperty& property, const char* bytes, bool swapped) {
  const bool is_signed = property.type == 'I';
  if (property.type == 'F') {
    return property.bytes == sizeof(float) ? static_cast<double>(NumberAt<float>(bytes, swapped))
                                           : NumberAt<double>(bytes, swapped);
  }
  if (property.bytes == 1) {
    return is_signed ? NumberAt<std::int8_t>(bytes) : NumberAt<std::uint8_t>(bytes);
  }
  if (property.bytes == 2) {
    return is_signed ? NumberAt<std::int16_t>(bytes, swapped)
                     : NumberAt<std::uint16_t>(bytes, swapped);
  }
  return is_signed ? static_cast<double>(NumberAt<std::int32_t>(bytes, swapped))
                   : static_cast<double>(NumberAt<std::uint32_t>(bytes, swapped));
}

/// Indices of the properties x, y and z; the last one counts if a name repeats.
std::array<std::size_t, 3> AxesOf(const PlyVertices& vertices) {
  std::array<std::size_t, 3> axes{};
  for (std::size_t k = 0; k < vertices.properties.size(); ++k) {
    const std::string& name = vertices.properties[k].name;
    if (name == "x") axes[0] = k;
    if (name == "y") axes[1] = k;
    if (name == "z") axes[2] = k;
  }
  return axes;
}

void ReadBinary(const std::filesystem::path& file, const PlyVertices& vertices,
                std::string_view body, PointCloud* cloud) {
  const bool swapped = vertices.form == "binary_big_endian";
  const std::uint64_t need = vertices.count * vertices.record_bytes;
  if (body.size() < need) {
    RefuseCloud(file, fmt::format("cut off: its vertices need {} bytes, {} are there; copy the "
                                  "file again",
                                  need, body.size()));
  }
  const std::array<std::size_t, 3> axes = AxesOf(vertices);
  for (std::uint64_t k = 0; k < vertices.count; ++k) {
    const char* record = body.data() + k * vertices.record_bytes;
    Vec3 p_m;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const PlyProperty& of = vertices.properties[axes[axis]];
      p_m[static_cast<int>(axis)] = ValueAt(of, record + of.at, swapped);
    }
    AddPoint(p_m, cloud);
  }
}

void ReadAscii(const std::filesystem::path& file, const PlyVertices& vertices,
               std::string_view body, PointCloud* cloud) {
  const std::array<std::size_t, 3> axes = AxesOf(vertices);
  std::istringstream words{std::string(body)};
  std::vector<std::string> row(vertices.properties.size());
  for (std::uint64_t k = 0; k < vertices.count; ++k) {
    for (std::string& word : row) {
      if (words >> word) continue;
      RefuseCloud(file, fmt::format("cut off: {} vertices declared, {} are there; copy the file "
                                    "again",
                                    vertices.count, k));
    }
    Vec3 p_m;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::string& word = row[axes[axis]];
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
  const PlyVertices vertices = ReadPlyHeader(file, bytes);
  const std::string_view body = bytes.substr(vertices.body);
  PointCloud cloud;
  if (vertices.form == "ascii") {
    ReadAscii(file, vertices, body, &cloud);
  } else {
    ReadBinary(file, vertices, body, &cloud);
  }
  return cloud;
}

}  // namespace tera
