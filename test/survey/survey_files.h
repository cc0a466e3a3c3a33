#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/motion.h"

/// Files of points, written byte by byte by their formats' descriptions.
namespace testing_survey {

template <typename T>
void Append(T value, std::string* bytes) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes->append(raw, sizeof(T));
}

inline void WriteBytes(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

/// PLY, binary little-endian, doubles.
inline std::string PlyOf(const std::vector<tera::Vec3>& p_m) {
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                      std::to_string(p_m.size()) +
                      "\nproperty double x\nproperty double y\nproperty double z\nend_header\n";
  for (const tera::Vec3& p : p_m) {
    for (const double value : p) Append(value, &bytes);
  }
  return bytes;
}

/// LAS 1.2 of point format 0 in millimetres about `offset_m`, its projected system named by the
/// GeoTIFF key 3072.
inline std::string LasOf(const std::vector<tera::Vec3>& p_m, const tera::Vec3& offset_m,
                         std::uint16_t epsg) {
  std::string bytes = "LASF";
  bytes.append(20, '\0');
  bytes += {'\1', '\2'};
  bytes.append(64 + 4, '\0');
  Append(std::uint16_t{227}, &bytes);
  Append(std::uint32_t{227 + 54 + 16}, &bytes);
  Append(std::uint32_t{1}, &bytes);
  Append(std::uint8_t{0}, &bytes);
  Append(std::uint16_t{20}, &bytes);
  Append(static_cast<std::uint32_t>(p_m.size()), &bytes);
  bytes.append(5 * 4, '\0');
  for (int axis = 0; axis < 3; ++axis) Append(0.001, &bytes);
  for (const double value : offset_m) Append(value, &bytes);
  bytes.append(6 * 8, '\0');
  // One variable length record: a directory with one key.
  bytes.append(2, '\0');
  std::string user = "LASF_Projection";
  user.resize(16, '\0');
  bytes += user;
  Append(std::uint16_t{34735}, &bytes);
  Append(std::uint16_t{16}, &bytes);
  bytes.append(32, '\0');
  for (const std::uint16_t value : {1, 1, 0, 1, 3072, 0, 1, static_cast<int>(epsg)}) {
    Append(value, &bytes);
  }
  for (const tera::Vec3& p : p_m) {
    for (int axis = 0; axis < 3; ++axis) {
      Append(static_cast<std::int32_t>(std::lround((p[axis] - offset_m[axis]) / 0.001)), &bytes);
    }
    bytes.append(8, '\0');
  }
  return bytes;
}

}  // namespace testing_survey
