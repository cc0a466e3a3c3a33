#include "dataset/export/picture/labelled_frame.h"
#include "dataset/format/png.h"
#include "untrusted_file.h"

// A picture as colour, class, depth and flow; its size, and its bytes as exports copy them.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  tera::ReadAsFile("0.png", data, size, tera::ReadRgbPng);
  tera::ReadAsFile("0.png", data, size, tera::ReadGreyPng);
  tera::ReadAsFile("0.png", data, size, tera::ReadGrey16Png);
  tera::ReadAsFile("0.png", data, size, [](const std::filesystem::path& file) {
    tera::Image<std::uint16_t> flow;
    tera::ReadPng(file, 3, &flow);
  });
  tera::ReadAsFile("0.png", data, size, tera::SizeOfPng);
  return tera::ReadAsFile("0.png", data, size, tera::ReadWholePng);
}
