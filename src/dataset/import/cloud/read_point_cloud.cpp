#include "dataset/import/cloud/read_point_cloud.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "dataset/files/checked_file.h"
#include "dataset/import/cloud/cloud_bytes.h"

namespace tera {
namespace {

std::string EndingOf(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

PointCloud Parse(const std::filesystem::path& file) {
  const std::string ending = EndingOf(file);
  if (ending == ".laz") {
    RefuseCloud(file, "LAZ is compressed; write it as LAS first, e.g. with pdal translate");
  }
  if (ending != ".pcd" && ending != ".ply" && ending != ".las") {
    RefuseCloud(file, fmt::format("'{}' is no ending of a point cloud that is known; need .pcd, "
                                  ".ply or .las",
                                  ending));
  }
  const std::string bytes = ReadWholeFile(file);
  if (ending == ".pcd") return ParsePcd(file, bytes);
  return ending == ".ply" ? ParsePly(file, bytes) : ParseLas(file, bytes);
}

}  // namespace

PointCloud ReadPointCloud(const std::filesystem::path& file) {
  PointCloud cloud = Parse(file);
  if (cloud.p_m.empty()) {
    RefuseCloud(file, fmt::format("no point has a place ({} without finite coordinates, {} marked "
                                  "as noise or withheld); need a file with points",
                                  cloud.without_place, cloud.marked));
  }
  return cloud;
}

}  // namespace tera
