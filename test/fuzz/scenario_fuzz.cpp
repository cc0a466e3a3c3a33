#include "sim/scenario/load_scenario.h"
#include "untrusted_file.h"

// A whole scenario that uses the project's own machines, rigs and meshes.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return tera::ReadAsFile("a.yaml", data, size, [](const std::filesystem::path& file) {
    tera::LoadScenario(file, {}, {});
  });
}
