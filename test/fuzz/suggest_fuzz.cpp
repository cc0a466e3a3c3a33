#include "dataset/import/suggest/suggest.h"
#include "untrusted_file.h"

// A first mapping of a table or a bag that nobody has described.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  tera::ReadAsFile("log.csv", data, size, tera::SuggestMapping);
  return tera::ReadAsFile("log.mcap", data, size, tera::SuggestMapping);
}
