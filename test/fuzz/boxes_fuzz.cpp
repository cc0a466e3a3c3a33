#include "dataset/format/object_boxes.h"
#include "untrusted_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return tera::ReadAsFile("0.json", data, size, tera::ReadBoxes);
}
