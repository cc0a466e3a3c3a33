#include "dataset/import/cloud/read_point_cloud.h"
#include "untrusted_file.h"

// Point clouds for `tera site` and `tera register`. The input's first byte chooses the format,
// otherwise given by the file name.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  constexpr const char* kNames[] = {"a.pcd", "a.ply", "a.las"};
  return tera::ReadAsFile(kNames[data[0] % 3], data + 1, size - 1, tera::ReadPointCloud);
}
