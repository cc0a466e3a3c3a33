#include "dataset/import/cloud/read_point_cloud.h"

#include <fmt/format.h>

#include <string_view>

#include "core/config/spelling.h"
#include "dataset/files/checked_file.h"
#include "dataset/import/cloud/cloud_bytes.h"
#include "dataset/import/foreign_file.h"

namespace tera {
namespace {

/// Throws InputError for other formats such as placeholders, archives and captures, independent of
/// the file name.
void RefuseOtherForms(const std::filesystem::path& file, std::string_view bytes) {
  for (const std::string_view own : {"LASF", "ply", "# .PCD", "VERSION"}) {
    if (bytes.starts_with(own)) return;
  }
  if (const auto kind = ForeignFileOf(bytes, file)) {
    RefuseCloud(file, fmt::format("is {}; need a point cloud as .pcd, .ply or .las; {}", kind->name,
                                  kind->remedy));
  }
}

PointCloud Parse(const std::filesystem::path& file) {
  const std::string ending = LowerCase(file.extension().string());
  const std::string bytes = ReadWholeFile(file);
  RefuseOtherForms(file, bytes);
  if (ending == ".laz") {
    RefuseCloud(file, "LAZ is compressed; write it as LAS first, e.g. with pdal translate");
  }
  if (ending == ".pcd") return ParsePcd(file, bytes);
  if (ending == ".ply") return ParsePly(file, bytes);
  if (ending == ".las") return ParseLas(file, bytes);
  RefuseCloud(file,
              fmt::format("'{}' is an unknown extension of a point cloud; need .pcd, .ply or .las",
                          ending));
}

}  // namespace

PointCloud ReadPointCloud(const std::filesystem::path& file) {
  PointCloud cloud = Parse(file);
  if (cloud.p_m.empty()) {
    RefuseCloud(file, fmt::format("no point is usable ({} without finite coordinates, {} marked as "
                                  "noise or withheld); need a file with points",
                                  cloud.without_place, cloud.marked));
  }
  return cloud;
}

}  // namespace tera
