#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/error.h"
#include "dataset/import/cloud/point_cloud.h"

namespace tera {

/// The formats that ReadPointCloud knows, each from the bytes of a whole file. They throw
/// InputError, and leave it to the caller to find that no point is left.
PointCloud ParsePcd(const std::filesystem::path& file, std::string_view bytes);
PointCloud ParsePly(const std::filesystem::path& file, std::string_view bytes);
PointCloud ParseLas(const std::filesystem::path& file, std::string_view bytes);

/// Throws the InputError of a file that cannot be used.
[[noreturn]] inline void RefuseCloud(const std::filesystem::path& file,
                                     const std::string& finding) {
  throw InputError(fmt::format("{}: {}", file.string(), finding));
}

/// Most points of a file: 2.4 GB as PointCloud.
inline constexpr std::uint64_t kMostCloudPoints = 100'000'000;

/// Refuses a number of points that is more than can be read.
inline void RequirePointCount(const std::filesystem::path& file, std::uint64_t count) {
  if (count > kMostCloudPoints) {
    RefuseCloud(file, fmt::format("{} points declared, need at most {}; thin it or cut out the "
                                  "site, or write the file again if that is no true number",
                                  count, kMostCloudPoints));
  }
}

/// Adds a point, or counts it where it has no place.
inline void AddPoint(const Vec3& p_m, PointCloud* cloud) {
  if (p_m.allFinite()) {
    cloud->p_m.push_back(p_m);
  } else {
    ++cloud->without_place;
  }
}

/// A number as it lies in memory, at the beginning of `bytes`; of another byte order, `swapped`.
template <typename T>
T NumberAt(const char* bytes, bool swapped = false) {
  static_assert(std::endian::native == std::endian::little);
  char ordered[sizeof(T)];
  std::memcpy(ordered, bytes, sizeof(T));
  if (swapped) std::reverse(ordered, ordered + sizeof(T));
  T value;
  std::memcpy(&value, ordered, sizeof(T));
  return value;
}

}  // namespace tera
