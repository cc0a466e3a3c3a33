#include "dataset/import/suggest/suggest.h"
#include "untrusted_file.h"

// A first mapping of an undescribed table or bag.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto suggest = [](const std::filesystem::path& file) { tera::SuggestMapping(file); };
  tera::ReadAsFile("log.csv", data, size, suggest);
  return tera::ReadAsFile("log.mcap", data, size, suggest);
}
