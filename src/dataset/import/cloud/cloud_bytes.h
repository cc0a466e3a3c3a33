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

/// Parse the content of a whole file. Throw InputError for an invalid file. The caller must check
/// for an empty cloud.
PointCloud ParsePcd(const std::filesystem::path& file, std::string_view bytes);
PointCloud ParsePly(const std::filesystem::path& file, std::string_view bytes);
PointCloud ParseLas(const std::filesystem::path& file, std::string_view bytes);

[[noreturn]] inline void RefuseCloud(const std::filesystem::path& file,
                                     const std::string& finding) {
  throw InputError(fmt::format("{}: {}", file.string(), finding));
}

/// Largest accepted number of points, which takes 2.4 GB as PointCloud.
inline constexpr std::uint64_t kMostCloudPoints = 100'000'000;

/// Throws InputError if the number of points exceeds kMostCloudPoints.
inline void RequirePointCount(const std::filesystem::path& file, std::uint64_t count) {
  if (count > kMostCloudPoints) {
    RefuseCloud(file, fmt::format("{} points declared, need at most {}; thin the cloud, cut out "
                                  "the site, or write the file again if this number is wrong",
                                  count, kMostCloudPoints));
  }
}

/// Adds a point. A point that is not finite is only counted.
inline void AddPoint(const Vec3& p_m, PointCloud* cloud) {
  if (p_m.allFinite()) {
    cloud->p_m.push_back(p_m);
  } else {
    ++cloud->without_place;
  }
}

/// Number at the beginning of `bytes` in native byte order, or in reversed order if `swapped`.
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
