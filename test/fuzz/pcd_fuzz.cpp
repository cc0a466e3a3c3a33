#include "dataset/format/pcd.h"
#include "untrusted_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return tera::ReadAsFile("scan.pcd", data, size, tera::ReadPcd);
}
